#include "engine/episode/scenario_world.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <tuple>
#include <utility>

#include "engine/base/text.h"

namespace aerascope {
namespace {

constexpr double kFar = 1e6;     // lengths and positions beyond this are mistakes
constexpr double kTurns = 1000;  // so are angles
constexpr std::string_view kSceneFile = "world/scene.xml";

void CheckSymbol(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name, TermKind kind,
                 ConfigErrors* errors) {
  const Term* symbol = FindSymbol(seed, name);
  if (symbol && symbol->is(kind)) return;
  std::vector<std::string> known;
  for (const Term& candidate : seed.symbols) {
    if (candidate.is(kind)) known.push_back(candidate.name());
  }
  const std::string closest = symbol ? "" : ClosestWord(name, known);
  errors->Add(where, std::string("expected ") +
                         (kind == TermKind::kEntity ? "an entity" : "an ontology symbol") +
                         " of the seed, found '" + Printable(name) + "', which " +
                         (symbol ? "is declared, but not as that" : "the seed does not declare") +
                         (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
}

std::string EntityKey(ConfigTable& table, const SeedKnowledge& seed, ConfigErrors* errors) {
  std::string name = table.RequiredString("entity");
  if (!name.empty()) CheckEntity(seed, *table.Get("entity"), name, errors);
  return name;
}

std::string OntologyKey(ConfigTable& table, std::string_view key, std::string fallback,
                        const SeedKnowledge& seed, ConfigErrors* errors) {
  std::string name = table.String(key, std::move(fallback));
  const ConfigValue* value = table.Get(key);
  CheckOntology(seed, value ? *value : table.value(), name, errors);
  return name;
}

// { shape = "cube", size = "small" }, in order of the alphabet.
std::vector<EntityProperty> Properties(ConfigTable& table, std::string_view key, const SeedKnowledge& seed,
                                       ConfigErrors* errors) {
  std::vector<EntityProperty> properties;
  const ConfigValue* value = table.Get(key);
  if (!value) return properties;
  if (value->kind != ConfigValue::Kind::kTable) {
    errors->Add(*value, "expected properties such as { size = \"large\" } for '" + std::string(key) + "'");
    return properties;
  }
  ConfigTable list(*value, std::string(key), errors);
  for (std::size_t i = 0; i < value->keys.size(); ++i) {
    EntityProperty property{value->keys[i], list.RequiredString(value->keys[i])};
    ConfigValue key_place;
    std::tie(key_place.line, key_place.column) = value->key_positions[i];
    CheckOntology(seed, key_place, property.attribute, errors);
    if (!property.value.empty()) CheckOntology(seed, value->items[i], property.value, errors);
    properties.push_back(std::move(property));
  }
  return properties;
}

// What the seed says for ever about an entity, then what the table adds.
std::vector<EntityProperty> AllProperties(ConfigTable& table, const std::string& entity,
                                          const SeedKnowledge& seed, ConfigErrors* errors) {
  std::vector<EntityProperty> properties;
  for (const SeedFact& fact : seed.facts) {
    if (IsLastingProperty(fact.fact) && fact.fact.payload[0].name() == entity) {
      properties.push_back({fact.fact.payload[1].name(), fact.fact.payload[2].name()});
    }
  }
  for (EntityProperty& property : Properties(table, "properties", seed, errors)) {
    const auto same = std::find_if(properties.begin(), properties.end(), [&](const EntityProperty& known) {
      return known.attribute == property.attribute;
    });
    if (same == properties.end())
      properties.push_back(std::move(property));
    else if (same->value != property.value) {
      errors->Add(*table.Get("properties"), "expected " + property.attribute + " = \"" + same->value +
                                                "\" of " + entity + ", as the seed says, found \"" +
                                                property.value + "\"");
    }
  }
  return properties;
}

CommandKind KindKey(ConfigTable& table) {
  table.Require("kind");
  constexpr CommandKind kKinds[] = {CommandKind::kMove, CommandKind::kGrab, CommandKind::kRelease};
  return kKinds[table.Choice("kind", {"move", "grab", "release"}, 0).value_or(0)];
}

// Reports entities that stand for two things.
void CheckDistinct(const std::vector<std::string>& names, const ConfigValue& where, std::string_view what,
                   ConfigErrors* errors) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty() && std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                                       names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i)) {
      errors->Add(
          where, "expected each " + std::string(what) + " once in the world, found '" + names[i] + "' twice");
    }
  }
}

template <class Config>
void CheckNames(const Config& config, const std::string& hand, const ConfigValue& world,
                ConfigErrors* errors) {
  std::vector<std::string> entities{hand};
  for (const auto& object : config.objects) entities.push_back(object.entity);
  CheckDistinct(entities, world, "entity", errors);
  std::vector<std::string> commands;
  for (const auto& command : config.commands) commands.push_back(command.name);
  CheckDistinct(commands, world, "command", errors);
}

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

bool IsLastingProperty(const Fact& fact) {
  return fact.positive && fact.confidence == 1 && fact.interval.after <= Time{0} &&
         fact.interval.before >= kForever && IsValue(fact.payload) && fact.payload[0].is(TermKind::kEntity) &&
         fact.payload[1].is(TermKind::kOntology) && fact.payload[2].is(TermKind::kOntology);
}

void CheckEntity(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name,
                 ConfigErrors* errors) {
  CheckSymbol(seed, where, name, TermKind::kEntity, errors);
}

void CheckOntology(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name,
                   ConfigErrors* errors) {
  CheckSymbol(seed, where, name, TermKind::kOntology, errors);
}

ScriptedWorldConfig ReadScriptedWorld(ConfigTable world, const SeedKnowledge& seed, ConfigErrors* errors) {
  ScriptedWorldConfig config;
  world.Require("kind");
  world.Require("hand");
  if (auto hand = world.Table("hand")) {
    config.hand_entity = EntityKey(*hand, seed, errors);
    config.hand_properties = AllProperties(*hand, config.hand_entity, seed, errors);
    config.hand_position = hand->Number("position", config.hand_position, -kFar, kFar);
    hand->Finish();
  }
  for (ConfigTable& object : world.Tables("objects")) {
    ScriptedObject read;
    read.entity = EntityKey(object, seed, errors);
    read.properties = AllProperties(object, read.entity, seed, errors);
    object.Require("position");
    read.position = object.Number("position", 0, -kFar, kFar);
    object.Finish();
    config.objects.push_back(std::move(read));
  }
  for (ConfigTable& command : world.Tables("commands")) {
    ScriptedCommand read;
    command.Require("name");
    read.name = OntologyKey(command, "name", "", seed, errors);
    read.kind = KindKey(command);
    read.holds = Properties(command, "holds", seed, errors);
    command.Finish();
    config.commands.push_back(std::move(read));
  }
  config.lowest_position = world.Number("lowest_position", -kFar, -kFar, kFar);
  config.highest_position = world.Number("highest_position", kFar, -kFar, kFar);
  config.position_attribute =
      OntologyKey(world, "position_attribute", config.position_attribute, seed, errors);
  config.holding_attribute = OntologyKey(world, "holding_attribute", config.holding_attribute, seed, errors);
  CheckNames(config, config.hand_entity, world.value(), errors);
  world.Finish();
  return config;
}

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
    read.kind = KindKey(command);
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
