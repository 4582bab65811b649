// A Plan is a way from the present to a goal: steps, one a frame, and the frame it is expected to end in.
#pragma once

#include <memory>
#include <vector>

#include "engine/reason/goal_log.h"
#include "engine/reason/imagination.h"
#include "engine/reason/parameters.h"
#include "engine/reason/retrieval.h"

namespace aerascope {

struct Step {
  Term command;          // nil: nothing is done in this frame, since what is wanted comes by itself
  ModelId causal_model;  // invalid while waiting for what is predicted already
  ModelId requirement;   // what allows it; of a hypothesis: the requirement it generalises
  int hypothesis = -1;   // position among the decision's hypotheses
};

struct Plan {
  std::vector<Step> steps;
  double score = 1;     // product of the confidences of all models along it (semantics 6.2)
  bool vetoed = false;  // a strong requirement model stands against one of the steps
  EventId veto;         // the first that does, while vetoed
  int familiar = 0;     // components kept by its hypotheses, in all
  // OpenAERA's ranking looks at the last model only: its confidence, and how long before the goal it must
  // fire.
  double solution_confidence = 1;
  Duration solution_delay;
  std::shared_ptr<ImaginedFrame> end;  // shared by all plans that go through this frame

  void TakeVetoOf(const Plan& other) {
    if (!vetoed) veto = other.veto;
    vetoed = vetoed || other.vetoed;
  }
};

// What one decision is made with.
struct PlanningContext {
  const ReasonerParameters& parameters;
  Duration period;
  const Situation& present;
  const KnowledgeBase& knowledge;
  Time now;
  Retrieval& retrieval;
};

// Does the fact bring the target about: same polarity and matching payload, or for an anti-fact another value
// of the same thing (semantics 1.6)?
bool BringsAbout(const Fact& fact, const Fact& target);
// Does anything in the situation?
bool HoldsIn(const Situation& situation, const Fact& target);

}  // namespace aerascope
