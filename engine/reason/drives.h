// The drives that are open: what the agent was given to bring about, each until it is reached or its deadline
// passes (semantics 4.1, 4.6, 4.8).
//
// A drive that a prediction promises is suspended: nothing more is done for it until the prediction fails. Of
// several open drives the most important one (nearest deadline, surest) that has a plan acts; one command a
// frame.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/reason/expectation.h"
#include "engine/reason/planner.h"

namespace aerascope {

// A command the agent wants, for a drive.
struct Wish {
  Term command;
  GoalId drive;
  EventId event;  // PlanCommitted
};

class Drives {
 public:
  // Both outlive it.
  Drives(const ReasonerParameters& parameters, Duration period, Journal* journal)
      : parameters_(parameters), period_(period), journal_(*journal) {}

  // True if the target holds in the situation: then the drive is given and reached at once.
  bool Give(const std::string& title, const Fact& target, const Situation& situation);
  bool any_open() const { return !open_.empty(); }
  GoalId last_given() const { return last_given_; }
  // Of the drive that was closed last, and of any one; nothing while it is open.
  bool last_reached() const { return last_reached_; }
  std::optional<bool> Reached(GoalId drive) const;

  // A drive that was reached at the start of this frame.
  struct Achieved {
    Fact target;
    std::size_t evidence;  // position in the situation
    EventId event;
  };
  // At the start of a frame, when predictions have been concluded: what is reached, missed or resumed.
  std::vector<Achieved> Check(const Situation& situation, const Conclusions& concluded);
  // Pursues again what an ended prediction had promised.
  void Resume(const Conclusions& concluded, Time now);
  // One prediction took another's place.
  void Renew(const Expectations::Renewal& renewal);
  // Suspends what an open prediction promises.
  void Suspend(Time now);
  std::optional<Wish> Decide(const Situation& situation, const OfferKnowledge& offer);

 private:
  struct Drive {
    GoalEntry goal;
    Fact target;
    PredictionId promised_by;  // valid while suspended
    EventId suspended;
    // Of the last decision: the plan committed to (the steps still to come), where that was said, and the
    // goals set.
    std::vector<Step> plan;
    EventId committed;
    std::vector<GoalLog::Line> goals;
    // Why it is still open: a promise that was not kept; and of the last decision the plan chosen, or else
    // the plans rejected and what kept others from being found.
    EventId let_down;
    std::vector<EventId> hindrances;
  };

  void Close(const Drive& drive, bool reached, EventId because, Time now);
  EventId Miss(const Drive& drive, const Conclusions& concluded, Time now);
  void DropOldPlan(const Drive& drive, const Decision& decision, const std::vector<EventId>& outcome,
                   Time now);

  const ReasonerParameters& parameters_;
  Duration period_;
  Journal& journal_;
  Retrieval retrieval_;
  std::vector<Drive> open_;  // in the order given
  std::map<GoalId, bool> closed_;
  GoalId last_given_;
  bool last_reached_ = false;
};

}  // namespace aerascope
