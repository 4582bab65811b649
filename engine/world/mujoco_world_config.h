// Everything MujocoWorld must be told about a MuJoCo model: which parts are the arm, the fingers and the
// objects, what the sensors report and how the commands move the hand. All lengths in metres, angles in
// radians, times in seconds.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/world/world.h"
#include "engine/world/world_config.h"

namespace aerascope {

// An actuator of the gripper. Its control is control_at_zero_gap + control_per_gap * (gap between the pads in
// metres).
struct FingerActuator {
  std::string actuator;
  double control_per_gap = 0.5;
  double control_at_zero_gap = 0;
};

// The hand and the arm that carries it.
struct HandConfig {
  std::string entity;
  std::vector<EntityProperty> properties;
  std::string tool_site;  // z points out of the hand; x is the direction in which the fingers close
  std::vector<std::string> arm_joints;  // hinges or slides, each driven by one position actuator
  std::vector<double>
      home_posture;  // joint values from which the home pose is searched; empty: the model's own
  std::array<double, 2> home_position_m{0, 0};  // where the tool hovers at the start
  double tool_yaw_rad = 0;  // direction of the tool's x axis, counter-clockwise from the world's x axis
  std::vector<std::string> finger_bodies;  // an object is held when every one of them touches it
  std::vector<FingerActuator> finger_actuators;
  double start_gap_m = 0.06;
};

struct ObjectConfig {
  std::string entity;
  std::string body;  // a body with a free joint
  std::vector<EntityProperty> properties;
};

// Uniform noise on the objects' poses at the start, from a seeded generator. Poses that bring two objects
// nearer than min_distance_m (centre to centre, in the plane) are drawn again.
struct PoseNoise {
  std::uint64_t seed = 0;
  double position_m = 0;  // up to this much either way, in x and in y
  double yaw_rad = 0;     // up to this much either way
  double min_distance_m = 0;
};

struct SensorConfig {
  std::string position_attribute = "position";
  std::string holding_attribute = "holding";
  double resolution_m = 0.005;  // reported positions are multiples of this
  double object_deadband_m =
      0.004;  // an object's report stays until the object is this far from it, in x or y
};

struct MotionCommand {
  std::string name;
  CommandKind kind = CommandKind::kMove;
  double open_gap_m = 0;    // grab: while going down; release: after letting go
  double closed_gap_m = 0;  // grab: what the fingers try to reach
};

struct MotionConfig {
  double table_height_m = 0;
  double hover_height_m =
      0.14;  // of the tool above the table between commands, and with something in the hand
  double grasp_height_m = 0.02;                   // of the tool above the table when the fingers close
  std::array<double, 2> workspace_min_m{-1, -1};  // moves are clipped to this rectangle
  std::array<double, 2> workspace_max_m{1, 1};
  double max_tool_speed_m_per_s = 1.5;  // a command that would have to be faster is refused
  double contact_stop_m = 0.0015;       // going down ends when the tool hangs back by more than this
  double settle_s = 0.5;                // physics before the episode starts
};

struct MujocoWorldConfig {
  // Either a file, or its text and the files it names.
  std::string model_path;
  std::string model_text;
  std::vector<WorldAsset> model_assets;

  HandConfig hand;
  std::vector<ObjectConfig> objects;
  PoseNoise noise;
  SensorConfig sensors;
  MotionConfig motion;
  std::vector<MotionCommand> commands;
  double recorded_states_per_s = 20;
};

}  // namespace aerascope
