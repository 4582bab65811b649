// aerascope report: an episode becomes an HTML report, and a PNG sheet if wanted.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

#include "viewer/app/commands.h"
#include "viewer/app/pictures.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  ReportFiles files;
  std::string size = "960x540";
  bool no_frames = false;
};

int MakeReport(Options options) {
  if (options.files.html.empty() && options.files.sheet.empty()) {
    return Fail("nothing to write: name the report with -o FILE.html, the sheet with --png FILE.png, or both");
  }
  auto size = ParsePictureSize(options.size);
  if (!size) return Fail(size.error());
  options.files.still_size = *size;
  options.files.frames = !options.no_frames;
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  if (Status written = WriteReports(*run, options.episode, options.files); !written) return Fail(written.error());
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
  command->add_option("--stills-per-second", options->files.stills_per_second, "Stills of the film for each second")
      ->check(CLI::Range(1, 60))
      ->capture_default_str();
  command->add_flag("--no-frames", options->no_frames, "Leave out the film");
  command->callback([=] { *chosen = [=] { return MakeReport(*options); }; });
}

}  // namespace aerascope
