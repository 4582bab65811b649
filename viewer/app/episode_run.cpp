#include "viewer/app/episode_run.h"

#include <charconv>
#include <filesystem>
#include <limits>

#include "viewer/app/commands.h"
#include "viewer/app/terminal.h"

namespace aerascope {

Result<RecordedEpisode> RecordWithProgress(const Scenario& scenario, const std::string& path) {
  ProgressLine progress;
  return RecordEpisode(scenario, path, ProgramVersion(), [&](const EpisodeProgress& at) {
    const std::string line = ToText(at.time) + "  " + at.doing;
    if (at.doing.empty()) {
      progress.Show(line);
    } else {
      progress.Keep(line);
    }
  });
}

std::string OutcomeText(const RecordedEpisode& episode) {
  const EpisodeOutcome& outcome = episode.outcome;
  return std::to_string(outcome.drives_reached) + " of " + std::to_string(outcome.drives) +
         " drives reached in " + std::to_string(outcome.frames) + " frames; " +
         std::to_string(outcome.events) + " events, digest " + ToText(episode.digest);
}

std::string CheckRandomSeed(const std::string& text) {
  std::int64_t seed = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error == std::errc() && end == text.data() + text.size() && seed >= 0) return "";
  return "expected a whole number from 0 to " + std::to_string(std::numeric_limits<std::int64_t>::max()) +
         ", found '" + text + "'";
}

Result<std::string> FindAsset(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (fs::path folder = program.parent_path(); !error && folder.has_relative_path();
       folder = folder.parent_path()) {
    for (const fs::path& candidate : {folder / "assets" / name, folder / "share" / "aerascope" / name}) {
      if (fs::exists(candidate, error)) return candidate.string();
    }
  }
  return Error{"cannot find assets/" + name + " in any folder above " + program.string() +
               "; run the program from its repository"};
}

}  // namespace aerascope
