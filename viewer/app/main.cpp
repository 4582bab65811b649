// The program: reads the command line, runs one subcommand, turns what went wrong into one sentence and a
// status.
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "engine/base/text.h"
#include "engine/world/mujoco_error.h"
#include "viewer/app/commands.h"
#include "viewer/app/terminal.h"

#ifndef AERASCOPE_VERSION
#define AERASCOPE_VERSION "unversioned"
#endif

namespace aerascope {
namespace {

// The subcommand most like what was typed, for a sentence that helps.
std::string SuggestionFor(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(command->get_name());
  }
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("-")) continue;
    if (std::find(known.begin(), known.end(), word) != known.end()) return "";
    const std::string closest = ClosestWord(word, known);
    return "there is no command '" + word + "'" +
           (closest.empty() ? "" : "; did you mean '" + closest + "'?");
  }
  return "";
}

// The option of the subcommand most like one that was typed and is not known.
std::string SuggestionForOption(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    word = word.substr(0, word.find('='));
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    const std::string closest = ClosestWord(word, known);
    return "there is no option '" + word + "'" + (closest.empty() ? "" : "; did you mean '" + closest + "'?");
  }
  return "";
}

// Whether nobody reads standard output any more, as behind `| head`: what was to be said has been heard.
bool ReaderWentAway() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

int ReportUse(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  std::string sentence = SuggestionFor(app, argc, argv);
  if (const auto commands = app.get_subcommands(); sentence.empty() && !commands.empty())
    sentence = SuggestionForOption(*commands.front(), argc, argv);
  if (sentence.empty()) sentence = error.what();
  for (char& c : sentence) {
    if (c == '\n') c = ' ';
  }
  while (!sentence.empty() && (sentence.back() == ' ' || sentence.back() == '.')) sentence.pop_back();
  std::string help = "aerascope --help";
  for (const CLI::App* command : app.get_subcommands()) help = "aerascope " + command->get_name() + " --help";
  return Fail(sentence + "; see " + help);
}

int Main(int argc, char** argv) {
  CLI::App app{"Sees why a causal reasoning agent did what it did."};
  app.name("aerascope");
  app.set_version_flag("--version", ProgramVersion());
  app.require_subcommand(1);
  Chosen chosen;
  AddDemoCommand(app, &chosen);
  AddRunCommand(app, &chosen);
  AddTrialsCommand(app, &chosen);
  AddReportCommand(app, &chosen);
  AddFrameCommand(app, &chosen);
  AddKbCommand(app, &chosen);
  AddEventsCommand(app, &chosen);
  AddWhyCommand(app, &chosen);
  AddDiffCommand(app, &chosen);
  AddExportCommand(app, &chosen);
  AddSnapshotCommand(app, &chosen);
  AddViewCommand(app, &chosen);
  AddVerifyCommand(app, &chosen);
  AddDoctorCommand(app, &chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ReportUse(app, error, argc, argv);
  }
  const int status = chosen();
  // What was printed may not have arrived: a full disk behind standard output is trouble, too.
  const bool arrived = std::fflush(stdout) == 0 && !std::ferror(stdout);
  if (!arrived && !ReaderWentAway()) return Fail("cannot write to standard output");
  return status;
}

}  // namespace

std::string ProgramVersion() {
  return "aerascope " AERASCOPE_VERSION;
}

}  // namespace aerascope

int main(int argc, char** argv) {
  aerascope::InstallMujocoErrorHandler();
  // A reader that went away (| head) and a file-size limit are errors of write(), not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return aerascope::Main(argc, argv);
  } catch (const std::exception& error) {
    return aerascope::Fail(std::string("this should not have happened: ") + error.what());
  }
}
