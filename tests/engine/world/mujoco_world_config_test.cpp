// Each wrong setting of a MuJoCo world is refused with a sentence that names it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/engine/world/tabletop.h"

namespace aerascope {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string Refusal(const std::function<void(MujocoWorldConfig&)>& spoil) {
  MujocoWorldConfig config = TabletopConfig(0);
  config.motion.settle_s = 0;
  spoil(config);
  const auto world = MakeMujocoWorld(config);
  return world ? "accepted" : world.error().message;
}

TEST(MujocoWorldConfig, TheTabletopIsAccepted) {
  EXPECT_EQ(Refusal([](MujocoWorldConfig&) {}), "accepted");
}

TEST(MujocoWorldConfig, UnknownPartsAreNamedWithTheLikeliestOne) {
  EXPECT_THAT(Refusal([](auto& c) { c.hand.tool_site = "tol"; }),
              AllOf(HasSubstr("tool_site"), HasSubstr("'tol'"), HasSubstr("'tool'")));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.arm_joints[1] = "arm_sholder"; }),
              HasSubstr("did you mean 'arm_shoulder'"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.finger_bodies[0] = "thumb"; }),
              AllOf(HasSubstr("finger_bodies"), HasSubstr("finger_left")));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.finger_actuators[0].actuator = "finger"; }),
              HasSubstr("did you mean 'fingers'"));
  EXPECT_THAT(Refusal([](auto& c) { c.objects[2].body = "s3"; }),
              AllOf(HasSubstr("object s1"), HasSubstr("'s3'")));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.tool_site = ""; }), HasSubstr("tool_site"));
}

TEST(MujocoWorldConfig, PartsOfTheWrongKindAreRefused) {
  EXPECT_THAT(Refusal([](auto& c) { c.objects[0].body = "hand"; }), HasSubstr("free joint"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.arm_joints[0] = "c1"; }), HasSubstr("hinge"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.arm_joints[0] = "finger_left"; }), HasSubstr("actuator"));
  EXPECT_THAT(Refusal([](auto& c) { c.objects[1].body = "c1"; }), HasSubstr("another object already"));
}

TEST(MujocoWorldConfig, NamesAreGivenOnce) {
  EXPECT_THAT(Refusal([](auto& c) { c.objects[1].entity = "c1"; }), HasSubstr("'c1' is given twice"));
  EXPECT_THAT(Refusal([](auto& c) { c.commands[1].name = "move"; }), HasSubstr("'move' is given twice"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.arm_joints[1] = "arm_yaw"; }), HasSubstr("given twice"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.entity = ""; }), HasSubstr("hand"));
}

TEST(MujocoWorldConfig, NumbersOutOfRangeAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(Refusal([](auto& c) { c.sensors.resolution_m = 0; }), HasSubstr("resolution"));
  EXPECT_THAT(Refusal([nan](auto& c) { c.sensors.resolution_m = nan; }), HasSubstr("resolution"));
  EXPECT_THAT(Refusal([](auto& c) { c.sensors.object_deadband_m = 0.002; }), HasSubstr("deadband"));
  EXPECT_THAT(Refusal([](auto& c) { c.motion.hover_height_m = 0.01; }), HasSubstr("hover height"));
  EXPECT_THAT(Refusal([](auto& c) { c.motion.workspace_max_m = {-1, 1}; }), HasSubstr("workspace"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.home_position_m = {5, 0}; }), HasSubstr("home position"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.home_posture.pop_back(); }), HasSubstr("home_posture"));
  EXPECT_THAT(Refusal([](auto& c) { c.commands[1].closed_gap_m = 0.2; }), HasSubstr("grab_type_1"));
  EXPECT_THAT(Refusal([](auto& c) { c.recorded_states_per_s = 0; }), HasSubstr("recorded"));
  EXPECT_THAT(Refusal([](auto& c) { c.noise.min_distance_m = 1; }), HasSubstr("min_distance"));
  EXPECT_THAT(Refusal([](auto& c) { c.hand.finger_bodies.pop_back(); }), HasSubstr("finger_bodies"));
}

TEST(MujocoWorldConfig, AHomeOutOfTheArmsReachIsRefused) {
  const std::string message = Refusal([](auto& c) {
    c.motion.workspace_max_m = {3, 3};
    c.hand.home_position_m = {2.5, 0};
  });
  EXPECT_THAT(message, AllOf(HasSubstr("home position"), HasSubstr("misses by")));
}

TEST(MujocoWorldConfig, EitherAFileOrAText) {
  EXPECT_THAT(Refusal([](auto& c) { c.model_path = ""; }), HasSubstr("neither"));
  EXPECT_THAT(Refusal([](auto& c) { c.model_text = "<mujoco/>"; }), HasSubstr("both"));
  EXPECT_THAT(Refusal([](auto& c) { c.model_path = "/nonexistent.xml"; }), HasSubstr("/nonexistent.xml"));
}

}  // namespace
}  // namespace aerascope
