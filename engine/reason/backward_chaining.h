// Backward chaining: from a goal, through models whose right side it matches, to what would have to be done
// and to hold (semantics 4.2 to 4.4). The result are plans, each with the frame it should end in; every goal
// on the way and every branch not taken is logged.
//
// Chained through are causal models with a command on the left (the step is that command), causal models with
// a fact on the left (that fact becomes a goal, and the step is to wait), and reuse models (the goal becomes
// an instance of another model, the step is that one's). Requirement models give composite states, whose
// missing parts become goals; requirement models may have requirements themselves.
//
// The class is one recursion in three files: goals (backward_chaining.cpp), what allows a model to fire
// (backward_conditions.cpp), and its firing (backward_firing.cpp).
#pragma once

#include <optional>
#include <vector>

#include "engine/reason/arrangement.h"
#include "engine/reason/feasibility.h"
#include "engine/reason/hypothesis.h"
#include "engine/reason/plan.h"

namespace aerascope {

class BackwardChainer {
 public:
  // All outlive the chainer.
  BackwardChainer(const PlanningContext& context, GoalLog* goals, Hypotheses* hypotheses)
      : context_(context),
        knowledge_(context.knowledge),
        goals_(*goals),
        hypotheses_(*hypotheses),
        feasibility_(context) {}

  // Plans that bring the target about from the frame, best first. With `through_hypotheses`, conditions
  // generalised by analogy are taken too; otherwise they are only compared. Each call has the whole budget of
  // nodes.
  std::vector<Plan> PlansFor(const Fact& target, const GoalEntry& goal,
                             const std::shared_ptr<ImaginedFrame>& from, bool through_hypotheses);

 private:
  using Frame = std::shared_ptr<ImaginedFrame>;
  static constexpr int kMaxWait = 32;  // frames waited for one effect

  // A frame in which a model is allowed to fire, how one gets there, and what is bound by what allows it.
  struct Way {
    Plan plan;
    Bindings bindings;      // of the model
    double confidence = 1;  // of the requirement model's statement; 1 if none is needed
    bool required = false;
    ModelId requirement;
    int hypothesis = -1;
  };
  // A firing at the end of a plan.
  struct Firing {
    Plan plan;  // up to the frame of the firing
    Step step;
    Bindings bindings;
    std::vector<SituationFact> effects;
  };
  // A frame in which a composite state holds, how one gets there, and its instance.
  struct Held {
    Plan plan;
    Bindings bindings;
    double confidence = 1;
  };
  // The goal a search is for, and where it stands in the tree.
  struct Quest {
    Fact target;
    GoalEntry goal;
    int depth = 0;
  };

  std::vector<Plan> Achieve(const Quest& quest, const Frame& from);
  std::optional<Plan> WaitFor(const Quest& quest, const Frame& from);
  GoalSkipReason WhyOutOfReach(const Term& payload) const;
  void AchieveThrough(const ModelRecord& record, const Bindings& bindings, const Quest& quest,
                      const Frame& from, std::vector<Plan>* plans);
  std::vector<Way> Enable(const ModelRecord& record, const Bindings& bindings, const Quest& quest,
                          const Frame& from);
  std::vector<ModelId> ConditionsFor(const Model& model, const Bindings& bindings) const;
  void EnableThrough(const ModelRecord& requirement, const ModelRecord& record, const Bindings& bindings,
                     const Bindings& required, const Quest& quest, const Frame& from, std::vector<Way>* ways);
  void EnableByAnalogy(const ModelRecord& requirement, const CompositeStateRecord& required,
                       const ModelRecord& record, const Bindings& bindings, const Bindings& state_bindings,
                       const Quest& quest, const Frame& from, std::vector<Way>* ways);
  bool Allow(const ModelRecord& requirement, const CompositeState& state, const Bindings& bindings,
             const Quest& quest, Held* held);
  std::optional<Way> Complete(const Model& requirement, double rate, const Held& held, const Term& instance,
                              const Model& model, const Bindings& bindings) const;
  bool Hold(const CompositeState& state, const Bindings& bindings, const Quest& quest, const Frame& from,
            std::vector<Held>* held);
  bool BringAbout(const CompositeState& state, const FlatState& flat, const Arrangement& arrangement,
                  const Quest& quest, const Frame& from, std::vector<Held>* held);
  void SkipWhatHolds(const FlatState& flat, const Arrangement& arrangement, const Quest& quest,
                     const ImaginedFrame& frame);
  std::vector<Plan> InOrder(const std::vector<Fact>& wanted, const Quest& quest, const Frame& from);
  std::vector<Firing> Fire(const ModelRecord& record, const Way& way, const Quest& quest, const Fact* wanted);
  std::vector<Firing> FireOnFact(const ModelRecord& record, const Way& way, const Quest& quest,
                                 const Fact* wanted);
  std::vector<Firing> FireOnInstance(const ModelRecord& record, const Way& way, const Quest& quest,
                                     const Fact* wanted);
  std::optional<Firing> Finish(const ModelRecord& record, const Way& way, const Bindings& bindings, Step step,
                               const Quest& quest, const Fact* wanted);
  std::optional<Plan> Advance(Firing firing, const Fact& wanted);
  EventId VetoOn(const Model& model, const Bindings& bindings, const Way& way) const;
  EventId VetoOnInstance(const Model& model, const Bindings& bindings, const Frame& at) const;
  EventId EventOf(const Requirement& requirement) const;
  bool StillAllowed(const Model& model, const Way& way) const;
  bool Expected(const FactPattern& part, const ImaginedFrame& frame) const;

  bool Spend(const Quest& quest);

  const PlanningContext& context_;
  const KnowledgeBase& knowledge_;
  GoalLog& goals_;
  Hypotheses& hypotheses_;
  Feasibility feasibility_;
  bool through_hypotheses_ = false;
  int nodes_ = 0;
  std::vector<Fact> stack_;  // goals being pursued, outermost first
};

}  // namespace aerascope
