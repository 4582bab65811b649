#include "engine/reason/planner.h"

#include <algorithm>

#include "engine/reason/commit.h"

namespace aerascope {
namespace {

// Plans tried in the head for one decision.
constexpr std::size_t kMaxSimulations = 8;

class Planner {
 public:
  Planner(const PlanningTask& task, const ReasonerParameters& parameters, Duration period,
          const Situation& situation, Retrieval* retrieval, const OfferKnowledge& offer, Journal* journal)
      : task_(task),
        journal_(*journal),
        context_{parameters, period, situation, journal->knowledge(), task.now, *retrieval},
        goals_(journal, task.now),
        hypotheses_(context_, offer, journal),
        chainer_(context_, &goals_, &hypotheses_) {}

  Decision Run() {
    const bool paper = context_.parameters.analogy_mode == AnalogyMode::kPaper;
    root_ = goals_.Set(task_.drive, {}, task_.target);
    TryMandatory();
    if (paper) {
      TryAll(chainer_.PlansFor(task_.target, root_, Present(), false), {});
      const bool search_further = !AnyReached() && context_.parameters.analogy_min_psi < 1;
      if (search_further) TryThroughHypotheses();
      if (!search_further) hypotheses_.ReportRejected();
      hypotheses_.ReportLeftOver(search_further);
    } else {
      // OpenAERA makes a hypothesis wherever a condition matches in part, whether it is needed or not.
      std::vector<Plan> plans = chainer_.PlansFor(task_.target, root_, Present(), true);
      hypotheses_.ReportRejected();
      hypotheses_.AdoptAll();
      for (Plan& plan : plans) hypotheses_.Adopt(&plan);
      TryAll(std::move(plans), {});
    }
    return Commit();
  }

 private:
  struct Tried {
    Plan plan;
    Trial trial;
    GoalEntry goal;
    bool mandatory = false;
  };

  std::shared_ptr<ImaginedFrame> Present() const {
    return std::make_shared<ImaginedFrame>(ImaginedFrame::Present(
        context_.present, PendingPredictions(context_.knowledge, context_.present, Pending::kAll)));
  }

  bool AnyReached() const {
    return std::any_of(tried_.begin(), tried_.end(), [](const Tried& one) {
      return !one.mandatory && one.trial.outcome == SimulationOutcome::kReached;
    });
  }

  void Try(Plan plan, const Fact& target, const GoalEntry& goal, bool mandatory,
           const std::vector<EventId>& hypothesised) {
    Trial trial = Simulate(plan, target, goal, hypothesised, task_.others, context_, &journal_);
    tried_.push_back({std::move(plan), std::move(trial), goal, mandatory});
  }

  void TryAll(std::vector<Plan> plans, const std::vector<EventId>& hypothesised) {
    for (std::size_t i = 0; i < plans.size() && i < kMaxSimulations; ++i) {
      Try(std::move(plans[i]), task_.target, root_, false, hypothesised);
    }
  }

  // What would undo the goal: commands not to give, and facts that must cease to hold.
  void TryMandatory() {
    const auto present = Present();
    const Threats threats = FindThreats(task_.target, root_, present.get(), context_, &goals_);
    prohibitions_ = threats.prohibitions;
    for (const MandatoryGoal& must : threats.mandatory) {
      std::vector<Plan> plans = chainer_.PlansFor(must.target, must.goal, Present(), false);
      for (std::size_t i = 0; i < plans.size() && i < kMaxSimulations; ++i) {
        Try(std::move(plans[i]), must.target, must.goal, true, {});
      }
    }
  }

  // The best plan through hypotheses is made possible and tried; only if that fails, the next.
  void TryThroughHypotheses() {
    std::vector<Plan> plans = chainer_.PlansFor(task_.target, root_, Present(), true);
    for (const Plan& plan : plans) {
      if (plan.vetoed) continue;
      for (const Step& step : plan.steps) {
        if (step.hypothesis >= 0) hypotheses_.NoteInPlan(step.hypothesis);
      }
    }
    hypotheses_.ReportRejected();
    std::size_t tries = 0;
    for (Plan& plan : plans) {
      const bool hypothetical = std::any_of(plan.steps.begin(), plan.steps.end(),
                                            [](const Step& step) { return step.hypothesis >= 0; });
      if (!hypothetical || plan.vetoed) continue;  // tried before, or known not to work
      if (++tries > kMaxSimulations) break;
      const std::vector<EventId> hypothesised = hypotheses_.Adopt(&plan);
      Try(std::move(plan), task_.target, root_, false, hypothesised);
      if (AnyReached()) break;
    }
  }

  // The most important of the goals that the plan would make fail, if it is more important than the task's.
  GoalId Harmed(const Tried& one) const {
    const double own = Importance(task_.target, task_.now);
    GoalId harmed;
    double most = own;
    for (const OtherGoal& other : task_.others) {
      const double importance = Importance(other.target, task_.now);
      const bool fails =
          std::find(one.trial.harmed.begin(), one.trial.harmed.end(), other.goal) != one.trial.harmed.end();
      if (fails && importance > most) {
        harmed = other.goal;
        most = importance;
      }
    }
    if (harmed.valid() || one.plan.steps.empty()) return harmed;
    for (const Prohibition& prohibition : task_.prohibitions) {
      Bindings none;
      if (Match(prohibition.command, one.plan.steps.front().command, none)) return prohibition.goal.id;
    }
    return {};
  }

  Decision Commit() {
    const AnalogyMode mode = context_.parameters.analogy_mode;
    std::vector<TriedPlan> plans;
    std::vector<PlanCandidate> candidates;
    for (const Tried& one : tried_) {
      const Time deadline = task_.target.interval.before - one.plan.solution_delay;
      const double score =
          RankingScore(mode, one.plan.score, one.plan.solution_confidence, deadline, task_.now);
      plans.push_back({one.trial.outcome, one.mandatory, score, Harmed(one)});
      const bool reached = one.trial.outcome == SimulationOutcome::kReached;
      candidates.push_back({one.trial.simulation,
                            mode == AnalogyMode::kPaper ? one.plan.score : one.plan.solution_confidence,
                            score, reached ? one.trial.ends : Time{}, deadline});
    }
    const Choice choice = Choose(plans);
    Decision decision;
    for (const Tried& one : tried_) decision.vetoed.insert(one.trial.vetoed.begin(), one.trial.vetoed.end());
    decision.vetoed.insert(goals_.refused().begin(), goals_.refused().end());
    for (std::size_t i = 0; i < plans.size(); ++i) {
      if (!choice.rejected[i]) continue;
      const Tried& one = tried_[i];
      std::vector<EventId> causes{one.trial.ended};
      if (choice.chosen) causes.push_back(tried_[*choice.chosen].trial.ended);
      decision.outcome.push_back({PlanRejected{one.goal.id, one.trial.simulation, *choice.rejected[i],
                                               plans[i].score, plans[i].harmed},
                                  causes});
    }
    decision.goals = goals_.lines();
    decision.prohibitions = prohibitions_;
    if (!choice.chosen) {
      decision.hindrances = goals_.hindered();
      decision.hindrances.insert(decision.hindrances.end(), hypotheses_.fruitless().begin(),
                                 hypotheses_.fruitless().end());
      return decision;
    }
    const Tried& best = tried_[*choice.chosen];
    decision.outcome.push_back(
        {PlanCommitted{best.goal.id, best.trial.simulation, candidates, plans[*choice.chosen].score},
         ReasonsFor(best)});
    decision.command = best.plan.steps.front().command;
    decision.steps = best.plan.steps;
    return decision;
  }

  // Why this plan: that it worked in the head, what made the models it relies on as sure as they are, and
  // what ruled other ways out.
  std::vector<EventId> ReasonsFor(const Tried& best) const {
    std::vector<EventId> reasons{best.trial.ended, best.goal.event};
    const auto add = [&](EventId reason) {
      const bool known = std::find(reasons.begin(), reasons.end(), reason) != reasons.end();
      if (reason.valid() && !known) reasons.push_back(reason);
    };
    for (const Step& step : best.plan.steps) {
      for (const ModelId id : {step.causal_model, step.requirement}) {
        if (const ModelRecord* record = context_.knowledge.Find(id)) add(record->rated);
      }
    }
    for (const EventId vetoed : goals_.vetoed()) add(vetoed);
    for (const EventId refused : hypotheses_.refused()) add(refused);
    return reasons;
  }

  const PlanningTask& task_;
  Journal& journal_;
  PlanningContext context_;
  GoalLog goals_;
  Hypotheses hypotheses_;
  BackwardChainer chainer_;
  GoalEntry root_;
  std::vector<Tried> tried_;
  std::vector<Prohibition> prohibitions_;
};

}  // namespace

Decision PlanFor(const PlanningTask& task, const ReasonerParameters& parameters, Duration period,
                 const Situation& situation, Retrieval* retrieval, const OfferKnowledge& offer,
                 Journal* journal) {
  return Planner(task, parameters, period, situation, retrieval, offer, journal).Run();
}

}  // namespace aerascope
