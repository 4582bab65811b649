// Goal-driven analogy (paper, section 5; semantics 6): comparing a known condition with the situation at hand
// for a goal, and building the hypothesis that keeps what is familiar and drops what is not.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/event/event_body.h"
#include "engine/kb/knowledge_base.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

// A requirement's composite state against a situation, under the best choice of individuals for what the goal
// leaves open. Positions play no part: apart from individuals, variables are free in each component by
// itself.
struct Comparison {
  ModelId requirement;
  CompositeStateId source;
  ModelId causal_model;
  Bindings bindings;  // of the composite state: from the goal, and individuals chosen
  std::vector<ComparedComponent> components;
  std::vector<std::size_t> kept;  // positions of components matched or achievable, in order
  int matched = 0;
  int achievable = 0;
  double psi = 0;         // (matched + achievable) / components: paper, equation 2
  double jaccard = 0;     // the same with the situation's unmatched counterparts in the union
  double confidence = 0;  // psi x confidence of the requirement: paper, equation 4
  std::optional<AnalogyVerdict> rejection;  // why it gives no hypothesis; none if it may
};

// Could any model bring about a fact with this payload (variables match anything)?
using CanBringAbout = std::function<bool(const Term& payload)>;

// A component that may be brought about must not ask for another individual than the one now in its place:
// with s1 in the hand, letting go is about s1, not about something that could be taken first. True if under
// `chosen` the component keeps to an individual that matches it under the goal's own bindings (or nothing
// matches it there).
bool KeepsToIndividuals(const FactPattern& component, const Situation& situation,
                        const Bindings& goal_bindings, const Bindings& chosen);

// Compares. `bindings` are those of the composite state that the goal gives; `goal` is the goal's payload.
// What is `predicted` counts as matched, as what is the case does.
Comparison Compare(const KnowledgeBase& knowledge, const ModelRecord& requirement, const Situation& situation,
                   const std::vector<SituationFact>& predicted, const Bindings& bindings, const Term& goal,
                   const CanBringAbout& can_bring_about, const ReasonerParameters& parameters);

// A nested or plain component under bindings: does something in force fit, could it be brought about, or
// neither?
ComponentStatus StatusOf(const FactPattern& component, const KnowledgeBase& knowledge,
                         const Situation& situation, const Bindings& bindings,
                         const CanBringAbout& can_bring_about, std::size_t* found = nullptr);

// The generalised composite state and requirement model of a comparison (paper, equation 3: P* is a subset of
// P). Ids are unset: state.id and requirement.id are invalid, and the requirement refers to composite state
// 0.
struct Hypothesis {
  CompositeState state;
  Model requirement;
  std::vector<int> variable_of;  // the original's variable number -> the new one, -1 if gone
};
Hypothesis MakeHypothesis(const CompositeState& source, const Model& requirement,
                          const std::vector<std::size_t>& kept);

}  // namespace aerascope
