// Which pictures a report carries: the instants of its stills, the pace of its video.
//
// Short episodes have a sharp still at the start of each frame; in long ones only the moments that matter
// have: what was learned, reached and failed, what was commanded, and a few in between, so that a report
// stays small whatever the length of the episode. The same run and wishes give the same plan.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

struct FilmWishes {
  bool video = true;
  std::optional<int> video_fps{};  // pictures of the video a second; none: by the length of the episode
  std::optional<int> stills_per_second{};  // beside those that matter; none: 0 with a video, 4 without
};

struct FilmPlan {
  std::vector<Time> stills;    // of the first camera, ascending
  std::vector<Time> views;     // of each further camera, ascending
  std::vector<Time> outlines;  // ascending; all of `stills` among them
  Time video_from;
  Time video_picture;               // how long each picture of the video is shown
  std::int64_t video_pictures = 0;  // 0 for no video
  std::string note;                 // what is left out, one or two sentences; empty if nothing is
};

// Limits of a plan; what is beyond is left out and said.
inline constexpr std::size_t kMostStills = 200;
inline constexpr std::size_t kMostViewStills = 40;
inline constexpr std::size_t kMostOutlines = 3000;
inline constexpr std::int64_t kMostVideoPictures = 3000;

// Pictures a second that a video can have: those that last whole milliseconds.
const std::vector<int>& VideoRates();

FilmPlan PlanFilm(const Run& run, const FilmWishes& wishes = {});

}  // namespace aerascope
