// Moments of a run as users write them.
#pragma once

#include <optional>
#include <string>

#include "engine/query/run.h"

namespace aerascope {

// "3.2s", "700ms", "3" (seconds); the end where no moment is asked for. An error outside the run's time, and
// where a moment is asked for but none is there, as with --at '': a variable of a script was empty.
Result<Time> ParseMoment(const std::optional<std::string>& asked, const Run& run);

// "A.episode" or "A.episode@3.2s": an episode, and the moment of it.
struct EpisodeAt {
  std::string path;
  std::optional<std::string> moment;  // none where there is no @
};
EpisodeAt SplitEpisodeAt(const std::string& text);

}  // namespace aerascope
