// What can be selected in a report, in a fixed order: knowledge, goals, predictions, commands and the things
// of the world. The page knows each by its id and by its number here.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/goal_tree.h"
#include "viewer/page/report_context.h"

namespace aerascope {

enum class SubjectKind { kRequirement, kModel, kState, kGoal, kPrediction, kCommand, kThing };

struct Subject {
  SubjectKind kind = SubjectKind::kThing;
  std::string id;     // "mdl_14", "goal_3", "#214", "thing:c1"
  std::string mark;   // name of a symbol of the page without "m-"
  std::string title;  // one line
  Time born;
  std::optional<Time> gone;  // of knowledge that was deleted
  Outcome outcome = Outcome::kOpen;
  EventId event;             // that brought it about
  EventId outcome_event;     // that decided it; none while open
  std::size_t position = 0;  // in the list it comes from: goals, predictions, commands
};

// Titles longer than this are cut, in code points.
inline constexpr std::size_t kLongestTitle = 160;

class SubjectTable {
 public:
  explicit SubjectTable(const ReportContext& context);

  const std::vector<Subject>& list() const { return list_; }
  const std::vector<IssuedCommand>& commands() const { return commands_; }
  // The number of what an id names; nothing where there is no such subject.
  std::optional<std::size_t> Find(ModelId id) const { return FindIn(models_, id); }
  std::optional<std::size_t> Find(GoalId id) const { return FindIn(goals_, id); }
  std::optional<std::size_t> Find(PredictionId id) const { return FindIn(predictions_, id); }
  std::optional<std::size_t> Find(EventId command) const { return FindIn(command_events_, command); }
  std::optional<std::size_t> Find(CompositeStateId id) const { return FindIn(states_, id); }
  // The first requirement model on a composite state.
  std::optional<std::size_t> FindRequirementOn(CompositeStateId state) const;
  std::optional<std::size_t> FindThing(const std::string& name) const { return FindIn(things_, name); }

  // The subjects that an event speaks of, what it is about first, no repeats.
  std::vector<std::size_t> MentionedBy(const Event& event) const;

 private:
  template <class Key>
  static std::optional<std::size_t> FindIn(const std::map<Key, std::size_t>& numbers, const Key& key) {
    const auto found = numbers.find(key);
    if (found == numbers.end()) return std::nullopt;
    return found->second;
  }
  void AddKnowledge();
  void AddGoals();
  void AddPredictions();
  void AddCommands();
  void AddThings();

  const ReportContext& context_;
  std::vector<Subject> list_;
  std::vector<IssuedCommand> commands_;
  std::map<ModelId, std::size_t> models_;
  std::map<CompositeStateId, std::size_t> states_;
  std::map<GoalId, std::size_t> goals_;
  std::map<PredictionId, std::size_t> predictions_;
  std::map<EventId, std::size_t> command_events_;
  std::map<std::string, std::size_t> things_;
};

}  // namespace aerascope
