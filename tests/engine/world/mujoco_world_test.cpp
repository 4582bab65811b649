// The tabletop world: physics decides what is held, sensors report steadily, and Act says what was really
// done.
#include "engine/world/mujoco_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/world/tabletop.h"

namespace aerascope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kSeeds = 5;  // the survey program tries many more

std::unique_ptr<World> Tabletop(std::uint64_t seed) {
  auto world = MakeMujocoWorld(TabletopConfig(seed));
  EXPECT_TRUE(world.ok()) << world.error().message;
  return std::move(*world);
}

double HeightOf(const World& world, std::size_t object) {
  const WorldState state = world.State();
  return state.qpos[state.qpos.size() - 35 + 7 * object + 2];
}

struct Grasp {
  std::size_t object;
  const char* right;
  const char* wrong;
};
constexpr Grasp kGrasps[] = {{0, "grab_type_1", "grab_type_2"},
                             {1, "grab_type_2", "grab_type_1"},
                             {2, "grab_type_2", "grab_type_1"},
                             {3, "grab_type_1", "grab_type_2"},
                             {4, "grab_type_2", "grab_type_1"}};

class GraspTest : public testing::TestWithParam<Grasp> {
 protected:
  std::string Name() const { return TabletopConfig(0).objects[GetParam().object].entity; }
};

TEST_P(GraspTest, TheRightGrabHoldsItAboveTheTableAndReleaseSetsItDownInPlace) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const auto world = Tabletop(seed);
    Driver driver(*world);
    driver.MoveTo(Name());
    const Term place = driver.Value(Name(), "position");
    ASSERT_EQ(driver.Value("h", "position"), place);
    const double lying = HeightOf(*world, GetParam().object);

    driver.Command(GetParam().right);
    EXPECT_EQ(driver.Holding(), "[" + Name() + "]");
    EXPECT_GT(HeightOf(*world, GetParam().object), lying + 0.1);
    EXPECT_EQ(driver.Value(Name(), "position"), place);
    EXPECT_EQ(driver.Value("h", "position"), place);

    driver.Command("release");
    EXPECT_EQ(driver.Holding(), "[]");
    EXPECT_NEAR(HeightOf(*world, GetParam().object), lying, 0.001);
    EXPECT_EQ(driver.Value(Name(), "position"), place);
  }
}

TEST_P(GraspTest, TheWrongGrabHoldsNothing) {
  for (int seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const auto world = Tabletop(seed);
    Driver driver(*world);
    driver.MoveTo(Name());
    const double lying = HeightOf(*world, GetParam().object);

    const ActOutcome outcome = driver.Command(GetParam().wrong);

    EXPECT_EQ(driver.Holding(), "[]");
    EXPECT_NEAR(HeightOf(*world, GetParam().object), lying, 0.002);
    EXPECT_EQ(outcome.executed.size(), 1u) << "the motion was carried out; physics refused the grasp";
  }
}

INSTANTIATE_TEST_SUITE_P(FiveObjects, GraspTest, testing::ValuesIn(kGrasps), [](const auto& param_info) {
  return TabletopConfig(0).objects[param_info.param.object].entity;
});

TEST(MujocoWorld, TheSameSeedGivesTheSameStatesToTheLastBit) {
  const auto run = [](std::uint64_t seed) {
    const auto world = Tabletop(seed);
    Driver driver(*world);
    std::vector<WorldState> states{world->State()};
    for (const ActOutcome& outcome :
         {driver.MoveTo("s1"), driver.Command("grab_type_2"), driver.Command("release")}) {
      states.insert(states.end(), outcome.states.begin(), outcome.states.end());
    }
    return states;
  };
  const std::vector<WorldState> first = run(4);
  EXPECT_EQ(first.size(), 61u) << "20 states a second";
  EXPECT_EQ(run(4), first);
  EXPECT_NE(run(5), first);
}

TEST(MujocoWorld, StatesAreRecordedAtTheirTimes) {
  MujocoWorldConfig config = TabletopConfig(0);
  config.recorded_states_per_s = 10;
  const auto world = std::move(*MakeMujocoWorld(config));
  const Result<ActOutcome> outcome = world->Act({}, {{0}, Time{500'000}});
  ASSERT_TRUE(outcome.ok());
  std::vector<std::int64_t> times;
  for (const WorldState& state : outcome->states) times.push_back(state.time.us);
  EXPECT_THAT(times, ElementsAre(100'000, 200'000, 300'000, 400'000, 500'000));
  EXPECT_EQ(world->State(), outcome->states.back());
}

TEST(MujocoWorld, FactsComeInAFixedOrder) {
  const auto world = Tabletop(0);
  const TimeInterval frame{{0}, {1'000'000}};
  std::vector<std::string> about;
  const std::vector<Fact> facts = *world->Observe(frame);
  for (const Fact& fact : facts) {
    EXPECT_EQ(fact.interval, frame);
    about.push_back(fact.payload[0].name() + " " + fact.payload[1].name());
  }
  EXPECT_THAT(about, ElementsAre("h position", "h holding", "c1 position", "c2 position", "s1 position",
                                 "s2 position", "cyl position"));
  EXPECT_EQ(ToText(world->Properties()[1].payload), "(mk.val c1 shape cube)");
}

TEST(MujocoWorld, RestingThingsAreReportedWithoutFlicker) {
  const auto world = Tabletop(7);
  Driver driver(*world);
  const std::vector<Fact> before = *world->Observe(driver.Frame());
  for (int i = 0; i < 5; ++i) driver.Do({});
  const std::vector<Fact> after = *world->Observe(driver.Frame());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].payload, after[i].payload);
}

TEST(MujocoWorld, AMoveIsReportedAsTheDifferenceOfThePositions) {
  const auto world = Tabletop(0);
  Driver driver(*world);
  const ActOutcome outcome = driver.Move(0.12, -0.055);
  ASSERT_EQ(outcome.executed.size(), 1u);
  EXPECT_EQ(ToText(outcome.executed[0]), "(cmd move [h (vec2 0.12 -0.055)])");
  EXPECT_EQ(ToText(driver.Value("h", "position")), "(vec2 0.12 -0.085)");
}

TEST(MujocoWorld, AMoveIsCutAtTheEndOfTheWorkspace) {
  const auto world = Tabletop(0);
  Driver driver(*world);
  const ActOutcome outcome = driver.Move(1, 0);
  ASSERT_EQ(outcome.executed.size(), 1u);
  EXPECT_EQ(ToText(outcome.executed[0]), "(cmd move [h (vec2 0.24 0)])");
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("the workspace ends there")));
}

TEST(MujocoWorld, WhatCannotBeDoneIsNotReportedAsDone) {
  const auto world = Tabletop(0);
  Driver driver(*world);
  const Term move = Term::Ontology("move");
  const Term far_away = Term::Struct("vec2", {Term::Number(std::nan("")), Term::Number(0)});
  for (const Term& command :
       {MakeCommand(Term::Ontology("dance"), {Term::Entity("h")}), MakeCommand(move, {Term::Entity("h")}),
        MakeCommand(move, {Term::Entity("c1"), far_away}), MakeCommand(move, {Term::Entity("h"), far_away}),
        MakeCommand(move, {Term::Entity("h"), Term::Number(1)}), Term::Nil(), Term::Entity("h")}) {
    const ActOutcome outcome = driver.Do({command});
    EXPECT_THAT(outcome.executed, IsEmpty()) << ToText(command);
    EXPECT_EQ(outcome.notes.size(), 1u) << ToText(command);
  }
  EXPECT_EQ(ToText(driver.Value("h", "position")), "(vec2 0 -0.03)");
}

TEST(MujocoWorld, APlaceOutOfReachOrTooFarForTheTimeIsRefused) {
  MujocoWorldConfig config = TabletopConfig(0);
  config.motion.workspace_min_m = {-2, -2};
  config.motion.workspace_max_m = {2, 2};
  const auto world = std::move(*MakeMujocoWorld(config));
  Driver driver(*world);
  EXPECT_THAT(driver.Move(1.5, 0).notes, ElementsAre(HasSubstr("cannot reach")));
  const auto hurried_world = std::move(*MakeMujocoWorld(config));
  Driver hurried(*hurried_world, Milliseconds(160));
  EXPECT_THAT(hurried.Move(0.2, 0).notes, ElementsAre(HasSubstr("too long")));
  EXPECT_THAT(hurried.Command("grab_type_1").notes, ElementsAre(HasSubstr("too long")));
}

TEST(MujocoWorld, AFullHandDoesNotGrabAndAnEmptyOneMayRelease) {
  const auto world = Tabletop(1);
  Driver driver(*world);
  driver.MoveTo("c1");
  EXPECT_EQ(driver.Command("release").executed.size(), 1u);
  driver.Command("grab_type_1");
  EXPECT_THAT(driver.Command("grab_type_2").executed, IsEmpty());
  EXPECT_EQ(driver.Holding(), "[c1]");
}

TEST(MujocoWorld, AHeldObjectIsReportedToMoveWithTheHand) {
  const auto world = Tabletop(2);
  Driver driver(*world);
  driver.MoveTo("s1");
  driver.Command("grab_type_2");
  driver.Move(-0.05, -0.1);
  EXPECT_EQ(driver.Holding(), "[s1]");
  EXPECT_EQ(driver.Value("s1", "position"), driver.Value("h", "position"));
}

TEST(MujocoWorld, NoiseMovesTheObjectsAndKeepsThemApart) {
  for (int seed = 0; seed < 12; ++seed) {
    MujocoWorldConfig config = TabletopConfig(seed);
    config.motion.settle_s = 0;
    const WorldState state = (*MakeMujocoWorld(config))->State();
    const double* poses = state.qpos.data() + state.qpos.size() - 35;
    EXPECT_LE(std::abs(poses[0] - -0.10), 0.015);
    for (int a = 0; a < 5; ++a) {
      for (int b = 0; b < a; ++b) {
        EXPECT_GE(std::hypot(poses[7 * a] - poses[7 * b], poses[7 * a + 1] - poses[7 * b + 1]), 0.11);
      }
    }
  }
}

TEST(MujocoWorld, TheDescriptionBuildsTheSameWorldAgain) {
  const auto world = Tabletop(3);
  const WorldDescription description = world->Description();
  EXPECT_EQ(description.kind, "mujoco");
  EXPECT_THAT(description.cameras, ElementsAre("film", "overview", "close"));

  MujocoWorldConfig config = TabletopConfig(3);
  config.model_path = "";
  config.model_text = description.model_text;
  config.model_assets = description.assets;
  const auto again = MakeMujocoWorld(config);

  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ((*again)->State(), world->State());
  EXPECT_EQ((*again)->Description().model_text, description.model_text);
}

TEST(MujocoWorld, PhysicsThatExplodesIsAnErrorNotASilentReset) {
  MujocoWorldConfig config = TabletopConfig(0);
  const WorldDescription description = Tabletop(0)->Description();
  config.model_path = "";
  config.model_text = description.model_text;
  config.model_assets = description.assets;
  const std::size_t at = config.model_text.find("kp=\"3000\"");
  ASSERT_NE(at, std::string::npos);
  config.model_text.replace(at, 9, "kp=\"1e15\"");
  const std::size_t limit = config.model_text.find("forcerange=\"-120 120\"");
  config.model_text.erase(limit, 21);
  config.noise = {};

  auto world = MakeMujocoWorld(config);
  const std::string message =
      !world ? world.error().message : (*world)->Act({}, {{0}, {5'000'000}}).error().message;

  EXPECT_THAT(message, HasSubstr("the physics went wrong"));
}

TEST(MujocoWorld, TimeDoesNotRunBackwards) {
  const auto world = Tabletop(0);
  Driver driver(*world);
  driver.Do({});
  EXPECT_FALSE(world->Act({}, {{0}, {500'000}}).ok());
}

}  // namespace
}  // namespace aerascope
