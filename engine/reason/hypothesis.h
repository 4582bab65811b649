// Hypotheses by analogy, for one decision: comparisons made while chaining backwards, what each would add to
// the knowledge, and the adoption of those that a plan needs (paper, section 5; semantics 6.2).
//
// In paper mode a hypothesis becomes knowledge only if a goal needs it, is not made twice and not after it
// was refuted. In openaera mode each comparison that passes becomes knowledge at once, and again each time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/reason/analogy.h"
#include "engine/reason/plan.h"

namespace aerascope {

// Called when a hypothesis became knowledge, so that the present situation is offered to it at once.
using OfferKnowledge = std::function<void(CompositeStateId, ModelId)>;

class Hypotheses {
 public:
  Hypotheses(const PlanningContext& context, const OfferKnowledge& offer, Journal* journal)
      : context_(context), offer_(offer), journal_(*journal), knowledge_(journal->knowledge()) {}

  // A comparison worth a hypothesis, and the definitions it would add.
  struct Candidate {
    Comparison comparison;
    GoalEntry goal;
    Hypothesis hypothesis;
    Bindings bindings;  // of the hypothesis' composite state
    bool in_a_plan = false;
    bool adopted = false;
    ModelId requirement;  // once adopted
    EventId created;      // the event that created it, if adoption did
    EventId refuted;      // of a black-listed one: the event that made it fall
  };

  // Compares the requirement's composite state (under the bindings the goal gives) with the frame, once for
  // each wanted payload. The position of the candidate if it may become a hypothesis, else -1.
  int Consider(const ModelRecord& requirement, const CompositeStateRecord& state, const Bindings& bindings,
               ImaginedFrame* frame, const Fact& wanted, const GoalEntry& goal,
               const CanBringAbout& can_bring_about);

  const Candidate& operator[](int i) const { return candidates_[static_cast<std::size_t>(i)]; }
  void NoteInPlan(int i) { candidates_[static_cast<std::size_t>(i)].in_a_plan = true; }

  // Makes the hypotheses of the plan's steps knowledge, nearest to the goal first (paper, figure 1 right: M2*
  // before M1*), and puts their numbers into the steps. Returns the events that created them.
  std::vector<EventId> Adopt(Plan* plan);
  // Makes all of them knowledge in the order considered (openaera mode).
  void AdoptAll();

  // Comparisons that could give no hypothesis; and, at the end, those that were not needed. `searched`: plans
  // through hypotheses were looked for.
  void ReportRejected();
  void ReportLeftOver(bool searched);
  // The comparisons reported as black-listed, in order.
  const std::vector<EventId>& refused() const { return refused_; }
  // All comparisons that led to nothing wanted: rejected, or no plan through them reaches the goal. In order.
  const std::vector<EventId>& fruitless() const { return fruitless_; }

 private:
  const ModelRecord* BlackListed(const Hypothesis& hypothesis) const;
  Model WithState(const Hypothesis& hypothesis, const CompositeStateRecord& record) const;
  AnalogyCompared Describe(const Candidate& candidate, AnalogyVerdict verdict) const;
  std::vector<EventId> CausesOf(const Candidate& candidate) const;
  void AdoptOne(Candidate* candidate);

  const PlanningContext& context_;
  const OfferKnowledge& offer_;
  Journal& journal_;
  const KnowledgeBase& knowledge_;
  std::vector<Candidate> candidates_;
  std::map<std::string, int> position_of_;
  std::vector<EventId> refused_;
  std::vector<EventId> fruitless_;
};

}  // namespace aerascope
