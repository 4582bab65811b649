// aerascope snapshot: an expected knowledge base kept in a file, as a test.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "engine/base/text.h"
#include "exporters/snapshot/snapshot.h"
#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string episode;
  std::optional<std::string> at;
  std::string file;
  bool evidence = false;
};

Result<KnowledgeBase> KnowledgeFor(const Options& options) {
  auto run = OpenRun(options.episode);
  if (!run) return run.error();
  auto at = ParseMoment(options.at, *run);
  if (!at) return at.error();
  return run->KnowledgeBaseAt(*at);
}

int Test(const Options& options) {
  auto knowledge = KnowledgeFor(options);
  if (!knowledge) return Fail(knowledge.error());
  auto comparison = TestSnapshot(options.file, *knowledge);
  if (!comparison) return Fail(comparison.error());
  if (comparison->same()) {
    std::printf("%s holds\n", options.file.c_str());
    return kDone;
  }
  std::fputs(comparison->difference.c_str(), stdout);
  return kDifferent;
}

int Accept(const Options& options) {
  if (const char* ci = std::getenv("CI"); ci && *ci) {
    return Fail(
        "snapshots are not accepted where CI is set; accept them on your own machine and commit the file");
  }
  auto knowledge = KnowledgeFor(options);
  if (!knowledge) return Fail(knowledge.error());
  if (std::filesystem::exists(options.file)) {
    if (Status fine = CheckWritable(options.file); !fine) return Fail(fine.error());
  }
  if (Status status = AcceptSnapshot(options.file, *knowledge, {.evidence = options.evidence}); !status) {
    return Fail(status.error());
  }
  std::printf("%s\n", options.file.c_str());
  return kDone;
}

void AddArguments(CLI::App* command, Options* options) {
  command->add_option("episode", options->episode, "The episode file")->required();
  command->add_option("file", options->file, "The snapshot file")->required();
  command->add_option("--at", options->at, "The moment: 3.2s, 700ms; default: the end");
}

}  // namespace

void AddSnapshotCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("snapshot", "Test the knowledge base against an expectation kept in a file");
  command->require_subcommand(1);
  CLI::App* test =
      command->add_subcommand("test", "Compare; status 0 if it holds, 1 and the difference if not");
  AddArguments(test, options.get());
  test->callback([=] { *chosen = [=] { return Test(*options); }; });
  CLI::App* accept = command->add_subcommand("accept", "Make the present knowledge the expectation");
  AddArguments(accept, options.get());
  accept->add_flag("--evidence", options->evidence, "Confidence and counts are part of the expectation");
  accept->callback([=] { *chosen = [=] { return Accept(*options); }; });
}

}  // namespace aerascope
