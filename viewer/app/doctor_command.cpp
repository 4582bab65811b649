// aerascope doctor: what this machine can do, and what to install for the rest.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "viewer/app/commands.h"
#include "viewer/app/episode_run.h"
#include "viewer/draw/png.h"
#include "viewer/render/renderer.h"

namespace aerascope {
namespace {

void Line(bool good, const char* what, const std::string& text) {
  std::printf("%s  %-9s %s\n", good ? "ok  " : "FAIL", what, text.c_str());
}

int Examine() {
  bool all_good = true;
  std::printf("%s\n", ProgramVersion().c_str());
  auto renderer = Renderer::Create();
  if (renderer) {
    const RendererInfo& info = (*renderer)->info();
    Line(true, "frames",
         info.driver + ", OpenGL " + info.version + ", EGL " + info.platform +
             (info.software ? "; drawn in software" : ""));
  } else {
    all_good = false;
    Line(false, "frames", renderer.error().message);
  }
  const bool fonts = std::filesystem::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf");
  Line(fonts, "fonts", fonts ? "DejaVu Sans" : "DejaVu Sans is missing; apt-get install fonts-dejavu-core");
  const auto png = SvgToPng("<svg xmlns='http://www.w3.org/2000/svg' width='8' height='8'/>");
  Line(png.ok(), "sheets", png.ok() ? "SVG to PNG works" : png.error().message);
  const auto asset = FindAsset("scenarios/pick_and_place.toml");
  Line(asset.ok(), "assets", asset.ok() ? "found" : asset.error().message);
  return all_good && fonts && png.ok() && asset.ok() ? kDone : kDifferent;
}

}  // namespace

void AddDoctorCommand(CLI::App& app, Chosen* chosen) {
  CLI::App* command =
      app.add_subcommand("doctor", "What this machine can do, and what to install for the rest");
  command->callback([=] { *chosen = Examine; });
}

}  // namespace aerascope
