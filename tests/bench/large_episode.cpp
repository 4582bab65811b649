// Writes a large episode, for measuring what reads it: large_episode OUT.episode [events=N] [models=N]
// [frames=N] [seed=N]. Prints what it has.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "engine/episode/run_episode.h"
#include "tests/support/large_scenario.h"

int main(int argc, char** argv) {
  using namespace aerascope;
  LargeScenarioOptions options;
  std::string path;
  bool understood = true;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::size_t equals = argument.find('=');
    const std::string_view name = argument.substr(0, equals);
    if (equals == std::string_view::npos && path.empty()) {
      path = argument;
      continue;
    }
    const std::int64_t value =
        equals == std::string_view::npos ? 0 : std::strtoll(argv[i] + equals + 1, nullptr, 10);
    if (name == "events" && value > 0)
      options.events = value;
    else if (name == "models" && value > 0)
      options.models = value;
    else if (name == "frames" && value > 0)
      options.frames = value;
    else if (name == "seed" && value >= 0)
      options.seed = static_cast<std::uint64_t>(value);
    else
      understood = false;
  }
  if (path.empty() || !understood) {
    std::fputs("usage: large_episode OUT.episode [events=N] [models=N] [frames=N] [seed=N]\n", stderr);
    return 2;
  }
  const auto scenario = LoadScenarioFromFiles(LargeScenario(options));
  if (!scenario) {
    std::fprintf(stderr, "large_episode: %s\n", scenario.error().message.c_str());
    return 2;
  }
  const auto recorded = RecordEpisode(*scenario, path, "measurement");
  if (!recorded) {
    std::fprintf(stderr, "large_episode: %s\n", recorded.error().message.c_str());
    return 2;
  }
  const EpisodeOutcome& outcome = recorded->outcome;
  std::printf("%s: %lld frames, %lld events, %lld of %lld drives reached\n", path.c_str(),
              static_cast<long long>(outcome.frames), static_cast<long long>(outcome.events),
              static_cast<long long>(outcome.drives_reached), static_cast<long long>(outcome.drives));
  return 0;
}
