#include "engine/world/arm_kinematics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace aerascope {
namespace {

constexpr int kMaxIterations = 150;
constexpr double kEnoughPosition = 1e-9;  // metres
constexpr double kEnoughRotation = 1e-8;  // radians
constexpr double kRotationWeight = 0.3;   // metres that count as much as one radian
constexpr double kMaxStep = 0.3;          // radians (or metres) of one joint in one iteration
constexpr double kLeastDamping = 1e-10;
constexpr double kDampingPerError = 0.05;

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Matrix3d Orientation(double yaw_rad) {
  Eigen::Matrix3d axes;
  axes << std::cos(yaw_rad), std::sin(yaw_rad), 0,  //
      std::sin(yaw_rad), -std::cos(yaw_rad), 0,     //
      0, 0, -1;
  return axes;
}

}  // namespace

// How far the tool is from the target, as a vector of 5 or 6 numbers, and how the joints change it.
struct ArmKinematics::Deviation {
  Eigen::VectorXd error;
  Eigen::MatrixXd jacobian;
  double position = 0;
  double rotation = 0;
};

ArmKinematics::ArmKinematics(const mjModel& model, const MujocoBinding& binding)
    : model_(model),
      tool_site_(binding.tool_site),
      arm_(binding.arm),
      scratch_(mj_makeData(&model)),
      translation_jacobian_(3 * model.nv),
      rotation_jacobian_(3 * model.nv) {}

ArmKinematics::Deviation ArmKinematics::Measure(const ToolPose& target, std::span<const double> joints) {
  mjData& data = *scratch_;
  for (std::size_t i = 0; i < arm_.size(); ++i) data.qpos[arm_[i].qpos_address] = joints[i];
  mj_kinematics(&model_, &data);
  mj_comPos(&model_, &data);
  mj_jacSite(&model_, &data, translation_jacobian_.data(), rotation_jacobian_.data(), tool_site_);

  const Eigen::Map<const Rows> translation(translation_jacobian_.data(), 3, model_.nv);
  const Eigen::Map<const Rows> rotation(rotation_jacobian_.data(), 3, model_.nv);
  const Eigen::Map<const Eigen::Vector3d> position(data.site_xpos + 3 * tool_site_);
  const Eigen::Matrix3d orientation = Eigen::Map<const Rows>(data.site_xmat + 9 * tool_site_, 3, 3);

  // The rotation error is taken in the tool's own frame: its third part is the yaw, dropped for arms without
  // a sixth joint.
  const Eigen::AngleAxisd turn(orientation.transpose() * Orientation(target.yaw_rad));
  const Eigen::Vector3d rotation_error = turn.angle() * turn.axis();
  const int rotations = arm_.size() >= 6 ? 3 : 2;

  Deviation deviation;
  deviation.error.resize(3 + rotations);
  deviation.jacobian.resize(3 + rotations, static_cast<Eigen::Index>(arm_.size()));
  deviation.error.head<3>() = Eigen::Map<const Eigen::Vector3d>(target.position_m.data()) - position;
  deviation.error.tail(rotations) = kRotationWeight * rotation_error.head(rotations);
  for (std::size_t i = 0; i < arm_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    deviation.jacobian.col(column).head<3>() = translation.col(arm_[i].dof_address);
    const Eigen::Vector3d turning = orientation.transpose() * rotation.col(arm_[i].dof_address);
    deviation.jacobian.col(column).tail(rotations) = kRotationWeight * turning.head(rotations);
  }
  deviation.position = deviation.error.head<3>().norm();
  deviation.rotation = rotation_error.head(rotations).norm();
  return deviation;
}

IkSolution ArmKinematics::Solve(const ToolPose& target, std::span<const double> start) {
  IkSolution solution{std::vector<double>(start.begin(), start.end()), 0, 0};
  for (int iteration = 0;; ++iteration) {
    const Deviation deviation = Measure(target, solution.joints);
    solution.position_error_m = deviation.position;
    solution.rotation_error_rad = deviation.rotation;
    const bool enough = deviation.position < kEnoughPosition && deviation.rotation < kEnoughRotation;
    if (enough || iteration == kMaxIterations) return solution;

    // Damping that fades with the error: careful far away, quadratic convergence near the target.
    const double damping = kLeastDamping + kDampingPerError * deviation.error.squaredNorm();
    Eigen::MatrixXd normal = deviation.jacobian * deviation.jacobian.transpose();
    normal.diagonal().array() += damping;
    Eigen::VectorXd step = deviation.jacobian.transpose() * normal.ldlt().solve(deviation.error);
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest > kMaxStep) step *= kMaxStep / largest;
    for (std::size_t i = 0; i < arm_.size(); ++i) {
      double& joint = solution.joints[i];
      joint += step[static_cast<Eigen::Index>(i)];
      if (!model_.jnt_limited[arm_[i].joint]) continue;
      const mjtNum* range = model_.jnt_range + 2 * arm_[i].joint;
      joint = std::clamp(joint, range[0], range[1]);
    }
  }
}

}  // namespace aerascope
