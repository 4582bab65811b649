// Events and frames in words.
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};

std::string_view Words(GoalSkipReason reason) {
  switch (reason) {
    case GoalSkipReason::kAlreadyHolds:
      return "it holds already";
    case GoalSkipReason::kLoop:
      return "it is wanted already, further up";
    case GoalSkipReason::kTooDeep:
      return "the chain is too long";
    case GoalSkipReason::kNoModel:
      return "no model leads to it";
    case GoalSkipReason::kBudget:
      return "the budget for planning is used up";
    case GoalSkipReason::kPredicted:
      return "it is expected already";
    case GoalSkipReason::kProperty:
      return "a property, which nothing changes";
    case GoalSkipReason::kTooLate:
      return "it would have to begin before now";
    case GoalSkipReason::kLowConfidence:
      return "hardly any confidence would be left";
    case GoalSkipReason::kUnbound:
      return "not everything it needs is known";
    case GoalSkipReason::kVetoed:
      return "what was learned from failure stands against it";
  }
  return {};
}

std::string_view Words(CauseVerdict verdict) {
  switch (verdict) {
    case CauseVerdict::kBuilt:
      return "a model was made of it";
    case CauseVerdict::kNoSharedValue:
      return "nothing in common with what changed";
    case CauseVerdict::kTooLate:
      return "not before what it should explain";
    case CauseVerdict::kSimultaneous:
      return "a condition, not a cause";
    case CauseVerdict::kNoGuardForm:
      return "no formula leads from it to what was seen";
    case CauseVerdict::kNoCompositeState:
      return "too few conditions could be put together";
    case CauseVerdict::kFreeVariable:
      return "what was seen holds something that neither cause nor condition gives";
    case CauseVerdict::kBlackListed:
      return "the same model failed before";
    case CauseVerdict::kDuplicate:
      return "the same model is known already";
    case CauseVerdict::kContradicted:
      return "it would forbid what has always been right";
    case CauseVerdict::kTooManyWays:
      return "what held with it can be put together in too many ways to tell anything";
  }
  return {};
}

std::string_view Words(AnalogyVerdict verdict) {
  switch (verdict) {
    case AnalogyVerdict::kAccepted:
      return "accepted";
    case AnalogyVerdict::kNotRequired:
      return "not required, a better plan is known";
    case AnalogyVerdict::kFullMatch:
      return "nothing unfamiliar to generalise";
    case AnalogyVerdict::kTooFewMatched:
      return "too few";
    case AnalogyVerdict::kNotFamiliar:
      return "not familiar enough";
    case AnalogyVerdict::kNothingObserved:
      return "no condition that holds speaks of what the goal is about";
    case AnalogyVerdict::kFreeVariable:
      return "what remains leaves something undetermined";
    case AnalogyVerdict::kBlackListed:
      return "the same idea failed before";
    case AnalogyVerdict::kNoPlan:
      return "no plan through it reaches the goal";
  }
  return {};
}

std::string_view Words(ChainingStatus status) {
  switch (status) {
    case ChainingStatus::kNoRequirement:
      return "applies: nothing is required";
    case ChainingStatus::kEnabled:
      return "applies";
    case ChainingStatus::kEnabledAgainstVeto:
      return "applies, against a veto that is less sure";
    case ChainingStatus::kWeakDisabled:
      return "does not apply: no condition for it holds";
    case ChainingStatus::kStrongDisabled:
    case ChainingStatus::kVetoed:
      return "is vetoed and predicts silently";
    case ChainingStatus::kPhasedOut:
      return "is phased out and predicts silently";
    case ChainingStatus::kTooDeep:
      return "does not apply: too many expectations rest on one another already";
  }
  return {};
}

std::string_view Words(InvalidationReason reason) {
  switch (reason) {
    case InvalidationReason::kPremiseContradicted:
      return "what it rested on did not come true";
    case InvalidationReason::kRenewed:
      return "what it rested on was seen, and it is expected from that";
    case InvalidationReason::kNotRenewed:
      return "what it rested on was seen, but it does not follow from that";
    case InvalidationReason::kOverdue:
      return "its time came before what it rested on was decided";
    case InvalidationReason::kOutweighed:
      return "something else is expected more surely";
    case InvalidationReason::kPremiseOutweighed:
      return "instead of what it rested on, something else is expected more surely";
  }
  return {};
}

std::string_view Words(PlanRejection reason) {
  switch (reason) {
    case PlanRejection::kNotEnabled:
      return "a step would not work there";
    case PlanRejection::kNotReached:
      return "it does not reach the goal";
    case PlanRejection::kLowerScore:
      return "another plan is surer";
    case PlanRejection::kTie:
      return "another plan as sure was found first";
    case PlanRejection::kHarms:
      return "it would harm a more important goal";
    case PlanRejection::kMandatoryHarms:
      return "what must be done would harm a more important goal";
    case PlanRejection::kMandatoryFirst:
      return "something else must be done first";
  }
  return {};
}

std::string_view Words(GoalDropReason reason) {
  switch (reason) {
    case GoalDropReason::kSuperGoalClosed:
      return "what it served is settled";
    case GoalDropReason::kRequirementContradicted:
      return "its condition is known not to hold now";
    case GoalDropReason::kReplaced:
      return "another way was chosen";
    case GoalDropReason::kNoPlan:
      return "no plan leads there any more";
  }
  return {};
}

std::string_view Words(InductionKind kind) {
  switch (kind) {
    case InductionKind::kChange:
      return "Not predicted";
    case InductionKind::kPredictionFailure:
      return "Predicted otherwise";
    case InductionKind::kGoalSuccess:
      return "Reached unexpectedly";
  }
  return {};
}

std::string Plural(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

class Teller {
 public:
  explicit Teller(const Run& run) : run_(run), knowledge_(run.final_knowledge()) {}

  std::string Tell(const Event& event) const {
    const std::string sentence = std::visit(
        [&](const auto& body) {
          // Some are told with what caused them.
          if constexpr (requires { Of(body, event); }) {
            return Of(body, event);
          } else {
            return Of(body);
          }
        },
        event.body);
    // Its beginning and end name the simulation themselves.
    const bool names_it = std::holds_alternative<SimulationStarted>(event.body) ||
                          std::holds_alternative<SimulationEnded>(event.body);
    if (!event.simulation.valid() || names_it) return sentence;
    return "In " + IdText(event.simulation) + ": " + sentence;
  }

  std::string TargetOf(GoalId goal) const {
    const EventId creation = run_.CreationOf(goal);
    if (const auto* drive = run_.FindBody<DriveInjected>(creation)) return Text(drive->target);
    if (const auto* set = run_.FindBody<GoalSet>(creation)) return Text(set->target);
    return IdText(goal);
  }

  // The drive at the top of a goal's chain, by title: "hold s1".
  bool IsDrive(GoalId goal) const { return run_.FindBody<DriveInjected>(run_.CreationOf(goal)) != nullptr; }

  std::string Of(const EvidenceUpdated& e) const {
    const double before = e.before.rate();
    const double after = e.after.rate();
    const std::string_view change = after > before   ? " rises to "
                                    : after < before ? " falls to "
                                                     : " stays at ";
    std::string text = IdText(e.model) + std::string(change) + FormatConfidence(after);
    if (e.strong_after && !e.strong_before) text += " and counts as confirmed";
    return text + ".";
  }

 private:
  std::string Text(const Fact& fact) const { return FactText(knowledge_, fact); }
  std::string Text(const Term& payload) const { return PayloadText(knowledge_, payload); }
  std::string FactOf(FactId id) const {
    const Fact* fact = run_.FindFact(id);
    return fact ? Text(*fact) : IdText(id);
  }
  std::string Titled(ModelId id) const { return TitleOf(knowledge_, id) + " (" + IdText(id) + ")"; }
  // A causal model by what it says, any other by its title.
  std::string ModelPhrase(ModelId id) const {
    const ModelRecord* record = knowledge_.Find(id);
    if (!record || KindOf(record->model) != ModelKind::kCausal) return Titled(id);
    std::string phrase = ExplanationOf(knowledge_, id);
    if (!phrase.empty()) phrase.pop_back();
    return phrase + " (" + IdText(id) + ")";
  }
  std::string PredictionTarget(PredictionId id) const {
    const auto* made = run_.FindBody<PredictionMade>(run_.CreationOf(id));
    return made ? Text(made->target) : IdText(id);
  }

  // A model that is vetoed or phased out is only watched: nothing rests on what it predicts.
  std::string IfSilent(PredictionId id) const {
    const auto* made = run_.FindBody<PredictionMade>(run_.CreationOf(id));
    return made && made->target.confidence <= 0 ? ", predicted silently" : "";
  }

  std::string Of(const EpisodeStarted& e) const {
    std::string text = "The episode \"" + Printable(e.scenario) + "\" begins";
    if (!e.world.empty()) text += ", in a world of kind " + Printable(e.world);
    return text + ".";
  }
  std::string Of(const SymbolDeclared& e) const {
    return (e.symbol.is(TermKind::kEntity) ? "Named: the thing " : "Named: the word ") + ValueText(e.symbol) +
           ".";
  }
  std::string Of(const FrameStarted& e) const {
    return "A frame begins, from " + SecondsText(e.interval.after) + ".";
  }
  std::string Of(const WorldStateRecorded&) const { return "The state of the world is recorded."; }
  std::string Of(const FactObserved& e) const {
    switch (e.source) {
      case FactSource::kSensor:
      case FactSource::kProperty:
        return "Seen: " + Text(e.fact) + ".";
      case FactSource::kExecuted:
        return "Done: " + Text(e.fact) + ".";
      case FactSource::kAbsence:
        return "Concluded: " + Text(e.fact) + ".";
    }
    return {};
  }
  std::string Of(const CompositeStateCreated& e) const {
    const std::string id = IdText(e.state.id);
    if (e.origin == Origin::kAnalogy) {
      std::vector<std::string> pruned;
      for (const Condition& condition : ConditionsWithPruned(knowledge_, e.state.id)) {
        if (condition.pruned) pruned.push_back("`" + condition.text + "`");
      }
      std::string text = "Generalised: " + id + " from " + IdText(e.derived_from);
      if (!pruned.empty()) text += ", without " + InWords(pruned);
      return text + ".";
    }
    return (e.origin == Origin::kSeed ? "Given: " : "Learned: ") + id + ", " +
           TitleOf(knowledge_, e.state.id) + ".";
  }
  std::string Of(const ModelCreated& e) const {
    const std::string sure = ", sure at " + FormatConfidence(e.evidence.rate()) + ".";
    switch (e.origin) {
      case Origin::kSeed:
        return "Given: " + ModelPhrase(e.model.id) + ".";
      case Origin::kAnalogy:
        return "By analogy: " + ModelPhrase(e.model.id) + sure;
      case Origin::kInduction:
      case Origin::kPredictionFailure:
      case Origin::kGoalSuccess:
        return "Learned: " + ModelPhrase(e.model.id) + sure;
    }
    return {};
  }
  std::string Of(const InductionStarted& e) const {
    return std::string(Words(e.induction)) + ": " + FactOf(e.consequent) + ". A cause is looked for.";
  }
  std::string Of(const CauseConsidered& e) const {
    // With its time: of a failure the cause may read like what was seen instead.
    if (e.verdict == CauseVerdict::kBuilt) {
      const Event* seen = run_.Find(run_.CreationOf(e.fact_id));
      return "The cause found: " + FactOf(e.fact_id) + (seen ? ", at " + SecondsText(seen->time) : "") + ".";
    }
    return "Not the cause: " + FactOf(e.fact_id) + " (" + std::string(Words(e.verdict)) + ").";
  }
  std::string Of(const IcstFound& e) const {
    if (!IsIcst(e.fact.payload)) return "Holds: " + Text(e.fact) + ".";
    const std::string bindings = BindingsText(BindingsOf(knowledge_, e.fact.payload));
    std::string text = ValueText(e.fact.payload[0]);
    text += e.fact.positive ? " holds" : " does not hold";
    return bindings.empty() ? text + "." : text + ": " + bindings + ".";
  }
  std::string Of(const ImdlPredicted& e) const {
    const ModelRecord* record = knowledge_.Find(e.requirement);
    const bool later = record && DelayOf(record->model).value_or(Duration{}) > Duration{};
    return IdText(e.requirement) + (e.fact.positive ? " expects that " : " denies that ") +
           Text(e.fact.payload) + (later ? ", at " + SecondsText(e.fact.interval.after) : "") + ".";
  }
  std::string Of(const PredictionMade& e) const {
    return (e.target.confidence > 0 ? "Predicted: " : "Predicted silently: ") + Text(e.target) + ".";
  }
  std::string Of(const PredictionSucceeded& e) const {
    return "Came true" + IfSilent(e.prediction) + ": " + PredictionTarget(e.prediction) + ".";
  }
  std::string Of(const PredictionFailed& e) const {
    const std::string seen =
        e.evidence.valid() ? "; seen: " + FactOf(e.evidence) : "; nothing of it was seen in time";
    return "Did not come true" + IfSilent(e.prediction) + ": " + PredictionTarget(e.prediction) + seen + ".";
  }
  std::string Of(const ModelStateChanged& e) const {
    switch (e.after) {
      case ModelState::kActive:
        return IdText(e.model) + " is in use again.";
      case ModelState::kPhasedOut:
        return IdText(e.model) + (e.reason == StateChangeReason::kTimedOut
                                      ? " was not met for long and only predicts silently now."
                                  : e.reason == StateChangeReason::kGiven
                                      ? " is given as one that only predicts silently."
                                      : " failed too often and only predicts silently now.");
      case ModelState::kDeleted:
        switch (e.reason) {
          case StateChangeReason::kRating:
            return IdText(e.model) + " is given up, and not to be made again.";
          case StateChangeReason::kOrphaned:
            return IdText(e.model) + " is given up: no condition for it is left.";
          case StateChangeReason::kRefersToDeleted:
            return IdText(e.model) + " is given up with what it speaks about.";
          case StateChangeReason::kTimedOut:
            return IdText(e.model) + " is given up: it was not met for too long.";
          case StateChangeReason::kForgotten:
            return IdText(e.model) + " failed long ago, which is forgotten: it may be made again.";
          case StateChangeReason::kGiven:
            return IdText(e.model) + " is given as one that is not to be made again.";
        }
    }
    return {};
  }
  std::string Of(const ModelRejected& e) const {
    std::string text = "Not learned: a model that was put together (" + std::string(Words(e.reason));
    if (e.same_as.valid()) text += ": " + IdText(e.same_as);
    return text + ").";
  }
  std::string Of(const ChainingDecided& e) const {
    if (IsVetoed(e) && e.winner.valid())
      return IdText(e.model) + " is vetoed by " + IdText(e.winner) + " and predicts silently.";
    std::string text = IdText(e.model) + " " + std::string(Words(e.status));
    if (e.status == ChainingStatus::kEnabledAgainstVeto) {
      std::vector<std::string> vetoes;
      for (const ConsideredRequirement& one : e.considered)
        if (!one.positive) vetoes.push_back(IdText(one.requirement));
      if (!vetoes.empty()) text += " (" + InWords(vetoes) + ")";
    }
    if (e.winner.valid()) text += ", by " + IdText(e.winner);
    return text + ".";
  }
  std::string Of(const ImdlFired& e) const { return "In force: " + Text(e.fact) + "."; }
  std::string Of(const InstanceProgress& e) const {
    return IdText(e.state) + " is met in " + std::to_string(e.matched) + " of " +
           Plural(e.total, "condition", "conditions") + ": " + FactOf(e.fact_id) + ".";
  }
  std::string Of(const PredictionInvalidated& e) const {
    return "No longer expected as it was: " + PredictionTarget(e.prediction) + " (" +
           std::string(Words(e.reason)) + (e.by.valid() ? ": " + FactOf(e.by) : "") +
           (e.surer.valid() ? ": " + PredictionTarget(e.surer) : "") + ").";
  }
  std::string Of(const FactPromoted& e) const { return "Holds on: " + Text(e.fact) + "."; }
  std::string Of(const PromotionDefeated& e) const {
    return "Does not hold on: " + Text(e.fact) + ", since " + PredictionTarget(e.by) + ".";
  }
  std::string Of(const CommandImagined& e) const { return "Imagined: " + Text(e.command) + "."; }
  std::string Of(const PlanRejected& e) const {
    const std::string hindrance =
        e.reason == PlanRejection::kNotEnabled ? HindranceIn(e.simulation) : std::string();
    std::string text = "Not chosen: " + PlanOf(e.simulation) + ", score " + FormatConfidence(e.score) + " (" +
                       (hindrance.empty() ? std::string(Words(e.reason)) : hindrance);
    if (e.harmed.valid()) text += ": " + TargetOf(e.harmed);
    return text + ").";
  }
  std::string Of(const GoalSuspended& e) const {
    return "Waiting: " + TargetOf(e.goal) + " is expected to come by itself.";
  }
  std::string Of(const GoalResumed& e) const {
    return "Pursued again: " + TargetOf(e.goal) + ", since what promised it failed.";
  }
  std::string Of(const GoalDropped& e) const {
    return "No longer pursued: " + TargetOf(e.goal) + " (" + std::string(Words(e.reason)) + ").";
  }
  std::string Of(const FrameCounted& e) const {
    return Plural(e.facts, "fact", "facts") + ", " + Plural(e.instances, "instance", "instances") + ", " +
           Plural(e.requirements, "statement of requirements", "statements of requirements") + ", " +
           Plural(e.predictions, "prediction", "predictions") + " open, " +
           Plural(e.models, "model", "models") + ".";
  }
  std::string Of(const DriveInjected& e) const {
    return "Drive: " + (e.title.empty() ? Text(e.target) : Printable(e.title)) + ".";
  }
  std::string Of(const GoalSet& e) const {
    std::string text = "Goal: " + Text(e.target);
    if (e.model.valid()) text += ", asked for by " + IdText(e.model);
    return text + ".";
  }
  std::string Of(const GoalSkipped& e, const Event& event) const {
    std::string text = "Not pursued: " + Text(e.target) + " (" + std::string(Words(e.reason));
    for (const EventId cause : run_.Causes(event.id)) {
      const auto* against = run_.FindBody<ImdlPredicted>(cause);
      if (against && e.reason == GoalSkipReason::kVetoed) text += ": " + IdText(against->requirement);
    }
    return text + ").";
  }
  std::string Of(const AnalogyCompared& e) const;
  std::string Of(const SimulationStarted& e) const {
    return "Tried in the head (" + IdText(e.simulation) + "): " + StepsText(e.steps) + "; score " +
           FormatConfidence(e.score) + ".";
  }
  std::string Of(const SimulationEnded& e) const {
    switch (e.outcome) {
      case SimulationOutcome::kReached:
        return "The plan of " + IdText(e.simulation) + " reaches its goal.";
      case SimulationOutcome::kNotEnabled: {
        const std::string hindrance = HindranceIn(e.simulation);
        return "A step of " + IdText(e.simulation) + " would not work there" +
               (hindrance.empty() ? "" : ": " + hindrance) + ".";
      }
      case SimulationOutcome::kNotReached:
        return "The plan of " + IdText(e.simulation) + " does not reach its goal.";
    }
    return {};
  }
  std::string Of(const PlanCommitted& e) const {
    const auto chosen =
        std::find_if(e.candidates.begin(), e.candidates.end(),
                     [&](const PlanCandidate& candidate) { return candidate.simulation == e.chosen; });
    std::string text = "Chosen: the plan of " + IdText(e.chosen) + ", score " + FormatConfidence(e.score);
    if (chosen != e.candidates.end() && chosen->reaches != Time{})
      text += ", reaching the goal at " + SecondsText(chosen->reaches);
    std::vector<std::string> others;
    for (const PlanCandidate& candidate : e.candidates) {
      if (candidate.simulation != e.chosen) others.push_back(CandidateText(candidate));
    }
    if (others.empty()) return text + "; it was the only one.";
    constexpr std::size_t kMost = 4;
    const std::size_t more = others.size() - std::min(others.size(), kMost);
    if (more > 0) {
      others.resize(kMost);
      others.push_back(std::to_string(more) + " more");
    }
    return text + (e.candidates.size() == 2 ? "; the other: " : "; the others: ") + InWords(others) + ".";
  }
  // "sim_14 (score 0.56, at 1.2 s)".
  static std::string CandidateText(const PlanCandidate& candidate) {
    const std::string id = IdText(candidate.simulation);
    if (std::isnan(candidate.score)) return id;  // from before it was recorded
    const std::string when =
        candidate.reaches == Time{} ? "does not get there" : "at " + SecondsText(candidate.reaches);
    return id + " (score " + FormatConfidence(candidate.score) + ", " + when + ")";
  }
  std::string Of(const CommandIssued& e) const {
    return (e.by == Commander::kTeacher ? "The teacher commands " : "The agent commands ") + Text(e.command) +
           ".";
  }
  std::string Of(const CommandRefused& e) const {
    std::string text = "The world did not do " + Text(e.command) + " as asked";
    if (!e.reason.empty()) text += ": " + Printable(e.reason);
    return text.ends_with('.') ? text : text + ".";
  }
  std::string Of(const GoalAchieved& e) const { return "Goal reached: " + TargetOf(e.goal) + "."; }
  std::string Of(const GoalFailed& e) const { return "Goal missed: " + TargetOf(e.goal) + "."; }
  std::string Of(const EpisodeEnded& e) const {
    return "The episode ends: " + std::to_string(e.drives_reached) + " of " +
           Plural(e.drives, "goal", "goals") + " reached.";
  }

  static bool IsVetoed(const ChainingDecided& e) {
    return e.status == ChainingStatus::kVetoed || e.status == ChainingStatus::kStrongDisabled;
  }
  // "press [jar], then twist [jar] (sim_96)".
  std::string PlanOf(SimulationId simulation) const {
    const auto* started = run_.FindBody<SimulationStarted>(run_.CreationOf(simulation));
    if (!started) return "the plan of " + IdText(simulation);
    return StepsText(started->steps) + " (" + IdText(simulation) + ")";
  }
  std::string StepsText(const std::vector<PlanStep>& steps) const {
    std::vector<std::string> texts;
    for (const PlanStep& step : steps) texts.push_back(StepText(knowledge_, step));
    return texts.empty() ? "nothing" : Join(texts, ", then ");
  }
  // Why a step would not work there: "release [h] is vetoed by mdl_150". Nothing if it cannot be told.
  std::string HindranceIn(SimulationId simulation) const {
    const EventId creation = run_.CreationOf(simulation);
    const auto* started = run_.FindBody<SimulationStarted>(creation);
    if (!started) return {};
    for (const EventId effect : run_.Effects(creation)) {
      if (!run_.FindBody<SimulationEnded>(effect)) continue;
      for (const EventId cause : run_.Causes(effect)) {
        const auto* decided = run_.FindBody<ChainingDecided>(cause);
        if (!decided) continue;
        const auto step =
            std::find_if(started->steps.begin(), started->steps.end(),
                         [&](const PlanStep& one) { return one.causal_model == decided->model; });
        const std::string what =
            step == started->steps.end() ? IdText(decided->model) : StepText(knowledge_, *step);
        if (IsVetoed(*decided) && decided->winner.valid())
          return what + " is vetoed by " + IdText(decided->winner);
        if (decided->status == ChainingStatus::kWeakDisabled) return "no condition for " + what + " holds";
        return what + " " + std::string(Words(decided->status));
      }
    }
    return {};
  }

  const Run& run_;
  const KnowledgeBase& knowledge_;
};

std::string Teller::Of(const AnalogyCompared& e) const {
  const CompositeStateRecord* source = knowledge_.Find(e.source);
  std::vector<std::size_t> missed;
  std::set<std::string> things;  // what the missed conditions are about
  for (const ComparedComponent& component : e.components) {
    if (component.status != ComponentStatus::kMissed) continue;
    missed.push_back(static_cast<std::size_t>(std::max<std::int64_t>(component.index, 0)));
    Parts parts;
    AddParts(knowledge_, {true, component.pattern, Term::Wildcard(), Term::Wildcard()}, 0, &parts);
    for (const Part& part : parts.parts) {
      if (IsValue(part.payload) && part.payload[0].is(TermKind::kEntity))
        things.insert(ValueText(part.payload[0]));
    }
  }
  std::string text = std::to_string(e.matched) + " of " + Plural(e.total, "condition", "conditions") +
                     " of " + IdText(e.source) + " hold";
  if (!things.empty()) text += " for " + InWords({things.begin(), things.end()});
  if (e.achievable > 0) text += ", " + std::to_string(e.achievable) + " more can be brought about";
  if (e.verdict != AnalogyVerdict::kAccepted) {
    return text + ": " + std::string(Words(e.verdict)) + " (ψ " + FormatConfidence(e.psi) + ").";
  }
  const std::string pruned = source ? QuotedConditions(knowledge_, source->state, missed) : "";
  if (!pruned.empty()) text += "; " + pruned + (missed.size() == 1 ? " is pruned" : " are pruned");
  return text + ": " + IdText(e.result_requirement) + " starts at " + FormatConfidence(e.confidence) + ".";
}

// What a frame brought, most telling first.
struct Moment {
  std::vector<std::string> outcomes;  // drives reached and missed, predictions that failed, trouble
  std::vector<std::string> evidence;  // of knowledge made by analogy
  std::vector<std::string> learned;
  std::vector<std::string> made_by_analogy;
  std::vector<std::string> drives;
  std::vector<std::string> next;  // commands, the end
};

class Narrator {
 public:
  explicit Narrator(const Run& run) : run_(run), teller_(run) {}

  std::string Tell(const RunFrame& frame) {
    Moment moment;
    for (std::int64_t id = frame.first.value; id <= frame.last.value; ++id) {
      const Event& event = *run_.Find(EventId{id});
      if (!event.simulation.valid()) Note(event, &moment);
    }
    // Two sentences at most; the next step only where there is room.
    std::vector<std::string> sentences;
    for (const auto* part : {&moment.outcomes, &moment.evidence, &moment.drives, &moment.made_by_analogy,
                             &moment.learned, &moment.next}) {
      for (const std::string& sentence : *part) {
        if (sentences.size() < 2) sentences.push_back(sentence);
      }
    }
    return sentences.empty() ? "Nothing new." : Join(sentences, " ");
  }

 private:
  void Note(const Event& event, Moment* moment) {
    const KnowledgeBase& knowledge = run_.final_knowledge();
    std::visit(
        Overloaded{[&](const GoalAchieved& e) {
                     if (teller_.IsDrive(e.goal)) moment->outcomes.push_back(teller_.Tell(event));
                   },
                   [&](const GoalFailed& e) {
                     if (teller_.IsDrive(e.goal)) moment->outcomes.push_back(teller_.Tell(event));
                   },
                   [&](const PredictionFailed&) { moment->outcomes.push_back(teller_.Tell(event)); },
                   [&](const CommandRefused&) { moment->outcomes.push_back(teller_.Tell(event)); },
                   [&](const ModelStateChanged&) { moment->outcomes.push_back(teller_.Tell(event)); },
                   [&](const EvidenceUpdated& e) {
                     const ModelRecord* record = knowledge.Find(e.model);
                     if (!record || record->origin != Origin::kAnalogy) return;
                     moment->evidence.push_back(
                         (e.success ? "The analogy was right: " : "The analogy was wrong: ") + teller_.Of(e));
                   },
                   [&](const ModelCreated& e) {
                     if (!IsRequirement(e.model) || e.origin == Origin::kSeed) return;
                     const std::string title = TitleOf(knowledge, e.model.id);
                     if (e.origin == Origin::kAnalogy) {
                       moment->made_by_analogy.push_back("By analogy: " + title + ", sure at " +
                                                         FormatConfidence(e.evidence.rate()) + ".");
                     } else {
                       moment->learned.push_back("Learned: " + title + ".");
                     }
                   },
                   [&](const DriveInjected&) { moment->drives.push_back(teller_.Tell(event)); },
                   [&](const CommandIssued&) { moment->next.push_back(teller_.Tell(event)); },
                   [&](const EpisodeEnded&) { moment->next.push_back(teller_.Tell(event)); },
                   [](const auto&) {}},
        event.body);
  }

  const Run& run_;
  Teller teller_;
};

}  // namespace

std::string SentenceOf(const Run& run, const Event& event) {
  return Teller(run).Tell(event);
}

std::string SentenceOfFrame(const Run& run, std::size_t frame) {
  return frame < run.frames().size() ? Narrator(run).Tell(run.frames()[frame]) : "";
}

}  // namespace aerascope
