// aerascope run: a scenario becomes an episode.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "engine/episode/run_episode.h"
#include "viewer/app/commands.h"
#include "viewer/app/episode_run.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string scenario;
  std::string output;
  std::optional<std::uint64_t> seed;
};

int Run(const Options& options) {
  auto scenario = LoadScenario(options.scenario);
  if (!scenario) return Fail(scenario.error());
  const Scenario chosen =
      options.seed ? WithRandomSeed(*std::move(scenario), *options.seed) : *std::move(scenario);
  auto recorded = RecordWithProgress(chosen, options.output);
  if (!recorded) return Fail(recorded.error());
  std::printf("%s\n%s\n", OutcomeText(*recorded).c_str(), options.output.c_str());
  return recorded->outcome.drives_reached == recorded->outcome.drives ? kDone : kDifferent;
}

}  // namespace

void AddRunCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("run", "Run a scenario and write its episode; status 1 if a drive was missed");
  command->add_option("scenario", options->scenario, "The scenario file (TOML)")->required();
  command->add_option("-o,--output", options->output, "The episode file to write")->required();
  command->add_option("--seed", options->seed, "Random seed of the world, instead of the scenario's")
      ->check(CheckRandomSeed);
  command->callback([=] { *chosen = [=] { return Run(*options); }; });
}

}  // namespace aerascope
