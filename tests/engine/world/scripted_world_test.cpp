// The 1-D emulation is exact: what rules and commands say, and nothing else, happens.
#include "engine/world/scripted_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aerascope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ScriptedWorldConfig FiveObjects() {
  ScriptedWorldConfig config;
  config.hand_entity = "h";
  config.hand_properties = {{"essence", "hand"}};
  config.objects = {{"c1", 5, {{"shape", "cube"}, {"size", "small"}}},
                    {"c2", 10, {{"shape", "cube"}, {"size", "large"}}},
                    {"s1", 15, {{"shape", "sphere"}, {"size", "large"}}},
                    {"s2", 20, {{"shape", "sphere"}, {"size", "small"}}},
                    {"cyl", 25, {{"shape", "cylinder"}, {"size", "large"}}}};
  config.commands = {{"move", CommandKind::kMove, {}},
                     {"grab_type_1", CommandKind::kGrab, {{"size", "small"}}},
                     {"grab_type_2", CommandKind::kGrab, {{"size", "large"}}},
                     {"release", CommandKind::kRelease, {}}};
  config.lowest_position = -5;
  config.highest_position = 30;
  return config;
}

Term Move(double delta) {
  return MakeCommand(Term::Ontology("move"), {Term::Entity("h"), Term::Number(delta)});
}
Term Do(const std::string& name) {
  return MakeCommand(Term::Ontology(name), {Term::Entity("h")});
}

class ScriptedWorldTest : public testing::Test {
 protected:
  ActOutcome Act(std::vector<Term> commands) {
    now_ = now_ + Milliseconds(100);
    return *world_->Act(commands, {now_ - Milliseconds(40), now_});
  }
  std::vector<std::string> Observed() {
    std::vector<std::string> texts;
    const std::vector<Fact> facts = *world_->Observe({now_, now_ + Milliseconds(100)});
    for (const Fact& fact : facts) texts.push_back(ToText(fact.payload));
    return texts;
  }
  std::string Holding() { return Observed()[1]; }

  std::unique_ptr<World> world_ = std::move(*MakeScriptedWorld(FiveObjects()));
  Time now_;
};

TEST_F(ScriptedWorldTest, FactsComeHandFirstThenObjectsAsConfigured) {
  EXPECT_THAT(Observed(),
              ElementsAre("(mk.val h position 0)", "(mk.val h holding [])", "(mk.val c1 position 5)",
                          "(mk.val c2 position 10)", "(mk.val s1 position 15)", "(mk.val s2 position 20)",
                          "(mk.val cyl position 25)"));
  EXPECT_EQ(world_->Observe({now_, now_ + Milliseconds(100)})->front().interval,
            (TimeInterval{now_, now_ + Milliseconds(100)}));
}

TEST_F(ScriptedWorldTest, PropertiesHoldAlways) {
  const std::vector<Fact> properties = world_->Properties();
  ASSERT_EQ(properties.size(), 11u);
  EXPECT_EQ(ToText(properties[0].payload), "(mk.val h essence hand)");
  EXPECT_EQ(ToText(properties[1].payload), "(mk.val c1 shape cube)");
  EXPECT_EQ(properties[1].interval, kAlways);
}

TEST_F(ScriptedWorldTest, EachGrabHoldsExactlyWhatItsRuleSays) {
  const ScriptedWorldConfig config = FiveObjects();
  for (const ScriptedObject& object : config.objects) {
    for (const std::string grab : {"grab_type_1", "grab_type_2"}) {
      world_ = std::move(*MakeScriptedWorld(config));
      now_ = {};
      const ActOutcome outcome = Act({Move(*object.position), Do(grab)});
      const bool fits = (object.properties[1].value == "small") == (grab == "grab_type_1");
      EXPECT_EQ(Holding(), "(mk.val h holding [" + (fits ? object.entity : "") + "])")
          << object.entity << " " << grab;
      EXPECT_EQ(outcome.executed.size(), 2u) << "a grab that holds nothing was carried out all the same";
    }
  }
}

TEST_F(ScriptedWorldTest, AHeldObjectMovesWithTheHandUntilItIsReleased) {
  Act({Move(5), Do("grab_type_1"), Move(2)});
  EXPECT_EQ(Observed()[2], "(mk.val c1 position 7)");

  Act({Do("release"), Move(1)});

  EXPECT_EQ(Holding(), "(mk.val h holding [])");
  EXPECT_EQ(Observed()[0], "(mk.val h position 8)");
  EXPECT_EQ(Observed()[2], "(mk.val c1 position 7)");
}

TEST_F(ScriptedWorldTest, GrabbingBesideAnObjectHoldsNothing) {
  Act({Move(4.9), Do("grab_type_1")});
  EXPECT_EQ(Holding(), "(mk.val h holding [])");
}

TEST_F(ScriptedWorldTest, AMoveIsCutAtTheEndOfTheRange) {
  const ActOutcome outcome = Act({Move(100)});
  EXPECT_THAT(outcome.executed, ElementsAre(Move(30)));
  EXPECT_THAT(outcome.notes, ElementsAre(HasSubstr("the workspace ends there")));
}

TEST_F(ScriptedWorldTest, WhatCannotBeDoneIsNotReportedAsDone) {
  const Term move = Term::Ontology("move");
  const std::vector<Term> bad{Do("dance"),
                              Do("move"),
                              MakeCommand(move, {Term::Entity("c1"), Term::Number(1)}),
                              MakeCommand(move, {Term::Entity("h"), Term::Entity("c1")}),
                              Term::Entity("h"),
                              Term::Nil(),
                              Term::Struct("cmd", {move, Term::Entity("h")})};

  const ActOutcome outcome = Act(bad);

  EXPECT_THAT(outcome.executed, IsEmpty());
  EXPECT_EQ(outcome.notes.size(), bad.size());
  EXPECT_EQ(Observed()[0], "(mk.val h position 0)");
}

TEST_F(ScriptedWorldTest, AFullHandDoesNotGrab) {
  EXPECT_EQ(Act({Move(5), Do("grab_type_1"), Do("grab_type_1")}).executed.size(), 2u);
}

TEST_F(ScriptedWorldTest, TheStateTellsPlacesAndWhatIsHeld) {
  const ActOutcome outcome = Act({Move(5), Do("grab_type_1"), Move(1)});
  ASSERT_EQ(outcome.states.size(), 1u);
  EXPECT_EQ(outcome.states[0], world_->State());
  EXPECT_EQ(world_->State().time, Time{100'000});
  EXPECT_THAT(world_->State().qpos, ElementsAre(6, 6, 10, 15, 20, 25));
  EXPECT_THAT(world_->State().ctrl, ElementsAre(1, 0, 0, 0, 0));
}

TEST_F(ScriptedWorldTest, ManySmallMovesDoNotDrift) {
  for (int i = 0; i < 50; ++i) Act({Move(0.1)});
  EXPECT_EQ(Observed()[0], "(mk.val h position 5)");
  Act({Do("grab_type_1")});
  EXPECT_EQ(Holding(), "(mk.val h holding [c1])");
}

TEST_F(ScriptedWorldTest, TimeDoesNotRunBackwards) {
  Act({});
  EXPECT_FALSE(world_->Act({}, {{0}, {50'000}}).ok());
}

// A world of named places: the hand has no position and reaches everything.
ScriptedWorldConfig DoorAndTable() {
  ScriptedWorldConfig config;
  config.hand_entity = "h";
  config.hand_position.reset();
  config.objects = {{"c1", {}, {{"size", "large"}}, {{"at", "door"}}},
                    {"s1", {}, {{"size", "large"}}, {{"at", "door"}}}};
  ScriptedCommand push{"push", CommandKind::kChange};
  push.requires_all = {{"at", "door"}};
  push.sets = {{"at", "table"}};
  ScriptedCommand grab{"grab", CommandKind::kGrab, {{"size", "large"}}};
  grab.requires_all = {{"at", "table"}};
  ScriptedCommand release{"release", CommandKind::kRelease};
  release.sets = {{"at", "shelf"}};
  config.commands = {push, grab, release};
  return config;
}

class DeclaredWorldTest : public ScriptedWorldTest {
 protected:
  void Begin(const ScriptedWorldConfig& config) {
    world_ = std::move(*MakeScriptedWorld(config));
    now_ = {};
  }
};

TEST_F(DeclaredWorldTest, AChangeAltersTheFirstThingItsConditionsAllow) {
  Begin(DoorAndTable());
  EXPECT_THAT(Observed(), ElementsAre("(mk.val h holding [])", "(mk.val c1 at door)", "(mk.val s1 at door)"));
  Act({Do("push")});
  EXPECT_THAT(Observed(),
              ElementsAre("(mk.val h holding [])", "(mk.val c1 at table)", "(mk.val s1 at door)"));
  Act({Do("push"), Do("push")});
  EXPECT_THAT(Observed(),
              ElementsAre("(mk.val h holding [])", "(mk.val c1 at table)", "(mk.val s1 at table)"));
}

TEST_F(DeclaredWorldTest, AGrabWaitsUntilWhatItRequiresHoldsAndAReleaseSetsTheThingDown) {
  Begin(DoorAndTable());
  Act({Do("grab")});
  EXPECT_EQ(Observed()[0], "(mk.val h holding [])");
  Act({Do("push"), Do("grab")});
  EXPECT_EQ(Observed()[0], "(mk.val h holding [c1])");
  EXPECT_EQ(Act({Do("release")}).executed.size(), 1u);
  EXPECT_THAT(Observed(),
              ElementsAre("(mk.val h holding [])", "(mk.val c1 at shelf)", "(mk.val s1 at door)"));
}

TEST_F(DeclaredWorldTest, ADeclaredObjectIsActedOnWhereverItIs) {
  ScriptedWorldConfig config = FiveObjects();
  ScriptedCommand fetch{"fetch", CommandKind::kChange};
  fetch.object = "s2";
  fetch.moves_to = 0;
  config.commands.push_back(fetch);
  Begin(config);
  Act({Do("fetch")});
  EXPECT_THAT(Observed(),
              ElementsAre("(mk.val h position 0)", "(mk.val h holding [])", "(mk.val c1 position 5)",
                          "(mk.val c2 position 10)", "(mk.val s1 position 15)", "(mk.val s2 position 0)",
                          "(mk.val cyl position 25)"));
}

TEST_F(DeclaredWorldTest, ACommandMayNameTheThingInsteadOfTheHand) {
  ScriptedWorldConfig config = DoorAndTable();
  config.commands[0].names_thing = true;
  Begin(config);
  const auto push = [](const std::string& thing) {
    return MakeCommand(Term::Ontology("push"), {Term::Entity(thing)});
  };
  EXPECT_THAT(Act({push("s1")}).executed, ElementsAre(push("s1")));
  EXPECT_THAT(Observed(),
              ElementsAre("(mk.val h holding [])", "(mk.val c1 at door)", "(mk.val s1 at table)"));
  EXPECT_THAT(Act({push("h"), push("s2")}).executed, IsEmpty());
}

TEST_F(DeclaredWorldTest, AReleaseFailsOnceAfterTwoThatGoWell) {
  ScriptedWorldConfig config = FiveObjects();
  config.commands[3].fails = {{{}, 2, 1}};
  Begin(config);
  Act({Move(5)});
  Act({Do("release"), Do("release"), Do("release")});  // of nothing: these are no tries
  std::string held;
  for (int i = 0; i < 5; ++i) {
    Act({Do("grab_type_1")});  // refused after the failure, as the hand still holds it
    const ActOutcome outcome = Act({Do("release")});
    EXPECT_EQ(outcome.executed.size(), 1u) << "it was carried out, whatever came of it";
    held += Holding() == "(mk.val h holding [])" ? "-" : "X";
  }
  EXPECT_EQ(held, "--X--");
}

TEST_F(DeclaredWorldTest, ARuleOfFailureCountsOnlyWhatItIsAbout) {
  ScriptedWorldConfig config = FiveObjects();
  config.commands[1].holds = {};
  config.commands[1].fails = {{{{"size", "large"}}, 0, {}}};
  Begin(config);
  Act({Move(5), Do("grab_type_1")});
  EXPECT_EQ(Holding(), "(mk.val h holding [c1])");
  Act({Do("release"), Move(5), Do("grab_type_1"), Do("grab_type_1")});
  EXPECT_EQ(Holding(), "(mk.val h holding [])");
}

TEST_F(DeclaredWorldTest, AMoveThatFailsIsReportedAndMovesNothing) {
  ScriptedWorldConfig config = FiveObjects();
  config.commands[0].fails = {{{}, 0, 1}};
  Begin(config);
  EXPECT_THAT(Act({Move(5)}).executed, ElementsAre(Move(5)));
  EXPECT_EQ(Observed()[0], "(mk.val h position 0)");
  Act({Move(5)});
  EXPECT_EQ(Observed()[0], "(mk.val h position 5)");
}

TEST_F(DeclaredWorldTest, AMoveIsCutToTheLargestThatIsAllowed) {
  ScriptedWorldConfig config = FiveObjects();
  config.commands[0].largest = 4;
  Begin(config);
  const ActOutcome outcome = Act({Move(7), Move(-5), Move(4)});
  EXPECT_THAT(outcome.executed, ElementsAre(Move(4), Move(-4), Move(4)));
  EXPECT_THAT(outcome.notes,
              ElementsAre(HasSubstr("no move may be longer"), HasSubstr("no move may be longer")));
}

TEST_F(DeclaredWorldTest, WhatMovesByItselfIsWhereItsSpeedTakesItAndASpeedChangesAfterTheSensorsHaveLooked) {
  ScriptedWorldConfig config;
  config.hand_entity = "h";
  config.hand_position.reset();
  config.objects = {{"b", 0, {}, {}, 40, {{2, 70}, {3, -20}}}};
  Begin(config);
  std::vector<std::string> seen;
  for (int frame = 0; frame < 5; ++frame) {
    const std::vector<std::string> facts = Observed();
    seen.push_back(facts[1] + " " + facts[2]);
    Act({});
  }
  EXPECT_THAT(
      seen,
      ElementsAre("(mk.val b position 0) (mk.val b speed 40)", "(mk.val b position 4) (mk.val b speed 40)",
                  "(mk.val b position 8) (mk.val b speed 40)", "(mk.val b position 15) (mk.val b speed 70)",
                  "(mk.val b position 13) (mk.val b speed -20)"));
}

// Semantics 7.2: a held value begins two time tolerances into its frame, so it may be a cause of what is seen
// next.
TEST_F(DeclaredWorldTest, ASpeedIsSensedInHoldMode) {
  ScriptedWorldConfig config = FiveObjects();
  config.objects[0].speed_per_s = 1;
  Begin(config);
  const std::vector<Fact> facts = *world_->Observe({{0}, {100'000}});
  EXPECT_EQ(facts[2].interval, (TimeInterval{{0}, {100'000}}));
  EXPECT_EQ(ToText(facts[3].payload), "(mk.val c1 speed 1)");
  EXPECT_EQ(facts[3].interval, (TimeInterval{{20'000}, {100'000}}));
  config.held_values = {"position"};
  Begin(config);
  EXPECT_EQ((*world_->Observe({{0}, {100'000}}))[0].interval, (TimeInterval{{20'000}, {100'000}}));
}

TEST_F(DeclaredWorldTest, WhatMovesByItselfRestsInTheHand) {
  ScriptedWorldConfig config = FiveObjects();
  config.objects[0].speed_per_s = 10;
  Begin(config);
  Act({Move(5), Do("grab_type_1")});
  EXPECT_EQ(Observed()[2], "(mk.val c1 position 5)");
  EXPECT_EQ(Observed()[3], "(mk.val c1 speed 0)");
  Act({Do("release")});
  EXPECT_EQ(Observed()[2], "(mk.val c1 position 6)");
}

TEST(MakeScriptedWorld, WhatIsDeclaredMustFitTogether) {
  ScriptedWorldConfig config = DoorAndTable();
  config.commands.push_back({"move", CommandKind::kMove});
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("expected a position of the hand"));
  config = DoorAndTable();
  config.commands[0].object = "c9";
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("found 'c9'"));
  config = DoorAndTable();
  config.objects[0].speed_per_s = 1;
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("as it has a speed"));
  config = FiveObjects();
  config.objects[0].speed_changes = {{1, 1}};
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("expected a speed at the start"));
  config.objects[0].speed_per_s = 1;
  config.objects[0].speed_changes = {{1, 1}, {1, 2}};
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("by rising frame"));
}

TEST(MakeScriptedWorld, WrongConfigurationsAreRefused) {
  ScriptedWorldConfig config = FiveObjects();
  config.objects[1].entity = "c1";
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("'c1' is given twice"));
  config = FiveObjects();
  config.commands[1].name = "move";
  EXPECT_THAT(MakeScriptedWorld(config).error().message, HasSubstr("'move' is given twice"));
  config = FiveObjects();
  config.hand_position = 99;
  EXPECT_FALSE(MakeScriptedWorld(config).ok());
  EXPECT_FALSE(MakeScriptedWorld({}).ok());
}

}  // namespace
}  // namespace aerascope
