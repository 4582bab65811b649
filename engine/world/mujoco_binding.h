// The parts that a MujocoWorldConfig names, found in a compiled model: ids and addresses instead of names.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "engine/base/result.h"
#include "engine/world/mujoco_world_config.h"

namespace aerascope {

// A joint of the arm and the position actuator that drives it: force = stiffness * (control - gear * joint
// position).
struct ArmJoint {
  int joint = 0;
  int qpos_address = 0;
  int dof_address = 0;
  int actuator = 0;
  double stiffness = 0;
  double gear = 1;
};

struct BoundObject {
  int body = 0;
  int qpos_address = 0;  // of its free joint: position, then quaternion
};

struct MujocoBinding {
  int tool_site = 0;
  std::vector<ArmJoint> arm;
  std::vector<int> finger_actuators;  // as in HandConfig::finger_actuators
  std::vector<BoundObject> objects;   // as in MujocoWorldConfig::objects
  std::vector<int> finger_of_body;    // by body id: the finger it belongs to, or -1
  std::vector<int> object_of_body;    // by body id: the object it belongs to, or -1
};

// Checks the whole configuration, against itself and against the model.
Result<MujocoBinding> BindModel(const mjModel& model, const MujocoWorldConfig& config);

}  // namespace aerascope
