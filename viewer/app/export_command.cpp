// aerascope export: the knowledge at a moment in the formats of other tools.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>

#include "engine/query/model_graph.h"
#include "exporters/dot/dot.h"
#include "exporters/graphml/graphml.h"
#include "exporters/json/json.h"
#include "exporters/replicode/replicode.h"
#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::string format;
  std::optional<std::string> at;
  std::string output = "-";
};

Status WriteAs(const std::string& format, const KnowledgeBase& knowledge, std::ostream& out) {
  if (format == "replicode") return WriteKnowledgeAsReplicode(knowledge, out);
  const ModelGraph graph = MakeModelGraph(knowledge);
  if (format == "dot") return WriteDot(graph, out);
  if (format == "graphml") return WriteGraphml(graph, out);
  return WriteModelGraphJson(graph, out);
}

int Export(const Options& options) {
  auto run = OpenRun(options.episode);
  if (!run) return Fail(run.error());
  NoteIncomplete(options.episode, run->complete(), run->events().size());
  auto at = ParseMoment(options.at, *run);
  if (!at) return Fail(at.error());
  std::ostringstream text;
  if (Status status = WriteAs(options.format, run->KnowledgeBaseAt(*at), text); !status)
    return Fail(status.error());
  if (Status written = WriteFile(options.output, text.str()); !written) return Fail(written.error());
  if (options.output != "-") std::printf("%s\n", options.output.c_str());
  return kDone;
}

}  // namespace

void AddExportCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Write the knowledge base in a format of other tools");
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("--format", options->format, "dot, graphml, json (the model graph), or replicode")
      ->required()
      ->check(CLI::IsMember({"dot", "graphml", "json", "replicode"}));
  command->add_option("--at", options->at, "The moment: 3.2s, 700ms; default: the end");
  command->add_option("-o,--output", options->output, "The file to write; - is standard output")
      ->capture_default_str();
  command->callback([=] { *chosen = [=] { return Export(*options); }; });
}

}  // namespace aerascope
