// The subcommands: one file each, each adding itself to the command line. What a command does runs after
// parsing and gives the exit status: 0 done, 1 a difference or failed expectation was found, 2 wrong use or
// trouble.
#pragma once

#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace aerascope {

inline constexpr int kDone = 0;
inline constexpr int kDifferent = 1;
inline constexpr int kTrouble = 2;

// What the chosen subcommand will do; set while parsing.
using Chosen = std::function<int()>;

void AddDemoCommand(CLI::App& app, Chosen* chosen);
void AddRunCommand(CLI::App& app, Chosen* chosen);
void AddTrialsCommand(CLI::App& app, Chosen* chosen);
void AddReportCommand(CLI::App& app, Chosen* chosen);
void AddFrameCommand(CLI::App& app, Chosen* chosen);
void AddKbCommand(CLI::App& app, Chosen* chosen);
void AddEventsCommand(CLI::App& app, Chosen* chosen);
void AddWhyCommand(CLI::App& app, Chosen* chosen);
void AddDiffCommand(CLI::App& app, Chosen* chosen);
void AddExportCommand(CLI::App& app, Chosen* chosen);
void AddSnapshotCommand(CLI::App& app, Chosen* chosen);
void AddViewCommand(CLI::App& app, Chosen* chosen);
void AddVerifyCommand(CLI::App& app, Chosen* chosen);
void AddDoctorCommand(CLI::App& app, Chosen* chosen);

// "aerascope 0.1.0"
std::string ProgramVersion();

}  // namespace aerascope
