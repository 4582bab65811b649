#include "engine/reason/commit.h"

#include <algorithm>

namespace aerascope {
namespace {

double SecondsLeft(Time until, Time now) {
  return static_cast<double>(std::max<std::int64_t>(1, (until - now).us)) / 1e6;
}

}  // namespace

double Importance(const Fact& target, Time now) {
  return target.confidence / SecondsLeft(target.interval.before, now);
}

double RankingScore(AnalogyMode mode, double product, double solution_confidence, Time solution_before,
                    Time now) {
  if (mode == AnalogyMode::kPaper) return product;
  return solution_confidence / SecondsLeft(solution_before, now);
}

Choice Choose(const std::vector<TriedPlan>& plans) {
  Choice choice;
  choice.rejected.resize(plans.size());
  const bool give_up = std::any_of(plans.begin(), plans.end(), [](const TriedPlan& plan) {
    return plan.mandatory && plan.outcome == SimulationOutcome::kReached && plan.harmed.valid();
  });
  const auto better = [&](const TriedPlan& a, const TriedPlan& b) {
    return a.mandatory != b.mandatory ? a.mandatory : a.score > b.score;
  };
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const TriedPlan& plan = plans[i];
    if (plan.outcome == SimulationOutcome::kNotEnabled) {
      choice.rejected[i] = PlanRejection::kNotEnabled;
    } else if (plan.outcome == SimulationOutcome::kNotReached) {
      choice.rejected[i] = PlanRejection::kNotReached;
    } else if (give_up) {
      choice.rejected[i] = PlanRejection::kMandatoryHarms;
    } else if (plan.harmed.valid()) {
      choice.rejected[i] = PlanRejection::kHarms;
    } else if (!choice.chosen || better(plan, plans[*choice.chosen])) {
      choice.chosen = i;
    }
  }
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (choice.rejected[i] || i == choice.chosen) continue;
    const TriedPlan& winner = plans[*choice.chosen];
    if (winner.mandatory && !plans[i].mandatory) {
      choice.rejected[i] = PlanRejection::kMandatoryFirst;
    } else {
      choice.rejected[i] = plans[i].score < winner.score ? PlanRejection::kLowerScore : PlanRejection::kTie;
    }
  }
  return choice;
}

}  // namespace aerascope
