#include "viewer/page/subject_table.h"

#include <algorithm>
#include <set>
#include <type_traits>

#include "engine/base/text.h"
#include "viewer/page/overloaded.h"
#include "viewer/page/shortened.h"

namespace aerascope {
namespace {

// Gathers the numbers of subjects named in the fields of an event.
class Mentions {
 public:
  explicit Mentions(const SubjectTable& table) : table_(table) {}

  void Add(std::optional<std::size_t> number) {
    if (number && std::find(numbers.begin(), numbers.end(), *number) == numbers.end())
      numbers.push_back(*number);
  }
  void See(ModelId id) { Add(table_.Find(id)); }
  // What speaks of a composite state speaks of the requirement model on it, too.
  void See(CompositeStateId id) {
    Add(table_.Find(id));
    Add(table_.FindRequirementOn(id));
  }
  void See(GoalId id) { Add(table_.Find(id)); }
  void See(PredictionId id) { Add(table_.Find(id)); }
  void See(const Model& model) {
    Add(table_.Find(model.id));
    See(TargetModel(model));
    See(RequiredState(model));
  }
  void See(const CompositeState& state) { See(state.id); }
  template <class Item>
  void See(const std::vector<Item>& list) {
    for (const Item& item : list) See(item);
  }
  template <class Other>
  void See(const Other& value) {
    if constexpr (requires { Other::Fields(); }) {
      ForEachField<Other>([&](const auto& field) { See(value.*field.member); });
    }
  }
  void SeeThings(const Term& term) {
    ForEachTerm(term, [&](const Term& part) {
      if (part.is(TermKind::kEntity)) Add(table_.FindThing(part.name()));
    });
  }

  std::vector<std::size_t> numbers;

 private:
  const SubjectTable& table_;
};

}  // namespace

SubjectTable::SubjectTable(const ReportContext& context) : context_(context) {
  AddKnowledge();
  AddGoals();
  AddPredictions();
  AddCommands();
  AddThings();
  for (Subject& subject : list_) subject.title = Shortened(subject.title, kLongestTitle);
}

void SubjectTable::AddKnowledge() {
  const KnowledgeBase& knowledge = context_.knowledge;
  for (const auto& [id, record] : knowledge.models()) {
    const bool requirement = IsRequirement(record.model);
    models_[id] = list_.size();
    list_.push_back({requirement ? SubjectKind::kRequirement : SubjectKind::kModel,
                     IdText(id),
                     requirement ? MarkOf(record.origin) : "model",
                     TitleOf(knowledge, id),
                     record.created,
                     context_.DeletedAt(id),
                     Outcome::kOpen,
                     record.event,
                     {},
                     0});
  }
  for (const auto& [id, record] : knowledge.composite_states()) {
    states_[id] = list_.size();
    list_.push_back({SubjectKind::kState,
                     IdText(id),
                     MarkOf(record.origin),
                     TitleOf(knowledge, id),
                     record.created,
                     std::nullopt,
                     Outcome::kOpen,
                     record.event,
                     {},
                     0});
  }
}

void SubjectTable::AddGoals() {
  const std::vector<GoalNode>& goals = context_.goals.goals;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    goals_[goals[i].goal] = list_.size();
    list_.push_back({SubjectKind::kGoal, IdText(goals[i].goal), "goal", goals[i].title, goals[i].time,
                     std::nullopt, goals[i].outcome, goals[i].event, goals[i].outcome_event, i});
  }
}

void SubjectTable::AddPredictions() {
  const std::vector<PredictionRecordOfRun>& predictions = context_.summary.predictions;
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    const PredictionRecordOfRun& prediction = predictions[i];
    predictions_[prediction.prediction] = list_.size();
    list_.push_back({SubjectKind::kPrediction, IdText(prediction.prediction), "prediction",
                     FactText(context_.knowledge, prediction.target), prediction.time, std::nullopt,
                     prediction.outcome, prediction.event, prediction.outcome_event, i});
  }
}

void SubjectTable::AddCommands() {
  commands_ = CommandsOf(context_.run);
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    const IssuedCommand& command = commands_[i];
    command_events_[command.event] = list_.size();
    list_.push_back({SubjectKind::kCommand, IdText(command.event),
                     command.by == Commander::kTeacher ? "taught-command" : "command",
                     PayloadText(context_.knowledge, command.command), command.time, std::nullopt,
                     command.refused.valid() ? Outcome::kFailed : Outcome::kOpen, command.event,
                     command.refused, i});
  }
}

void SubjectTable::AddThings() {
  std::map<std::string, EventId> seen;  // entity -> where it was first seen
  for (const EventId id : context_.run.OfKind<FactObserved>()) {
    const Term& payload = context_.run.FindBody<FactObserved>(id)->fact.payload;
    if (IsValue(payload) && payload[0].is(TermKind::kEntity)) seen.try_emplace(payload[0].name(), id);
  }
  std::set<std::string> ids;
  for (const auto& [name, first] : seen) {
    const std::string shown = Shortened(Printable(name), kLongestTitle);
    std::string id = "thing:" + shown;
    for (int n = 2; !ids.insert(id).second; ++n) id = "thing:" + shown + " (" + std::to_string(n) + ")";
    things_[name] = list_.size();
    list_.push_back({SubjectKind::kThing,
                     id,
                     "seen",
                     Printable(name),
                     context_.run.Find(first)->time,
                     std::nullopt,
                     Outcome::kOpen,
                     first,
                     {},
                     0});
  }
}

std::optional<std::size_t> SubjectTable::FindRequirementOn(CompositeStateId state) const {
  const auto found = context_.requirement_on.find(state);
  return found == context_.requirement_on.end() ? std::nullopt : Find(found->second);
}

std::vector<std::size_t> SubjectTable::MentionedBy(const Event& event) const {
  Mentions mentions(*this);
  mentions.Add(Find(event.id));
  // A comparison is told with what it made.
  std::visit(Overloaded{[&](const AnalogyCompared& e) {
                          mentions.See(e.result_requirement.valid() ? e.result_requirement : e.requirement);
                          mentions.See(e);
                        },
                        [&](const IcstFound& e) {
                          if (IsIcst(e.fact.payload) && e.fact.payload[0].is(TermKind::kCompositeState))
                            mentions.Add(Find(e.fact.payload[0].composite_state()));
                        },
                        [&](const auto& body) { mentions.See(body); }},
             event.body);
  if (event.simulation.valid()) return mentions.numbers;
  std::visit(Overloaded{[&](const DriveInjected& e) { mentions.SeeThings(e.target.payload); },
                        [&](const AnalogyCompared& e) { mentions.SeeThings(e.bindings); },
                        [&](const PredictionMade& e) { mentions.SeeThings(e.target.payload); },
                        [&](const CommandIssued& e) {
                          mentions.SeeThings(e.command);
                          if (e.goal.valid()) mentions.See(e.goal);
                        },
                        [](const auto&) {}},
             event.body);
  return mentions.numbers;
}

}  // namespace aerascope
