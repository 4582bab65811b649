// aerascope report: an episode becomes an HTML report, and a PNG sheet if wanted.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "viewer/app/commands.h"
#include "viewer/app/report_files.h"
#include "viewer/app/terminal.h"
#include "viewer/render/renderer.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  ReportFiles files;
  std::string size = "960x540";
  bool no_frames = false;
  bool video = true;
  int video_fps = 0;           // 0: by the length of the episode
  int stills_per_second = -1;  // below 0: as the plan says
};

int MakeReport(Options options) {
  if (options.files.html.empty() && options.files.sheet.empty()) {
    return Fail(
        "nothing to write: name the report with -o FILE.html, the sheet with --png FILE.png, or both");
  }
  auto size = ParsePictureSize(options.size);
  if (!size) return Fail(size.error());
  FilmOptions& film = options.files.film;
  film.still_size = *size;
  film.wishes.video = options.video;
  if (options.video_fps > 0) film.wishes.video_fps = options.video_fps;
  if (options.stills_per_second >= 0) film.wishes.stills_per_second = options.stills_per_second;
  options.files.frames = !options.no_frames;
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  if (Status written = WriteReports(*run, options.episode, options.files); !written)
    return Fail(written.error());
  for (const std::string& path : {options.files.html, options.files.sheet}) {
    if (!path.empty() && path != "-") std::printf("%s\n", path.c_str());
  }
  return kDone;
}

}  // namespace

void AddReportCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("report", "Write the HTML report of an episode, and its PNG sheet");
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("-o,--output", options->files.html, "The HTML file to write");
  command->add_option("--png", options->files.sheet, "The PNG sheet to write");
  command->add_option("--size", options->size, "Size of the film's stills in pixels")->capture_default_str();
  command->add_flag("--video,!--no-video", options->video,
                    "With a video for smooth play, or with stills only");
  command
      ->add_option("--video-fps", options->video_fps,
                   "Pictures of the video for each second; default: 20, fewer for episodes over 2 minutes")
      ->check(CLI::IsMember(VideoRates()));
  command
      ->add_option("--stills-per-second", options->stills_per_second,
                   "Stills for each second beside those at frame starts; default: 0, without video 4")
      ->check(CLI::Range(0, 60));
  command->add_option(
      "--cameras", options->files.film.cameras,
      "Cameras with commas between, the first with video: names of the model's cameras, side, above, "
      "at:ENTITY, free:AZIMUTH,ELEVATION,DISTANCE; default: the model's first, side, above and the "
      "hand");
  command->add_flag("--folder", options->files.folder,
                    "Pictures and video as files in a folder beside the page (report_files for report.html), "
                    "for web servers and very long episodes");
  command->add_flag("--no-frames", options->no_frames, "Leave out the film");
  command->callback([=] { *chosen = [=] { return MakeReport(*options); }; });
}

}  // namespace aerascope
