// Which kinds of events a scenario may leave out.
#include "engine/event/report_kinds.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "engine/event/apply.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

std::vector<std::size_t> Reports() {
  std::vector<std::size_t> kinds;
  for (const std::string& name : ReportKindNames()) kinds.push_back(KindOfName(name));
  return kinds;
}

// Own: the law that makes leaving out harmless.
TEST(ReportKinds, MoveTheClockOfAKnowledgeBaseOnly) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    AnyEvents any(seed);
    KnowledgeBase kb;
    for (const std::size_t kind : Reports()) {
      Event event = any.AnyEvent(1, kind);
      event.simulation = {};
      Apply(event, &kb);
      RC_ASSERT(kb.now() == event.time);
      RC_ASSERT(kb.symbols().empty() && kb.facts().empty() && kb.goals().empty() && kb.predictions().empty());
      RC_ASSERT(kb.composite_states().empty() && kb.models().empty());
    }
  }));
}

TEST(ReportKinds, AlwaysHaveACause) {
  // Given any event of a report kind
  AnyEvents any(3);
  for (const std::size_t kind : Reports()) {
    // Then whoever it caused has causes even when it is left out
    EXPECT_FALSE(MayBeUncaused(any.AnyEvent(1, kind).body)) << kind;
  }
}

TEST(ReportKinds, AreNotTheStoryItself) {
  for (const char* kind :
       {"EpisodeStarted", "FrameStarted", "WorldStateRecorded", "FactObserved", "ModelCreated", "IcstFound",
        "PredictionMade", "GoalSet", "SimulationStarted", "CommandIssued", "EpisodeEnded"}) {
    EXPECT_FALSE(IsReportKind(KindOfName(kind))) << kind;
  }
  EXPECT_TRUE(IsReportKind(KindOf<CauseConsidered>()));
  EXPECT_FALSE(IsReportKind(kEventKinds));
  EXPECT_EQ(KindOf<GoalSkipped>(), KindOfName("GoalSkipped"));
}

TEST(ReportKinds, OnlyTheyAreLeftOutByDefault) {
  const EventKindSet left_out = LeftOutByDefault();
  EXPECT_EQ(NamesOf(left_out), "InstanceProgress");
  for (std::size_t kind = 0; kind < kEventKinds; ++kind)
    EXPECT_TRUE(!left_out[kind] || IsReportKind(kind)) << kind;
}

TEST(ReportKinds, AreNamedInTheOrderOfTheSchema) {
  EventKindSet kinds;
  kinds.set(KindOfName("GoalSkipped"));
  kinds.set(KindOfName("CauseConsidered"));
  EXPECT_EQ(NamesOf(kinds), "CauseConsidered GoalSkipped");
  EXPECT_EQ(NamesOf({}), "");
}

}  // namespace
}  // namespace aerascope
