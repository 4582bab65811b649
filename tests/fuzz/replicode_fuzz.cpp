// Any bytes as Replicode: the reader answers, and what it has read is written and read back as the same text.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "engine/replicode/reader.h"
#include "engine/replicode/writer.h"

namespace aerascope {
namespace {

[[noreturn]] void Fail(const std::string& what, const std::string& text) {
  std::fprintf(stderr, "%s\n%s\n", what.c_str(), text.c_str());
  std::abort();
}

void TryRoundTrip(const SeedKnowledge& seed) {
  const Result<std::string> text = WriteReplicode(seed);
  if (!text) Fail("what was read cannot be written: " + text.error().message, "");
  const Result<SeedKnowledge> back = ReadReplicode(*text, "written");
  if (!back) Fail("what was written cannot be read: " + back.error().message, *text);
  const Result<std::string> again = WriteReplicode(*back);
  if (!again) Fail("what was read back cannot be written: " + again.error().message, *text);
  if (*again != *text) Fail("what was read back says something else:\n" + *again, *text);
}

void TryAll(std::string_view text) {
  const Result<SeedKnowledge> seed = ReadReplicode(text, "t");
  if (seed) TryRoundTrip(*seed);
  (void)ReadReplicode(text, "t", {Milliseconds(100), {}, /*foreign=*/true});
  const ReplicodeOptions options{Milliseconds(100), {Term::Entity("h"), Term::Ontology("move")}, false};
  (void)ReadPayload(text, {"t", 1, 1}, options);
}

}  // namespace
}  // namespace aerascope

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  aerascope::TryAll({reinterpret_cast<const char*>(data), size});
  return 0;
}
