// Inverse kinematics of an arm: joint positions that bring the tool to a place, pointing straight down.
// Damped least squares on MuJoCo's Jacobians. With fewer than six joints the tool's yaw is left free.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/world/mujoco_binding.h"
#include "engine/world/mujoco_model.h"

namespace aerascope {

// Where the tool site should be. Its z axis points down, its x axis along yaw (counter-clockwise from the
// world's x).
struct ToolPose {
  std::array<double, 3> position_m{};
  double yaw_rad = 0;

  bool operator==(const ToolPose&) const = default;
};

struct IkSolution {
  std::vector<double> joints;
  double position_error_m = 0;
  double rotation_error_rad = 0;

  bool reached() const { return position_error_m < 1e-4 && rotation_error_rad < 1e-3; }
};

class ArmKinematics {
 public:
  // The model must outlive this.
  ArmKinematics(const mjModel& model, const MujocoBinding& binding);

  // The search starts from the given joint positions and keeps to the joints' ranges. When the pose cannot be
  // reached, the solution is as near as the search came.
  IkSolution Solve(const ToolPose& target, std::span<const double> start);

 private:
  struct Deviation;
  Deviation Measure(const ToolPose& target, std::span<const double> joints);

  const mjModel& model_;
  int tool_site_;
  std::vector<ArmJoint> arm_;
  DataPointer scratch_;
  std::vector<double> translation_jacobian_;  // 3 x nv, row by row
  std::vector<double> rotation_jacobian_;
};

}  // namespace aerascope
