#include "viewer/page/subject_data.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"
#include "viewer/page/cause_data.h"
#include "viewer/page/overloaded.h"

namespace aerascope {
namespace {

using nlohmann::json;

std::string VerdictText(AnalogyVerdict verdict) {
  switch (verdict) {
    case AnalogyVerdict::kAccepted:
      return "accepted";
    case AnalogyVerdict::kNotRequired:
      return "not required: a better plan reached the goal";
    case AnalogyVerdict::kFullMatch:
      return "nothing to generalise: everything matched";
    case AnalogyVerdict::kTooFewMatched:
      return "rejected: too few conditions hold";
    case AnalogyVerdict::kNotFamiliar:
      return "rejected: not familiar enough";
    case AnalogyVerdict::kNothingObserved:
      return "rejected: no condition that holds speaks of the object";
    case AnalogyVerdict::kFreeVariable:
      return "rejected: what remains leaves a variable open";
    case AnalogyVerdict::kBlackListed:
      return "rejected: it failed before";
    case AnalogyVerdict::kNoPlan:
      return "rejected: no plan through it reaches the goal";
  }
  return "";
}

std::string HowMade(Origin origin) {
  switch (origin) {
    case Origin::kSeed:
      return "given";
    case Origin::kInduction:
      return "learned";
    case Origin::kPredictionFailure:
      return "learned from a failed prediction";
    case Origin::kGoalSuccess:
      return "learned from a goal reached";
    case Origin::kAnalogy:
      return "made by analogy";
  }
  return "";
}

std::string OutcomeMark(Outcome outcome) {
  switch (outcome) {
    case Outcome::kOpen:
      return "open";
    case Outcome::kReached:
      return "true";
    case Outcome::kFailed:
      return "failed";
  }
  return "open";
}

class SubjectAuthor {
 public:
  explicit SubjectAuthor(const ReportContext& context)
      : context_(context), run_(context.run), knowledge_(context.knowledge) {}

  json Write() const {
    json subjects = json::object();
    for (const auto& [id, record] : knowledge_.models())
      subjects[IdText(id)] = IsRequirement(record.model) ? RequirementSubject(record) : ModelSubject(record);
    for (const auto& [id, record] : knowledge_.composite_states())
      if (!context_.requirement_on.contains(id)) subjects[IdText(id)] = StateSubject(record);
    for (const GoalNode& goal : context_.goals.goals) subjects[IdText(goal.goal)] = GoalSubject(goal);
    for (const PredictionRecordOfRun& prediction : context_.summary.predictions)
      subjects[IdText(prediction.prediction)] = PredictionSubject(prediction);
    for (const IssuedCommand& command : CommandsOf(run_))
      subjects[IdText(command.event)] = CommandSubject(command);
    AddThings(subjects);
    return subjects;
  }

 private:
  json Base(const std::string& id, const std::string& mark, const std::string& note, const std::string& title,
            Time born) const {
    return {{"id", id}, {"mark", mark}, {"note", note}, {"title", Capitalised(title)}, {"born", born.us}};
  }

  // ---- models, states

  static json Line(const std::string& text, const std::vector<std::string>& variables, bool cut = false) {
    return {{"text", text}, {"vars", variables}, {"cut", cut}};
  }

  json StateLines(CompositeStateId id) const {
    json lines = json::array();
    for (const Condition& condition : ConditionsWithPruned(knowledge_, id))
      lines.push_back(Line(condition.text, condition.variables, condition.pruned));
    return lines;
  }

  json RequirementSubject(const ModelRecord& record) const {
    const Model& model = record.model;
    const ModelId target = TargetModel(model);
    json data = Base(IdText(model.id), MarkOf(record.origin), MadeNote(record.origin, record.created),
                     TitleOf(knowledge_, model.id), record.created);
    data["kind"] = "requirement";
    data["say"] = ExplanationOf(knowledge_, model.id);
    json definition = json::array();
    const CompositeStateId state = RequiredState(model);
    if (state.valid()) {
      definition.push_back({{"side", "lhs"}, {"label", IdText(state)}, {"lines", StateLines(state)}});
    } else {
      const ModelLines lines = LinesOf(knowledge_, model);
      definition.push_back({{"side", "lhs"}, {"label", "if"}, {"lines", {Line(lines.lhs, lines.variables)}}});
    }
    if (const ModelRecord* causal = knowledge_.Find(target); causal != nullptr) {
      const ModelLines lines = LinesOf(knowledge_, causal->model);
      const bool strong = KindOf(model) == ModelKind::kStrongRequirement;
      definition.push_back(
          {{"side", "rhs"},
           {"label", IdText(target)},
           {"subject", IdText(target)},
           {"lines", {Line((strong ? "not: " : "") + lines.lhs + " \u2192 " + lines.rhs, lines.variables)}}});
    }
    data["definition"] = definition;
    data["vars"] = VariableNames(knowledge_, model);
    AddModelParts(data, record);
    return data;
  }

  json ModelSubject(const ModelRecord& record) const {
    const Model& model = record.model;
    json data = Base(IdText(model.id), "model",
                     std::string(ToText(KindOf(model))) + ", " + MadeNote(record.origin, record.created),
                     TitleOf(knowledge_, model.id), record.created);
    data["kind"] = "model";
    data["vars"] = VariableNames(knowledge_, model);
    data["say"] = ExplanationOf(knowledge_, model.id);
    const ModelLines lines = LinesOf(knowledge_, model);
    data["definition"] = {
        {{"side", "lhs"}, {"label", "if done"}, {"lines", {Line(lines.lhs, lines.variables)}}},
        {{"side", "rhs"}, {"label", "then"}, {"lines", {Line(lines.rhs, lines.variables)}}}};
    if (KindOf(model) != ModelKind::kCausal) data["definition"][0]["label"] = "if";
    json required = json::array();
    for (const auto& [id, other] : knowledge_.models())
      if (IsRequirement(other.model) && TargetModel(other.model) == model.id)
        required.push_back({{"subject", IdText(id)},
                            {"mark", MarkOf(other.origin)},
                            {"text", Capitalised(TitleOf(knowledge_, id))},
                            {"at", other.created.us}});
    data["requirements"] = required;
    AddModelParts(data, record);
    return data;
  }

  json StateSubject(const CompositeStateRecord& record) const {
    json data = Base(IdText(record.state.id), MarkOf(record.origin),
                     "composite state, " + MadeNote(record.origin, record.created),
                     TitleOf(knowledge_, record.state.id), record.created);
    data["kind"] = "state";
    data["definition"] = {
        {{"side", "lhs"}, {"label", IdText(record.state.id)}, {"lines", StateLines(record.state.id)}}};
    AddCauses(data, record.event);
    return data;
  }

  std::string MadeNote(Origin origin, Time created) const {
    if (origin == Origin::kSeed) return HowMade(origin);
    return HowMade(origin) + " at " + SecondsText(created);
  }

  void AddModelParts(json& data, const ModelRecord& record) const {
    const ModelId id = record.model.id;
    data["confidence"] = ConfidenceData(id);
    if (const auto uses = context_.uses.find(id); uses != context_.uses.end())
      data["uses"] = UseData(uses->second);
    if (const auto deleted = context_.DeletedAt(id)) data["gone"] = deleted->us;
    AddComparisons(data, id);
    AddCauses(data, record.event);
  }

  json ConfidenceData(ModelId id) const {
    json steps = json::array();
    const auto history = context_.histories.find(id);
    if (history == context_.histories.end()) return steps;
    for (const ConfidenceStep& step : history->second.steps) {
      json data = {{"at", step.time.us}, {"sure", step.evidence.rate()}, {"why", step.reason}};
      if (step.success && !*step.success) data["failed"] = true;
      if (step.state == ModelState::kDeleted) data["deleted"] = true;
      if (step.strong) data["strong"] = true;
      steps.push_back(std::move(data));
    }
    return steps;
  }

  static json UseData(const std::vector<Use>& uses) {
    json data = json::array();
    for (const Use& use : uses) {
      json bindings = json::array();
      for (const Binding& binding : use.bindings) bindings.push_back({binding.variable, binding.value});
      data.push_back({use.from.us, use.until.us, bindings});
    }
    return data;
  }

  // ---- comparisons

  // The comparison that made it comes first, then those made for the same goal, then those that used it as a
  // source.
  void AddComparisons(json& data, ModelId id) const {
    std::vector<EventId> chosen;
    const auto add = [&](EventId event) {
      if (std::find(chosen.begin(), chosen.end(), event) == chosen.end()) chosen.push_back(event);
    };
    const auto made = context_.comparison_of.find(id);
    if (made != context_.comparison_of.end()) {
      add(made->second);
      const auto* own = run_.FindBody<AnalogyCompared>(made->second);
      for (const AnalogyOfRun& other : context_.summary.analogies)
        if (other.compared->goal == own->goal) add(other.event);
    }
    for (const AnalogyOfRun& other : context_.summary.analogies)
      if (other.compared->requirement == id) add(other.event);
    if (chosen.empty()) return;
    json list = json::array();
    for (const EventId event : chosen) list.push_back(ComparisonData(event));
    data["compared"] = list;
    data["made_by_comparison"] = made != context_.comparison_of.end();
  }

  json ComparisonData(EventId event) const {
    const auto* compared = run_.FindBody<AnalogyCompared>(event);
    json rows = json::array();
    if (const CompositeStateRecord* source = knowledge_.Find(compared->source); source != nullptr)
      for (const Condition& condition : ConditionsOf(knowledge_, source->state))
        rows.push_back(ComparedRow(condition, *compared));
    json data = {{"at", run_.Find(event)->time.us},
                 {"source", IdText(compared->source)},
                 {"requirement", IdText(compared->requirement)},
                 {"object", Printable(ObjectOf(*compared))},
                 {"rows", rows},
                 {"matched", compared->matched},
                 {"achievable", compared->achievable},
                 {"total", compared->total},
                 {"psi", FormatConfidence(compared->psi)},
                 {"jaccard", FormatConfidence(compared->jaccard)},
                 {"confidence", FormatConfidence(compared->confidence)},
                 {"verdict", VerdictText(compared->verdict)},
                 {"accepted", compared->verdict == AnalogyVerdict::kAccepted}};
    if (compared->result_requirement.valid()) data["result"] = IdText(compared->result_requirement);
    if (compared->psi > 0) data["source_sure"] = FormatConfidence(compared->confidence / compared->psi);
    for (const Parameter& parameter : run_.started().parameters)
      if (parameter.name == "analogy_min_psi") data["above"] = parameter.value;
    return data;
  }

  json ComparedRow(const Condition& condition, const AnalogyCompared& compared) const {
    ComponentStatus status = ComponentStatus::kMatched;
    std::vector<std::string> found;
    for (const ComparedComponent& component : compared.components) {
      const auto index = static_cast<std::size_t>(component.index);
      const auto& parts = condition.components;
      if (std::find(parts.begin(), parts.end(), index) == parts.end()) continue;
      status = std::max(status, component.status);
      if (!component.counterpart.is(TermKind::kNil))
        found.push_back(PayloadText(knowledge_, component.counterpart));
    }
    return {{"condition", Line(condition.text, condition.variables, status == ComponentStatus::kMissed)},
            {"found", found.empty() ? "nothing" : Join(found, ", ")},
            {"status", std::string(EnumName(status))}};
  }

  // ---- goals, predictions, commands

  json GoalSubject(const GoalNode& goal) const {
    const std::string until = SecondsText(goal.target.interval.before);
    json data = Base(
        IdText(goal.goal), "goal",
        (goal.drive ? "drive, given at " : "sub-goal, set at ") + SecondsText(goal.time) + ", until " + until,
        goal.title, goal.time);
    data["kind"] = "goal";
    data["say"] = goal.drive ? "Wanted: " + FactText(knowledge_, goal.target) + "."
                             : "Wanted because something else is: " + FactText(knowledge_, goal.target) + ".";
    data["outcome"] = OutcomeMark(goal.outcome);
    if (goal.outcome == Outcome::kReached) data["result"] = "reached at " + SecondsText(goal.outcome_time);
    if (goal.outcome == Outcome::kFailed) data["result"] = "not reached by " + SecondsText(goal.outcome_time);
    if (goal.outcome == Outcome::kOpen) data["result"] = "still open";
    json plans = json::array();
    for (const PlanRecord& plan : goal.plans) {
      std::vector<std::string> steps;
      for (const PlanStep& step : plan.steps) steps.push_back(StepText(knowledge_, step));
      plans.push_back({{"at", plan.time.us},
                       {"text", Join(steps, ", then ")},
                       {"score", FormatConfidence(plan.score)},
                       {"committed", plan.committed},
                       {"outcome", plan.ended ? std::string(EnumName(plan.outcome)) : "not ended"}});
    }
    if (!plans.empty()) data["plans"] = plans;
    AddCauses(data, goal.event, goal.outcome_event);
    return data;
  }

  json PredictionSubject(const PredictionRecordOfRun& prediction) const {
    json data =
        Base(IdText(prediction.prediction), "prediction", "predicted at " + SecondsText(prediction.time),
             FactText(knowledge_, prediction.target), prediction.time);
    data["kind"] = "prediction";
    const Event* made = run_.Find(prediction.event);
    data["say"] = SentenceOf(run_, *made);
    data["outcome"] = OutcomeMark(prediction.outcome);
    if (prediction.outcome == Outcome::kReached)
      data["result"] = "came true at " + SecondsText(prediction.until);
    if (prediction.outcome == Outcome::kFailed) data["result"] = "failed at " + SecondsText(prediction.until);
    if (prediction.outcome == Outcome::kOpen) data["result"] = "not decided";
    json models = json::array();
    const auto add = [&](ModelId id) {
      const ModelRecord* record = knowledge_.Find(id);
      if (record == nullptr) return;
      models.push_back({{"subject", IdText(id)},
                        {"mark", IsRequirement(record->model) ? MarkOf(record->origin) : "model"},
                        {"text", Capitalised(TitleOf(knowledge_, id))},
                        {"at", record->created.us}});
    };
    for (const ModelId id : prediction.requirements) add(id);
    add(prediction.model);
    data["requirements"] = models;
    AddCauses(data, prediction.event, prediction.outcome_event);
    return data;
  }

  json CommandSubject(const IssuedCommand& command) const {
    const bool teacher = command.by == Commander::kTeacher;
    json data = Base(IdText(command.event), teacher ? "taught-command" : "command",
                     std::string(teacher ? "commanded by the teacher at " : "commanded by the agent at ") +
                         SecondsText(command.time),
                     PayloadText(knowledge_, command.command), command.time);
    data["kind"] = "command";
    data["say"] = SentenceOf(run_, *run_.Find(command.event));
    if (command.refused.valid()) {
      data["outcome"] = "failed";
      if (const auto* refused = run_.FindBody<CommandRefused>(command.refused))
        data["result"] = "refused: " + Printable(refused->reason);
    }
    AddCauses(data, command.event);
    return data;
  }

  // ---- things of the world

  // Whether what an event says names the entity.
  static bool Names(const Event& event, const std::string& entity) {
    const auto in_term = [&](const Term& term) {
      bool found = false;
      ForEachTerm(term, [&](const Term& part) {
        found = found || (part.is(TermKind::kEntity) && part.name() == entity);
      });
      return found;
    };
    return std::visit(Overloaded{[&](const DriveInjected& e) { return in_term(e.target.payload); },
                                 [&](const AnalogyCompared& e) { return in_term(e.bindings); },
                                 [&](const PredictionMade& e) { return in_term(e.target.payload); },
                                 [&](const CommandIssued& e) { return in_term(e.command); },
                                 [](const auto&) { return false; }},
                      event.body);
  }

  // Things of the world: what was wanted, compared, predicted and done with each.
  void AddThings(json& subjects) const {
    std::map<std::string, EventId> things;  // entity -> where it was first seen
    for (const EventId id : run_.OfKind<FactObserved>()) {
      const Term& payload = run_.FindBody<FactObserved>(id)->fact.payload;
      if (IsValue(payload) && payload[0].is(TermKind::kEntity)) things.try_emplace(payload[0].name(), id);
    }
    for (const auto& [name, first] : things) {
      const Time seen = run_.Find(first)->time;
      const std::string shown = Printable(name);
      json data = Base("thing:" + shown, "seen", "seen since " + SecondsText(seen), shown, seen);
      data["title"] = shown;
      data["kind"] = "thing";
      data["name"] = shown;
      std::vector<EventId> happenings;
      for (const Event& event : run_.events())
        if (!event.simulation.valid() && Names(event, name)) happenings.push_back(event.id);
      data["led"] = ListData(happenings);
      data["why"] = NoWhyData();
      subjects["thing:" + shown] = std::move(data);
    }
  }

  // An object that has an outcome is explained from there: the outcome's causes include its making.
  void AddCauses(json& data, EventId made, EventId outcome = {}) const {
    data["event"] = made.value;
    data["why"] = WhyData(context_, outcome.valid() ? outcome : made);
    data["led"] = EffectData(context_, made);
  }

  const ReportContext& context_;
  const Run& run_;
  const KnowledgeBase& knowledge_;
};

}  // namespace

json SubjectData(const ReportContext& context) {
  return SubjectAuthor(context).Write();
}

}  // namespace aerascope
