// aerascope diff: what one agent knows and another does not.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <sstream>

#include "engine/query/kb_diff.h"
#include "exporters/diff/diff.h"
#include "viewer/app/commands.h"
#include "viewer/app/file_output.h"
#include "viewer/app/moment.h"
#include "viewer/app/terminal.h"
#include "viewer/page/diff_page.h"

namespace aerascope {
namespace {

struct Options {
  std::string left;
  std::string right;
  std::string format = "text";
  std::string output = "-";
};

struct Side {
  Run run;
  Time at;
};

Result<Side> OpenSide(const std::string& text) {
  const EpisodeAt which = SplitEpisodeAt(text);
  auto run = OpenRun(which.path);
  if (!run) return run.error();
  NoteIncomplete(which.path, run->complete(), run->events().size());
  auto at = ParseMoment(which.moment, *run);
  if (!at) return at.error();
  return Side{std::move(*run), *at};
}

// What a page calls the sides: files without their folders, which are nobody's business, but for the
// innermost one where the files have one name.
DiffNames PageNames(const Options& options) {
  const auto with_folder = [](const std::string& name) {
    const std::filesystem::path path(name);
    return (path.parent_path().filename() / path.filename()).string();
  };
  if (FileName(options.left) != FileName(options.right))
    return {FileName(options.left), FileName(options.right)};
  return {with_folder(options.left), with_folder(options.right)};
}

// The difference in the format that was asked for.
Result<std::string> Told(const Options& options, const Side& left, const Side& right,
                         const KbDiffResult& difference) {
  const RunDiff runs = DiffRuns({left.run, left.at}, {right.run, right.at});
  if (options.format == "html") {
    const DiffNames names = PageNames(options);
    return BuildDiffPage({left.run, left.at, names.left}, {right.run, right.at, names.right}, difference,
                         runs);
  }
  const DiffReport report{difference, {options.left, options.right}, runs};
  std::ostringstream text;
  const Status status = options.format == "json"       ? WriteDiffJson(report, text)
                        : options.format == "markdown" ? WriteDiffMarkdown(report, text)
                                                       : WriteDiffText(report, text);
  if (!status) return status.error();
  return text.str();
}

int Compare(const Options& options) {
  if (Status fine = CheckWritable(options.output); !fine) return Fail(fine.error());
  auto left = OpenSide(options.left);
  if (!left) return Fail(left.error());
  auto right = OpenSide(options.right);
  if (!right) return Fail(right.error());
  const KbDiffResult difference =
      DiffKnowledge(left->run.KnowledgeBaseAt(left->at), right->run.KnowledgeBaseAt(right->at));
  auto told = Told(options, *left, *right, difference);
  if (!told) return Fail(told.error());
  if (Status written = WriteFile(options.output, *told); !written) return Fail(written.error());
  return difference.empty() ? kDone : kDifferent;
}

}  // namespace

void AddDiffCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "diff", "Compare two knowledge bases by content; status 0 if equal, 1 if they differ");
  command->add_option("left", options->left, "An episode, or episode@TIME")->required();
  command->add_option("right", options->right, "An episode, or episode@TIME")->required();
  command->add_option("--format", options->format, "text, json, markdown, or html for a page to look at")
      ->check(CLI::IsMember({"text", "json", "markdown", "html"}))
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "The file to write; - is standard output")
      ->capture_default_str();
  command->callback([=] { *chosen = [=] { return Compare(*options); }; });
}

}  // namespace aerascope
