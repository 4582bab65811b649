#include "viewer/scene/state_timeline.h"

#include <gtest/gtest.h>

namespace aerascope {
namespace {

Event StateAt(std::int64_t us, double position) {
  Event event;
  event.body = WorldStateRecorded{{us}, {position}, {}, {}};
  return event;
}

TEST(StateTimeline, AStateHoldsUntilTheNext) {
  const std::vector<Event> events{StateAt(100, 1), StateAt(200, 2)};
  const StateTimeline timeline(events);
  EXPECT_EQ(timeline.At({150})->qpos[0], 1);
  EXPECT_EQ(timeline.At({199})->qpos[0], 1);
  EXPECT_EQ(timeline.At({200})->qpos[0], 2);
  EXPECT_EQ(timeline.At({10'000})->qpos[0], 2);
}

TEST(StateTimeline, BeforeTheFirstThereIsTheFirst) {
  const std::vector<Event> events{StateAt(100, 1)};
  EXPECT_EQ(StateTimeline(events).At({0})->qpos[0], 1);
}

TEST(StateTimeline, WithoutStatesThereIsNothing) {
  EXPECT_TRUE(StateTimeline({}).empty());
  EXPECT_EQ(StateTimeline({}).At({0}), nullptr);
}

TEST(StateTimeline, OfOneTimeTheLastRecordedCountsAndImaginedStatesDoNot) {
  std::vector<Event> events{StateAt(200, 3), StateAt(100, 1), StateAt(100, 2), StateAt(100, 9)};
  events[3].simulation = {7};
  const StateTimeline timeline(events);
  ASSERT_EQ(timeline.states().size(), 2u);
  EXPECT_EQ(timeline.At({100})->qpos[0], 2);
  EXPECT_EQ(timeline.At({300})->qpos[0], 3);
}

}  // namespace
}  // namespace aerascope
