// aerascope trials: the same scenario over many random seeds, without pictures; the table of what was
// reached.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>

#include "engine/episode/run_episode.h"
#include "viewer/app/commands.h"
#include "viewer/app/episode_run.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

struct Options {
  std::string scenario;
  std::uint64_t first_seed = 1;
  int count = 50;
};

// Keeps what the table needs of an episode: drives in order, and how each ended.
class OutcomeSink : public EventSink {
 public:
  void Append(Event event) override {
    if (const auto* drive = std::get_if<DriveInjected>(&event.body)) {
      drives_.push_back({drive->title, false});
      position_[drive->goal] = drives_.size() - 1;
    } else if (const auto* achieved = std::get_if<GoalAchieved>(&event.body)) {
      const auto it = position_.find(achieved->goal);
      if (it != position_.end()) drives_[it->second].second = true;
    } else if (std::holds_alternative<CommandRefused>(event.body)) {
      ++refused_;
    } else if (const auto* model = std::get_if<ModelCreated>(&event.body)) {
      if (model->origin != Origin::kSeed && IsRequirement(model->model)) ++learned_;
    }
  }
  const std::vector<std::pair<std::string, bool>>& drives() const { return drives_; }
  int refused() const { return refused_; }
  int learned() const { return learned_; }

 private:
  std::vector<std::pair<std::string, bool>> drives_;
  std::map<GoalId, std::size_t> position_;
  int refused_ = 0;
  int learned_ = 0;
};

int RunTrials(const Options& options) {
  auto scenario = LoadScenario(options.scenario);
  if (!scenario) return Fail(scenario.error());
  std::map<std::size_t, int> reached;  // by position of the drive
  int whole = 0;
  std::printf("%6s  %-7s  %7s  %7s  %s\n", "seed", "reached", "learned", "refused", "drives");
  for (int i = 0; i < options.count; ++i) {
    const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(i);
    const Scenario trial = WithRandomSeed(*scenario, seed);
    auto world = MakeWorld(trial);
    if (!world) return Fail(world.error());
    OutcomeSink sink;
    auto outcome = RunEpisode(trial, world->get(), &sink);
    if (!outcome) return Fail(outcome.error());
    std::string drives;
    for (std::size_t d = 0; d < sink.drives().size(); ++d) {
      const auto& [title, good] = sink.drives()[d];
      reached[d] += good ? 1 : 0;
      drives += (d > 0 ? ", " : "") + title + (good ? "" : " MISSED");
    }
    const bool all = outcome->drives_reached == outcome->drives;
    whole += all ? 1 : 0;
    std::printf("%6llu  %lld of %lld  %7d  %7d  %s\n", static_cast<unsigned long long>(seed),
                static_cast<long long>(outcome->drives_reached), static_cast<long long>(outcome->drives),
                sink.learned(), sink.refused(), drives.c_str());
    std::fflush(stdout);
  }
  std::printf("\n");
  for (std::size_t d = 0; d < scenario->drives.size(); ++d) {
    std::printf("%3d of %d  %s\n", reached[d], options.count, scenario->drives[d].title.c_str());
  }
  std::printf("%3d of %d  all drives\n", whole, options.count);
  return whole == options.count ? kDone : kDifferent;
}

}  // namespace

void AddTrialsCommand(CLI::App& app, Chosen* chosen) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("trials", "Run a scenario over many random seeds and print what was reached");
  command->add_option("scenario", options->scenario, "The scenario file (TOML)")->required();
  command->add_option("--seeds", options->count, "How many seeds")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->add_option("--first-seed", options->first_seed, "The first seed")
      ->check(CheckRandomSeed)
      ->capture_default_str();
  command->callback([=] { *chosen = [=] { return RunTrials(*options); }; });
}

}  // namespace aerascope
