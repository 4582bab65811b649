// aerascope kb: what the agent knew at a moment, as text.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <sstream>

#include "exporters/kb/knowledge_text.h"
#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::optional<std::string> at;
};

int PrintKnowledge(const Options& options) {
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  auto at = ParseMoment(options.at, *run);
  if (!at) return Fail(at.error());
  std::ostringstream text;
  if (Status status = WriteKnowledgeText(run->KnowledgeBaseAt(*at), text); !status)
    return Fail(status.error());
  if (Status status = WriteFile("-", text.str()); !status) return Fail(status.error());
  return kDone;
}

}  // namespace

void AddKbCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("kb", "The knowledge base as text");
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("--at", options->at, "The moment: 3.2s, 700ms; default: the end");
  command->callback([=] { *chosen = [=] { return PrintKnowledge(*options); }; });
}

}  // namespace aerascope
