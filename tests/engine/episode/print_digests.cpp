// Prints the digest of every scripted scenario in a folder, one a line: print_digests FOLDER.
//
// Built more than once, with the engine at different levels of optimisation; what is printed must not differ.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"
#include "engine/event/digest_sink.h"

namespace aerascope {
namespace {

Status PrintDigest(const std::filesystem::path& path) {
  const auto scenario = LoadScenario(path.string());
  if (!scenario) return scenario.error();
  if (WorldKind(*scenario) != "scripted") return Ok();
  auto world = MakeWorld(*scenario);
  if (!world) return world.error();
  DigestSink sink;
  const auto outcome = RunEpisode(*scenario, world->get(), &sink);
  if (!outcome) return outcome.error();
  std::printf("%s: %lld events, digest %s\n", path.filename().c_str(),
              static_cast<long long>(outcome->events), ToText(sink.Value()).c_str());
  return Ok();
}

int PrintDigests(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    if (const Status status = PrintDigest(path); !status) {
      std::fprintf(stderr, "%s\n", status.error().message.c_str());
      return 1;
    }
  }
  return 0;
}

}  // namespace
}  // namespace aerascope

int main(int count, char** arguments) {
  return count == 2 ? aerascope::PrintDigests(arguments[1]) : 2;
}
