// The kinds of events: what can happen in an episode, one struct a kind, each field with a name and a
// sentence.
//
// This is the schema. The store makes a table a kind from it, the exporters print it, the digest runs over it
// and docs/event-schema.md is generated from it. A new field or kind is added here and nowhere else; a change
// of meaning raises kSchemaVersion (engine/store). Field types: ids, numbers, booleans, enums with EnumNames,
// strings, Term, Time, TimeInterval, Fact, Evidence, CompositeState, Model, lists of those, and lists of
// structs with fields of their own.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "engine/kb/knowledge_base.h"

namespace aerascope {

// One field of an event body: its stable name, what it says (with unit), and where it is.
template <class Body, class Value>
struct Field {
  std::string_view name;
  std::string_view meaning;
  Value Body::*member;
};
template <class Body, class Value>
Field(std::string_view, std::string_view, Value Body::*) -> Field<Body, Value>;

// Calls visit(field) for each field of Body, in order.
template <class Body, class Visit>
constexpr void ForEachField(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, Body::Fields());
}

// Whether a field is a list, and whether it is the number of something.
template <class Value>
inline constexpr bool kIsVector = false;
template <class Item>
inline constexpr bool kIsVector<std::vector<Item>> = true;
template <class Value>
inline constexpr bool kIsId = false;
template <class Tag>
inline constexpr bool kIsId<Id<Tag>> = true;

// The stable names of an enum's values, in order of the values from 0.
template <class Enum>
inline constexpr std::array<std::string_view, 0> kEnumNames{};

template <>
inline constexpr std::array<std::string_view, 5> kEnumNames<Origin>{"seed", "induction", "prediction_failure",
                                                                    "goal_success", "analogy"};
template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<ModelState>{"active", "phased_out", "deleted"};
template <>
inline constexpr std::array<std::string_view, 4> kEnumNames<FactSource>{"sensor", "property", "executed",
                                                                        "absence"};

template <class Enum>
constexpr std::string_view EnumName(Enum value) {
  return kEnumNames<Enum>[static_cast<std::size_t>(value)];
}

// ---------------------------------------------------------------------------------------------- start,
// frames, world

struct Parameter {
  std::string name;
  std::string value;
  static constexpr auto Fields() {
    return std::tuple{Field{"name", "name of the parameter", &Parameter::name},
                      Field{"value", "its value as text", &Parameter::value}};
  }
};

struct EpisodeStarted {
  std::string scenario;
  std::string world;
  std::int64_t seed = 0;
  std::int64_t sampling_period_us = 0;
  std::vector<Parameter> parameters;
  static constexpr std::string_view kName = "EpisodeStarted";
  static constexpr std::string_view kMeaning = "An episode begins, with these settings.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"scenario", "title of the scenario", &EpisodeStarted::scenario},
        Field{"world", "kind of world: scripted or mujoco", &EpisodeStarted::world},
        Field{"seed", "random seed of the world", &EpisodeStarted::seed},
        Field{"sampling_period_us", "length of a frame, microseconds", &EpisodeStarted::sampling_period_us},
        Field{"parameters", "the reasoner's parameters", &EpisodeStarted::parameters}};
  }
};

struct SymbolDeclared {
  Term symbol;
  static constexpr std::string_view kName = "SymbolDeclared";
  static constexpr std::string_view kMeaning = "The seed names an entity or an ontology symbol.";
  static constexpr auto Fields() {
    return std::tuple{Field{"symbol", "the entity or ontology symbol", &SymbolDeclared::symbol}};
  }
};

struct FrameStarted {
  TimeInterval interval;
  static constexpr std::string_view kName = "FrameStarted";
  static constexpr std::string_view kMeaning = "A sampling period begins; facts of earlier ones are over.";
  static constexpr auto Fields() {
    return std::tuple{Field{"interval", "the sampling period", &FrameStarted::interval}};
  }
};

struct WorldStateRecorded {
  Time at;
  std::vector<double> qpos;
  std::vector<double> qvel;
  std::vector<double> ctrl;
  static constexpr std::string_view kName = "WorldStateRecorded";
  static constexpr std::string_view kMeaning =
      "The state of the world at one instant, enough to draw it again.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"at", "when, microseconds of engine time", &WorldStateRecorded::at},
        Field{"qpos", "generalised positions (m, rad, unit quaternions)", &WorldStateRecorded::qpos},
        Field{"qvel", "generalised velocities (m/s, rad/s)", &WorldStateRecorded::qvel},
        Field{"ctrl", "actuator controls", &WorldStateRecorded::ctrl}};
  }
};

struct FactObserved {
  FactId fact_id;
  Fact fact;
  FactSource source = FactSource::kSensor;
  static constexpr std::string_view kName = "FactObserved";
  static constexpr std::string_view kMeaning =
      "A fact became known: sensed, given, really executed, or concluded.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"fact_id", "number of the fact", &FactObserved::fact_id},
        Field{"fact", "what held, and when", &FactObserved::fact},
        Field{"source", "sensor, property, executed command, or absence", &FactObserved::source}};
  }
};

// ------------------------------------------------------------------------------------------------ knowledge
// is made

struct CompositeStateCreated {
  CompositeState state;
  Origin origin = Origin::kSeed;
  CompositeStateId derived_from;
  static constexpr std::string_view kName = "CompositeStateCreated";
  static constexpr std::string_view kMeaning = "A composite state enters the knowledge base.";
  static constexpr auto Fields() {
    return std::tuple{Field{"state", "its number and definition", &CompositeStateCreated::state},
                      Field{"origin", "how it came about", &CompositeStateCreated::origin},
                      Field{"derived_from", "the composite state generalised by analogy",
                            &CompositeStateCreated::derived_from}};
  }
};

struct ModelCreated {
  Model model;
  Evidence evidence;
  bool strong = false;
  Origin origin = Origin::kSeed;
  ModelId derived_from;
  static constexpr std::string_view kName = "ModelCreated";
  static constexpr std::string_view kMeaning = "A model enters the knowledge base.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"model", "its number and definition", &ModelCreated::model},
        Field{"evidence", "first evidence; confidence = positive / total", &ModelCreated::evidence},
        Field{"strong", "whether it starts confirmed", &ModelCreated::strong},
        Field{"origin", "how it came about", &ModelCreated::origin},
        Field{"derived_from", "the model generalised by analogy", &ModelCreated::derived_from}};
  }
};

enum class InductionKind { kChange, kPredictionFailure, kGoalSuccess };
template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<InductionKind>{"change", "prediction_failure",
                                                                           "goal_success"};

// What selective attention made of a fact that was there (semantics 5.1, "inputs").
enum class InputVerdict {
  kCause,          // kept: a possible cause, of which CauseConsidered says what came of it
  kCondition,      // kept: a condition under which a cause may have worked
  kNoSharedValue,  // dropped: nothing in common with what changed
  kPartNotShared,  // dropped: an instance, of which a component has nothing in common with what changed
  kOutOfStep,      // dropped: neither before the consequent as a cause is, nor in step with the premise
  kTooLate,        // dropped: not before the consequent
  kNotEligible,  // dropped: this kind of induction does not look at such, as at the engine's own conclusions
};
template <>
inline constexpr std::array<std::string_view, 7> kEnumNames<InputVerdict>{
    "cause", "condition", "no_shared_value", "part_not_shared", "out_of_step", "too_late", "not_eligible"};

struct ConsideredInput {
  FactId input;
  InputVerdict verdict = InputVerdict::kNotEligible;
  static constexpr auto Fields() {
    return std::tuple{Field{"input", "a fact or instance of the frames looked at", &ConsideredInput::input},
                      Field{"verdict", "kept as a possible cause or as a condition; or why it was dropped",
                            &ConsideredInput::verdict}};
  }
};

struct InductionStarted {
  InductionKind induction = InductionKind::kChange;
  FactId premise;
  FactId consequent;
  std::vector<ConsideredInput> inputs = {};
  static constexpr std::string_view kName = "InductionStarted";
  static constexpr std::string_view kMeaning =
      "Something happened that nothing predicted; a cause is looked for.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"induction", "what set it off", &InductionStarted::induction},
        Field{"premise", "the fact before", &InductionStarted::premise},
        Field{"consequent", "the fact after", &InductionStarted::consequent},
        Field{"inputs", "all that was looked at, what was kept first", &InductionStarted::inputs}};
  }
};

enum class CauseVerdict {
  kBuilt,             // a model was made of it
  kNoSharedValue,     // nothing in common with what changed
  kTooLate,           // not before the consequent
  kSimultaneous,      // in step with the premise: a condition, not a cause
  kNoGuardForm,       // no formula leads from premise and cause to the consequent
  kNoCompositeState,  // fewer than two conditions could be put together
  kFreeVariable,      // the consequent holds something neither cause nor condition gives
  kBlackListed,       // the same model failed and was deleted before
  kDuplicate,         // the same model is known already
  kContradicted,      // it would forbid what has always been right
  kTooManyWays,       // what could be put together holds in too many ways at once to tell anything
};
template <>
inline constexpr std::array<std::string_view, 11> kEnumNames<CauseVerdict>{
    "built",         "no_shared_value", "too_late",  "simultaneous", "no_guard_form", "no_composite_state",
    "free_variable", "black_listed",    "duplicate", "contradicted", "too_many_ways"};

struct CauseConsidered {
  FactId fact_id;
  CauseVerdict verdict = CauseVerdict::kBuilt;
  std::string guard_form;
  static constexpr std::string_view kName = "CauseConsidered";
  static constexpr std::string_view kMeaning = "Induction looked at one earlier fact as the possible cause.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"fact_id", "the candidate cause", &CauseConsidered::fact_id},
        Field{"verdict", "built, or why not", &CauseConsidered::verdict},
        Field{"guard_form", "formula from premise to consequent: timing, sum, product, rate ...",
              &CauseConsidered::guard_form}};
  }
};

// -----------------------------------------------------------------------------------------------------------
// chaining

struct IcstFound {
  FactId fact_id;
  Fact fact;
  static constexpr std::string_view kName = "IcstFound";
  static constexpr std::string_view kMeaning =
      "A composite state holds; its causes are its components in order.";
  static constexpr auto Fields() {
    return std::tuple{Field{"fact_id", "number of the instance as a fact", &IcstFound::fact_id},
                      Field{"fact", "the instance, its interval and confidence", &IcstFound::fact}};
  }
};

struct ImdlPredicted {
  FactId fact_id;
  ModelId requirement;
  Fact fact;
  static constexpr std::string_view kName = "ImdlPredicted";
  static constexpr std::string_view kMeaning =
      "A requirement model says that a model will be right (or, negative, wrong).";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"fact_id", "number of the instance as a fact", &ImdlPredicted::fact_id},
        Field{"requirement", "the requirement model", &ImdlPredicted::requirement},
        Field{"fact", "the model instance, its interval; confidence = composite state x requirement model",
              &ImdlPredicted::fact}};
  }
};

struct PredictionMade {
  PredictionId prediction;
  ModelId model;
  std::vector<ModelId> requirements;
  FactId input;
  Fact target;
  std::vector<PredictionId> grounds = {};
  static constexpr std::string_view kName = "PredictionMade";
  static constexpr std::string_view kMeaning = "A model fired: its right side is expected.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"prediction", "number of the prediction", &PredictionMade::prediction},
        Field{"model", "the model that fired", &PredictionMade::model},
        Field{"requirements", "the requirement models that allowed it", &PredictionMade::requirements},
        Field{"input", "the fact on its left side; none if that is only expected, or imagined",
              &PredictionMade::input},
        Field{"target", "what is expected, when; confidence = input x model", &PredictionMade::target},
        Field{"grounds",
              "the open predictions it rests on, that on its left side first; empty if it rests on facts, or "
              "in a simulation",
              &PredictionMade::grounds}};
  }
};

struct PredictionSucceeded {
  PredictionId prediction;
  FactId evidence;
  static constexpr std::string_view kName = "PredictionSucceeded";
  static constexpr std::string_view kMeaning = "What was expected was seen.";
  static constexpr auto Fields() {
    return std::tuple{Field{"prediction", "the prediction", &PredictionSucceeded::prediction},
                      Field{"evidence", "the fact that shows it", &PredictionSucceeded::evidence}};
  }
};

struct PredictionFailed {
  PredictionId prediction;
  FactId evidence;
  static constexpr std::string_view kName = "PredictionFailed";
  static constexpr std::string_view kMeaning = "Something else than expected was seen, or nothing in time.";
  static constexpr auto Fields() {
    return std::tuple{Field{"prediction", "the prediction", &PredictionFailed::prediction},
                      Field{"evidence", "the fact that shows it; none if nothing came in time",
                            &PredictionFailed::evidence}};
  }
};

struct EvidenceUpdated {
  ModelId model;
  bool success = false;
  Evidence before;
  Evidence after;
  bool strong_before = false;
  bool strong_after = false;
  static constexpr std::string_view kName = "EvidenceUpdated";
  static constexpr std::string_view kMeaning = "An outcome moved a model's evidence.";
  static constexpr auto Fields() {
    return std::tuple{Field{"model", "the model", &EvidenceUpdated::model},
                      Field{"success", "whether it was right", &EvidenceUpdated::success},
                      Field{"before", "evidence before", &EvidenceUpdated::before},
                      Field{"after", "evidence after", &EvidenceUpdated::after},
                      Field{"strong_before", "confirmed before", &EvidenceUpdated::strong_before},
                      Field{"strong_after", "confirmed after", &EvidenceUpdated::strong_after}};
  }
};

enum class StateChangeReason {
  kRating,           // its success rate
  kOrphaned,         // a causal model that needs a requirement model has none left
  kRefersToDeleted,  // it speaks about knowledge that was deleted
  kTimedOut,         // it was not matched for too long
  kForgotten,        // deleted long ago and not met again: it may be made anew
  kGiven,            // the seed says so
};
template <>
inline constexpr std::array<std::string_view, 6> kEnumNames<StateChangeReason>{
    "rating", "orphaned", "refers_to_deleted", "timed_out", "forgotten", "given"};

struct ModelStateChanged {
  ModelId model;
  ModelState before = ModelState::kActive;
  ModelState after = ModelState::kActive;
  StateChangeReason reason = StateChangeReason::kRating;
  static constexpr std::string_view kName = "ModelStateChanged";
  static constexpr std::string_view kMeaning =
      "A model was phased out, phased in, deleted (and black-listed), or taken off the black list.";
  static constexpr auto Fields() {
    return std::tuple{Field{"model", "the model", &ModelStateChanged::model},
                      Field{"before", "state before", &ModelStateChanged::before},
                      Field{"after", "state after", &ModelStateChanged::after},
                      Field{"reason", "what moved it", &ModelStateChanged::reason}};
  }
};

// ---------------------------------------------------------------------------------------------------- goals
// and plans

struct DriveInjected {
  GoalId goal;
  std::string title;
  Fact target;
  static constexpr std::string_view kName = "DriveInjected";
  static constexpr std::string_view kMeaning =
      "The agent is given something to bring about, until a deadline.";
  static constexpr auto Fields() {
    return std::tuple{Field{"goal", "number of the goal", &DriveInjected::goal},
                      Field{"title", "what the scenario calls it", &DriveInjected::title},
                      Field{"target", "what is wanted; interval up to the deadline", &DriveInjected::target}};
  }
};

struct GoalSet {
  GoalId goal;
  GoalId super_goal;
  ModelId model;
  Fact target;
  static constexpr std::string_view kName = "GoalSet";
  static constexpr std::string_view kMeaning =
      "Backward chaining wants something because something else is wanted.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"goal", "number of the goal", &GoalSet::goal},
        Field{"super_goal", "the goal it serves", &GoalSet::super_goal},
        Field{"model", "the model that leads from it to the super goal; none inside a composite state",
              &GoalSet::model},
        Field{"target", "what is wanted; may hold variables not bound yet", &GoalSet::target}};
  }
};

enum class GoalSkipReason {
  kAlreadyHolds,   // a fact in force says so
  kLoop,           // it is wanted already, further up
  kTooDeep,        // longer chain than the parameter allows
  kNoModel,        // no model leads to it
  kBudget,         // the nodes counted for this decision are used up
  kPredicted,      // it is expected already, at least as surely
  kProperty,       // it is a property of a thing: given, and not to be changed
  kTooLate,        // it would have to begin before now
  kLowConfidence,  // nothing of it would be left after the confidences on the way
  kUnbound,        // the backward guards cannot be computed
  kVetoed,         // a strong requirement model stands against every way to it
};
template <>
inline constexpr std::array<std::string_view, 11> kEnumNames<GoalSkipReason>{
    "already_holds", "loop",     "too_deep",       "no_model", "budget", "predicted",
    "property",      "too_late", "low_confidence", "unbound",  "vetoed"};

// Whether what is skipped for this reason is missing in the end; the others hold, come by themselves or are
// pursued elsewhere.
constexpr bool Hinders(GoalSkipReason reason) {
  switch (reason) {
    case GoalSkipReason::kAlreadyHolds:
    case GoalSkipReason::kPredicted:
    case GoalSkipReason::kLoop:
      return false;
    case GoalSkipReason::kTooDeep:
    case GoalSkipReason::kNoModel:
    case GoalSkipReason::kBudget:
    case GoalSkipReason::kProperty:
    case GoalSkipReason::kTooLate:
    case GoalSkipReason::kLowConfidence:
    case GoalSkipReason::kUnbound:
    case GoalSkipReason::kVetoed:
      return true;
  }
  return true;
}

struct GoalSkipped {
  GoalId super_goal;
  Fact target;
  GoalSkipReason reason = GoalSkipReason::kNoModel;
  static constexpr std::string_view kName = "GoalSkipped";
  static constexpr std::string_view kMeaning = "Backward chaining did not pursue a sub-goal.";
  static constexpr auto Fields() {
    return std::tuple{Field{"super_goal", "the goal it would have served", &GoalSkipped::super_goal},
                      Field{"target", "what would have been wanted", &GoalSkipped::target},
                      Field{"reason", "why it was not pursued", &GoalSkipped::reason}};
  }
};

enum class ComponentStatus {
  kMatched,     // a fact in force, or one predicted in the plan, fits
  kAchievable,  // nothing fits yet, but a model could bring it about: a sub-goal
  kMissed,      // nothing fits and no model could change that
};
template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<ComponentStatus>{"matched", "achievable",
                                                                             "missed"};

struct ComparedComponent {
  std::int64_t index = 0;
  Term pattern;
  ComponentStatus status = ComponentStatus::kMissed;
  FactId found;
  Term counterpart;
  static constexpr auto Fields() {
    return std::tuple{
        Field{"index", "position in the compared composite state, from 0", &ComparedComponent::index},
        Field{"pattern", "the component's payload under the goal's bindings", &ComparedComponent::pattern},
        Field{"status", "matched, achievable, or missed", &ComparedComponent::status},
        Field{"found", "the fact that matched; none if missed", &ComparedComponent::found},
        Field{"counterpart", "what the situation has there: the matching payload, or the nearest one, or nil",
              &ComparedComponent::counterpart}};
  }
};

enum class AnalogyVerdict {
  kAccepted,         // hypothesised (or an equal one known already): result ids are given
  kNotRequired,      // would do, but a better plan reached the goal
  kFullMatch,        // nothing unfamiliar, so nothing to generalise
  kTooFewMatched,    // fewer matched components than the parameter asks for
  kNotFamiliar,      // psi not above the threshold
  kNothingObserved,  // nothing is known of an object of the goal
  kFreeVariable,     // what remains does not bind a variable the requirement passes on
  kBlackListed,      // the same hypothesis failed before
  kNoPlan,           // no plan through it reaches the goal
};
template <>
inline constexpr std::array<std::string_view, 9> kEnumNames<AnalogyVerdict>{
    "accepted",         "not_required",  "full_match",   "too_few_matched", "not_familiar",
    "nothing_observed", "free_variable", "black_listed", "no_plan"};

struct AnalogyCompared {
  GoalId goal;
  ModelId requirement;
  CompositeStateId source;
  ModelId causal_model;
  Term bindings;
  std::vector<ComparedComponent> components;
  std::int64_t matched = 0;
  std::int64_t achievable = 0;
  std::int64_t total = 0;
  double psi = 0;
  double jaccard = 0;
  double confidence = 0;
  AnalogyVerdict verdict = AnalogyVerdict::kNoPlan;
  CompositeStateId result_state;
  ModelId result_requirement;
  static constexpr std::string_view kName = "AnalogyCompared";
  static constexpr std::string_view kMeaning =
      "A known condition was compared with the situation for a goal.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"goal", "the goal it would serve", &AnalogyCompared::goal},
        Field{"requirement", "the requirement model compared", &AnalogyCompared::requirement},
        Field{"source", "its composite state", &AnalogyCompared::source},
        Field{"causal_model", "the causal model it allows", &AnalogyCompared::causal_model},
        Field{"bindings", "the composite state's instance under the goal's bindings",
              &AnalogyCompared::bindings},
        Field{"components", "component by component", &AnalogyCompared::components},
        Field{"matched", "components matched", &AnalogyCompared::matched},
        Field{"achievable", "components not matched that a model could bring about",
              &AnalogyCompared::achievable},
        Field{"total", "components in all", &AnalogyCompared::total},
        Field{"psi", "familiarity: (matched + achievable) / total (paper, equation 2)",
              &AnalogyCompared::psi},
        Field{"jaccard", "kept / (total + unmatched counterparts), the other reading of equation 2",
              &AnalogyCompared::jaccard},
        Field{"confidence", "psi x confidence of the requirement model (paper, equation 4)",
              &AnalogyCompared::confidence},
        Field{"verdict", "accepted, or why not", &AnalogyCompared::verdict},
        Field{"result_state", "the generalised composite state, if accepted", &AnalogyCompared::result_state},
        Field{"result_requirement", "the new requirement model, if accepted",
              &AnalogyCompared::result_requirement}};
  }
};

struct PlanStep {
  Term command;
  ModelId causal_model;
  ModelId requirement;
  static constexpr auto Fields() {
    return std::tuple{
        Field{"command", "the command", &PlanStep::command},
        Field{"causal_model", "the causal model that says what it brings", &PlanStep::causal_model},
        Field{"requirement", "the requirement model that allows it; none if it needs none",
              &PlanStep::requirement}};
  }
};

struct SimulationStarted {
  SimulationId simulation;
  GoalId goal;
  std::vector<PlanStep> steps;
  double score = 0;
  static constexpr std::string_view kName = "SimulationStarted";
  static constexpr std::string_view kMeaning =
      "A plan is tried in the head: forward chaining from the present.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"simulation", "number of the simulation", &SimulationStarted::simulation},
        Field{"goal", "the goal the plan is for", &SimulationStarted::goal},
        Field{"steps", "the commands in order", &SimulationStarted::steps},
        Field{"score", "product of the confidences of all models along the plan", &SimulationStarted::score}};
  }
};

enum class SimulationOutcome { kReached, kNotEnabled, kNotReached };
template <>
inline constexpr std::array<std::string_view, 3> kEnumNames<SimulationOutcome>{"reached", "not_enabled",
                                                                               "not_reached"};

struct SimulationEnded {
  SimulationId simulation;
  SimulationOutcome outcome = SimulationOutcome::kNotReached;
  static constexpr std::string_view kName = "SimulationEnded";
  static constexpr std::string_view kMeaning =
      "The tried plan reached its goal, or did not; always at the instant it began, so that nothing can put "
      "an "
      "end to it before.";
  static constexpr auto Fields() {
    return std::tuple{Field{"simulation", "the simulation", &SimulationEnded::simulation},
                      Field{"outcome", "reached; a step was not enabled; or the end was another",
                            &SimulationEnded::outcome}};
  }
};

// What one plan of a decision was worth. Up to version 4 of the schema only the simulation was recorded.
struct PlanCandidate {
  SimulationId simulation;
  double confidence = std::numeric_limits<double>::quiet_NaN();
  double score = std::numeric_limits<double>::quiet_NaN();
  Time reaches;
  Time deadline;
  static constexpr auto Fields() {
    return std::tuple{
        Field{"simulation", "the simulation in which the plan was tried", &PlanCandidate::simulation},
        Field{"confidence",
              "product of the confidences of all models along it; in openaera mode that of its last model",
              &PlanCandidate::confidence},
        Field{
            "score",
            "what plans are ranked by: the confidence; in openaera mode the confidence per second up to the "
            "deadline",
            &PlanCandidate::score},
        Field{"reaches", "when its goal would be reached, microseconds; 0: it was not reached in the head",
              &PlanCandidate::reaches},
        Field{"deadline",
              "when its last model must have fired for the goal to be reached in time, microseconds",
              &PlanCandidate::deadline}};
  }
};

struct PlanCommitted {
  GoalId goal;
  SimulationId chosen;
  std::vector<PlanCandidate> candidates;
  double score = 0;
  static constexpr std::string_view kName = "PlanCommitted";
  static constexpr std::string_view kMeaning =
      "The best tried plan was chosen; its first command will be issued.";
  static constexpr auto Fields() {
    return std::tuple{Field{"goal", "the goal", &PlanCommitted::goal},
                      Field{"chosen", "the simulation of the chosen plan", &PlanCommitted::chosen},
                      Field{"candidates", "all plans of this decision, the chosen one included",
                            &PlanCommitted::candidates},
                      Field{"score", "what the chosen plan is ranked by", &PlanCommitted::score}};
  }
};

enum class Commander { kTeacher, kAgent };
template <>
inline constexpr std::array<std::string_view, 2> kEnumNames<Commander>{"teacher", "agent"};

struct CommandIssued {
  Term command;
  Commander by = Commander::kAgent;
  GoalId goal;
  TimeInterval interval;
  static constexpr std::string_view kName = "CommandIssued";
  static constexpr std::string_view kMeaning = "A command was sent to the world.";
  static constexpr auto Fields() {
    return std::tuple{Field{"command", "the command as requested", &CommandIssued::command},
                      Field{"by", "teacher or agent", &CommandIssued::by},
                      Field{"goal", "the drive it serves; none for the teacher's", &CommandIssued::goal},
                      Field{"interval", "when it is to be executed", &CommandIssued::interval}};
  }
};

struct CommandRefused {
  Term command;
  std::string reason;
  static constexpr std::string_view kName = "CommandRefused";
  static constexpr std::string_view kMeaning =
      "The world executed a command not at all, or otherwise than asked.";
  static constexpr auto Fields() {
    return std::tuple{Field{"command", "the command as requested", &CommandRefused::command},
                      Field{"reason", "the world's own words", &CommandRefused::reason}};
  }
};

struct GoalAchieved {
  GoalId goal;
  FactId evidence;
  static constexpr std::string_view kName = "GoalAchieved";
  static constexpr std::string_view kMeaning = "What was wanted holds.";
  static constexpr auto Fields() {
    return std::tuple{Field{"goal", "the goal", &GoalAchieved::goal},
                      Field{"evidence", "the fact that shows it", &GoalAchieved::evidence}};
  }
};

struct GoalFailed {
  GoalId goal;
  static constexpr std::string_view kName = "GoalFailed";
  static constexpr std::string_view kMeaning = "The deadline passed and what was wanted does not hold.";
  static constexpr auto Fields() { return std::tuple{Field{"goal", "the goal", &GoalFailed::goal}}; }
};

struct EpisodeEnded {
  std::int64_t frames = 0;
  std::int64_t drives_reached = 0;
  std::int64_t drives = 0;
  static constexpr std::string_view kName = "EpisodeEnded";
  static constexpr std::string_view kMeaning =
      "The episode is over; a file without this event is incomplete.";
  static constexpr auto Fields() {
    return std::tuple{Field{"frames", "sampling periods run", &EpisodeEnded::frames},
                      Field{"drives_reached", "drives reached in time", &EpisodeEnded::drives_reached},
                      Field{"drives", "drives given", &EpisodeEnded::drives}};
  }
};

// --------------------------------------------------------------------------------- what was considered and
// did not win

struct ModelRejected {
  InductionKind induction = InductionKind::kChange;
  Model candidate;
  CauseVerdict reason = CauseVerdict::kDuplicate;
  ModelId same_as;
  static constexpr std::string_view kName = "ModelRejected";
  static constexpr std::string_view kMeaning = "Induction put a model together and did not adopt it.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"induction", "what set it off", &ModelRejected::induction},
        Field{"candidate", "its definition; its number is used nowhere else", &ModelRejected::candidate},
        Field{"reason", "why it was not adopted", &ModelRejected::reason},
        Field{"same_as", "the equal model that is known, or was deleted; else none",
              &ModelRejected::same_as}};
  }
};

// Whether a model may fire on an input, as its requirement models say (semantics 3.3).
enum class ChainingStatus {
  kNoRequirement,       // no requirement model speaks about it: it fires
  kEnabled,             // a weak requirement model allows it: it fires
  kEnabledAgainstVeto,  // one that is surer than every veto allows it: it fires
  kWeakDisabled,        // it needs a weak requirement model, and none holds
  kStrongDisabled,      // only vetoes speak: it predicts silently
  kVetoed,              // a veto is at least as sure as what allows it: it predicts silently
  kPhasedOut,           // phased out: it predicts silently
  kTooDeep,             // too many predictions rest on one another already: it does not fire
};
template <>
inline constexpr std::array<std::string_view, 8> kEnumNames<ChainingStatus>{
    "no_requirement",  "enabled", "enabled_against_veto", "weak_disabled",
    "strong_disabled", "vetoed",  "phased_out",           "too_deep"};

struct ConsideredRequirement {
  ModelId requirement;
  bool positive = true;
  double confidence = 0;
  static constexpr auto Fields() {
    return std::tuple{
        Field{"requirement", "the requirement model", &ConsideredRequirement::requirement},
        Field{"positive", "allows (true) or vetoes (false)", &ConsideredRequirement::positive},
        Field{"confidence", "composite state x requirement model", &ConsideredRequirement::confidence}};
  }
};

struct ChainingDecided {
  ModelId model;
  FactId input;
  ChainingStatus status = ChainingStatus::kNoRequirement;
  std::vector<ConsideredRequirement> considered;
  ModelId winner;
  PredictionId premise = {};
  static constexpr std::string_view kName = "ChainingDecided";
  static constexpr std::string_view kMeaning =
      "A fact, seen or expected, fits a model's left side; its requirement models decide whether it fires.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"model", "the model", &ChainingDecided::model},
        Field{"input", "the fact on its left side; none if that is only expected, or imagined",
              &ChainingDecided::input},
        Field{"status", "fires, silently, or not; and why", &ChainingDecided::status},
        Field{"considered", "the requirement models that spoke", &ChainingDecided::considered},
        Field{"winner", "the requirement model that decided; none if none did", &ChainingDecided::winner},
        Field{"premise", "the prediction on its left side, if that is only expected",
              &ChainingDecided::premise}};
  }
};

struct ImdlFired {
  FactId fact_id;
  PredictionId prediction;
  Fact fact;
  static constexpr std::string_view kName = "ImdlFired";
  static constexpr std::string_view kMeaning =
      "A model fired: this instance of it is in force, and others may build on it.";
  static constexpr auto Fields() {
    return std::tuple{Field{"fact_id", "number of the instance as a fact", &ImdlFired::fact_id},
                      Field{"prediction", "what it predicts", &ImdlFired::prediction},
                      Field{"fact", "the instance, over the interval of its input", &ImdlFired::fact}};
  }
};

struct InstanceProgress {
  CompositeStateId state;
  FactId fact_id;
  std::int64_t component = 0;
  std::int64_t matched = 0;
  std::int64_t total = 0;
  static constexpr std::string_view kName = "InstanceProgress";
  static constexpr std::string_view kMeaning =
      "A fact fits a component of a composite state; others may still be missing.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"state", "the composite state", &InstanceProgress::state},
        Field{"fact_id", "the fact", &InstanceProgress::fact_id},
        Field{"component", "the component it fits, from 0", &InstanceProgress::component},
        Field{"matched", "components that some fact fits so far in this frame", &InstanceProgress::matched},
        Field{"total", "components in all", &InstanceProgress::total}};
  }
};

// Why a prediction is no longer open, though nothing showed whether it is right. All but kOutweighed are of
// predictions that rested on others.
enum class InvalidationReason {
  kPremiseContradicted,  // what it rested on did not come true
  kRenewed,              // what it rested on was seen, and the same is predicted from that
  kNotRenewed,           // what it rested on was seen, but nothing is predicted from that
  kOverdue,              // its time came before what it rested on was decided
  kOutweighed,           // a surer prediction speaks against it
  kPremiseOutweighed,    // a surer prediction speaks against what it rested on
};
template <>
inline constexpr std::array<std::string_view, 6> kEnumNames<InvalidationReason>{
    "premise_contradicted", "renewed", "not_renewed", "overdue", "outweighed", "premise_outweighed"};

struct PredictionInvalidated {
  PredictionId prediction;
  FactId by;
  InvalidationReason reason = InvalidationReason::kPremiseContradicted;
  PredictionId surer = {};
  static constexpr std::string_view kName = "PredictionInvalidated";
  static constexpr std::string_view kMeaning =
      "A prediction that rested on others, or that a surer one speaks against, is given up: it is neither "
      "right nor wrong.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"prediction", "the prediction", &PredictionInvalidated::prediction},
        Field{"by",
              "the fact that decided what it rested on; none if nothing came in time, or if a "
              "prediction decided",
              &PredictionInvalidated::by},
        Field{"reason", "why it is given up", &PredictionInvalidated::reason},
        Field{"surer", "the surer prediction that speaks against it or against what it rested on; else none",
              &PredictionInvalidated::surer}};
  }
};

struct FactPromoted {
  FactId fact_id;
  Fact fact;
  static constexpr std::string_view kName = "FactPromoted";
  static constexpr std::string_view kMeaning = "In the head: what nothing changed is taken to hold on.";
  static constexpr auto Fields() {
    return std::tuple{Field{"fact_id", "the fact that held before", &FactPromoted::fact_id},
                      Field{"fact", "the same, in the next imagined frame", &FactPromoted::fact}};
  }
};

struct PromotionDefeated {
  Fact fact;
  PredictionId by;
  static constexpr std::string_view kName = "PromotionDefeated";
  static constexpr std::string_view kMeaning =
      "In the head: what held before does not hold on, since something else is predicted.";
  static constexpr auto Fields() {
    return std::tuple{Field{"fact", "what would have held on", &PromotionDefeated::fact},
                      Field{"by", "the prediction against it", &PromotionDefeated::by}};
  }
};

struct CommandImagined {
  Term command;
  TimeInterval interval;
  static constexpr std::string_view kName = "CommandImagined";
  static constexpr std::string_view kMeaning = "In the head: a command of the plan is executed.";
  static constexpr auto Fields() {
    return std::tuple{Field{"command", "the command", &CommandImagined::command},
                      Field{"interval", "when, in imagined time", &CommandImagined::interval}};
  }
};

enum class PlanRejection {
  kNotEnabled,      // a step of it would not work there
  kNotReached,      // it ends elsewhere
  kLowerScore,      // another reaches the goal with more confidence
  kTie,             // another as good was found before
  kHarms,           // it would make a more important goal fail
  kMandatoryHarms,  // what must be done would make a more important goal fail: nothing is done
  kMandatoryFirst,  // something else must be done before it
};
template <>
inline constexpr std::array<std::string_view, 7> kEnumNames<PlanRejection>{
    "not_enabled", "not_reached", "lower_score", "tie", "harms", "mandatory_harms", "mandatory_first"};

struct PlanRejected {
  GoalId goal;
  SimulationId simulation;
  PlanRejection reason = PlanRejection::kLowerScore;
  double score = 0;
  GoalId harmed;
  static constexpr std::string_view kName = "PlanRejected";
  static constexpr std::string_view kMeaning = "A plan that was tried in the head was not chosen.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"goal", "the goal it was for", &PlanRejected::goal},
        Field{"simulation", "the simulation in which it was tried", &PlanRejected::simulation},
        Field{"reason", "why not", &PlanRejected::reason}, Field{"score", "its score", &PlanRejected::score},
        Field{"harmed", "the more important goal it would harm; else none", &PlanRejected::harmed}};
  }
};

struct GoalSuspended {
  GoalId goal;
  PredictionId prediction;
  static constexpr std::string_view kName = "GoalSuspended";
  static constexpr std::string_view kMeaning =
      "What is wanted is predicted already: nothing more is done for it until that fails.";
  static constexpr auto Fields() {
    return std::tuple{Field{"goal", "the goal", &GoalSuspended::goal},
                      Field{"prediction", "what promises it", &GoalSuspended::prediction}};
  }
};

struct GoalResumed {
  GoalId goal;
  PredictionId prediction;
  static constexpr std::string_view kName = "GoalResumed";
  static constexpr std::string_view kMeaning = "What promised a goal failed: it is pursued again.";
  static constexpr auto Fields() {
    return std::tuple{Field{"goal", "the goal", &GoalResumed::goal},
                      Field{"prediction", "what had promised it", &GoalResumed::prediction}};
  }
};

enum class GoalDropReason {
  kSuperGoalClosed,          // what it served is reached or missed
  kRequirementContradicted,  // the condition it was to use is known not to work now
  kReplaced,                 // a later plan goes another way
  kNoPlan,                   // no plan leads there any more
};
template <>
inline constexpr std::array<std::string_view, 4> kEnumNames<GoalDropReason>{
    "super_goal_closed", "requirement_contradicted", "replaced", "no_plan"};

struct GoalDropped {
  GoalId goal;
  GoalDropReason reason = GoalDropReason::kSuperGoalClosed;
  static constexpr std::string_view kName = "GoalDropped";
  static constexpr std::string_view kMeaning =
      "A goal is not pursued any more, without being reached or missed. Where the plan it belonged to is "
      "given up, its causes are what speaks against that plan, and the choice of it.";
  static constexpr auto Fields() {
    return std::tuple{Field{"goal", "the goal", &GoalDropped::goal},
                      Field{"reason", "why not", &GoalDropped::reason}};
  }
};

struct FrameCounted {
  std::int64_t facts = 0;
  std::int64_t instances = 0;
  std::int64_t requirements = 0;
  std::int64_t predictions = 0;
  std::int64_t models = 0;
  std::int64_t matches = 0;
  std::int64_t cut = 0;
  static constexpr std::string_view kName = "FrameCounted";
  static constexpr std::string_view kMeaning = "How much the forward chaining of a frame had to do.";
  static constexpr auto Fields() {
    return std::tuple{
        Field{"facts", "facts in force, properties included", &FrameCounted::facts},
        Field{"instances", "instances of composite states", &FrameCounted::instances},
        Field{"requirements", "statements of requirement models", &FrameCounted::requirements},
        Field{"predictions", "predictions still open", &FrameCounted::predictions},
        Field{"models", "models that are not deleted", &FrameCounted::models},
        Field{"matches", "patterns compared with facts", &FrameCounted::matches},
        Field{"cut", "composite states with more instances than are looked for", &FrameCounted::cut}};
  }
};

// The order is part of the schema (the kind number in files is the position here, from 0): add at the end.
using EventBody =
    std::variant<EpisodeStarted, SymbolDeclared, FrameStarted, WorldStateRecorded, FactObserved,
                 CompositeStateCreated, ModelCreated, InductionStarted, CauseConsidered, IcstFound,
                 ImdlPredicted, PredictionMade, PredictionSucceeded, PredictionFailed, EvidenceUpdated,
                 ModelStateChanged, DriveInjected, GoalSet, GoalSkipped, AnalogyCompared, SimulationStarted,
                 SimulationEnded, PlanCommitted, CommandIssued, CommandRefused, GoalAchieved, GoalFailed,
                 EpisodeEnded, ModelRejected, ChainingDecided, ImdlFired, InstanceProgress,
                 PredictionInvalidated, FactPromoted, PromotionDefeated, CommandImagined, PlanRejected,
                 GoalSuspended, GoalResumed, GoalDropped, FrameCounted>;

inline constexpr std::size_t kEventKinds = std::variant_size_v<EventBody>;

template <std::size_t I>
using EventBodyAt = std::variant_alternative_t<I, EventBody>;

// Calls visit.template operator()<Body>() for each kind, in order.
template <class Visit>
constexpr void ForEachKind(Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (visit.template operator()<EventBodyAt<I>>(), ...);
  }
  (std::make_index_sequence<kEventKinds>());
}

}  // namespace aerascope
