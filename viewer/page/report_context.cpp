#include "viewer/page/report_context.h"

#include <algorithm>

#include "viewer/page/overloaded.h"

namespace aerascope {
namespace {

// The last entity named in a term, in reading order.
std::string LastEntity(const Term& term) {
  std::string name;
  ForEachTerm(term, [&](const Term& part) {
    if (part.is(TermKind::kEntity)) name = part.name();
  });
  return name;
}

// What a composite state bound that was found to hold, among the causes of an instance of a requirement
// model; empty if there is none.
std::vector<Binding> BindingsBehind(const Run& run, EventId instance) {
  for (const EventId cause : run.Causes(instance))
    if (const auto* found = run.FindBody<IcstFound>(cause))
      return BindingsOf(run.final_knowledge(), found->fact.payload);
  return {};
}

// What the variables of the model stood for that made a prediction, times left out: what its requirement
// models say, what was on its left side, and what it expects.
std::vector<Binding> BindingsOfModel(const Run& run, EventId prediction) {
  const auto& made = *run.FindBody<PredictionMade>(prediction);
  const ModelRecord* record = run.final_knowledge().Find(made.model);
  if (record == nullptr) return {};
  const Model& model = record->model;
  Bindings bound;
  const auto bind = [&](auto&& one_more) {
    Bindings trial = bound;
    if (one_more(trial)) bound = std::move(trial);
  };
  bind([&](Bindings& trial) { return Match(model.rhs.payload, made.target.payload, trial); });
  for (const EventId cause : run.Causes(prediction)) {
    const auto* said = run.FindBody<ImdlPredicted>(cause);
    if (said != nullptr && said->fact.positive && IsImdl(said->fact.payload) &&
        said->fact.payload[0] == Term::Reference(made.model))
      bind([&](Bindings& trial) { return BindInstance(model, said->fact.payload, trial); });
  }
  if (const auto* seen = run.FindBody<FactObserved>(run.CreationOf(made.input)))
    bind([&](Bindings& trial) { return Match(model.lhs.payload, seen->fact.payload, trial); });
  const std::vector<std::string> names = VariableNames(run.final_knowledge(), model);
  std::vector<Binding> bindings;
  for (std::size_t v = 0; v < names.size(); ++v) {
    const Term* value = bound.Find(static_cast<int>(v));
    if (value != nullptr && value->ground() && !value->is(TermKind::kTime) && !value->is(TermKind::kDuration))
      bindings.push_back({names[v], ValueText(*value)});
  }
  return bindings;
}

}  // namespace

ReportContext::ReportContext(const Run& the_run)
    : run(the_run),
      knowledge(the_run.final_knowledge()),
      summary(Summarise(the_run)),
      goals(MakeGoalTree(the_run)) {
  for (ModelHistory& history : Histories(run)) histories[history.model] = std::move(history);
  for (const auto& [id, record] : knowledge.models()) {
    if (!IsRequirement(record.model)) continue;
    const CompositeStateId state = RequiredState(record.model);
    if (state.valid()) requirement_on.try_emplace(state, id);
  }
  CollectComparisons();
  CollectUses();
}

void ReportContext::CollectComparisons() {
  for (const EventId id : run.OfKind<AnalogyCompared>()) {
    const auto* compared = run.FindBody<AnalogyCompared>(id);
    if (compared->verdict == AnalogyVerdict::kAccepted && compared->result_requirement.valid())
      comparison_of.try_emplace(compared->result_requirement, id);
  }
}

// A model is used from the comparison or the prediction on that bound it, up to the frame in which the
// outcome was seen. Of two uses that begin at once, the later in the list tells more.
void ReportContext::CollectUses() {
  CollectInstances();
  const Duration period{run.started().sampling_period_us};
  for (const auto& [requirement, event] : comparison_of) {
    const auto* compared = run.FindBody<AnalogyCompared>(event);
    // The new state has the variables of its source by name, so the source's instance tells what they stand
    // for.
    uses[requirement].push_back({run.Find(event)->time, run.Find(event)->time + period,
                                 BindingsOf(knowledge, compared->bindings), Use::Kind::kCompared});
  }
  for (const PredictionRecordOfRun& prediction : summary.predictions) {
    std::vector<Binding> bindings;
    for (const EventId cause : run.Causes(prediction.event)) {
      if (bindings.empty() && run.FindBody<ImdlPredicted>(cause) != nullptr)
        bindings = BindingsBehind(run, cause);
    }
    const Time until = prediction.until + period;
    if (!bindings.empty())
      for (const ModelId requirement : prediction.requirements)
        uses[requirement].push_back({prediction.time, until, bindings});
    std::vector<Binding> own = BindingsOfModel(run, prediction.event);
    if (!own.empty()) uses[prediction.model].push_back({prediction.time, until, std::move(own)});
  }
  // Silent ones are not among those, but the model was right or wrong with them, too.
  for (const EventId id : run.OfKind<PredictionMade>()) {
    const auto& made = *run.FindBody<PredictionMade>(id);
    const Event& event = *run.Find(id);
    if (event.simulation.valid() || made.target.confidence > 0) continue;
    std::vector<Binding> own = BindingsOfModel(run, id);
    const Time until = std::min(made.target.interval.before, run.end() + period);
    if (!own.empty()) uses[made.model].push_back({event.time, until, std::move(own)});
  }
  for (auto& [model, list] : uses)
    std::stable_sort(list.begin(), list.end(), [](const Use& a, const Use& b) { return a.from < b.from; });
}

// What a requirement model says while its state holds, whether or not a prediction comes of it: a veto makes
// none. The same said frame after frame is one stretch.
void ReportContext::CollectInstances() {
  const Time end = run.end() + Duration{run.started().sampling_period_us};
  for (const EventId id : run.OfKind<ImdlPredicted>()) {
    const Event& event = *run.Find(id);
    if (event.simulation.valid()) continue;
    const auto& predicted = std::get<ImdlPredicted>(event.body);
    std::vector<Binding> bindings = BindingsBehind(run, id);
    if (bindings.empty()) continue;
    const Time until = std::min(predicted.fact.interval.before, end);
    std::vector<Use>& list = uses[predicted.requirement];
    // It may say so of a few things in turn, frame after frame.
    const auto recent = list.end() - std::min<std::ptrdiff_t>(std::ssize(list), 8);
    const auto same = std::find_if(recent, list.end(), [&](const Use& use) {
      return event.time <= use.until && bindings == use.bindings;
    });
    if (same != list.end())
      same->until = std::max(same->until, until);
    else
      list.push_back({event.time, until, std::move(bindings), Use::Kind::kHolds});
  }
}

std::string ReportContext::SubjectOf(CompositeStateId state) const {
  if (knowledge.Find(state) == nullptr) return "";
  const auto found = requirement_on.find(state);
  return found == requirement_on.end() ? IdText(state) : IdText(found->second);
}

std::optional<Time> ReportContext::DeletedAt(ModelId model) const {
  const auto history = histories.find(model);
  if (history == histories.end() || history->second.steps.empty()) return std::nullopt;
  const ConfidenceStep& last = history->second.steps.back();
  if (last.state != ModelState::kDeleted) return std::nullopt;
  return last.time;
}

std::string MarkOf(Origin origin) {
  switch (origin) {
    case Origin::kSeed:
      return "given";
    case Origin::kAnalogy:
      return "analogy";
    case Origin::kInduction:
    case Origin::kPredictionFailure:
    case Origin::kGoalSuccess:
      return "learned";
  }
  return "learned";
}

std::string MarkOf(const Event& event) {
  return std::visit(
      Overloaded{[](const CompositeStateCreated& e) { return MarkOf(e.origin); },
                 [](const ModelCreated& e) { return MarkOf(e.origin); },
                 [](const InductionStarted&) { return std::string("learned"); },
                 [](const CauseConsidered&) { return std::string("learned"); },
                 [](const AnalogyCompared&) { return std::string("analogy"); },
                 [](const PredictionMade&) { return std::string("prediction"); },
                 [](const PredictionSucceeded&) { return std::string("prediction"); },
                 [](const PredictionFailed&) { return std::string("prediction"); },
                 [](const ImdlPredicted&) { return std::string("prediction"); },
                 [](const DriveInjected&) { return std::string("goal"); },
                 [](const GoalSet&) { return std::string("goal"); },
                 [](const GoalSkipped&) { return std::string("goal"); },
                 [](const GoalSuspended&) { return std::string("goal"); },
                 [](const GoalResumed&) { return std::string("goal"); },
                 [](const GoalDropped&) { return std::string("goal"); },
                 [](const PlanRejected&) { return std::string("goal"); },
                 [](const CommandImagined&) { return std::string("goal"); },
                 [](const FactPromoted&) { return std::string("goal"); },
                 [](const PromotionDefeated&) { return std::string("goal"); },
                 [](const ModelRejected&) { return std::string("learned"); },
                 [](const ChainingDecided&) { return std::string("prediction"); },
                 [](const ImdlFired&) { return std::string("prediction"); },
                 [](const PredictionInvalidated&) { return std::string("prediction"); },
                 [](const GoalAchieved&) { return std::string("goal"); },
                 [](const GoalFailed&) { return std::string("goal"); },
                 [](const PlanCommitted&) { return std::string("goal"); },
                 [](const SimulationStarted&) { return std::string("goal"); },
                 [](const SimulationEnded&) { return std::string("goal"); },
                 [](const CommandIssued& e) {
                   return std::string(e.by == Commander::kTeacher ? "taught-command" : "command");
                 },
                 [](const CommandRefused&) { return std::string("command"); },
                 [](const FactObserved& e) {
                   return std::string(e.source == FactSource::kExecuted ? "command" : "seen");
                 },
                 [](const EvidenceUpdated&) { return std::string("model"); },
                 [](const ModelStateChanged&) { return std::string("model"); },
                 [](const auto&) { return std::string("seen"); }},
      event.body);
}

bool TellsOfFailure(const Event& event) {
  if (const auto* ended = std::get_if<SimulationEnded>(&event.body))
    return ended->outcome != SimulationOutcome::kReached;
  if (const auto* updated = std::get_if<EvidenceUpdated>(&event.body)) return !updated->success;
  return std::holds_alternative<PredictionFailed>(event.body) ||
         std::holds_alternative<PlanRejected>(event.body) ||
         std::holds_alternative<ModelRejected>(event.body) ||
         std::holds_alternative<GoalFailed>(event.body) || std::holds_alternative<CommandRefused>(event.body);
}

std::string ObjectOf(const AnalogyCompared& compared) {
  for (const ComparedComponent& component : compared.components) {
    if (component.status != ComponentStatus::kMissed) continue;
    if (IsValue(component.pattern) && component.pattern[0].is(TermKind::kEntity))
      return component.pattern[0].name();
    const std::string inside = LastEntity(component.pattern);
    if (!inside.empty()) return inside;
  }
  return LastEntity(compared.bindings);
}

}  // namespace aerascope
