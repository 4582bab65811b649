#include "engine/reason/simulation.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "engine/reason/chaining.h"

namespace aerascope {
namespace {

// Derivations inside one imagined frame (effects that come about at once and set off others).
constexpr int kMaxRoundsInFrame = 16;

class Simulator {
 public:
  Simulator(const Plan& plan, const Fact& target, const GoalEntry& goal, const std::vector<OtherGoal>& others,
            const PlanningContext& context, Journal* journal)
      : plan_(plan),
        target_(target),
        goal_(goal),
        others_(others),
        context_(context),
        knowledge_(context.knowledge),
        journal_(*journal),
        frame_(ImaginedFrame::Present(
            context.present, PendingPredictions(knowledge_, context.present, Pending::kFromFacts))) {}

  Trial Run(const std::vector<EventId>& hypothesised) {
    trial_.simulation = journal_.NewId<SimulationId>();
    std::vector<PlanStep> steps;
    for (const Step& step : plan_.steps) steps.push_back({step.command, step.causal_model, step.requirement});
    std::vector<EventId> causes{goal_.event};
    causes.insert(causes.end(), hypothesised.begin(), hypothesised.end());
    last_ = Write(SimulationStarted{trial_.simulation, goal_.id, std::move(steps), plan_.score}, causes);
    causes_of_end_.push_back(last_);
    for (step_ = 0; step_ < plan_.steps.size(); ++step_) {
      if (!TakeStep(plan_.steps[step_])) {
        trial_.outcome = SimulationOutcome::kNotEnabled;
        break;
      }
      if (HoldsIn(frame_.situation(), target_)) {
        trial_.outcome = SimulationOutcome::kReached;
        break;
      }
    }
    trial_.ends = frame_.interval().after;
    trial_.ended = Write(SimulationEnded{trial_.simulation, trial_.outcome}, causes_of_end_);
    return std::move(trial_);
  }

 private:
  EventId Write(EventBody body, const std::vector<EventId>& causes) {
    return journal_.Write(context_.now, std::move(body), causes, trial_.simulation);
  }

  // One frame. False if the step's model is not allowed to fire.
  bool TakeStep(const Step& step) {
    const TimeInterval interval{frame_.interval().after + context_.parameters.command_offset,
                                frame_.interval().before};
    std::vector<SituationFact> effects;
    bool fired = !step.causal_model.valid();
    LogPromotions(step);
    if (!step.command.is(TermKind::kNil)) {
      last_ = Write(CommandImagined{step.command, interval}, {last_});
      fired = FireOn({true, step.command, interval, 1}, last_, step.causal_model, &effects);
    }
    if (!first_frame_ || (!fired && step.command.is(TermKind::kNil))) {
      // In the present, models have fired on facts already: what they say is among the pending predictions.
      fired = FireOnFacts(step.causal_model, &effects) || fired;
    }
    if (!fired) return false;
    first_frame_ = false;
    Move(std::move(effects), context_.period);
    // What comes about at once in the new frame may set off more.
    for (int round = 0; round < kMaxRoundsInFrame; ++round) {
      std::vector<SituationFact> at_once;
      FireOnFacts({}, &at_once, /*only_at_once=*/true);
      if (at_once.empty()) break;
      Move(std::move(at_once), Duration{0});
    }
    return true;
  }

  bool FireOnFacts(ModelId expected, std::vector<SituationFact>* effects, bool only_at_once = false) {
    bool fired = false;
    const std::size_t count = frame_.situation().facts().size();
    for (std::size_t i = 0; i < count; ++i) {
      const SituationFact fact = frame_.situation()[i];
      if (fact.permanent || IsIcst(fact.fact.payload) || IsImdl(fact.fact.payload) ||
          IsCommand(fact.fact.payload))
        continue;
      fired = FireOn(fact.fact, fact.event, expected, effects, only_at_once) || fired;
    }
    // Models with an instance on their left side.
    const ModelRecord* waiting = knowledge_.Find(expected);
    if (!only_at_once && waiting && IsIcst(waiting->model.lhs.payload)) {
      if (const auto* state = knowledge_.Find(waiting->model.lhs.payload[0].composite_state())) {
        frame_.FindInstances(knowledge_, state->state);
        const auto found = frame_.situation().Candidates(waiting->model.lhs.payload, {});
        const std::vector<std::size_t> candidates(found.begin(), found.end());
        for (const std::size_t i : candidates) {
          const SituationFact fact = frame_.situation()[i];
          fired = FireOn(fact.fact, fact.event, expected, effects) || fired;
        }
      }
    }
    return fired;
  }

  // All models on one fact. True if the expected one fired and is not vetoed.
  bool FireOn(const Fact& input, EventId because, ModelId expected, std::vector<SituationFact>* effects,
              bool only_at_once = false, int depth = 0) {
    bool fired = false;
    for (const ModelId id : knowledge_.ModelsByLhs(input.payload)) {
      const ModelRecord& record = *knowledge_.Find(id);
      frame_.AskRequirements(knowledge_, id);
      bool any = false;
      std::vector<aerascope::Firing> firings = Fire(record, knowledge_, input, frame_.situation());
      for (aerascope::Firing& firing : firings) {
        if (only_at_once && firing.target.interval.after >= frame_.interval().before) continue;
        any = true;
        if (firing.vetoed) {
          if (id == expected) LogVeto(record, firing, because);
          continue;
        }
        fired = fired || id == expected;
        if (firing.target.interval.before <= frame_.interval().after) continue;
        if (only_at_once && Known(firing.target)) continue;
        std::vector<EventId> causes{because, record.event};
        std::vector<ModelId> requirements;
        const auto word_of = [&](const Requirement& requirement) {
          return requirement.event.valid() ? requirement.event
                                           : knowledge_.Find(requirement.requirement)->event;
        };
        for (const std::size_t i : firing.requirements) {
          const Requirement& requirement = frame_.situation().requirements()[i];
          requirements.push_back(requirement.requirement);
          causes.push_back(word_of(requirement));
        }
        // What it goes ahead in spite of.
        for (const std::size_t i : firing.vetoes)
          causes.push_back(word_of(frame_.situation().requirements()[i]));
        SituationFact effect;
        effect.fact = firing.target;
        const PredictionId prediction = journal_.NewId<PredictionId>();
        effect.event = Write(PredictionMade{prediction, id, requirements, {}, firing.target}, causes);
        prediction_of_[effect.event] = prediction;
        causes_of_end_.push_back(effect.event);
        last_ = effect.event;
        effects->push_back(effect);
        // The instance of the model is in force while its input is: reuse models fire on it.
        if (firing.instance.ground() && depth < context_.parameters.max_plan_depth) {
          const Fact instance{true, firing.instance, input.interval, firing.target.confidence};
          fired = FireOn(instance, effect.event, expected, effects, only_at_once, depth + 1) || fired;
        }
      }
      if (!any && id == expected) LogDisabled(record, because);
    }
    return fired;
  }

  bool Known(const Fact& fact) const {
    return frame_.situation().FindMatch(fact.payload, fact.positive, {}) != Situation::npos;
  }

  std::vector<ConsideredRequirement> Considered(const Model& model, const Bindings& bindings, ModelId* winner,
                                                bool* veto) const {
    std::vector<ConsideredRequirement> considered;
    double best = -1;
    for (const Requirement& requirement : frame_.situation().requirements()) {
      Bindings trial = bindings;
      if (requirement.target != model.id || !requirement.imdl.interval.Overlaps(frame_.interval()) ||
          !BindInstance(model, requirement.imdl.payload, trial)) {
        continue;
      }
      considered.push_back({requirement.requirement, requirement.imdl.positive, requirement.imdl.confidence});
      if (!requirement.imdl.positive && requirement.imdl.confidence > best) {
        best = requirement.imdl.confidence;
        *winner = requirement.requirement;
        *veto = true;
      }
    }
    return considered;
  }

  void LogVeto(const ModelRecord& record, const aerascope::Firing& firing, EventId because) {
    ChainingDecided decided;
    decided.model = record.model.id;
    bool veto = false;
    decided.considered = Considered(record.model, firing.bindings, &decided.winner, &veto);
    decided.status = record.state == ModelState::kPhasedOut ? ChainingStatus::kPhasedOut
                     : firing.requirements.empty()          ? ChainingStatus::kStrongDisabled
                                                            : ChainingStatus::kVetoed;
    const ModelRecord* winner = knowledge_.Find(decided.winner);
    const EventId said = Write(decided, {because, record.event, winner ? winner->event : EventId{}});
    trial_.vetoed.emplace(record.model.id, said);
    causes_of_end_.push_back(said);
  }

  void LogDisabled(const ModelRecord& record, EventId because) {
    ChainingDecided decided;
    decided.model = record.model.id;
    decided.status = ChainingStatus::kWeakDisabled;
    causes_of_end_.push_back(Write(decided, {because, record.event}));
  }

  // On to the next frame, or with period zero to more in this one.
  void Move(std::vector<SituationFact> effects, Duration period) {
    ImaginedFrame::Passage passage = frame_.Next(std::move(effects), period);
    frame_ = std::move(passage.frame);
    if (period.us != 0) came_about_.clear();
    for (const SituationFact& arrived : passage.arrived) {
      came_about_.insert(arrived.event);
      if (prediction_of_.contains(arrived.event)) Harm(arrived.fact);  // not what comes anyway
    }
    // Where the plan rested on a fact, its end is worth a word.
    for (const ImaginedFrame::Defeat& defeat : passage.defeated) {
      if (!rested_on_.contains(defeat.fact.fact.payload)) continue;
      Fact would_be = defeat.fact.fact;
      would_be.interval = frame_.interval();
      const auto by = prediction_of_.find(defeat.by.event);
      Write(PromotionDefeated{would_be,
                              by == prediction_of_.end() ? OpenPredictionOf(defeat.by.event) : by->second},
            {defeat.by.event, defeat.fact.event});
    }
  }

  // Does it speak against another open goal? What is predicted for a part of the goal's time counts.
  void Harm(const Fact& fact) {
    for (const OtherGoal& other : others_) {
      Fact during = other.target;
      const auto common = Intersection(fact.interval, other.target.interval);
      if (!common) continue;
      during.interval = *common;
      if (EvidenceFor(fact, during) != EvidenceVerdict::kNegative) continue;
      if (std::find(trial_.harmed.begin(), trial_.harmed.end(), other.goal) == trial_.harmed.end()) {
        trial_.harmed.push_back(other.goal);
      }
    }
  }

  // The facts that the step's condition rests on, if they hold on from the frame before.
  void LogPromotions(const Step& step) {
    if (!journal_.Records<FactPromoted>() && !journal_.Records<PromotionDefeated>()) return;
    const ModelRecord* requirement = knowledge_.Find(step.requirement);
    const CompositeStateRecord* state =
        requirement ? knowledge_.Find(RequiredState(requirement->model)) : nullptr;
    if (!state) return;
    frame_.FindInstances(knowledge_, state->state);
    std::set<std::size_t> facts;
    const auto matches = JointMatches(state->state, frame_.situation(), {}, {64});
    for (const JointMatch& match : matches) {
      // Of several ways the condition holds, the one for what is wanted.
      if (matches.size() > 1 && !SharesEntity(InstancePayload(state->state, match.bindings))) continue;
      for (const std::size_t i : match.facts) CollectPlain(i, &facts);
    }
    for (const std::size_t i : facts) {
      const SituationFact& fact = frame_.situation()[i];
      if (fact.permanent) continue;
      rested_on_.insert(fact.fact.payload);
      if (first_frame_ || came_about_.contains(fact.event)) continue;
      Write(FactPromoted{fact.id, fact.fact}, {fact.event, last_});
    }
  }

  // A prediction made before the simulation.
  PredictionId OpenPredictionOf(EventId event) const {
    for (const auto& [id, prediction] : knowledge_.predictions()) {
      if (prediction.event == event) return id;
    }
    return {};
  }

  void CollectPlain(std::size_t i, std::set<std::size_t>* facts) const {
    const SituationFact& fact = frame_.situation()[i];
    if (fact.components.empty()) {
      facts->insert(i);
    } else {
      for (const std::size_t part : fact.components) CollectPlain(part, facts);
    }
  }

  bool SharesEntity(const Term& instance) const {
    bool all = true;
    ForEachTerm(target_.payload, [&](const Term& wanted) {
      if (!wanted.is(TermKind::kEntity)) return;
      bool found = false;
      ForEachTerm(instance, [&](const Term& part) { found = found || part == wanted; });
      all = all && found;
    });
    return all;
  }

  const Plan& plan_;
  const Fact& target_;
  const GoalEntry& goal_;
  const std::vector<OtherGoal>& others_;
  const PlanningContext& context_;
  const KnowledgeBase& knowledge_;
  Journal& journal_;

  ImaginedFrame frame_;
  bool first_frame_ = true;
  std::size_t step_ = 0;
  Trial trial_;
  EventId last_;
  std::vector<EventId> causes_of_end_;
  std::map<EventId, PredictionId> prediction_of_;
  std::set<EventId> came_about_;  // what made known the facts that came about in this very frame
  std::set<Term> rested_on_;      // payloads a condition of the plan rested on
};

}  // namespace

Trial Simulate(const Plan& plan, const Fact& target, const GoalEntry& goal,
               const std::vector<EventId>& hypothesised, const std::vector<OtherGoal>& others,
               const PlanningContext& context, Journal* journal) {
  return Simulator(plan, target, goal, others, context, journal).Run(hypothesised);
}

}  // namespace aerascope
