// ScriptedWorld is a 1-D emulation of the pick-and-place world: hand and objects are at numbers, commands act
// at once and exactly, and a table of rules says which grab holds what. For fast tests of reasoning; there is
// no physics.
#pragma once

#include <string>
#include <vector>

#include "engine/world/world.h"
#include "engine/world/world_config.h"

namespace aerascope {

struct ScriptedObject {
  std::string entity;
  double position = 0;
  std::vector<EntityProperty> properties;
};

struct ScriptedCommand {
  std::string name;
  CommandKind kind = CommandKind::kMove;
  // Of a grab: holds an object at the hand's position that has one of these properties; without any, every
  // object.
  std::vector<EntityProperty> holds;
};

struct ScriptedWorldConfig {
  std::string hand_entity;
  double hand_position = 0;
  std::vector<EntityProperty> hand_properties;
  std::vector<ScriptedObject> objects;
  std::vector<ScriptedCommand> commands;
  double lowest_position = -1e9;  // moves are clipped to this range
  double highest_position = 1e9;
  std::string position_attribute = "position";
  std::string holding_attribute = "holding";
};

// Fails when a name is missing or used twice, or a position lies outside the range.
Result<std::unique_ptr<World>> MakeScriptedWorld(const ScriptedWorldConfig& config);

}  // namespace aerascope
