// Where the data of a page are from, and what a reader has to know before trusting them.
#pragma once

#include <string>

#include "engine/query/run.h"

namespace aerascope {

// Two lines: "run.episode, 15 s in 15 frames, 1047 events" and "engine 0.1.0, seed 1, digest 3f9c2a1b,
// verified".
std::string ProvenanceOf(const Run& run, const std::string& file_name);

// That the run is incomplete, or that the file was changed after the run; empty where all is well.
std::string WarningAbout(const Run& run);

// "1 piece", "2 pieces".
std::string Plural(std::int64_t count, const std::string& word);

}  // namespace aerascope
