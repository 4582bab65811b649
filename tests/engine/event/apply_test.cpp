// Apply is the one way a knowledge base moves: folding any beginning of a run gives the knowledge at that
// moment.
#include "engine/event/apply.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"
#include "tests/support/knowledge_edits.h"

namespace aerascope {
namespace {

Event At(std::int64_t id, std::int64_t ms, EventBody body) {
  return {{id}, {ms * 1000}, ms / 100, {}, {}, std::move(body)};
}

TEST(ApplyFold, AnyPrefixEqualsTheStateReachedOnTheWay) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    AnyEvents any(seed);
    std::vector<Event> events;
    std::vector<std::string> on_the_way;
    KnowledgeBase incremental;
    for (std::int64_t i = 1; i <= 40; ++i) {
      events.push_back(any.AnyEvent(i));
      Apply(events.back(), &incremental);
      on_the_way.push_back(Everything(incremental));
    }
    const auto length = static_cast<std::size_t>(any.Below(40)) + 1;
    KnowledgeBase folded;
    for (std::size_t i = 0; i < length; ++i) Apply(events[i], &folded);
    RC_ASSERT(Everything(folded) == on_the_way[length - 1]);
  }));
}

TEST(ApplyFold, ACopyGoesItsOwnWay) {
  AnyEvents any(11);
  KnowledgeBase kb;
  for (std::int64_t i = 1; i <= 200; ++i) Apply(any.AnyEvent(i), &kb);
  const std::string before = Everything(kb);
  KnowledgeBase copy = kb;
  for (std::int64_t i = 201; i <= 400; ++i) Apply(any.AnyEvent(i), &copy);
  EXPECT_EQ(Everything(kb), before);
  EXPECT_NE(Everything(copy), before);
}

TEST(Apply, WhatHappensInASimulationMovesTheClockOnly) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    AnyEvents any(seed);
    KnowledgeBase kb;
    Event event = any.AnyEvent(1);
    event.simulation = {7};
    Apply(event, &kb);
    KnowledgeBase clock_only;
    clock_only.SetNow(event.time, event.frame);
    RC_ASSERT(Everything(kb) == Everything(clock_only));
  }));
}

TEST(Apply, FactsHoldUntilAFrameBeginsAfterTheirEnd) {
  KnowledgeBase kb;
  Apply(At(1, 100, FrameStarted{Ms(100, 200)}), &kb);
  Apply(At(2, 100, FactObserved{{1}, Holds(E("a"), Ms(100, 200)), FactSource::kSensor}), &kb);
  Apply(At(3, 100, FactObserved{{2}, Holds(E("b"), kAlways), FactSource::kProperty}), &kb);
  EXPECT_EQ(kb.facts().size(), 2u);
  EXPECT_EQ(kb.facts().at({1}).event, EventId{2});
  Apply(At(4, 200, FrameStarted{Ms(200, 300)}), &kb);
  ASSERT_EQ(kb.facts().size(), 1u);
  EXPECT_TRUE(kb.facts().contains({2}));
  EXPECT_EQ(kb.now(), Time{200'000});
  EXPECT_EQ(kb.frame(), 2);
}

TEST(Apply, OutcomesMoveEvidenceAndCloseWhatWasOpen) {
  KnowledgeBase kb;
  Model model;
  model.id = {5};
  model.lhs = {true, MakeCommand(O("grab"), {V(0)}), V(1), V(2)};
  model.rhs = {true, MakeValue(V(0), O("holding"), E("c1")), V(3), V(4)};
  Apply(At(1, 0, ModelCreated{model, {0.75, 1}, false, Origin::kAnalogy, {4}}), &kb);
  EXPECT_EQ(kb.models().at({5}).evidence.rate(), 0.75);
  EXPECT_EQ(kb.models().at({5}).derived_from, ModelId{4});
  Apply(At(2, 0, PredictionMade{{9}, {5}, {{6}}, {}, Holds(E("x"), Ms(0, 100))}), &kb);
  Apply(At(3, 0, DriveInjected{{8}, "hold c1", Holds(E("x"), Ms(0, 100))}), &kb);
  EXPECT_TRUE(kb.predictions().contains({9}));
  EXPECT_TRUE(kb.goals().contains({8}));
  Apply(At(4, 100, PredictionSucceeded{{9}, {1}}), &kb);
  Apply(At(5, 100, GoalAchieved{{8}, {1}}), &kb);
  Apply(At(6, 100, EvidenceUpdated{{5}, true, {0.75, 1}, {1.75, 2}, false, false}), &kb);
  EXPECT_TRUE(kb.predictions().empty());
  EXPECT_TRUE(kb.goals().empty());
  EXPECT_EQ(kb.models().at({5}).evidence.rate(), 0.875);
  Apply(At(7, 100, ModelStateChanged{{5}, ModelState::kActive, ModelState::kDeleted}), &kb);
  EXPECT_EQ(kb.models().at({5}).state, ModelState::kDeleted);
}

TEST(Apply, WhatSpeaksOfUnknownThingsChangesNothing) {
  KnowledgeBase kb;
  const std::string before = Everything(kb);
  Apply(At(1, 0, EvidenceUpdated{{99}, true, {}, {}, false, false}), &kb);
  Apply(At(2, 0, ModelStateChanged{{99}, ModelState::kActive, ModelState::kDeleted}), &kb);
  Apply(At(3, 0, PredictionFailed{{99}, {}}), &kb);
  Apply(At(4, 0, GoalFailed{{99}}), &kb);
  EXPECT_EQ(Everything(kb), before);
}

}  // namespace
}  // namespace aerascope
