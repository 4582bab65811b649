// The few instants of a run that tell its story: what was learned, which analogy was made, what was reached,
// what failed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

enum class MomentKind { kGoalFailed, kGoalReached, kAnalogy, kLearned, kStart };

struct KeyMoment {
  Time at;                               // the start of the frame
  MomentKind kind = MomentKind::kStart;  // the weightiest thing that happened then
  EventId event;                         // that thing; invalid for the start
  std::string caption;                   // one or two sentences
};

// At most `max`, in order of time, at different times. First and last of a kind come before those between;
// failures before all else. A run in which nothing of the kind happened gives its first and last frame.
std::vector<KeyMoment> KeyMomentsOf(const Run& run, std::size_t max);

// What there is to say about these times, in their order; a frame's own sentence where nothing weighty
// happened.
std::vector<KeyMoment> MomentsAt(const Run& run, const std::vector<Time>& times);

// Only the times, for whoever draws the pictures.
std::vector<Time> KeyMoments(const Run& run, std::size_t max);

}  // namespace aerascope
