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
      const ActOutcome outcome = Act({Move(object.position), Do(grab)});
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
