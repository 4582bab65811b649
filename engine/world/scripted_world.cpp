#include "engine/world/scripted_world.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace aerascope {
namespace {

// Numbers in terms have nine significant digits; two places nearer than this are the same place.
constexpr double kSamePlace = 1e-6;

class ScriptedWorld final : public World {
 public:
  explicit ScriptedWorld(const ScriptedWorldConfig& config) : config_(config), hand_(config.hand_position) {
    for (const ScriptedObject& object : config_.objects) places_.push_back(object.position);
  }

  Result<std::vector<Fact>> Observe(TimeInterval frame) override {
    const Term hand = Term::Entity(config_.hand_entity);
    const Term position = Term::Ontology(config_.position_attribute);
    std::vector<Term> holding;
    if (held_) holding.push_back(Term::Entity(config_.objects[*held_].entity));
    std::vector<Fact> facts;
    facts.push_back({true, MakeValue(hand, position, Term::Number(hand_)), frame, 1});
    facts.push_back(
        {true, MakeValue(hand, Term::Ontology(config_.holding_attribute), Term::Set(std::move(holding))),
         frame, 1});
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Term object = Term::Entity(config_.objects[i].entity);
      facts.push_back({true, MakeValue(object, position, Term::Number(places_[i])), frame, 1});
    }
    return facts;
  }

  std::vector<Fact> Properties() const override {
    std::vector<Fact> facts;
    for (const EntityProperty& property : config_.hand_properties)
      facts.push_back(PropertyFact(config_.hand_entity, property));
    for (const ScriptedObject& object : config_.objects) {
      for (const EntityProperty& property : object.properties)
        facts.push_back(PropertyFact(object.entity, property));
    }
    return facts;
  }

  Result<ActOutcome> Act(std::span<const Term> commands, TimeInterval during) override {
    if (during.before < now_) {
      return Error{"the world is at " + ToText(now_) + " and cannot act until " + ToText(during.before)};
    }
    ActOutcome outcome;
    for (const Term& command : commands) {
      if (std::optional<Term> executed = Carry(command, outcome.notes)) outcome.executed.push_back(*executed);
    }
    now_ = during.before;
    outcome.states.push_back(State());
    return outcome;
  }

  WorldState State() const override {
    WorldState state{now_, {hand_}, {}, std::vector<double>(places_.size(), 0)};
    state.qpos.insert(state.qpos.end(), places_.begin(), places_.end());
    if (held_) state.ctrl[*held_] = 1;
    return state;
  }

  WorldDescription Description() const override { return {"scripted", "", {}, {}}; }

 private:
  std::optional<Term> Refuse(const Term& command, const std::string& reason,
                             std::vector<std::string>& notes) const {
    notes.push_back(ToText(command) + " was not carried out: " + reason);
    return std::nullopt;
  }

  std::optional<Term> Carry(const Term& command, std::vector<std::string>& notes) {
    if (!IsCommand(command)) return Refuse(command, "expected (cmd name [hand ...])", notes);
    const auto known =
        std::find_if(config_.commands.begin(), config_.commands.end(),
                     [&](const ScriptedCommand& candidate) { return candidate.name == command[0].name(); });
    if (known == config_.commands.end()) return Refuse(command, "the world has no such command", notes);
    const Term& arguments = command[1];
    const std::size_t expected = known->kind == CommandKind::kMove ? 2 : 1;
    if (!arguments.is(TermKind::kSet) || arguments.size() != expected) {
      return Refuse(command,
                    "expected " + std::to_string(expected) + (expected == 1 ? " argument" : " arguments"),
                    notes);
    }
    if (arguments[0] != Term::Entity(config_.hand_entity)) {
      return Refuse(command, "expected the hand " + config_.hand_entity + " as first argument", notes);
    }
    switch (known->kind) {
      case CommandKind::kMove:
        return CarryMove(command, arguments[1], notes);
      case CommandKind::kGrab:
        if (held_) return Refuse(command, "the hand holds something", notes);
        held_ = Graspable(*known);
        return command;
      case CommandKind::kRelease:
        held_.reset();
        return command;
    }
    return std::nullopt;
  }

  std::optional<Term> CarryMove(const Term& command, const Term& delta, std::vector<std::string>& notes) {
    if (!delta.is(TermKind::kNumber) || !std::isfinite(delta.number()))
      return Refuse(command, "expected a number as delta", notes);
    const double wanted =
        Term::Number(hand_ + delta.number()).number();  // places are numbers that terms can hold
    const double reached = std::clamp(wanted, config_.lowest_position, config_.highest_position);
    const Term moved = reached == wanted ? delta : Term::Number(reached - hand_);
    if (reached != wanted)
      notes.push_back(ToText(command) + " was cut to " + ToText(moved) + ": the workspace ends there");
    hand_ = reached;
    if (held_) places_[*held_] = reached;
    return MakeCommand(command[0], {command[1][0], moved});
  }

  // The first object at the hand's place that this grab can hold.
  std::optional<std::size_t> Graspable(const ScriptedCommand& grab) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (std::abs(places_[i] - hand_) > kSamePlace) continue;
      const std::vector<EntityProperty>& properties = config_.objects[i].properties;
      const bool fits = grab.holds.empty() ||
                        std::any_of(grab.holds.begin(), grab.holds.end(), [&](const EntityProperty& wanted) {
                          return std::find(properties.begin(), properties.end(), wanted) != properties.end();
                        });
      if (fits) return i;
    }
    return std::nullopt;
  }

  const ScriptedWorldConfig config_;
  Time now_;
  double hand_;
  std::vector<double> places_;
  std::optional<std::size_t> held_;
};

Status Check(const ScriptedWorldConfig& config) {
  std::set<std::string> entities{config.hand_entity};
  if (config.hand_entity.empty()) return Error{"hand: expected the name of an entity, found none"};
  const auto inside = [&](double place) {
    return place >= config.lowest_position && place <= config.highest_position;
  };
  if (!inside(config.hand_position))
    return Error{"hand: expected a position between lowest_position and highest_position"};
  for (const ScriptedObject& object : config.objects) {
    if (object.entity.empty()) return Error{"objects: expected the name of an entity, found none"};
    if (!entities.insert(object.entity).second)
      return Error{"objects: the entity '" + object.entity + "' is given twice"};
    if (!std::isfinite(object.position))
      return Error{"object " + object.entity + ": expected a finite position"};
  }
  std::set<std::string> commands;
  for (const ScriptedCommand& command : config.commands) {
    if (command.name.empty()) return Error{"commands: expected a name, found none"};
    if (!commands.insert(command.name).second)
      return Error{"commands: '" + command.name + "' is given twice"};
  }
  return Ok();
}

}  // namespace

Result<std::unique_ptr<World>> MakeScriptedWorld(const ScriptedWorldConfig& config) {
  if (Status status = Check(config); !status) return status.error();
  return std::unique_ptr<World>(std::make_unique<ScriptedWorld>(config));
}

}  // namespace aerascope
