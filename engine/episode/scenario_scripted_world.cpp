#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/base/text.h"
#include "engine/episode/scenario_world.h"
#include "engine/episode/world_keys.h"

namespace aerascope {
namespace {

constexpr std::int64_t kMany = 1'000'000;  // frames and tries beyond this are mistakes

class ScriptedWorldReader {
 public:
  ScriptedWorldReader(const SeedKnowledge& seed, ConfigErrors* errors) : seed_(seed), errors_(*errors) {}

  ScriptedWorldConfig Read(ConfigTable& world) {
    world.Require("kind");
    config_.position_attribute = world.String("position_attribute", config_.position_attribute);
    config_.lowest_position = world.Number("lowest_position", -kFar, -kFar, kFar);
    config_.highest_position = world.Number("highest_position", kFar, -kFar, kFar);
    config_.holding_attribute =
        OntologyKey(world, "holding_attribute", config_.holding_attribute, seed_, &errors_);
    world.Require("hand");
    if (auto hand = world.Table("hand")) ReadHand(*hand);
    for (ConfigTable& object : world.Tables("objects")) ReadObject(object);
    for (ConfigTable& command : world.Tables("commands")) ReadCommand(command);
    ReadSenses(world);
    CheckNames(config_, config_.hand_entity, world.value(), &errors_);
    world.Finish();
    return std::move(config_);
  }

 private:
  void ReadHand(ConfigTable& hand) {
    config_.hand_entity = EntityKey(hand, seed_, &errors_);
    config_.hand_properties = AllProperties(hand, config_.hand_entity, seed_, &errors_);
    config_.hand_position = OptionalNumber(hand, "position");
    const double place = config_.hand_position.value_or(config_.lowest_position);
    if (place < config_.lowest_position || place > config_.highest_position) {
      hand.Fail(*hand.Get("position"),
                "expected the hand's position from lowest_position to highest_position, found " +
                    FormatNumber(place));
    }
    hand.Finish();
  }

  void ReadObject(ConfigTable& object) {
    ScriptedObject read;
    read.entity = EntityKey(object, seed_, &errors_);
    read.properties = AllProperties(object, read.entity, seed_, &errors_);
    read.position = OptionalNumber(object, "position");
    read.state = Properties(object, "state", seed_, &errors_);
    for (const EntityProperty& value : read.state) {
      const bool fixed =
          std::any_of(read.properties.begin(), read.properties.end(),
                      [&](const EntityProperty& property) { return property.attribute == value.attribute; });
      if (fixed || value.attribute == config_.position_attribute ||
          value.attribute == config_.holding_attribute) {
        object.Fail(*object.Get("state"), "expected a state of attributes that nothing else says, found '" +
                                              Printable(value.attribute) + "' of " + Printable(read.entity));
      }
    }
    read.speed_per_s = OptionalNumber(object, "speed");
    if (read.speed_per_s && !speed_) speed_ = object.Get("speed");
    for (ConfigTable& change : object.Tables("speed_changes")) ReadSpeedChange(change, object, &read);
    if (read.speed_per_s && !read.position) {
      object.Fail(*object.Get("speed"), "expected a position beside the speed, found none");
    }
    if (!read.position && read.state.empty()) {
      object.Fail(object.value(), "expected 'position' or 'state' of " + Printable(read.entity) +
                                      ", where it is at the start, found neither");
    }
    object.Finish();
    config_.objects.push_back(std::move(read));
  }

  void ReadSpeedChange(ConfigTable& change, ConfigTable& object, ScriptedObject* read) {
    ScriptedSpeedChange next;
    change.Require("frame");
    next.frame = change.Integer("frame", 0, 0, kMany);
    change.Require("speed");
    next.speed_per_s = change.Number("speed", 0, -kFar, kFar);
    if (!read->speed_per_s) {
      change.Fail(change.value(), "expected 'speed' at the start of what changes its speed, found none");
    }
    if (!read->speed_changes.empty() && next.frame <= read->speed_changes.back().frame &&
        change.Has("frame")) {
      object.Fail(*change.Get("frame"), "expected the changes of speed by rising frame, found frame " +
                                            std::to_string(next.frame) + " after " +
                                            std::to_string(read->speed_changes.back().frame));
    }
    change.Finish();
    read->speed_changes.push_back(next);
  }

  void ReadCommand(ConfigTable& command) {
    ScriptedCommand read;
    command.Require("name");
    read.name = OntologyKey(command, "name", "", seed_, &errors_);
    const std::optional<CommandKind> kind = KindKey(command, {"move", "grab", "release", "change"});
    if (!kind) return;  // what belongs to it cannot be said
    read.kind = *kind;
    const bool moves = read.kind == CommandKind::kMove;
    const bool grabs = read.kind == CommandKind::kGrab;
    const bool changes = read.kind == CommandKind::kChange;
    if (Fits(command, "holds", grabs, "a grab")) read.holds = Properties(command, "holds", seed_, &errors_);
    if (Fits(command, "requires", !moves, "a command that acts on a thing")) {
      read.requires_all = Properties(command, "requires", seed_, &errors_);
    }
    if (Fits(command, "object", grabs || changes, "a grab or a change")) read.object = ReadActedOn(command);
    if (Fits(command, "argument", grabs || changes, "a grab or a change")) {
      read.names_thing = command.Choice("argument", {"hand", "thing"}, 0) == 1u;
      if (read.names_thing && command.Has("object")) {
        command.Fail(*command.Get("object"),
                     "expected no 'object' of a command whose argument is the thing, found one");
      }
    }
    if (Fits(command, "sets", !moves, "a command that acts on a thing")) read.sets = ReadSets(command);
    if (Fits(command, "moves_to", changes, "a change")) read.moves_to = OptionalNumber(command, "moves_to");
    if (Fits(command, "largest", moves, "a move")) read.largest = command.Number("largest", 0, 0, kFar);
    for (ConfigTable& rule : command.Tables("fails")) {
      ScriptedFailure failure;
      failure.when = Properties(rule, "when", seed_, &errors_);
      failure.after = rule.Integer("after", 0, 0, kMany);
      if (rule.Has("times")) failure.times = rule.Integer("times", 1, 1, kMany);
      rule.Finish();
      read.fails.push_back(std::move(failure));
    }
    if (moves && !config_.hand_position) {
      command.Fail(command.value(),
                   "expected a position of the hand, as '" + Printable(read.name) + "' moves it, found none");
    }
    command.Finish();
    config_.commands.push_back(std::move(read));
  }

  // Whether the key is there; reported if it is and makes no sense.
  bool Fits(ConfigTable& command, std::string_view key, bool fits, std::string_view whose) {
    const ConfigValue* value = command.Get(key);
    if (value && !fits) {
      command.Fail(*value, "expected '" + std::string(key) + "' only of " + std::string(whose) +
                               ", found it of another kind of command");
    }
    return value && fits;
  }

  std::string ReadActedOn(ConfigTable& command) {
    const std::string name = command.RequiredString("object");
    std::vector<std::string> known;
    for (const ScriptedObject& object : config_.objects) known.push_back(object.entity);
    if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return name;
    const std::string closest = ClosestWord(name, known);
    command.Fail(*command.Get("object"), "expected an object of the world, found '" + Printable(name) + "'" +
                                             (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
    return name;
  }

  // Only what some thing's state has can be set.
  std::vector<EntityProperty> ReadSets(ConfigTable& command) {
    std::vector<EntityProperty> sets = Properties(command, "sets", seed_, &errors_);
    std::vector<std::string> known;
    for (const ScriptedObject& object : config_.objects) {
      for (const EntityProperty& value : object.state) known.push_back(value.attribute);
    }
    for (const EntityProperty& value : sets) {
      if (std::find(known.begin(), known.end(), value.attribute) != known.end()) continue;
      const std::string closest = ClosestWord(value.attribute, known);
      command.Fail(*command.Get("sets"), "expected attributes that are the 'state' of some object, found '" +
                                             Printable(value.attribute) + "'" +
                                             (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
    }
    return sets;
  }

  void ReadSenses(ConfigTable& world) {
    const bool any_position =
        config_.hand_position ||
        std::any_of(config_.objects.begin(), config_.objects.end(),
                    [](const ScriptedObject& object) { return object.position.has_value(); });
    if (any_position)
      CheckOntology(seed_, PlaceOf(world, "position_attribute"), config_.position_attribute, &errors_);
    config_.speed_attribute = world.String("speed_attribute", config_.speed_attribute);
    const ConfigValue* named = world.Get("speed_attribute");
    if (speed_) CheckOntology(seed_, named ? *named : *speed_, config_.speed_attribute, &errors_);
    config_.held_values = {config_.speed_attribute};
    if (const ConfigValue* held = world.Get("held_values")) {
      config_.held_values = world.Strings("held_values");
      for (const std::string& attribute : config_.held_values)
        CheckOntology(seed_, *held, attribute, &errors_);
    }
  }

  // Where a message about the key belongs.
  static const ConfigValue& PlaceOf(ConfigTable& table, std::string_view key) {
    const ConfigValue* value = table.Get(key);
    return value ? *value : table.value();
  }

  static std::optional<double> OptionalNumber(ConfigTable& table, std::string_view key) {
    if (!table.Has(key)) {
      table.Know({std::string(key)});
      return std::nullopt;
    }
    return table.Number(key, 0, -kFar, kFar);
  }

  const SeedKnowledge& seed_;
  ConfigErrors& errors_;
  ScriptedWorldConfig config_;
  const ConfigValue* speed_ = nullptr;  // the first that is given
};

}  // namespace

ScriptedWorldConfig ReadScriptedWorld(ConfigTable world, const SeedKnowledge& seed, ConfigErrors* errors) {
  return ScriptedWorldReader(seed, errors).Read(world);
}

}  // namespace aerascope
