// aerascope demo: the paper's pick-and-place, from teaching to report, in one command.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "engine/query/episode_summary.h"
#include "viewer/app/commands.h"
#include "viewer/app/episode_run.h"
#include "viewer/app/file_output.h"
#include "viewer/app/report_files.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

constexpr const char* kDemoScenario = "scenarios/pick_and_place.toml";

struct Options {
  std::string folder = "out";
  std::optional<std::uint64_t> seed;
};

int Demo(const Options& options) {
  auto path = FindAsset(kDemoScenario);
  if (!path) return Fail(path.error());
  auto scenario = LoadScenario(*path);
  if (!scenario) return Fail(scenario.error());
  const Scenario chosen =
      options.seed ? WithRandomSeed(*std::move(scenario), *options.seed) : *std::move(scenario);
  if (Status made = MakeFolder(options.folder); !made) return Fail(made.error());
  const std::string episode = options.folder + "/demo.episode";
  const std::string report = options.folder + "/demo.html";
  const std::string sheet = options.folder + "/demo.png";

  auto recorded = RecordWithProgress(chosen, episode);
  if (!recorded) return Fail(recorded.error());
  auto run = OpenRun(episode);
  if (!run) return Fail(run.error());
  if (Status written = WriteReports(*run, episode, {.html = report, .sheet = sheet}); !written) {
    return Fail(written.error());
  }
  std::printf("%s\n", run->title().c_str());
  for (const std::string& line : Summarise(*run).headline) std::printf("  %s\n", line.c_str());
  std::printf("episode  %s\nreport   %s\nsheet    %s\n", episode.c_str(), report.c_str(), sheet.c_str());
  return recorded->outcome.drives_reached == recorded->outcome.drives ? kDone : kDifferent;
}

}  // namespace

void AddDemoCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("demo", "The paper's pick-and-place: run it, write the report, say where it is");
  command->add_option("--out", options->folder, "Folder for episode, report and sheet")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Random seed of the world, instead of the scenario's")
      ->check(CheckRandomSeed);
  command->callback([=] { *chosen = [=] { return Demo(*options); }; });
}

}  // namespace aerascope
