#include "engine/reason/reasoner.h"

#include <algorithm>
#include <map>

#include "engine/reason/chaining.h"
#include "engine/reason/change_induction.h"
#include "engine/reason/credit.h"
#include "engine/reason/failure_induction.h"
#include "engine/reason/goal_induction.h"
#include "engine/reason/plan.h"
#include "engine/reason/requirement_builder.h"

namespace aerascope {
namespace {

// Seed numbers -> episode numbers, in one term or definition.
class Renumbering {
 public:
  void Add(CompositeStateId from, CompositeStateId to) { states_[from] = to; }
  void Add(ModelId from, ModelId to) { models_[from] = to; }

  Term operator()(const Term& term) const {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (part.is(TermKind::kCompositeState)) {
        const auto it = states_.find(part.composite_state());
        return it == states_.end() ? part : Term::Reference(it->second);
      }
      if (part.is(TermKind::kModel)) {
        const auto it = models_.find(part.model());
        return it == models_.end() ? part : Term::Reference(it->second);
      }
      return std::nullopt;
    });
  }
  FactPattern operator()(const FactPattern& pattern) const {
    return {pattern.positive, (*this)(pattern.payload), pattern.after, pattern.before};
  }

 private:
  std::map<CompositeStateId, CompositeStateId> states_;
  std::map<ModelId, ModelId> models_;
};

}  // namespace

Reasoner::Reasoner(const ReasonerParameters& parameters, Duration sampling_period, EventSink* sink)
    : parameters_(parameters),
      period_(sampling_period),
      journal_(sink),
      previous_({Time{-sampling_period.us}, Time{0}}),
      situation_({Time{-sampling_period.us}, Time{0}}),
      expectations_(parameters_, sampling_period, &journal_),
      time_outs_(parameters_, &journal_),
      drives_(parameters_, sampling_period, &journal_) {}

void Reasoner::LoadSeed(const std::vector<Term>& symbols, const std::vector<Fact>& properties,
                        const std::vector<CompositeState>& states,
                        const std::vector<SeedModelDefinition>& models) {
  const Time start{0};
  for (const Term& symbol : symbols) journal_.Write(start, SymbolDeclared{symbol});
  for (const Fact& fact : properties) {
    SituationFact property;
    property.id = journal_.NewId<FactId>();
    property.fact = fact;
    property.permanent = true;
    property.event = journal_.Write(start, FactObserved{property.id, fact, FactSource::kProperty});
    properties_.push_back(std::move(property));
  }
  Renumbering renumbered;
  for (const CompositeState& given : states) {
    CompositeState state = given;
    state.id = journal_.NewId<CompositeStateId>();
    renumbered.Add(given.id, state.id);
    for (FactPattern& component : state.components) component = renumbered(component);
    journal_.Write(start, CompositeStateCreated{std::move(state), Origin::kSeed, {}});
  }
  for (const SeedModelDefinition& given : models) {
    Model model = given.model;
    model.id = journal_.NewId<ModelId>();
    renumbered.Add(given.model.id, model.id);
    model.lhs = renumbered(model.lhs);
    model.rhs = renumbered(model.rhs);
    const ModelId id = model.id;
    const EventId created = journal_.Write(
        start, ModelCreated{std::move(model), given.evidence, given.strong, Origin::kSeed, {}});
    if (given.state == ModelState::kActive) continue;
    journal_.Write(start, ModelStateChanged{id, ModelState::kActive, given.state, StateChangeReason::kGiven},
                   {created});
  }
}

std::size_t Reasoner::AddFact(Fact fact, FactSource source, Time at, const std::vector<EventId>& causes) {
  SituationFact entry;
  entry.id = journal_.NewId<FactId>();
  entry.fact = std::move(fact);
  entry.concluded = source == FactSource::kAbsence;
  entry.event = journal_.Write(at, FactObserved{entry.id, entry.fact, source}, causes);
  return situation_.Add(std::move(entry));
}

void Reasoner::BeginFrame(std::int64_t frame, const std::vector<Fact>& sensed) {
  journal_.StartFrame(frame);
  const TimeInterval interval{Time{frame * period_.us}, Time{(frame + 1) * period_.us}};
  earlier_.push_front(std::move(previous_));
  while (!earlier_.empty() && static_cast<int>(earlier_.size()) >= parameters_.tpx_time_horizon_frames) {
    earlier_.pop_back();
  }
  previous_ = std::move(situation_);
  situation_ = Situation(interval);
  std::erase_if(pending_,
                [&](const Requirement& said) { return said.imdl.interval.before <= interval.after; });
  for (const Requirement& said : pending_) situation_.Add(said);
  frame_started_ = journal_.Write(interval.after, FrameStarted{interval});
  for (const SituationFact& property : properties_) {
    if (property.fact.interval.Overlaps(interval)) situation_.Add(property);
  }
  for (const Fact& fact : sensed) AddFact(fact, FactSource::kSensor, interval.after, {});
  CheckPredictions();
  time_outs_.Check(interval.after, frame_started_);
  const std::vector<Drives::Achieved> reached = drives_.Check(situation_, concluded_);
  LearnFromChanges();
  LearnFromGoals(reached);
  Chain(interval.after);
  GiveUpOutweighed(interval.after);
  for (const Expectations::Renewal& renewal : expectations_.Renew(&concluded_, interval.after))
    drives_.Renew(renewal);
  drives_.Resume(concluded_, interval.after);
  expectations_.Extend(situation_, pending_, interval.after);
  GiveUpOutweighed(interval.after);
  drives_.Resume(concluded_, interval.after);
}

void Reasoner::GiveUpOutweighed(Time at) {
  for (const Outweighed& one : FindOutweighed(knowledge(), last_weighed_)) {
    const PredictionRecord& prediction = knowledge().predictions().at(one.prediction);
    if (prediction.grounds.empty()) outweighed_.push_back(prediction.target);
    expectations_.Outweigh(one, &concluded_, at);
    open_firings_.erase(one.prediction);
  }
  if (!knowledge().predictions().empty())
    last_weighed_ = std::max(last_weighed_, knowledge().predictions().rbegin()->first);
  expectations_.GiveUp(&concluded_, at);
}

void Reasoner::CheckPredictions() {
  expected_.clear();
  concluded_.clear();
  came_true_.clear();
  const TimeInterval frame = FrameInterval();
  std::erase_if(outweighed_, [&](const Fact& target) { return target.interval.before <= frame.after; });
  for (const Fact& target : outweighed_) {
    if (target.interval.after < frame.before) expected_.push_back(target);
  }
  std::vector<PredictionRecord> open;
  for (const auto& [id, prediction] : knowledge().predictions()) {
    const bool from_facts = prediction.grounds.empty();
    if (from_facts && prediction.target.interval.after < frame.before) open.push_back(prediction);
  }
  for (const PredictionRecord& prediction : open) {
    const Fact& target = prediction.target;
    expected_.push_back(target);
    const SituationFact* evidence = nullptr;
    EvidenceVerdict verdict = EvidenceVerdict::kNone;
    Bindings none;
    const Term any_value = IsValue(target.payload)
                               ? MakeValue(target.payload[0], target.payload[1], Term::Wildcard())
                               : target.payload;
    for (const std::size_t i : situation_.Candidates(any_value, none)) {
      verdict = EvidenceFor(situation_[i].fact, target);
      if (verdict == EvidenceVerdict::kNone) continue;
      evidence = &situation_[i];
      break;
    }
    // Facts of this frame are in; what is due by its start and has not come will not come.
    const bool overdue = target.interval.before <= frame.after + kTimeTolerance;
    if (verdict == EvidenceVerdict::kNone && !overdue) continue;
    const bool success =
        verdict == EvidenceVerdict::kPositive || (verdict == EvidenceVerdict::kNone && !target.positive);
    Conclude(prediction, success, evidence);
  }
  expectations_.GiveUp(&concluded_, frame.after);
}

void Reasoner::Conclude(const PredictionRecord& prediction, bool success, const SituationFact* evidence) {
  const Time now = FrameInterval().after;
  const Fact& target = prediction.target;
  const bool silent = target.confidence == 0;
  // What rests on an assumption proves nothing about the models (semantics 3.4).
  const bool proven = !evidence || evidence->fact.confidence == 1;
  FactId shown_by = evidence ? evidence->id : FactId{};
  const std::vector<EventId> causes{prediction.event, evidence ? evidence->event : EventId{}};
  const EventId outcome = success ? journal_.Write(now, PredictionSucceeded{prediction.id, shown_by}, causes)
                                  : journal_.Write(now, PredictionFailed{prediction.id, shown_by}, causes);
  if (!success && !evidence && !silent) {
    Fact absent = target;
    absent.positive = !target.positive;
    absent.confidence = 1;
    shown_by = situation_[AddFact(std::move(absent), FactSource::kAbsence, now, {outcome})].id;
  }
  concluded_[prediction.id] = {outcome, success, shown_by};
  const auto firing = open_firings_.find(prediction.id);
  // A silent prediction counts only when it was right.
  if (proven && (success || !silent)) {
    std::vector<ModelId> silenced;
    if (firing != open_firings_.end()) silenced = firing->second.silenced;
    GiveCredit({prediction.model, prediction.requirements, success, outcome, std::move(silenced)}, now,
               parameters_, &journal_);
    if (!success) LearnFromFailure(prediction, shown_by, outcome);
  }
  if (firing == open_firings_.end()) return;
  if (success) came_true_.push_back({prediction, std::move(firing->second)});
  open_firings_.erase(firing);
}

void Reasoner::LearnFromFailure(const PredictionRecord& prediction, FactId shown_by, EventId outcome) {
  const auto firing = open_firings_.find(prediction.id);
  if (firing == open_firings_.end()) return;
  const Time fired =
      TemplateInterval(firing->second.instance[1]).value_or(previous_.interval()).after + kTimeTolerance;
  std::vector<const Situation*> frames;
  if (previous_.interval().after <= fired) frames.push_back(&previous_);
  for (const Situation& frame : earlier_) {
    if (frame.interval().after <= fired) frames.push_back(&frame);
  }
  InduceFromFailure({prediction.model,
                     firing->second.instance,
                     firing->second.input,
                     shown_by,
                     prediction.target,
                     {outcome, prediction.event}},
                    frames, parameters_, FrameInterval().after, &journal_);
}

void Reasoner::LearnFromChanges() {
  for (std::size_t i = 0; i < previous_.facts().size(); ++i) {
    const SituationFact& premise = previous_[i];
    if (premise.permanent || !premise.fact.positive || !IsValue(premise.fact.payload)) continue;
    const Term any_value = MakeValue(premise.fact.payload[0], premise.fact.payload[1], Term::Wildcard());
    const bool predicted = std::any_of(expected_.begin(), expected_.end(), [&](const Fact& target) {
      Bindings none;
      return target.positive && Match(any_value, target.payload, none);
    });
    if (predicted) continue;
    for (const std::size_t c : situation_.Candidates(any_value, {})) {
      const SituationFact& consequent = situation_[c];
      if (consequent.permanent || !consequent.fact.positive ||
          !ContradictsValue(consequent.fact.payload, premise.fact.payload)) {
        continue;
      }
      InduceFromChange({i, consequent}, previous_, parameters_.value_roles, FrameInterval().after, &journal_);
      break;
    }
  }
}

// A success is unexpected if nothing that came true in this frame had promised it.
void Reasoner::LearnFromGoals(const std::vector<Drives::Achieved>& reached) {
  for (const Drives::Achieved& goal : reached) {
    const SituationFact& evidence = situation_[goal.evidence];
    const bool promised = std::any_of(came_true_.begin(), came_true_.end(), [&](const CameTrue& one) {
      return BringsAbout(one.prediction.target, goal.target);
    });
    if (promised || evidence.concluded || evidence.permanent) continue;
    std::vector<const Situation*> frames;
    const auto since_given = [&](const Situation& frame) {
      if (frame.interval().before > goal.target.interval.after) frames.push_back(&frame);
    };
    since_given(previous_);
    for (const Situation& frame : earlier_) since_given(frame);
    std::vector<PredictedCommand> commands;
    for (const CameTrue& one : came_true_) {
      const ModelRecord* record = knowledge().Find(one.prediction.model);
      if (one.prediction.target.confidence <= 0 || !record || !IsCommand(record->model.lhs.payload)) continue;
      for (const Situation* frame : frames) {
        if (frame->interval().after != one.firing.frame) continue;
        const auto& facts = frame->facts();
        const auto command = std::find_if(facts.begin(), facts.end(), [&](const SituationFact& fact) {
          return fact.id == one.firing.input;
        });
        if (command != facts.end()) commands.push_back({*command, frame, one.firing.condition});
      }
    }
    InduceFromGoal({goal.target, evidence.id, evidence.fact, {goal.event, evidence.event}}, commands, frames,
                   parameters_, FrameInterval().after, &journal_);
  }
}

void Reasoner::WriteInstances(const std::vector<std::size_t>& positions, Time at) {
  for (const std::size_t position : positions) {
    const SituationFact& instance = situation_[position];
    std::vector<EventId> causes;
    for (const std::size_t component : instance.components) causes.push_back(situation_[component].event);
    const FactId id = journal_.NewId<FactId>();
    const EventId event = journal_.Write(at, IcstFound{id, instance.fact}, causes);
    situation_.SetEvent(position, id, event);
  }
}

void Reasoner::OfferToRequirement(ModelId id, Time at) {
  const ModelRecord* record = knowledge().Find(id);
  if (!record) return;
  std::vector<ChainingDecision> decisions;
  std::vector<Requirement> statements = StatementsOf(*record, knowledge(), situation_, &decisions);
  if (!statements.empty()) time_outs_.Met(id, at);
  for (std::size_t i = 0; i < statements.size(); ++i) {
    Requirement& requirement = statements[i];
    if (i < decisions.size()) ReportDecision(id, requirement.from, decisions[i], at);
    std::vector<EventId> causes{situation_[requirement.from].event, record->event};
    for (const std::size_t above : requirement.above)
      causes.push_back(situation_.requirements()[above].event);
    requirement.event =
        journal_.Write(at, ImdlPredicted{journal_.NewId<FactId>(), id, requirement.imdl}, causes);
    if (requirement.imdl.interval.before > FrameInterval().before) {
      pending_.push_back(requirement);
      pending_.back().from = Situation::npos;
      pending_.back().above.clear();
    }
    situation_.Add(std::move(requirement));
  }
}

// What the requirement model that allowed the firing spoke of; npos if none did, or in an earlier frame.
std::size_t Reasoner::ConditionOf(const Firing& firing) const {
  return firing.requirements.empty() ? Situation::npos
                                     : situation_.requirements()[firing.requirements.front()].from;
}

void Reasoner::Chain(Time at) {
  JoinWork work;
  OnComponentMet on_met;
  if (journal_.Records<InstanceProgress>()) {
    on_met = [&](const ComponentMet& met) {
      const SituationFact& fact = situation_[met.fact];
      if (!fact.event.valid()) return;
      journal_.Write(
          at,
          InstanceProgress{met.state, fact.id, static_cast<std::int64_t>(met.component),
                           static_cast<std::int64_t>(met.met), static_cast<std::int64_t>(met.total)},
          {fact.event});
    };
  }
  WriteInstances(AddInstances(knowledge(), &situation_, &work, on_met), at);
  for (const ModelId id : RequirementModelsFor(knowledge(), situation_)) OfferToRequirement(id, at);
  const std::size_t count = situation_.facts().size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!situation_[i].permanent) FireOn(i, at);
  }
  if (!journal_.Records<FrameCounted>()) return;
  FrameCounted counts;
  counts.facts = static_cast<std::int64_t>(count);
  for (const SituationFact& fact : situation_.facts()) counts.instances += fact.components.empty() ? 0 : 1;
  counts.requirements = static_cast<std::int64_t>(situation_.requirements().size());
  counts.predictions = static_cast<std::int64_t>(knowledge().predictions().size());
  counts.models = static_cast<std::int64_t>(knowledge().models_in_use());
  counts.matches = work.steps;
  counts.cut = work.cut;
  journal_.Write(at, counts, {frame_started_});
}

void Reasoner::ReportDecision(ModelId model, std::size_t input, const ChainingDecision& decision, Time at) {
  if (!journal_.Records<ChainingDecided>()) return;
  ChainingDecided report{model, situation_[input].id, decision.status, {}, {}};
  std::vector<EventId> causes{situation_[input].event};
  for (const std::size_t i : decision.considered) {
    const Requirement& said = situation_.requirements()[i];
    report.considered.push_back({said.requirement, said.imdl.positive, said.imdl.confidence});
    causes.push_back(said.event);
  }
  if (decision.winner != Situation::npos)
    report.winner = situation_.requirements()[decision.winner].requirement;
  journal_.Write(at, std::move(report), causes);
}

void Reasoner::FireOn(std::size_t fact, Time at) {
  for (const ModelId id : knowledge().ModelsByLhs(situation_[fact].fact.payload)) {
    const ModelRecord& record = *knowledge().Find(id);
    std::optional<ChainingDecision> decision;
    const std::vector<Firing> firings =
        Fire(record, knowledge(), situation_[fact].fact, situation_, &decision);
    if (decision) {
      time_outs_.Met(id, at);
      ReportDecision(id, fact, *decision, at);
    }
    for (const Firing& firing : firings) {
      if (firing.target.interval.before <= at) continue;
      std::vector<EventId> causes{situation_[fact].event};
      for (const std::vector<std::size_t>* said : {&firing.requirements, &firing.vetoes}) {
        for (const std::size_t i : *said) causes.push_back(situation_.requirements()[i].event);
      }
      causes.push_back(record.event);
      const PredictionId prediction = journal_.NewId<PredictionId>();
      const FactId input = situation_[fact].id;
      const EventId event = journal_.Write(
          at, PredictionMade{prediction, id, SpokenFor(firing, situation_), input, firing.target}, causes);
      open_firings_[prediction] = {firing.instance, input, FrameInterval().after, ConditionOf(firing),
                                   SilencedIn(firing, situation_)};
      if (firing.vetoed || !firing.instance.ground()) continue;
      // The instance itself is a fact, for reuse models and as a possible cause.
      SituationFact instance;
      instance.id = journal_.NewId<FactId>();
      instance.fact = {true, firing.instance, situation_[fact].fact.interval, firing.target.confidence};
      instance.event = journal_.Write(at, ImdlFired{instance.id, prediction, instance.fact}, {event});
      FireOn(situation_.Add(std::move(instance)), at);
    }
  }
}

bool Reasoner::SetDrive(const std::string& title, const Term& goal, Time deadline, bool positive,
                        double confidence) {
  return drives_.Give(title, Fact{positive, goal, {At(parameters_.goal_offset), deadline}, confidence},
                      situation_);
}

std::optional<Wish> Reasoner::Decide() {
  const OfferKnowledge offer = [&](CompositeStateId state, ModelId requirement) {
    const Time now = At(parameters_.goal_offset);
    const CompositeStateRecord* record = knowledge().Find(state);
    if (record) WriteInstances(AddInstances(record->state, &situation_), now);
    OfferToRequirement(requirement, now);
  };
  return drives_.Decide(situation_, offer);
}

EventId Reasoner::CommandIssued(const Term& command, Commander by, GoalId drive, EventId cause) {
  const Time at = by == Commander::kTeacher ? At(parameters_.goal_offset) : At(parameters_.commit_offset);
  return journal_.Write(
      at,
      aerascope::CommandIssued{command, by, drive, {At(parameters_.command_offset), FrameInterval().before}},
      {cause});
}

void Reasoner::Executed(const Term& command, EventId issued) {
  const Time at = At(parameters_.commit_offset);
  const Fact fact{true, command, {At(parameters_.command_offset), FrameInterval().before}, 1};
  FireOn(AddFact(fact, FactSource::kExecuted, at, {issued}), at);
  GiveUpOutweighed(at);
  expectations_.Extend(situation_, pending_, at);
  GiveUpOutweighed(at);
  drives_.Resume(concluded_, at);
  drives_.Suspend(at);
}

}  // namespace aerascope
