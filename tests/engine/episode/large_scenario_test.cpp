// The scenarios that measurements of readers rest on, small: what they must have to be worth measuring.
#include "tests/support/large_scenario.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"

namespace aerascope {
namespace {

constexpr LargeScenarioOptions kSmall{1, 420, 110'000, 300};

struct Lived {
  EpisodeOutcome outcome;
  std::vector<Event> events;
  Hash128 digest;
};

class KeepingSink : public EventSink {
 public:
  explicit KeepingSink(Lived* lived) : lived_(*lived) {}
  void Append(Event event) override {
    digest_.Add(event);
    lived_.digest = digest_.Value();
    lived_.events.push_back(std::move(event));
  }

 private:
  Lived& lived_;
  EventDigest digest_;
};

Lived LivedThrough(const LargeScenarioOptions& options) {
  Lived lived;
  const auto scenario = LoadScenarioFromFiles(LargeScenario(options));
  EXPECT_TRUE(scenario.ok()) << (scenario.ok() ? "" : scenario.error().message);
  if (!scenario) return lived;
  auto world = MakeWorld(*scenario);
  if (!world) return lived;
  KeepingSink sink(&lived);
  if (auto outcome = RunEpisode(*scenario, world->get(), &sink)) lived.outcome = *outcome;
  return lived;
}

// Lived once for all tests: a hundred thousand events take minutes under a sanitizer.
const Lived& SmallOne() {
  static const Lived lived = LivedThrough(kSmall);
  return lived;
}

template <class Body>
int CountOf(const Lived& lived) {
  int count = 0;
  for (const Event& event : lived.events) count += std::holds_alternative<Body>(event.body);
  return count;
}

TEST(LargeScenario, HasAboutAsManyFramesEventsAndModelsAsAsked) {
  const Lived& lived = SmallOne();
  EXPECT_EQ(lived.outcome.frames, kSmall.frames);
  EXPECT_NEAR(static_cast<double>(lived.events.size()), 110'000, 25'000);
  EXPECT_NEAR(CountOf<ModelCreated>(lived), 300, 60);
}

TEST(LargeScenario, HasKnowledgeOfEveryOriginAndEveryTurnOfAStory) {
  const Lived& lived = SmallOne();
  std::map<Origin, int> origins;
  int vetoes = 0;
  int deleted = 0;
  for (const Event& event : lived.events) {
    if (const auto* made = std::get_if<ModelCreated>(&event.body)) {
      ++origins[made->origin];
      vetoes += !made->model.rhs.positive;
    }
    if (const auto* changed = std::get_if<ModelStateChanged>(&event.body))
      deleted += changed->after == ModelState::kDeleted;
  }
  EXPECT_GE(origins[Origin::kSeed], 50);
  EXPECT_GE(origins[Origin::kInduction], 50);
  EXPECT_GE(origins[Origin::kAnalogy], 10);
  EXPECT_GE(origins[Origin::kPredictionFailure], 3);
  EXPECT_GE(vetoes, 20);
  EXPECT_GE(deleted, 3);
  EXPECT_GE(CountOf<PredictionFailed>(lived), 3);
  EXPECT_GE(CountOf<PredictionSucceeded>(lived), 300);
  EXPECT_GE(CountOf<GoalAchieved>(lived), 30);
  EXPECT_GE(CountOf<GoalFailed>(lived), 1);
  EXPECT_GE(CountOf<AnalogyCompared>(lived), 500);
  EXPECT_GE(CountOf<PlanRejected>(lived), 5);
}

TEST(LargeScenario, IsTheSameEachTimeAndAnotherWithAnotherSeed) {
  LargeScenarioOptions short_one = kSmall;
  short_one.frames = 150;
  const Hash128 once = LivedThrough(short_one).digest;
  EXPECT_EQ(LivedThrough(short_one).digest, once);
  short_one.seed = 2;
  EXPECT_NE(LivedThrough(short_one).digest, once);
}

}  // namespace
}  // namespace aerascope
