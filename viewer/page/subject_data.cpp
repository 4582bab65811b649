#include "viewer/page/subject_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/text.h"
#include "viewer/page/analogy_data.h"
#include "viewer/page/page_json.h"
#include "viewer/page/shortened.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestText = 2000;  // code points

std::string_view KindWord(SubjectKind kind) {
  switch (kind) {
    case SubjectKind::kRequirement:
      return "requirement";
    case SubjectKind::kModel:
      return "model";
    case SubjectKind::kState:
      return "state";
    case SubjectKind::kGoal:
      return "goal";
    case SubjectKind::kPrediction:
      return "prediction";
    case SubjectKind::kCommand:
      return "command";
    case SubjectKind::kThing:
      return "thing";
  }
  return "";
}

class DetailAuthor {
 public:
  DetailAuthor(const ReportContext& context, const SubjectTable& subjects)
      : context_(context), run_(context.run), knowledge_(context.knowledge), subjects_(subjects) {
    for (const AnalogyOfRun& analogy : context_.summary.analogies) {
      compared_for_[analogy.compared->goal].push_back(analogy.event);
      compared_with_[analogy.compared->requirement].push_back(analogy.event);
      compared_state_[analogy.compared->source].push_back(analogy.event);
    }
    for (const GoalNode& goal : context_.goals.goals)
      if (!goal.drive) searches_[context_.goals.goals[DriveOf(goal)].goal].insert(goal.time);
    for (const auto& [id, record] : knowledge_.models()) {
      if (!IsRequirement(record.model)) continue;
      requirements_of_[TargetModel(record.model)].push_back(id);
      requirements_on_[RequiredState(record.model)].push_back(id);
    }
  }

  json Write(const Subject& subject) const {
    switch (subject.kind) {
      case SubjectKind::kRequirement:
      case SubjectKind::kModel:
        return ModelDetail(*knowledge_.Find(run_.FindBody<ModelCreated>(subject.event)->model.id));
      case SubjectKind::kState:
        return StateDetail(*knowledge_.Find(run_.FindBody<CompositeStateCreated>(subject.event)->state.id));
      case SubjectKind::kGoal:
        return GoalDetail(context_.goals.goals[subject.position]);
      case SubjectKind::kPrediction:
        return PredictionDetail(context_.summary.predictions[subject.position]);
      case SubjectKind::kCommand:
        return CommandDetail(subjects_.commands()[subject.position]);
      case SubjectKind::kThing:
        return {{"note", "seen since " + SecondsText(subject.born)}};
    }
    return {};
  }

 private:
  // ---- models, states

  static json Lines(const std::vector<Condition>& conditions) {
    json lines = json::array();
    for (const Condition& condition : conditions) {
      json line = ConditionData(condition.text, condition.variables, condition.pruned);
      if (condition.relation.starts_with("not ")) line["anti"] = true;
      lines.push_back(std::move(line));
    }
    return lines;
  }

  json ModelDetail(const ModelRecord& record) const {
    const Model& model = record.model;
    const ModelKind kind = KindOf(model);
    const bool requirement = IsRequirement(model);
    json data = {
        {"note",
         (requirement && kind != ModelKind::kStrongRequirement ? "" : std::string(ToText(kind)) + ", ") +
             MadeNote(record.origin, record.created)},
        {"say", Shortened(ExplanationOf(knowledge_, model.id), kLongestText)},
        {"vars", VariableNames(knowledge_, model)},
        {"definition", requirement ? RequirementDefinition(model) : ModelDefinition(model)}};
    if (kind == ModelKind::kStrongRequirement) data["strong"] = true;
    if (const CompositeStateRecord* state = knowledge_.Find(RequiredState(model)))
      AddNested(data, state->state);
    if (record.derived_from.valid()) data["derived_from"] = IdText(record.derived_from);
    if (!requirement)
      if (const auto found = requirements_of_.find(model.id); found != requirements_of_.end())
        AddRequirements(data, found->second);
    if (const auto history = context_.histories.find(model.id); history != context_.histories.end())
      data["steps"] = StepData(history->second);
    if (const auto uses = context_.uses.find(model.id); uses != context_.uses.end())
      data["uses"] = UseData(uses->second);
    AddComparisons(data, model.id);
    return data;
  }

  json RequirementDefinition(const Model& model) const {
    const CompositeStateId state = RequiredState(model);
    json definition = json::array();
    if (state.valid()) {
      definition.push_back({{"side", "lhs"},
                            {"label", IdText(state)},
                            {"subject", IdText(state)},
                            {"lines", Lines(ConditionsOfRequirement(knowledge_, model))}});
    } else {
      const ModelLines lines = LinesOf(knowledge_, model);
      definition.push_back(
          {{"side", "lhs"}, {"label", "if"}, {"lines", {ConditionData(lines.lhs, lines.variables)}}});
    }
    const ModelId target = TargetModel(model);
    if (const ModelLines lines = LinesOfTarget(knowledge_, model); !lines.lhs.empty()) {
      const bool strong = KindOf(model) == ModelKind::kStrongRequirement;
      json line =
          ConditionData((strong ? "not: " : "") + lines.lhs + " \u2192 " + lines.rhs, lines.variables);
      if (strong) line["anti"] = true;
      definition.push_back(
          {{"side", "rhs"}, {"label", IdText(target)}, {"subject", IdText(target)}, {"lines", {line}}});
    }
    return definition;
  }

  json ModelDefinition(const Model& model) const {
    const ModelLines lines = LinesOf(knowledge_, model);
    const auto line = [&](const std::string& text, bool positive) {
      json data = ConditionData(text, lines.variables);
      if (!positive) data["anti"] = true;
      return data;
    };
    return {{{"side", "lhs"},
             {"label", IsCommand(model.lhs.payload) ? "if done" : "if"},
             {"lines", {line(lines.lhs, model.lhs.positive)}}},
            {{"side", "rhs"}, {"label", "then"}, {"lines", {line(lines.rhs, model.rhs.positive)}}}};
  }

  json StateDetail(const CompositeStateRecord& record) const {
    const CompositeStateId id = record.state.id;
    json data = {
        {"note", "composite state, " + MadeNote(record.origin, record.created)},
        {"definition",
         {{{"side", "lhs"}, {"label", IdText(id)}, {"lines", Lines(ConditionsWithPruned(knowledge_, id))}}}}};
    AddNested(data, record.state);
    if (record.derived_from.valid()) data["derived_from"] = IdText(record.derived_from);
    if (const auto found = requirements_on_.find(id); found != requirements_on_.end())
      AddRequirements(data, found->second);
    if (const auto found = compared_state_.find(id); found != compared_state_.end()) {
      json list = json::array();
      for (const EventId event : found->second) list.push_back(event.value);
      data["compared"] = list;
    }
    return data;
  }

  // The composite states among its components: two states that read alike may be made of different ones.
  void AddNested(json& data, const CompositeState& state) const {
    json nested = json::array();
    const std::vector<std::string> names = VariableNames(knowledge_, state);
    for (const FactPattern& component : state.components) {
      if (!IsIcst(component.payload) || !component.payload[0].is(TermKind::kCompositeState)) continue;
      const CompositeStateId id = component.payload[0].composite_state();
      if (subjects_.Find(id))
        nested.push_back(
            {IdText(id), Shortened(PayloadText(knowledge_, component.payload, names), kLongestText)});
    }
    if (!nested.empty()) data["nested"] = nested;
  }

  std::string MadeNote(Origin origin, Time created) const {
    const std::string words(WordsOf(origin));
    return origin == Origin::kSeed ? words : words + " at " + SecondsText(created);
  }

  // In the order of the steps in the log: what moved it, and the evidence after that.
  static json StepData(const ModelHistory& history) {
    json steps = json::array();
    for (const ConfidenceStep& step : history.steps)
      steps.push_back({Shortened(step.reason, kLongestTitle), step.evidence.positive, step.evidence.total});
    return steps;
  }

  static json UseData(const std::vector<Use>& uses) {
    json data = json::array();
    for (const Use& use : uses) {
      json bindings = json::array();
      for (const Binding& binding : use.bindings)
        bindings.push_back({binding.variable, Shortened(binding.value, kLongestTitle)});
      data.push_back({use.from.us, use.until.us, bindings, static_cast<int>(use.kind)});
    }
    return data;
  }

  // The comparison that made it comes first, then those made for the same goal, then those that used it as a
  // source.
  void AddComparisons(json& data, ModelId id) const {
    json list = json::array();
    const auto add = [&](EventId event) {
      if (std::find(list.begin(), list.end(), event.value) == list.end()) list.push_back(event.value);
    };
    const auto made = context_.comparison_of.find(id);
    if (made != context_.comparison_of.end()) {
      add(made->second);
      for (const EventId other : compared_for_.at(run_.FindBody<AnalogyCompared>(made->second)->goal))
        add(other);
    }
    if (const auto found = compared_with_.find(id); found != compared_with_.end())
      for (const EventId other : found->second) add(other);
    if (list.empty()) return;
    data["compared"] = list;
    data["made_by_comparison"] = made != context_.comparison_of.end();
  }

  // ---- goals, predictions, commands

  json SubjectIds(const std::vector<ModelId>& models) const {
    json list = json::array();
    for (const ModelId id : models)
      if (subjects_.Find(id)) list.push_back(IdText(id));
    return list;
  }

  // What allows, and apart from that what forbids.
  void AddRequirements(json& data, const std::vector<ModelId>& models) const {
    std::vector<ModelId> weak, strong;
    for (const ModelId id : models) {
      const bool forbids = KindOf(knowledge_.Find(id)->model) == ModelKind::kStrongRequirement;
      (forbids ? strong : weak).push_back(id);
    }
    if (!weak.empty()) data["requirements"] = SubjectIds(weak);
    if (!strong.empty()) data["vetoes"] = SubjectIds(strong);
  }

  json GoalDetail(const GoalNode& goal) const {
    json data = {{"note", (goal.drive ? "drive, given at " : "sub-goal, set at ") + SecondsText(goal.time) +
                              ", until " + SecondsText(goal.target.interval.before)},
                 {"say", Shortened((goal.drive ? "Wanted: " : "Wanted because something else is: ") +
                                       FactText(knowledge_, goal.target) + ".",
                                   kLongestText)},
                 {"drive", goal.drive}};
    if (goal.outcome == Outcome::kReached) data["result"] = "reached at " + SecondsText(goal.outcome_time);
    if (goal.outcome == Outcome::kFailed) data["result"] = "not reached by " + SecondsText(goal.outcome_time);
    if (goal.outcome == Outcome::kOpen) data["result"] = WhatBecameOf(goal);
    if (goal.model.valid() && subjects_.Find(goal.model)) data["model"] = IdText(goal.model);
    json sub_goals = json::array();
    for (const std::size_t position : goal.sub_goals)
      sub_goals.push_back(IdText(context_.goals.goals[position].goal));
    if (!sub_goals.empty()) data["sub_goals"] = sub_goals;
    json plans = json::array();
    for (const PlanRecord& plan : goal.plans) plans.push_back(PlanData(plan));
    if (!plans.empty()) data["plans"] = plans;
    json commands = json::array();
    for (const IssuedCommand& command : goal.commands) commands.push_back(IdText(command.event));
    if (!commands.empty()) data["commands"] = commands;
    return data;
  }

  // Of a goal without an outcome of its own: a sub-goal lasts until the way to its drive is looked for again,
  // or the drive is settled.
  std::string WhatBecameOf(const GoalNode& goal) const {
    const GoalNode& drive = context_.goals.goals[DriveOf(goal)];
    if (goal.drive || !drive.drive) return "still open";
    if (const auto anew = searches_.find(drive.goal); anew != searches_.end()) {
      const auto next = anew->second.upper_bound(goal.time);
      if (next != anew->second.end()) return "left at " + SecondsText(*next) + ", to look for a way again";
    }
    if (drive.outcome == Outcome::kOpen) return "still open";
    return "left at " + SecondsText(drive.outcome_time) + ", when its drive was " +
           (drive.outcome == Outcome::kReached ? "reached" : "missed");
  }
  std::size_t DriveOf(const GoalNode& goal) const {
    std::size_t position = subjects_.list()[*subjects_.Find(goal.goal)].position;
    const std::vector<GoalNode>& goals = context_.goals.goals;
    for (std::size_t up = 0; up < goals.size() && goals[position].parent != position; ++up)
      position = goals[position].parent;
    return position;
  }

  json PlanData(const PlanRecord& plan) const {
    std::vector<std::string> steps;
    for (const PlanStep& step : plan.steps) steps.push_back(StepText(knowledge_, step));
    return {{"at", plan.time.us},
            {"event", IdText(plan.started)},
            {"simulation", plan.simulation.value},
            {"text", Shortened(Join(steps, ", then "), kLongestText)},
            {"score", FormatConfidence(plan.score)},
            {"committed", plan.committed},
            {"outcome", plan.ended ? std::string(EnumName(plan.outcome)) : "not ended"}};
  }

  json PredictionDetail(const PredictionRecordOfRun& prediction) const {
    json data = {{"note", "predicted at " + SecondsText(prediction.time)},
                 {"say", Shortened(SentenceOf(run_, *run_.Find(prediction.event)), kLongestText)}};
    if (prediction.outcome == Outcome::kReached)
      data["result"] = "came true at " + SecondsText(prediction.until);
    if (prediction.outcome == Outcome::kFailed) data["result"] = "failed at " + SecondsText(prediction.until);
    if (prediction.outcome == Outcome::kOpen) data["result"] = "not decided";
    std::vector<ModelId> models = prediction.requirements;
    models.push_back(prediction.model);
    data["requirements"] = SubjectIds(models);
    return data;
  }

  json CommandDetail(const IssuedCommand& command) const {
    const bool teacher = command.by == Commander::kTeacher;
    json data = {
        {"note", std::string(teacher ? "commanded by the teacher at " : "commanded by the agent at ") +
                     SecondsText(command.time)},
        {"say", Shortened(SentenceOf(run_, *run_.Find(command.event)), kLongestText)}};
    if (const auto* refused = run_.FindBody<CommandRefused>(command.refused))
      data["result"] = Shortened("refused: " + Printable(refused->reason), kLongestText);
    if (command.goal.valid() && subjects_.Find(command.goal)) data["goal"] = IdText(command.goal);
    return data;
  }

  const ReportContext& context_;
  const Run& run_;
  const KnowledgeBase& knowledge_;
  const SubjectTable& subjects_;
  std::map<GoalId, std::set<Time>> searches_;  // drive -> when a way to it was looked for
  std::map<GoalId, std::vector<EventId>> compared_for_;
  std::map<ModelId, std::vector<EventId>> compared_with_;
  std::map<CompositeStateId, std::vector<EventId>> compared_state_;  // as the source
  std::map<ModelId, std::vector<ModelId>> requirements_of_;
  std::map<CompositeStateId, std::vector<ModelId>> requirements_on_;
};

}  // namespace

json SubjectIndex(const ReportContext& context, const SubjectTable& subjects) {
  json ids = json::array(), titles = json::array(), kinds = json::array(), marks = json::array(),
       born = json::array(), gone = json::array(), outcomes = json::array(), events = json::array(),
       decided = json::array(), parents = json::array();
  for (const Subject& subject : subjects.list()) {
    ids.push_back(subject.id);
    titles.push_back(subject.title);
    kinds.push_back(std::string(KindWord(subject.kind)));
    marks.push_back(subject.mark);
    born.push_back(subject.born.us);
    gone.push_back(subject.gone ? json(subject.gone->us) : json(nullptr));
    outcomes.push_back(static_cast<int>(subject.outcome));
    events.push_back(subject.event.value);
    decided.push_back(subject.outcome_event.value);
    json parent = nullptr;
    if (subject.kind == SubjectKind::kGoal) {
      const GoalNode& goal = context.goals.goals[subject.position];
      const auto number = subjects.Find(context.goals.goals[goal.parent].goal);
      if (number && goal.parent != subject.position) parent = *number;
    }
    parents.push_back(parent);
  }
  return {{"id", ids},          {"title", titles},   {"kind", kinds},           {"mark", marks},
          {"born", born},       {"gone", gone},      {"outcome", outcomes},     {"event", events},
          {"decided", decided}, {"parent", parents}, {"block", kSubjectsABlock}};
}

Status AddSubjectDetails(const ReportContext& context, const SubjectTable& subjects, PageBlocks* blocks) {
  const DetailAuthor author(context, subjects);
  const std::vector<Subject>& list = subjects.list();
  for (std::size_t start = 0, n = 0; start < list.size(); start += kSubjectsABlock, ++n) {
    json details = json::array();
    for (std::size_t i = start; i < std::min(start + kSubjectsABlock, list.size()); ++i)
      details.push_back(author.Write(list[i]));
    Status written = blocks->AddPacked("subjects", "subjects-" + std::to_string(n), "application/json",
                                       PageJson(std::move(details)));
    if (!written) return written;
  }
  return {};
}

}  // namespace aerascope
