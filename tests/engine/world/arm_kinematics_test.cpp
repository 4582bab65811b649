// Inverse kinematics on the tabletop arm: the tool gets where it is asked to be, or says that it cannot.
#include "engine/world/arm_kinematics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/world/tabletop.h"

namespace aerascope {
namespace {

struct Arm {
  explicit Arm(const MujocoWorldConfig& config)
      : model(std::move(*LoadModel(*PackModelFile(config.model_path)))),
        binding(*BindModel(*model, config)) {}
  ModelPointer model;
  MujocoBinding binding;
};

// Where the tool really is with these joints, as MuJoCo sees it.
struct Tool {
  std::array<double, 3> position;
  std::array<double, 3> approach;  // its z axis
  std::array<double, 3> closing;   // its x axis
};

Tool ToolWith(const Arm& arm, const std::vector<double>& joints) {
  const DataPointer data(mj_makeData(arm.model.get()));
  for (std::size_t i = 0; i < joints.size(); ++i) data->qpos[arm.binding.arm[i].qpos_address] = joints[i];
  mj_kinematics(arm.model.get(), data.get());
  const mjtNum* p = data->site_xpos + 3 * arm.binding.tool_site;
  const mjtNum* m = data->site_xmat + 9 * arm.binding.tool_site;
  return {{p[0], p[1], p[2]}, {m[2], m[5], m[8]}, {m[0], m[3], m[6]}};
}

TEST(ArmKinematics, EveryPlaceOfTheWorkspaceIsReachedWithinAMillimetre) {
  const MujocoWorldConfig config = TabletopConfig(0);
  const Arm arm(config);
  ArmKinematics kinematics(*arm.model, arm.binding);
  for (double height : {config.motion.grasp_height_m, config.motion.hover_height_m}) {
    for (double x = config.motion.workspace_min_m[0]; x <= config.motion.workspace_max_m[0] + 1e-9;
         x += 0.04) {
      for (double y = config.motion.workspace_min_m[1]; y <= config.motion.workspace_max_m[1] + 1e-9;
           y += 0.022) {
        const IkSolution solution = kinematics.Solve({{x, y, height}, 0.3}, config.hand.home_posture);
        ASSERT_TRUE(solution.reached())
            << x << " " << y << " " << height << " misses by " << solution.position_error_m;
        const Tool tool = ToolWith(arm, solution.joints);
        EXPECT_LT(std::hypot(tool.position[0] - x, tool.position[1] - y, tool.position[2] - height), 1e-5);
        EXPECT_NEAR(tool.approach[2], -1, 1e-6);
        EXPECT_NEAR(std::atan2(tool.closing[1], tool.closing[0]), 0.3, 1e-5);
      }
    }
  }
}

TEST(ArmKinematics, AFarPlaceIsNotReachedAndJointsStayInTheirRanges) {
  const MujocoWorldConfig config = TabletopConfig(0);
  const Arm arm(config);
  ArmKinematics kinematics(*arm.model, arm.binding);

  const IkSolution solution = kinematics.Solve({{2, 2, 0.1}, 0}, config.hand.home_posture);

  EXPECT_FALSE(solution.reached());
  EXPECT_GT(solution.position_error_m, 1);
  for (std::size_t i = 0; i < solution.joints.size(); ++i) {
    const mjtNum* range = arm.model->jnt_range + 2 * arm.binding.arm[i].joint;
    EXPECT_GE(solution.joints[i], range[0]);
    EXPECT_LE(solution.joints[i], range[1]);
  }
}

TEST(ArmKinematics, AnArmOfFiveJointsPointsDownAndLeavesTheYawFree) {
  MujocoWorldConfig config = TabletopConfig(0);
  config.hand.arm_joints.pop_back();
  config.hand.home_posture.pop_back();
  const Arm arm(config);
  ArmKinematics kinematics(*arm.model, arm.binding);

  const IkSolution solution = kinematics.Solve({{0.1, -0.1, 0.1}, 0}, config.hand.home_posture);

  ASSERT_TRUE(solution.reached());
  EXPECT_NEAR(ToolWith(arm, solution.joints).approach[2], -1, 1e-6);
}

TEST(ArmKinematics, TheSameQuestionHasTheSameAnswer) {
  const MujocoWorldConfig config = TabletopConfig(0);
  const Arm arm(config);
  ArmKinematics kinematics(*arm.model, arm.binding);
  const ToolPose pose{{0.1, -0.1, 0.1}, 0};

  const IkSolution first = kinematics.Solve(pose, config.hand.home_posture);
  kinematics.Solve({{-0.2, 0, 0.1}, 1}, config.hand.home_posture);

  EXPECT_EQ(kinematics.Solve(pose, config.hand.home_posture).joints, first.joints);
}

}  // namespace
}  // namespace aerascope
