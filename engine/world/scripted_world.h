// ScriptedWorld is a small world without physics, for exact tests of reasoning: hand and things are at
// numbers on a line or at named places, commands act at once, and everything that can happen is declared.
// What a grab can hold, what a push changes, which commands fail and when, and what moves by itself are all
// in the configuration; nothing about a particular task is in the code.
//
// Commands are carried out one after the other. One acts on a *thing*: a release on what is held; a grab or a
// change on the object it is told or declared to act on, else on the first object within reach that its
// conditions allow. A command that has no such thing, or that fails by a rule, is reported as executed and
// changes nothing, as a grasp that misses.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/world/world.h"
#include "engine/world/world_config.h"

namespace aerascope {

// From this frame on, a thing moves by this many units per second. The sensors have looked before it happens:
// in its own frame they still report the speed of before.
struct ScriptedSpeedChange {
  std::int64_t frame = 0;
  double speed_per_s = 0;

  bool operator==(const ScriptedSpeedChange&) const = default;
};

struct ScriptedObject {
  std::string entity;
  std::optional<double> position;  // none: it is nowhere on the line
  std::vector<EntityProperty> properties;
  std::vector<EntityProperty> state = {};  // what commands can change, as it is at the start: at = "door"
  std::optional<double> speed_per_s = {};  // of what moves by itself; it rests while it is held
  std::vector<ScriptedSpeedChange> speed_changes = {};  // by rising frame
};

// Tries that fail although the command has something to act on.
struct ScriptedFailure {
  std::vector<EntityProperty> when =
      {};                  // counts only tries on a thing of which all this holds; empty: all tries
  std::int64_t after = 0;  // so many of them go well first
  std::optional<std::int64_t> times = {};  // then so many fail; none: all that follow
};

struct ScriptedCommand {
  std::string name;
  CommandKind kind = CommandKind::kMove;
  std::vector<EntityProperty> holds = {};  // of a grab: the thing has one of these; empty: whatever it has
  std::vector<EntityProperty> requires_all = {};  // the thing has all of these
  bool names_thing = false;  // of a grab or change: its one argument is the thing it acts on, not the hand
  std::string object = {};   // of a grab or change: acts on this thing wherever it is; empty: by reach
  std::vector<EntityProperty> sets = {};  // what becomes of the thing's state
  std::optional<double> moves_to = {};    // of a change: where the thing is then
  std::optional<double> largest = {};     // of a move: longer ones are cut to this
  std::vector<ScriptedFailure> fails = {};
};

struct ScriptedWorldConfig {
  std::string hand_entity;
  std::optional<double> hand_position =
      0;  // none: the hand is nowhere on the line, and everything is within its reach
  std::vector<EntityProperty> hand_properties;
  std::vector<ScriptedObject> objects;
  std::vector<ScriptedCommand> commands;
  double lowest_position = -1e9;  // moves are clipped to this range
  double highest_position = 1e9;
  std::string position_attribute = "position";
  std::string holding_attribute = "holding";
  std::string speed_attribute = "speed";
  std::vector<std::string> held_values = {"speed"};  // attributes sensed with SyncMode::kHold
};

// Fails when a name is missing or used twice, a position lies outside the range, or a command names what is
// not there.
Result<std::unique_ptr<World>> MakeScriptedWorld(const ScriptedWorldConfig& config);

}  // namespace aerascope
