#include "engine/world/scripted_world.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace aerascope {
namespace {

// Numbers in terms have nine significant digits; two places nearer than this are the same place.
constexpr double kSamePlace = 1e-6;

// A place that terms can hold exactly.
double Place(double value) {
  return Term::Number(value).number();
}

using Properties = std::vector<EntityProperty>;

// The object as it is now.
struct Thing {
  const ScriptedObject* config;
  std::optional<double> place;
  Properties state;

  bool Has(const EntityProperty& wanted) const {
    const auto in = [&](const Properties& list) {
      return std::find(list.begin(), list.end(), wanted) != list.end();
    };
    return in(config->properties) || in(state);
  }
  bool HasAll(const Properties& wanted) const {
    return std::all_of(wanted.begin(), wanted.end(), [&](const EntityProperty& one) { return Has(one); });
  }
  bool HasOneOf(const Properties& wanted) const {
    return wanted.empty() ||
           std::any_of(wanted.begin(), wanted.end(), [&](const EntityProperty& one) { return Has(one); });
  }
  void Set(const EntityProperty& value) {
    const auto known = std::find_if(state.begin(), state.end(), [&](const EntityProperty& one) {
      return one.attribute == value.attribute;
    });
    if (known == state.end())
      state.push_back(value);
    else
      known->value = value.value;
  }
};

// A command and how often each of its failure rules has been met.
struct Command {
  const ScriptedCommand* config;
  std::vector<std::int64_t> tries;

  // Counts the try. `thing` may be null: an empty hand that moves.
  bool Fails(const Thing* thing) {
    bool fails = false;
    for (std::size_t i = 0; i < tries.size(); ++i) {
      const ScriptedFailure& rule = config->fails[i];
      if (!rule.when.empty() && (!thing || !thing->HasAll(rule.when))) continue;
      const std::int64_t before = tries[i]++;
      fails = fails || (before >= rule.after && (!rule.times || before < rule.after + *rule.times));
    }
    return fails;
  }
};

class ScriptedWorld final : public World {
 public:
  explicit ScriptedWorld(const ScriptedWorldConfig& config) : config_(config), hand_(config.hand_position) {
    for (const ScriptedObject& object : config_.objects)
      things_.push_back({&object, object.position, object.state});
    for (const ScriptedCommand& command : config_.commands) {
      commands_.push_back({&command, std::vector<std::int64_t>(command.fails.size())});
    }
  }

  Result<std::vector<Fact>> Observe(TimeInterval frame) override {
    if (frame.before <= frame.after)
      return Error{"expected a frame that takes time, found one that ends as it begins"};
    frame_ = frame.after.us / (frame.before - frame.after).us;
    std::vector<Fact> facts;
    const auto sense = [&](const std::string& entity, const std::string& attribute, Term value) {
      const auto& held = config_.held_values;
      const bool hold = std::find(held.begin(), held.end(), attribute) != held.end();
      facts.push_back({true, MakeValue(Term::Entity(entity), Term::Ontology(attribute), std::move(value)),
                       SensedDuring(frame, hold ? SyncMode::kHold : SyncMode::kPeriodic), 1});
    };
    std::vector<Term> holding;
    if (held_) holding.push_back(Term::Entity(things_[*held_].config->entity));
    if (hand_) sense(config_.hand_entity, config_.position_attribute, Term::Number(*hand_));
    sense(config_.hand_entity, config_.holding_attribute, Term::Set(std::move(holding)));
    for (std::size_t i = 0; i < things_.size(); ++i) {
      const Thing& thing = things_[i];
      const std::string& entity = thing.config->entity;
      if (thing.place) sense(entity, config_.position_attribute, Term::Number(*thing.place));
      for (const EntityProperty& value : thing.state)
        sense(entity, value.attribute, Term::Ontology(value.value));
      if (thing.config->speed_per_s) {
        sense(entity, config_.speed_attribute, Term::Number(held_ == i ? 0 : SpeedBefore(thing, frame_)));
      }
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
    const double passed_s = static_cast<double>((during.before - now_).us) / 1e6;
    for (std::size_t i = 0; i < things_.size(); ++i) {
      Thing& thing = things_[i];
      if (!thing.config->speed_per_s || !thing.place || held_ == i) continue;
      thing.place = Place(*thing.place + SpeedBefore(thing, frame_ + 1) * passed_s);
    }
    now_ = during.before;
    outcome.states.push_back(State());
    return outcome;
  }

  WorldState State() const override {
    WorldState state{now_, {hand_.value_or(0)}, {}, std::vector<double>(things_.size(), 0)};
    for (const Thing& thing : things_) state.qpos.push_back(thing.place.value_or(0));
    if (held_) state.ctrl[*held_] = 1;
    return state;
  }

  WorldDescription Description() const override { return {"scripted", "", {}, {}}; }

 private:
  // The speed that a thing has when the frame begins.
  static double SpeedBefore(const Thing& thing, std::int64_t frame) {
    double speed = thing.config->speed_per_s.value_or(0);
    for (const ScriptedSpeedChange& change : thing.config->speed_changes) {
      if (change.frame < frame) speed = change.speed_per_s;
    }
    return speed;
  }

  std::optional<Term> Refuse(const Term& command, const std::string& reason,
                             std::vector<std::string>& notes) const {
    notes.push_back(ToText(command) + " was not carried out: " + reason);
    return std::nullopt;
  }

  std::optional<Term> Carry(const Term& asked, std::vector<std::string>& notes) {
    if (!IsCommand(asked)) return Refuse(asked, "expected (cmd name [hand ...])", notes);
    const auto known = std::find_if(commands_.begin(), commands_.end(), [&](const Command& candidate) {
      return candidate.config->name == asked[0].name();
    });
    if (known == commands_.end()) return Refuse(asked, "the world has no such command", notes);
    const CommandKind kind = known->config->kind;
    const Term& arguments = asked[1];
    const std::size_t expected = kind == CommandKind::kMove ? 2 : 1;
    if (!arguments.is(TermKind::kSet) || arguments.size() != expected) {
      return Refuse(asked,
                    "expected " + std::to_string(expected) + (expected == 1 ? " argument" : " arguments"),
                    notes);
    }
    if (known->config->names_thing && !IsThing(arguments[0])) {
      return Refuse(asked, "expected a thing of the world as argument", notes);
    }
    if (!known->config->names_thing && arguments[0] != Term::Entity(config_.hand_entity)) {
      return Refuse(asked, "expected the hand " + config_.hand_entity + " as first argument", notes);
    }
    switch (kind) {
      case CommandKind::kMove:
        return CarryMove(asked, *known, notes);
      case CommandKind::kGrab:
        if (held_) return Refuse(asked, "the hand holds something", notes);
        break;
      case CommandKind::kRelease:
      case CommandKind::kChange:
        break;
    }
    const std::optional<std::size_t> target = Target(*known->config, arguments[0]);
    if (!target || known->Fails(&things_[*target])) return asked;
    Affect(*known->config, *target);
    return asked;
  }

  std::optional<Term> CarryMove(const Term& asked, Command& move, std::vector<std::string>& notes) {
    const Term& delta = asked[1][1];
    if (!delta.is(TermKind::kNumber) || !std::isfinite(delta.number()))
      return Refuse(asked, "expected a number as delta", notes);
    if (!hand_) return Refuse(asked, "the hand has no position", notes);
    const double longest = move.config->largest.value_or(std::abs(delta.number()));
    const double wanted = Place(*hand_ + std::clamp(delta.number(), -longest, longest));
    const double reached = std::clamp(wanted, config_.lowest_position, config_.highest_position);
    const bool whole = reached == Place(*hand_ + delta.number());
    const Term moved = whole ? delta : Term::Number(reached - *hand_);
    if (!whole) {
      notes.push_back(ToText(asked) + " was cut to " + ToText(moved) +
                      (reached == wanted ? ": no move may be longer" : ": the workspace ends there"));
    }
    if (!move.Fails(held_ ? &things_[*held_] : nullptr)) {
      hand_ = reached;
      if (held_) things_[*held_].place = reached;
    }
    return MakeCommand(asked[0], {asked[1][0], moved});
  }

  bool IsThing(const Term& term) const {
    return std::any_of(things_.begin(), things_.end(),
                       [&](const Thing& thing) { return term == Term::Entity(thing.config->entity); });
  }

  bool WithinReach(const Thing& thing) const {
    return !hand_ || (thing.place && std::abs(*thing.place - *hand_) <= kSamePlace);
  }

  // What a grab, release or change acts on.
  std::optional<std::size_t> Target(const ScriptedCommand& command, const Term& argument) const {
    const std::string& told = command.names_thing ? argument.name() : command.object;
    for (std::size_t i = 0; i < things_.size(); ++i) {
      const Thing& thing = things_[i];
      const bool meant =
          command.kind == CommandKind::kRelease
              ? held_ == i
              : held_ != i && (told.empty() ? WithinReach(thing) : thing.config->entity == told);
      if (meant && thing.HasOneOf(command.holds) && thing.HasAll(command.requires_all)) return i;
    }
    return std::nullopt;
  }

  void Affect(const ScriptedCommand& command, std::size_t target) {
    Thing& thing = things_[target];
    if (command.kind == CommandKind::kGrab) {
      held_ = target;
      if (hand_) thing.place = hand_;
    }
    if (command.kind == CommandKind::kRelease) held_.reset();
    if (command.moves_to) thing.place = Place(*command.moves_to);
    for (const EntityProperty& value : command.sets) thing.Set(value);
  }

  const ScriptedWorldConfig config_;
  Time now_;
  std::int64_t frame_ = 0;
  std::optional<double> hand_;
  std::vector<Thing> things_;  // one for each object, in order
  std::vector<Command> commands_;
  std::optional<std::size_t> held_;
};

Status CheckObject(const ScriptedObject& object) {
  const std::string name = "object " + object.entity + ": ";
  if (object.position && !std::isfinite(*object.position)) return Error{name + "expected a finite position"};
  if (object.speed_per_s && !object.position) return Error{name + "expected a position, as it has a speed"};
  if (!object.speed_per_s && !object.speed_changes.empty()) {
    return Error{name + "expected a speed at the start, as the speed changes later"};
  }
  std::vector<double> speeds{object.speed_per_s.value_or(0)};
  for (std::size_t i = 0; i < object.speed_changes.size(); ++i) {
    speeds.push_back(object.speed_changes[i].speed_per_s);
    if (i > 0 && object.speed_changes[i].frame <= object.speed_changes[i - 1].frame) {
      return Error{name + "expected changes of speed by rising frame"};
    }
  }
  if (!std::all_of(speeds.begin(), speeds.end(), [](double speed) { return std::isfinite(speed); })) {
    return Error{name + "expected finite speeds"};
  }
  return Ok();
}

Status CheckCommand(const ScriptedCommand& command, const ScriptedWorldConfig& config) {
  const std::string name = "command " + command.name + ": ";
  if (command.kind == CommandKind::kMove && !config.hand_position) {
    return Error{name + "expected a position of the hand, as it can be moved"};
  }
  const bool known =
      std::any_of(config.objects.begin(), config.objects.end(),
                  [&](const ScriptedObject& object) { return object.entity == command.object; });
  if (!command.object.empty() && !known) {
    return Error{name + "expected an object of the world to act on, found '" + command.object + "'"};
  }
  for (const ScriptedFailure& rule : command.fails) {
    if (rule.after < 0 || rule.times.value_or(0) < 0)
      return Error{name + "expected counts of failures from 0 on"};
  }
  return Ok();
}

Status Check(const ScriptedWorldConfig& config) {
  std::set<std::string> entities{config.hand_entity};
  if (config.hand_entity.empty()) return Error{"hand: expected the name of an entity, found none"};
  const double hand = config.hand_position.value_or(config.lowest_position);
  if (!(hand >= config.lowest_position && hand <= config.highest_position))
    return Error{"hand: expected a position between lowest_position and highest_position"};
  for (const ScriptedObject& object : config.objects) {
    if (object.entity.empty()) return Error{"objects: expected the name of an entity, found none"};
    if (!entities.insert(object.entity).second)
      return Error{"objects: the entity '" + object.entity + "' is given twice"};
    if (Status status = CheckObject(object); !status) return status;
  }
  std::set<std::string> commands;
  for (const ScriptedCommand& command : config.commands) {
    if (command.name.empty()) return Error{"commands: expected a name, found none"};
    if (!commands.insert(command.name).second)
      return Error{"commands: '" + command.name + "' is given twice"};
    if (Status status = CheckCommand(command, config); !status) return status;
  }
  return Ok();
}

}  // namespace

Result<std::unique_ptr<World>> MakeScriptedWorld(const ScriptedWorldConfig& config) {
  if (Status status = Check(config); !status) return status.error();
  return std::unique_ptr<World>(std::make_unique<ScriptedWorld>(config));
}

}  // namespace aerascope
