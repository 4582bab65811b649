// The episode report: one self-contained HTML file with film, story, model graph, time lanes and inspector.
//
// The page loads nothing and may load nothing: its content security policy allows its own script and style
// (by hash) and images it makes itself. Everything shown comes from the run given; pixels come through
// ReportFrames, so that this folder needs no graphics. Same run, same frames, same options: the same bytes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/query/run.h"

namespace aerascope {

// Where a thing is in a still, in pixels of the still.
struct StillPoint {
  double x = 0;
  double y = 0;
};

struct StillObject {
  std::string name;                 // as facts call it
  std::vector<StillPoint> outline;  // a closed polygon; empty if only the label's place is known
  StillPoint label;                 // where the middle of its name's base line belongs
};

// What the world looked like at one instant, as an encoded image.
struct Still {
  Time at;
  std::string bytes;  // of the type ReportFrames::mime; equal images are stored once
  std::vector<StillObject> objects;
};

struct ReportFrames {
  int width = 0;
  int height = 0;
  std::string mime;           // "image/webp" or "image/png"
  std::vector<Still> stills;  // in order of time; empty for a report without frames
  std::string note;           // why there are no frames, or fewer than there could be; one sentence; shown
};

struct ReportOptions {
  std::string file_name;  // of the episode, as shown; without folder
};

// What takes the space, for people who wonder.
struct ReportPart {
  std::string name;
  std::size_t bytes = 0;
};

struct Report {
  std::string html;
  std::vector<ReportPart> parts;      // add up to the size of `html`
  std::vector<std::string> warnings;  // one sentence each
};

// Reports above this size open slowly; they are made all the same, with a warning.
inline constexpr std::size_t kLargeReport = 20'000'000;

Result<Report> BuildReport(const Run& run, const ReportFrames& frames, const ReportOptions& options = {});

}  // namespace aerascope
