// Moments of a run as users write them.
#pragma once

#include <string>

#include "engine/query/run.h"

namespace aerascope {

// "3.2s", "700ms", "3" (seconds); empty means the end. An error outside the run's time.
Result<Time> ParseMoment(const std::string& text, const Run& run);

// "A.episode" or "A.episode@3.2s": an episode, and the moment of it.
struct EpisodeAt {
  std::string path;
  std::string moment;
};
EpisodeAt SplitEpisodeAt(const std::string& text);

}  // namespace aerascope
