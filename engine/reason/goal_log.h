// The GoalLog writes the goals of one decision: each goal and each goal not pursued once, however often the
// search comes by it again.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/reason/journal.h"

namespace aerascope {

struct GoalEntry {
  GoalId id;
  EventId event;
};

class GoalLog {
 public:
  GoalLog(Journal* journal, Time now) : journal_(*journal), now_(now) {}

  // The goal for this target under its super goal. `model` leads from it to the super goal; none inside a
  // composite state.
  GoalEntry Set(const GoalEntry& super, ModelId model, const Fact& target);
  // `because`: what stands against it, where something does.
  void Skip(const GoalEntry& super, const Fact& target, GoalSkipReason reason, EventId because = {});

  // What was not pursued because of a veto, in order.
  const std::vector<EventId>& vetoed() const { return vetoed_; }
  // Of these, the models whose instance was wanted.
  const std::map<ModelId, EventId>& refused() const { return refused_; }
  // What was not pursued though it is wanted and not there: no way leads on from it. In order, those of a
  // veto too.
  const std::vector<EventId>& hindered() const { return hindered_; }

  // All goals set, oldest first, with the goal each serves.
  struct Line {
    GoalEntry goal;
    GoalId super;
    ModelId model;
  };
  const std::vector<Line>& lines() const { return lines_; }

 private:
  Journal& journal_;
  Time now_;
  std::map<std::string, GoalEntry> goals_;
  std::set<std::string> skipped_;
  std::vector<Line> lines_;
  std::vector<EventId> vetoed_;
  std::vector<EventId> hindered_;
  std::map<ModelId, EventId> refused_;
};

}  // namespace aerascope
