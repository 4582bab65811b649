// Feasibility is a quick look ahead: could some model bring this about at all, from the present situation?
//
// It follows conditions without planning: what holds now, or some model says, counts as possible. So a yes
// may turn out wrong, and a no saves the search (a hand cannot be made of a sphere). Answers are remembered
// for one decision, during which the present does not change.
#pragma once

#include <map>
#include <string>

#include "engine/reason/plan.h"

namespace aerascope {

class Feasibility {
 public:
  // The context outlives it.
  explicit Feasibility(const PlanningContext& context) : context_(context), knowledge_(context.knowledge) {}

  // Could a model bring this about, through a condition that is at least familiar? A condition that asks for
  // unchangeable things which do not hold (a sphere that should be a hand) is no way to anything.
  bool CanBringAbout(const Term& payload, bool positive);

 private:
  bool CanFire(const ModelRecord& record, const Bindings& bindings, int depth);
  // The share of conditions that hold now or concern something a model can change.
  double Conceivable(const Term& payload);

  const PlanningContext& context_;
  const KnowledgeBase& knowledge_;
  std::map<std::string, bool> can_bring_about_;
};

}  // namespace aerascope
