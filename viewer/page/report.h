// The episode report: one self-contained HTML file with film, story, model graph, time lanes and inspector.
//
// The page loads nothing and may load nothing: its content security policy allows its own script and style
// (by hash), and images and videos it makes itself. Everything shown comes from the run given; pixels come
// through ReportFrames, so that this folder needs no graphics. Same run, same frames, same options: the same
// bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
  Time until{};  // nothing moves before this time, so that the image is right up to here; not used if not
                 // after `at`
};

// Where things are in the pictures of the first camera, at more instants than there are stills.
struct OutlinesAt {
  Time at;
  std::vector<StillObject> objects;
};

// A further camera.
struct FilmView {
  std::string id;     // in the address of the page
  std::string title;  // on its button
  std::vector<Still> stills;
};

// The pictures of the first camera as a video; picture i shows the world at from + i * picture.
struct FilmVideo {
  std::string bytes;
  std::string mime;
  Time from;
  Time picture;  // how long each is shown
  std::int64_t pictures = 0;
  int width = 0;
  int height = 0;
};

struct ReportFrames {
  int width = 0;  // of stills and outlines
  int height = 0;
  std::string mime;           // "image/webp" or "image/png"
  std::vector<Still> stills;  // in order of time; empty for a report without frames
  std::string note;           // why there are no frames, or fewer than there could be; shown
  std::string camera_id{};    // of the first camera; may be empty where there is no other
  std::string camera_title{};
  std::optional<FilmVideo> video{};
  std::vector<OutlinesAt> outlines{};  // in order of time
  std::vector<FilmView> views{};
};

struct ReportOptions {
  std::string file_name;  // of the episode, as shown; without folder
  // Where pictures and video go, as the page names it ("report_files"); empty: into the page.
  std::string picture_folder{};
};

// A file that belongs beside the page.
struct ReportFile {
  std::string path;  // as the page names it, beginning with ReportOptions::picture_folder
  std::string bytes;
};

// What takes the space, for people who wonder.
struct ReportPart {
  std::string name;
  std::size_t bytes = 0;
};

struct Report {
  std::string html;
  std::vector<ReportFile> files;      // none where everything is in the page; by name
  std::vector<ReportPart> parts;      // add up to the size of `html`
  std::vector<std::string> warnings;  // one sentence each
};

// Reports above this size open slowly; they are made all the same, with a warning.
inline constexpr std::size_t kLargeReport = 20'000'000;

Result<Report> BuildReport(const Run& run, const ReportFrames& frames, const ReportOptions& options = {});

}  // namespace aerascope
