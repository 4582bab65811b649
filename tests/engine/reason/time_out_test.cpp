// Time-outs (semantics 3.5): what is not met for long is put aside and deleted, and a failure is forgotten.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/reason/credit.h"
#include "engine/reason/time_outs.h"
#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ReasonerParameters ShortMemory() {
  ReasonerParameters parameters;
  parameters.primary_thz = Milliseconds(300);
  parameters.secondary_thz = Milliseconds(700);
  return parameters;
}

Term X(const char* state) {
  return Value(E("x"), "state", O(state));
}

// "0.3s active -> phased_out timed_out", one for each change.
std::vector<std::string> Changes(const ToyMind& mind) {
  std::vector<std::string> changes;
  for (const Event* event : mind.Found<ModelStateChanged>()) {
    const auto& change = std::get<ModelStateChanged>(event->body);
    changes.push_back(ToText(event->time) + " " + std::string(EnumName(change.before)) + " -> " +
                      std::string(EnumName(change.after)) + " " + std::string(EnumName(change.reason)));
  }
  return changes;
}

TEST(TimeOut, WhatNothingMatchesIsPutAsideAndThenDeletedWithoutBlackList) {
  // OpenAERA (semantics 3.5: primary_thz, secondary_thz), here 300 and 700 ms after the start.
  ToyMind mind(ShortMemory());
  mind.Know({}, {}, {{Free(1, X("a"), X("b")), {}, false}});
  for (int frame = 0; frame < 10; ++frame) mind.See({X("z")});
  EXPECT_THAT(Changes(mind),
              ElementsAre("0.3s active -> phased_out timed_out", "0.7s phased_out -> deleted timed_out"));
  EXPECT_FALSE(mind.reasoner.knowledge().models().begin()->second.black_listed);
}

TEST(TimeOut, AMatchBeginsTheTimeAnew) {
  // own. Given that a comes at 200 ms, then the model is put aside at 500 ms.
  ToyMind mind(ShortMemory());
  mind.Know({}, {}, {{Free(1, X("a"), X("b")), {}, false}});
  for (int frame = 0; frame < 7; ++frame) mind.See({frame == 2 ? X("a") : frame == 3 ? X("b") : X("z")});
  EXPECT_THAT(Changes(mind), ElementsAre("0.5s active -> phased_out timed_out"));
}

TEST(TimeOut, WhatWasPutAsideComesBackWhenItIsRightAgain) {
  // OpenAERA (semantics 3.5, phased in): in the secondary group it predicts silently, and a success brings it
  // back.
  ToyMind mind(ShortMemory());
  mind.Know({}, {}, {{Free(1, X("a"), X("b")), {}, false}});
  for (int frame = 0; frame < 6; ++frame) mind.See({frame == 4 ? X("a") : frame == 5 ? X("b") : X("z")});
  EXPECT_THAT(Changes(mind),
              ElementsAre("0.3s active -> phased_out timed_out", "0.5s phased_out -> active rating"));
  ASSERT_EQ(mind.All<PredictionMade>().size(), 1u);
  EXPECT_EQ(mind.All<PredictionMade>()[0]->target.confidence, 0) << "silently";
}

TEST(TimeOut, ARequirementIsMetWhenItsConditionHolds) {
  // own. Given a command that is never given and whose condition always holds, then only the command's model
  // is put aside, and the requirement model falls when that is deleted.
  ToyMind mind(ShortMemory());
  const Model go = Free(1, Command("go", {V(2)}), Value(V(2), "place", O("table")));
  const Model may = Requires(2, Value(V(0), "state", O("z")), go, {V(0), V(4), V(5)}, 2);
  mind.Know({}, {}, {{go, {}, false}, {may, {}, false}});
  for (int frame = 0; frame < 9; ++frame) mind.See({X("z")});
  EXPECT_THAT(Changes(mind),
              ElementsAre("0.3s active -> phased_out timed_out", "0.7s phased_out -> deleted timed_out",
                          "0.7s active -> deleted refers_to_deleted"));
}

TEST(TimeOut, DriveModelsStay) {
  // own. Nothing matches a drive model forward.
  ToyMind mind(ShortMemory());
  Model drive;
  drive.id = {1};
  drive.lhs = {true, X("b"), V(0), V(1)};
  drive.rhs = {true, E("run"), V(0), V(1)};
  mind.Know({}, {}, {{drive, {}, false}});
  for (int frame = 0; frame < 12; ++frame) mind.See({X("z")});
  EXPECT_THAT(Changes(mind), IsEmpty());
}

TEST(TimeOut, ByDefaultNothingIsForgotten) {
  // OpenAERA (semantics appendix B: 3.6e6 and 7.2e6 s).
  ToyMind mind;
  mind.Know({}, {}, {{Free(1, X("a"), X("b")), {}, false}});
  mind.See({X("z")});
  mind.StartAt(30'000'000);  // 3e6 s later
  mind.See({X("z")});
  EXPECT_THAT(Changes(mind), IsEmpty());
  mind.StartAt(36'000'000);
  mind.See({X("z")});
  EXPECT_THAT(Changes(mind), ElementsAre("3600000s active -> phased_out timed_out"));
}

class BlackList : public ::testing::Test {
 protected:
  // A model that was deleted because it failed, at 100 ms.
  BlackList() {
    Model model = Free(1, X("a"), X("b"));
    model.id = id = journal.NewId<ModelId>();
    const EventId made = journal.Write({}, ModelCreated{model, {}, false, Origin::kInduction, {}});
    time_outs.Check(Time{0}, made);
    Delete(id, StateChangeReason::kRating, made, Time{100'000}, &journal);
    time_outs.Met(id, Time{100'000});
  }
  bool Listed() const { return journal.knowledge().Find(id)->black_listed; }
  void CheckFrom(int first_ms, int last_ms) {
    for (int ms = first_ms; ms <= last_ms; ms += 100) time_outs.Check(Time{ms * 1000}, journal.last_event());
  }

  ModelId id;
  ReasonerParameters parameters = ShortMemory();
  EventList events;
  Journal journal{&events};
  TimeOuts time_outs{parameters, &journal};
};

TEST_F(BlackList, AFailureIsForgottenAfterLong) {
  // OpenAERA (semantics 3.5: forgotten after secondary_thz without being touched).
  CheckFrom(200, 700);
  EXPECT_TRUE(Listed());
  CheckFrom(800, 800);
  EXPECT_FALSE(Listed());
  EXPECT_EQ(events.All<ModelStateChanged>().back()->after, ModelState::kDeleted);
  EXPECT_EQ(events.All<ModelStateChanged>().back()->reason, StateChangeReason::kForgotten);
  CheckFrom(900, 3000);
  EXPECT_EQ(events.All<ModelStateChanged>().size(), 2u) << "forgotten once";
}

TEST_F(BlackList, ButNotWhileTheSameComesUpAgain) {
  // OpenAERA (semantics 3.5). Given that its like was put together again at 500 ms, it is remembered until
  // 1200 ms.
  CheckFrom(200, 400);
  journal.ComeUpAgain(id);
  CheckFrom(500, 1100);
  EXPECT_TRUE(Listed());
  CheckFrom(1200, 1200);
  EXPECT_FALSE(Listed());
}

}  // namespace
}  // namespace aerascope::toy
