// aerascope why: the causes of a thing, back to what was observed; or what it led to.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "engine/query/why.h"
#include "viewer/app/commands.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::string id;
  bool led_to = false;
  int depth = 12;
};

int Explain(const Options& options) {
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  auto id = run->FindObject(options.id);
  if (!id) return Fail(id.error());
  const EventId event = run->CreationOf(*id);
  CauseLimits limits;
  limits.depth = options.depth;
  const CauseTree tree = options.led_to ? LedTo(*run, event, limits) : Why(*run, event, limits);
  std::fputs(TreeText(*run, tree).c_str(), stdout);
  return kDone;
}

}  // namespace

void AddWhyCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("why", "Why something exists: its causes as a tree, back to observations");
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("id", options->id, "mdl_14, cst_12, goal_7, pred_9, fact_3, or an event #214")
      ->required();
  command->add_flag("--led-to", options->led_to, "What it led to instead");
  command->add_option("--depth", options->depth, "Levels to show")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([=] { *chosen = [=] { return Explain(*options); }; });
}

}  // namespace aerascope
