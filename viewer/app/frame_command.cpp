// aerascope frame: one moment of an episode as a picture.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/pictures.h"
#include "viewer/app/terminal.h"
#include "viewer/scene/episode_scene.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::optional<std::string> at;
  std::string output;
  std::string size = "1280x720";
  std::string camera;
};

int DrawFrame(const Options& options) {
  auto size = ParsePictureSize(options.size);
  if (!size) return Fail(size.error());
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  auto at = ParseMoment(options.at, *run);
  if (!at) return Fail(at.error());
  auto pictures = EpisodePictures::Open(*run);
  if (!pictures) return Fail(pictures.error());
  if (!pictures->can_draw()) return Fail(pictures->trouble());
  auto camera = ParseCamera(pictures->model(), options.camera);
  if (!camera) return Fail(camera.error());
  auto png = pictures->DrawPng(*at, *camera, *size);
  if (!png) return Fail(png.error());
  if (Status written = WriteFile(options.output, *png); !written) return Fail(written.error());
  if (options.output != "-") std::printf("%s\n", options.output.c_str());
  return kDone;
}

}  // namespace

void AddFrameCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("frame", "Draw one moment of an episode as a PNG");
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("--at", options->at, "The moment: 3.2s, 700ms; default: the end");
  command->add_option("-o,--output", options->output, "The PNG file to write")->required();
  command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
  command->add_option("--camera", options->camera,
                      "A camera of the model, or free:AZIMUTH,ELEVATION,DISTANCE");
  command->callback([=] { *chosen = [=] { return DrawFrame(*options); }; });
}

}  // namespace aerascope
