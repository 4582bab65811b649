#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "engine/base/text.h"
#include "engine/episode/scenario_world.h"
#include "engine/episode/world_keys.h"

namespace aerascope {
namespace {

constexpr std::string_view kSceneFile = "world/scene.xml";

HandConfig ReadHand(ConfigTable hand, const SeedKnowledge& seed, ConfigErrors* errors) {
  HandConfig config;
  config.entity = EntityKey(hand, seed, errors);
  config.properties = AllProperties(hand, config.entity, seed, errors);
  config.tool_site = hand.RequiredString("tool_site");
  hand.Require("arm_joints");
  config.arm_joints = hand.Strings("arm_joints");
  config.home_posture = hand.Numbers("home_posture", -kFar, kFar);
  config.home_position_m = hand.Pair("home_position_m", config.home_position_m, -kFar, kFar);
  config.tool_yaw_rad = hand.Number("tool_yaw_rad", config.tool_yaw_rad, -kTurns, kTurns);
  hand.Require("finger_bodies");
  config.finger_bodies = hand.Strings("finger_bodies");
  config.start_gap_m = hand.Number("start_gap_m", config.start_gap_m, 0, kFar);
  hand.Require("finger_actuators");
  for (ConfigTable& actuator : hand.Tables("finger_actuators")) {
    FingerActuator finger;
    finger.actuator = actuator.RequiredString("actuator");
    finger.control_per_gap = actuator.Number("control_per_gap", finger.control_per_gap, -kFar, kFar);
    finger.control_at_zero_gap =
        actuator.Number("control_at_zero_gap", finger.control_at_zero_gap, -kFar, kFar);
    actuator.Finish();
    config.finger_actuators.push_back(std::move(finger));
  }
  hand.Finish();
  return config;
}

PoseNoise ReadNoise(ConfigTable noise) {
  PoseNoise config;
  config.position_m = noise.Number("position_m", config.position_m, 0, kFar);
  config.yaw_rad = noise.Number("yaw_rad", config.yaw_rad, 0, kTurns);
  config.min_distance_m = noise.Number("min_distance_m", config.min_distance_m, 0, kFar);
  noise.Finish();
  return config;
}

SensorConfig ReadSensors(ConfigTable sensors, const SeedKnowledge& seed, ConfigErrors* errors) {
  SensorConfig config;
  config.position_attribute =
      OntologyKey(sensors, "position_attribute", config.position_attribute, seed, errors);
  config.holding_attribute =
      OntologyKey(sensors, "holding_attribute", config.holding_attribute, seed, errors);
  config.resolution_m = sensors.Number("resolution_m", config.resolution_m, 1e-6, kFar);
  config.object_deadband_m = sensors.Number("object_deadband_m", config.object_deadband_m, 0, kFar);
  sensors.Finish();
  return config;
}

MotionConfig ReadMotion(ConfigTable motion) {
  MotionConfig config;
  config.table_height_m = motion.Number("table_height_m", config.table_height_m, -kFar, kFar);
  config.hover_height_m = motion.Number("hover_height_m", config.hover_height_m, 0, kFar);
  config.grasp_height_m = motion.Number("grasp_height_m", config.grasp_height_m, 0, kFar);
  config.workspace_min_m = motion.Pair("workspace_min_m", config.workspace_min_m, -kFar, kFar);
  config.workspace_max_m = motion.Pair("workspace_max_m", config.workspace_max_m, -kFar, kFar);
  config.max_tool_speed_m_per_s =
      motion.Number("max_tool_speed_m_per_s", config.max_tool_speed_m_per_s, 1e-3, kFar);
  config.contact_stop_m = motion.Number("contact_stop_m", config.contact_stop_m, 0, kFar);
  config.settle_s = motion.Number("settle_s", config.settle_s, 0, 60);
  if (config.workspace_min_m[0] > config.workspace_max_m[0] ||
      config.workspace_min_m[1] > config.workspace_max_m[1]) {
    motion.Fail(motion.value(),
                "expected workspace_min_m below workspace_max_m in x and in y, found them the other way");
  }
  motion.Finish();
  return config;
}

// Fills in the model: from what was kept, or the path, which must lead to a file.
void FindModel(ConfigTable& world, const ModelSource& source, ConfigErrors* errors,
               MujocoWorldConfig& config) {
  const std::string model = world.RequiredString("model");
  if (model.empty()) return;
  if (!source.kept) {
    config.model_path = (std::filesystem::path(source.folder) / model).lexically_normal().string();
    std::error_code trouble;
    if (!std::filesystem::is_regular_file(config.model_path, trouble)) {
      errors->Add(*world.Get("model"), "expected the MuJoCo model at " + Printable(config.model_path) +
                                           ", found no file there; paths are relative to the scenario file");
    }
    return;
  }
  const auto scene = source.kept->find(std::string(kSceneFile));
  if (scene == source.kept->end()) {
    errors->Add(*world.Get("model"),
                "expected the file " + std::string(kSceneFile) + " in the episode, found none");
    return;
  }
  config.model_text = scene->second;
  for (const auto& [name, bytes] : *source.kept) {
    if (name.starts_with("world/") && name != kSceneFile)
      config.model_assets.push_back({name.substr(6), bytes});
  }
}

}  // namespace

MujocoWorldConfig ReadMujocoWorld(ConfigTable world, const SeedKnowledge& seed, const ModelSource& source,
                                  ConfigErrors* errors) {
  MujocoWorldConfig config;
  world.Require("kind");
  FindModel(world, source, errors, config);
  world.Require("hand");
  if (auto hand = world.Table("hand")) config.hand = ReadHand(*hand, seed, errors);
  for (ConfigTable& object : world.Tables("objects")) {
    ObjectConfig read;
    read.entity = EntityKey(object, seed, errors);
    read.body = object.String("body", read.entity);
    read.properties = AllProperties(object, read.entity, seed, errors);
    object.Finish();
    config.objects.push_back(std::move(read));
  }
  if (auto noise = world.Table("noise")) config.noise = ReadNoise(*noise);
  if (auto sensors = world.Table("sensors")) config.sensors = ReadSensors(*sensors, seed, errors);
  if (auto motion = world.Table("motion")) config.motion = ReadMotion(*motion);
  for (ConfigTable& command : world.Tables("commands")) {
    MotionCommand read;
    command.Require("name");
    read.name = OntologyKey(command, "name", "", seed, errors);
    read.kind = KindKey(command, {"move", "grab", "release"}).value_or(CommandKind::kMove);
    read.open_gap_m = command.Number("open_gap_m", read.open_gap_m, 0, kFar);
    read.closed_gap_m = command.Number("closed_gap_m", read.closed_gap_m, 0, kFar);
    command.Finish();
    config.commands.push_back(std::move(read));
  }
  CheckNames(config, config.hand.entity, world.value(), errors);
  world.Finish();
  return config;
}

}  // namespace aerascope
