#include "engine/reason/drives.h"

#include <algorithm>

#include "engine/reason/commit.h"

namespace aerascope {
namespace {

// The fact in the situation that shows the target; npos if none does.
std::size_t EvidenceIn(const Situation& situation, const Fact& target) {
  const std::size_t found = situation.FindMatch(target.payload, target.positive, {});
  if (found != Situation::npos || target.positive || !IsValue(target.payload)) return found;
  const Term any = MakeValue(target.payload[0], target.payload[1], Term::Wildcard());
  for (const std::size_t i : situation.Candidates(any, {})) {
    if (BringsAbout(situation[i].fact, target)) return i;
  }
  return Situation::npos;
}

}  // namespace

bool Drives::Give(const std::string& title, const Fact& target, const Situation& situation) {
  const Time now = target.interval.after;
  Drive drive;
  drive.goal.id = journal_.NewId<GoalId>();
  drive.target = target;
  drive.goal.event = journal_.Write(now, DriveInjected{drive.goal.id, title, target});
  last_given_ = drive.goal.id;
  const std::size_t evidence = EvidenceIn(situation, target);
  if (evidence == Situation::npos) {
    open_.push_back(std::move(drive));
    return false;
  }
  journal_.Write(now, GoalAchieved{drive.goal.id, situation[evidence].id},
                 {drive.goal.event, situation[evidence].event});
  closed_[drive.goal.id] = true;
  last_reached_ = true;
  return true;
}

std::optional<bool> Drives::Reached(GoalId drive) const {
  const auto it = closed_.find(drive);
  return it == closed_.end() ? std::nullopt : std::optional(it->second);
}

void Drives::Close(const Drive& drive, bool reached, EventId because, Time now) {
  // What was set for it in the last decision serves nothing any more.
  for (const GoalLog::Line& line : drive.goals) {
    journal_.Write(now, GoalDropped{line.goal.id, GoalDropReason::kSuperGoalClosed},
                   {because, line.goal.event});
  }
  closed_[drive.goal.id] = reached;
  last_reached_ = reached;
}

// It is missed because it was wanted until now, and because of what stood in its way; the nearest causes are
// enough.
EventId Drives::Miss(const Drive& drive, const Conclusions& concluded, Time now) {
  constexpr std::size_t kMostHindrances = 32;
  const auto promise = concluded.find(drive.promised_by);
  std::vector<EventId> causes{drive.goal.event,
                              promise == concluded.end() ? drive.let_down : promise->second.event};
  const std::size_t count = std::min(drive.hindrances.size(), kMostHindrances);
  causes.insert(causes.end(), drive.hindrances.begin(),
                drive.hindrances.begin() + static_cast<std::ptrdiff_t>(count));
  return journal_.Write(now, GoalFailed{drive.goal.id}, causes);
}

std::vector<Drives::Achieved> Drives::Check(const Situation& situation, const Conclusions& concluded) {
  const Time now = situation.interval().after;
  std::vector<Achieved> reached;
  std::vector<Drive> still_open;
  for (Drive& drive : open_) {
    const std::size_t evidence = EvidenceIn(situation, drive.target);
    if (evidence != Situation::npos) {
      const EventId achieved = journal_.Write(now, GoalAchieved{drive.goal.id, situation[evidence].id},
                                              {drive.goal.event, situation[evidence].event});
      Close(drive, true, achieved, now);
      reached.push_back({drive.target, evidence, achieved});
      continue;
    }
    if (drive.target.interval.before <= now) {
      Close(drive, false, Miss(drive, concluded, now), now);
      continue;
    }
    still_open.push_back(std::move(drive));
  }
  open_ = std::move(still_open);
  Resume(concluded, now);
  return reached;
}

void Drives::Resume(const Conclusions& concluded, Time now) {
  for (Drive& drive : open_) {
    if (!drive.promised_by.valid() || journal_.knowledge().predictions().contains(drive.promised_by))
      continue;
    const auto outcome = concluded.find(drive.promised_by);
    drive.let_down =
        journal_.Write(now, GoalResumed{drive.goal.id, drive.promised_by},
                       {drive.suspended, outcome == concluded.end() ? EventId{} : outcome->second.event});
    drive.promised_by = {};
  }
}

void Drives::Renew(const Expectations::Renewal& renewal) {
  for (Drive& drive : open_) {
    if (drive.promised_by == renewal.old) drive.promised_by = renewal.now;
  }
}

void Drives::Suspend(Time now) {
  for (Drive& drive : open_) {
    if (drive.promised_by.valid()) continue;
    for (const auto& [id, prediction] : journal_.knowledge().predictions()) {
      const Fact& promised = prediction.target;
      if (promised.confidence <= 0 || promised.interval.after > drive.target.interval.before ||
          !BringsAbout(promised, drive.target)) {
        continue;
      }
      drive.promised_by = id;
      drive.suspended =
          journal_.Write(now, GoalSuspended{drive.goal.id, id}, {prediction.event, drive.goal.event});
      break;
    }
  }
}

std::optional<Wish> Drives::Decide(const Situation& situation, const OfferKnowledge& offer) {
  const Time now = situation.interval().after + parameters_.goal_offset;
  const Time commit = situation.interval().after + parameters_.commit_offset;
  Suspend(now);
  std::vector<Drive*> order;
  for (Drive& drive : open_) order.push_back(&drive);
  std::stable_sort(order.begin(), order.end(), [&](const Drive* a, const Drive* b) {
    return Importance(a->target, now) > Importance(b->target, now);
  });

  std::vector<std::pair<Drive*, Decision>> decisions;
  std::vector<Prohibition> prohibitions;
  for (Drive* drive : order) {
    if (drive->promised_by.valid()) continue;
    PlanningTask task;
    task.drive = drive->goal;
    task.target = drive->target;
    for (const Drive& other : open_) {
      if (other.goal.id != drive->goal.id) task.others.push_back({other.goal.id, other.target});
    }
    task.prohibitions = prohibitions;
    task.now = now;
    decisions.emplace_back(drive,
                           PlanFor(task, parameters_, period_, situation, &retrieval_, offer, &journal_));
    const Decision& decision = decisions.back().second;
    prohibitions.insert(prohibitions.end(), decision.prohibitions.begin(), decision.prohibitions.end());
    if (decision.command && !decision.command->is(TermKind::kNil)) break;
  }

  std::optional<Wish> wish;
  for (auto& [drive, decision] : decisions) {
    std::vector<EventId> outcomes;
    for (const PendingEvent& outcome : decision.outcome)
      outcomes.push_back(journal_.Write(commit, outcome.body, outcome.causes));
    drive->hindrances = outcomes;
    if (decision.command) drive->hindrances = {outcomes.back()};
    drive->hindrances.insert(drive->hindrances.end(), decision.hindrances.begin(), decision.hindrances.end());
    DropOldPlan(*drive, decision, outcomes, commit);
    drive->goals = decision.goals;
    drive->plan.clear();
    if (!decision.command) continue;
    drive->committed = outcomes.back();
    drive->plan.assign(decision.steps.begin() + 1, decision.steps.end());
    if (!decision.command->is(TermKind::kNil))
      wish = Wish{*decision.command, drive->goal.id, drive->committed};
  }
  return wish;
}

// Where the new plan is not what was left of the old one, the conditions that the old one was to use are
// given up. `outcome`: the events that say what was decided, the plan committed to last.
void Drives::DropOldPlan(const Drive& drive, const Decision& decision, const std::vector<EventId>& outcome,
                         Time now) {
  for (const Step& old : drive.plan) {
    if (!old.requirement.valid()) continue;
    const bool kept = std::any_of(decision.steps.begin(), decision.steps.end(),
                                  [&](const Step& step) { return step.requirement == old.requirement; });
    if (kept) continue;
    GoalDropReason reason = decision.command ? GoalDropReason::kReplaced : GoalDropReason::kNoPlan;
    std::vector<EventId> causes = outcome;
    if (decision.command) {
      causes = {outcome.back()};
    } else if (outcome.empty() && !decision.goals.empty()) {
      causes = {decision.goals.front().goal.event};  // that it looked again, in vain
    }
    const ModelRecord* requirement = journal_.knowledge().Find(old.requirement);
    const auto veto = decision.vetoed.find(old.causal_model);
    if (requirement && requirement->state != ModelState::kActive) {
      reason = GoalDropReason::kRequirementContradicted;
      causes = {requirement->moved};
    } else if (veto != decision.vetoed.end()) {
      reason = GoalDropReason::kRequirementContradicted;
      causes = {veto->second};
    }
    causes.push_back(drive.committed);
    for (const GoalLog::Line& line : drive.goals) {
      if (line.model != old.requirement) continue;
      causes.push_back(line.goal.event);
      journal_.Write(now, GoalDropped{line.goal.id, reason}, causes);
      causes.pop_back();
    }
  }
}

}  // namespace aerascope
