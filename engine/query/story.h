// What a run's frames brought, as a stranger is told it: what failed and what was made of that, what was
// reached and missed, which analogy decided, what was learned. One moment a frame, since what happens in one
// frame is seen on one picture.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/query/episode_summary.h"
#include "engine/query/run.h"

namespace aerascope {

// The most telling first.
enum class MomentKind {
  kFailure,       // a prediction about the world did not come true
  kGoalFailed,    // a drive was missed
  kGoalReached,   // a drive was reached
  kAnalogy,       // an analogy made new knowledge
  kStateChanged,  // models were given up, phased out, or are in use again
  kLearned,       // knowledge was made otherwise
  kAside,  // a command was refused, what a veto denies came true, an idea was not had again, the teacher took
           // over
  kStart,  // nothing of the kind
};
inline constexpr std::size_t kMomentKinds = static_cast<std::size_t>(MomentKind::kStart);  // without the last

struct StoryMoment {
  std::size_t frame = 0;                 // position in run.frames()
  MomentKind kind = MomentKind::kStart;  // the most telling thing that happened then
  EventId event;                         // that thing, the first of its kind
  std::vector<std::string> sentences;    // the most telling first
};

// All frames in which something of the kind happened, in order of time. A run without frames has none.
std::vector<StoryMoment> StoryOf(const Run& run, const EpisodeSummary& summary);

// The title of a veto without its being one, and without when its condition held: "release a sphere".
std::string WhatIsVetoed(const Run& run, ModelId veto);
// Whether a model says under which condition another will be wrong.
bool IsVeto(const Run& run, ModelId model);

}  // namespace aerascope
