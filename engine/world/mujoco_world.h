// MujocoWorld is a world with physics: an arm with a gripper moves over a table by inverse kinematics, grasps
// hold or fail by contact forces alone, and the sensors read positions and finger contacts. See
// mujoco_world_config.h.
//
// A grab opens the fingers, goes down, closes them and lifts; a release goes down, opens and lifts. A command
// takes the whole time it is given. Refused, with a note: unknown commands, a grab with something in the
// hand, and whatever the arm cannot reach or not in that time.
#pragma once

#include <memory>

#include "engine/world/mujoco_world_config.h"
#include "engine/world/world.h"

namespace aerascope {

// Fails when the model cannot be loaded, the configuration does not fit it, or the home position cannot be
// reached.
Result<std::unique_ptr<World>> MakeMujocoWorld(const MujocoWorldConfig& config);

}  // namespace aerascope
