// The journal with kinds of events left out: causes lead on past the gap.
#include "engine/reason/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>

#include "tests/engine/reason/pick_and_place.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

EventKindSet AllReports() {
  EventKindSet kinds;
  for (const std::string& name : ReportKindNames()) kinds.set(KindOfName(name));
  return kinds;
}

EventBody Frame() {
  return FrameStarted{{Time{0}, Time{100'000}}};
}

TEST(Journal, WhatAnOmittedEventCausedIsCausedByThatEventsCauses) {
  // Given a journal that leaves out all reports, and a report with two causes
  EventList sink;
  Journal journal(&sink);
  journal.LeaveOut(AllReports());
  const EventId first = journal.Write({0}, Frame());
  const EventId second = journal.Write({0}, Frame());
  const EventId report = journal.Write({5}, GoalSkipped{}, {second, first});

  // When something names the report as its cause, beside one of the report's causes
  journal.Write({7}, GoalSet{}, {first, report});

  // Then it is caused by what caused the report, each once, and numbers have no gap
  ASSERT_EQ(sink.events.size(), 3u);
  EXPECT_EQ(sink.events[2].id, EventId{3});
  EXPECT_THAT(sink.events[2].causes, ElementsAre(first, second));
}

TEST(Journal, AnOmittedChainIsFollowedToItsRecordedEnds) {
  EventList sink;
  Journal journal(&sink);
  journal.LeaveOut(AllReports());
  const EventId first = journal.Write({0}, Frame());
  const EventId second = journal.Write({0}, Frame());
  const EventId third = journal.Write({0}, Frame());
  const EventId inner = journal.Write({1}, InductionStarted{}, {first, second});
  const EventId outer = journal.Write({1}, CauseConsidered{}, {inner, third});
  EXPECT_EQ(journal.last_event(), outer);
  journal.Write({1}, GoalSet{}, {outer});
  EXPECT_THAT(sink.events.back().causes, ElementsAre(first, second, third));
}

TEST(Journal, AnOmittedEventDoesNotMoveTheKnowledgeBase) {
  EventList sink;
  Journal journal(&sink);
  journal.LeaveOut(AllReports());
  journal.Write({10}, Frame());
  journal.Write({20}, GoalSkipped{}, {});
  EXPECT_EQ(journal.knowledge().now(), Time{10});  // as in the fold of what was recorded
}

TEST(Journal, OnlyWhatIsLeftOutNeedNotBeMade) {
  EventList sink;
  Journal journal(&sink);
  EXPECT_TRUE(journal.Records<GoalSkipped>());
  journal.LeaveOut(AllReports());
  EXPECT_FALSE(journal.Records<GoalSkipped>());
  EXPECT_TRUE(journal.Records<GoalSet>());
}

// Own: the law, against a log in which everything is recorded.
TEST(Journal, LeavingOutIsTheFullLogWithOmittedCausesReplacedByTheirCauses) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    AnyEvents any(seed);
    EventKindSet left_out;
    const EventKindSet reports = AllReports();
    for (std::size_t kind = 0; kind < kEventKinds; ++kind) left_out[kind] = reports[kind] && any.Chance();
    EventList everything;
    EventList recorded;
    Journal full(&everything);
    Journal thin(&recorded);
    thin.LeaveOut(left_out);

    // The same script for both: each event names some of the events before it.
    std::vector<EventId> in_full;
    std::vector<EventId> in_thin;
    for (int i = 0; i < 60; ++i) {
      const bool report = any.Below(3) > 0;
      std::size_t kind = static_cast<std::size_t>(any.Below(kEventKinds));
      while (IsReportKind(kind) != report) kind = (kind + 1) % kEventKinds;
      const EventBody body = any.AnyEvent(1, kind).body;
      std::vector<EventId> full_causes;
      std::vector<EventId> thin_causes;
      for (std::int64_t n = any.Below(4); n > 0 && i > 0; --n) {
        const auto cause = static_cast<std::size_t>(any.Below(i));
        full_causes.push_back(in_full[cause]);
        thin_causes.push_back(in_thin[cause]);
      }
      in_full.push_back(full.Write({i}, body, full_causes));
      in_thin.push_back(thin.Write({i}, body, thin_causes));
    }

    // The expected thin log: each cause is followed to recorded events, in order, repeats dropped.
    std::map<EventId, std::vector<EventId>> stands_for;  // number in the full log -> numbers in the thin one
    std::size_t next = 0;
    for (const Event& event : everything.events) {
      std::vector<EventId> causes;
      for (const EventId cause : event.causes) {
        for (const EventId own : stands_for[cause]) {
          if (std::find(causes.begin(), causes.end(), own) == causes.end()) causes.push_back(own);
        }
      }
      if (left_out[event.body.index()]) {
        stands_for[event.id] = causes;
        continue;
      }
      stands_for[event.id] = {EventId{static_cast<std::int64_t>(next) + 1}};
      RC_ASSERT(next < recorded.events.size());
      const Event& found = recorded.events[next++];
      RC_ASSERT(found.id == EventId{static_cast<std::int64_t>(next)});
      RC_ASSERT(found.body.index() == event.body.index());
      RC_ASSERT(found.causes == causes);
    }
    RC_ASSERT(next == recorded.events.size());
  }));
}

// Own: the agent lives the same life whether or not its considerations are written down.
TEST(Journal, LeavingOutChangesNothingTheAgentDoesOrLearns) {
  const auto pursue = [](PickAndPlace* task) {
    task->TeachBothGrasps();
    return task->Pursue({task->Holding("s1"), task->Holding(""), task->Holding("s2")});
  };
  PickAndPlace full;
  PickAndPlace thin;
  thin.reasoner.journal().LeaveOut(AllReports());
  EXPECT_EQ(pursue(&full), pursue(&thin));
  EXPECT_EQ(full.commands, thin.commands);
  EXPECT_LT(thin.events.events.size(), full.events.events.size());
  const KnowledgeBase& a = full.reasoner.knowledge();
  const KnowledgeBase& b = thin.reasoner.knowledge();
  ASSERT_EQ(a.models().size(), b.models().size());
  for (const auto& [id, record] : a.models()) {
    ASSERT_TRUE(b.Find(id)) << id.value;
    EXPECT_EQ(ToText(record.model), ToText(b.Find(id)->model));
    EXPECT_EQ(record.evidence, b.Find(id)->evidence);
  }
  // And every event that must have a cause has one, an earlier event.
  for (const Event& event : thin.events.events) {
    EXPECT_TRUE(MayBeUncaused(event.body) || !event.causes.empty()) << ToText(event);
    for (const EventId cause : event.causes)
      EXPECT_TRUE(cause.value >= 1 && cause < event.id) << ToText(event);
  }
}

}  // namespace
}  // namespace aerascope
