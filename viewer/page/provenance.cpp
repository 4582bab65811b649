#include "viewer/page/provenance.h"

#include <vector>

#include "engine/base/text.h"
#include "engine/query/describe.h"

namespace aerascope {
namespace {

Hash128 DigestOf(const Run& run) {
  EventDigest digest;
  for (const Event& event : run.events()) digest.Add(event);
  return digest.Value();
}

std::string DigestText(const Run& run) {
  const Hash128 digest = DigestOf(run);
  const std::string name = "digest " + ToText(digest).substr(0, 8);
  if (!run.complete()) return name + ", incomplete";
  if (!run.stored_digest()) return name;
  return name + (*run.stored_digest() == digest ? ", verified" : ", NOT the one stored");
}

}  // namespace

std::string Plural(std::int64_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

std::string ProvenanceOf(const Run& run, const std::string& file_name) {
  std::string text = file_name.empty() ? "" : Printable(file_name) + ", ";
  text += SecondsText(run.end()) + " in " + Plural(static_cast<std::int64_t>(run.frames().size()), "frame") +
          ", " + Plural(static_cast<std::int64_t>(run.events().size()), "event") + "\n";
  text +=
      "engine " + Printable(run.header().program_version) + ", seed " + std::to_string(run.started().seed);
  return text + ", " + DigestText(run);
}

std::string WarningAbout(const Run& run) {
  std::vector<std::string> sentences;
  if (!run.complete())
    sentences.push_back("This run is incomplete: it stops after event " +
                        std::to_string(run.events().size()) + " at " +
                        SecondsText(run.events().empty() ? Time{} : run.events().back().time) +
                        ". What follows in the world is not known.");
  if (run.complete() && run.stored_digest() && *run.stored_digest() != DigestOf(run))
    sentences.push_back(
        "The events do not give the digest stored with them: the file was changed after the run.");
  return Join(sentences, " ");
}

}  // namespace aerascope
