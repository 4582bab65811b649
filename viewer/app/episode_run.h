// Running an episode with progress for a person, as `run` and `demo` do.
#pragma once

#include <string>

#include "engine/episode/run_episode.h"

namespace aerascope {

Result<RecordedEpisode> RecordWithProgress(const Scenario& scenario, const std::string& path);

// "5 of 5 drives reached in 16 frames; 912 events, digest 0f3c..."
std::string OutcomeText(const RecordedEpisode& episode);

// For CLI11's check(): empty if text is a random seed, else what is wrong with it.
std::string CheckRandomSeed(const std::string& text);

// A file below assets/, found from where the program is, or an error that says where it was looked for.
Result<std::string> FindAsset(const std::string& name);

}  // namespace aerascope
