// The few instants of a run that tell its story: what failed and what was made of it, what was reached and
// missed, which analogy was made, what was learned.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/query/run.h"
#include "engine/query/story.h"

namespace aerascope {

struct KeyMoment {
  Time at;                               // the start of the frame
  MomentKind kind = MomentKind::kStart;  // the most telling thing that happened then
  EventId event;                         // that thing; invalid where nothing telling did
  std::vector<std::string> sentences;    // the most telling first
};

struct KeyStory {
  std::vector<KeyMoment> moments;  // in order of time
  std::size_t left_out = 0;        // further moments of the story
};

// At most `max`, at different times. First and last of a kind come before those between; failures before all
// else. A run in which nothing of the kind happened gives its first and last frame.
KeyStory KeyMomentsOf(const Run& run, std::size_t max);

// What there is to say about these times, in their order; a frame's own sentence where nothing telling
// happened.
KeyStory MomentsAt(const Run& run, const std::vector<Time>& times);

// Only the times, for whoever draws the pictures: with the first and last frame where there are few.
inline constexpr std::size_t kLeastPictures = 3;
std::vector<Time> KeyMoments(const Run& run, std::size_t max);

}  // namespace aerascope
