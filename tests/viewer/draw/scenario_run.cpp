#include "tests/viewer/draw/scenario_run.h"

#include <gtest/gtest.h>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"

namespace aerascope {
namespace {

class KeptEvents : public EventSink {
 public:
  explicit KeptEvents(std::vector<Event>* events) : events_(events) {}
  void Append(Event event) override { events_->push_back(std::move(event)); }

 private:
  std::vector<Event>* events_;
};

}  // namespace

Run ScenarioRun(const std::string& name) {
  EpisodeFile file;
  const auto scenario = LoadScenario(std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios/" + name);
  EXPECT_TRUE(scenario.ok()) << scenario.error().message;
  if (!scenario.ok()) return Run::FromEvents({});
  auto world = MakeWorld(*scenario);
  EXPECT_TRUE(world.ok()) << world.error().message;
  if (!world.ok()) return Run::FromEvents({});
  KeptEvents sink(&file.events);
  const auto outcome = RunEpisode(*scenario, world->get(), &sink);
  EXPECT_TRUE(outcome.ok()) << outcome.error().message;
  file.complete = outcome.ok();
  return Run::FromEvents(std::move(file));
}

}  // namespace aerascope
