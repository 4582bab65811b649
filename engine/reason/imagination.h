// An ImaginedFrame is what is expected to hold in one frame of a plan: a situation, what is still to come,
// and, asked for piece by piece, which composite states hold there and what the requirement models say about
// it.
//
// What nothing contradicts holds on from frame to frame (semantics 3.1: promotion, the frame axiom), and what
// contradicts it puts an end to it. Knowledge is consulted on demand, so a frame costs what its plan asks
// about and not the whole knowledge base. Not thread-safe: asking fills in.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/situation.h"

namespace aerascope {

class ImaginedFrame {
 public:
  // The present: instances and requirements that forward chaining found are in the situation already.
  // `pending` are predictions for later frames.
  static ImaginedFrame Present(Situation situation, std::vector<SituationFact> pending);

  const Situation& situation() const { return situation_; }
  TimeInterval interval() const { return situation_.interval(); }
  const std::vector<SituationFact>& pending() const { return pending_; }

  // Makes the instances of the states nested in this one (and of itself) findable in the situation.
  void FindParts(const KnowledgeBase& knowledge, const CompositeState& state);
  void FindInstances(const KnowledgeBase& knowledge, const CompositeState& state);
  // Makes the requirement models that speak about the model say what they have to say, vetoes included; also
  // what they said in earlier frames about this one.
  void AskRequirements(const KnowledgeBase& knowledge, ModelId model);

  struct Defeat {
    SituationFact fact;  // would have held on
    SituationFact by;    // the effect against it
  };
  struct Passage;
  // One period later (or, with period zero, later in the same frame), if `effects` come about when their
  // intervals say.
  Passage Next(std::vector<SituationFact> effects, Duration period) const;

 private:
  explicit ImaginedFrame(Situation situation) : situation_(std::move(situation)) {}

  Situation situation_;
  std::vector<SituationFact> pending_;
  bool present_ = false;
  std::set<CompositeStateId> found_;
  std::set<ModelId> asked_;
  // The frame before, as far as it was imagined: requirement models may have spoken there about this one.
  // Shared by all frames that follow it.
  std::shared_ptr<ImaginedFrame> before_;
};

struct ImaginedFrame::Passage {
  ImaginedFrame frame;
  std::vector<SituationFact> arrived;  // effects and earlier predictions that came about in it
  std::vector<Defeat> defeated;
};

// Which predictions: those made from facts, or also those that rest on others.
enum class Pending { kFromFacts, kAll };

// What is open to be expected: targets of predictions that are not silent, after the frame of the situation.
std::vector<SituationFact> PendingPredictions(const KnowledgeBase& knowledge, const Situation& situation,
                                              Pending which);

// Would the effect put an end to the fact: the same thing with the other polarity, or with another value?
bool PutsAnEndTo(const Fact& effect, const Fact& fact);

}  // namespace aerascope
