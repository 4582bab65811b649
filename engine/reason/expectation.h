// Expectations: what is expected because something else is expected. Predictions are inputs of models as
// facts are (semantics 3.1, 3.3): where predicted facts, with what always holds, let a composite state hold
// and a model fire, its right side is predicted too, with confidence = least input x model.
//
// Such a prediction names the predictions it rests on (its grounds). It is not rated: only what follows from
// facts is. It is given up (PredictionInvalidated)
// - when one of its grounds does not come true or is outweighed, and with it what rests on it in turn;
// - when all of them came true: then its model fires on the facts, and what it predicts from them takes its
//   place (renewed), or nothing does (not renewed);
// - when its time comes before its grounds are decided (overdue);
// - as any prediction is: when a surer one speaks against it (outweighing.h).
//
// Own rules: a chain of predictions ends after max_prediction_chain links, so that a cycle of models does not
// go on for ever, and there are at most 1000 expectations at a time; what a model predicts already is not
// predicted again, and what was outweighed not as long as what outweighed it is open; where a prediction
// takes the place of one with the same target and confidence, what rested on the old one rests on the new one
// from then on.
#pragma once

#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "engine/reason/chaining.h"
#include "engine/reason/journal.h"
#include "engine/reason/outweighing.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

// How a prediction ended in this frame.
struct Conclusion {
  EventId event;
  bool came_true = false;
  FactId shown_by;          // invalid if nothing came in time
  PredictionId surer = {};  // what outweighed it, or what it rested on
};
using Conclusions = std::map<PredictionId, Conclusion>;

class Expectations {
 public:
  // Both outlive it.
  Expectations(const ReasonerParameters& parameters, Duration period, Journal* journal)
      : parameters_(parameters), period_(period), journal_(*journal) {}

  // A surer prediction speaks against this one.
  void Outweigh(const Outweighed& one, Conclusions* concluded, Time now);

  // When predictions have been concluded otherwise than by Renew: gives up what rested on those that failed.
  // What is given up is added to the conclusions.
  void GiveUp(Conclusions* concluded, Time now);

  // One prediction in the place of another.
  struct Renewal {
    PredictionId old;
    PredictionId now;
  };
  // When models have fired on the facts of this frame: gives up what rested on predictions that came true.
  std::vector<Renewal> Renew(Conclusions* concluded, Time now);

  // Chains forward from what is open. `said`: what requirement models said earlier about later frames.
  void Extend(const Situation& present, const std::vector<Requirement>& said, Time now);

 private:
  struct Link {
    std::vector<PredictionId> grounds;  // still undecided
    EventId seen;                       // the conclusion of one that came true
    FactId shown_by;
  };
  struct ExpectedFrame;

  void Invalidate(const PredictionInvalidated& end, EventId because, Conclusions* concluded, Time now);
  bool MayChain(const Fact& expected) const;
  ExpectedFrame Imagine(std::int64_t frames_ahead, const Situation& present,
                        const std::vector<Requirement>& said) const;
  bool ExtendIn(ExpectedFrame* frame, Time now);
  bool FireOn(const Fact& input, const std::vector<PredictionId>& grounds, EventId because,
              ExpectedFrame* frame, Time now, int ridden);
  bool Predicted(ModelId model, const Fact& target) const;
  int DepthOf(const std::vector<PredictionId>& grounds, std::map<PredictionId, int>* known) const;
  void Report(ModelId model, const ChainingDecision& decision, const std::vector<PredictionId>& grounds,
              EventId because, const ExpectedFrame& frame, Time now);

  const ReasonerParameters& parameters_;
  Duration period_;
  Journal& journal_;
  std::map<PredictionId, Link> links_;  // of the open predictions that rest on others
  // What was given up for a surer prediction, while that is open.
  std::multimap<PredictionId, PredictionRecord> outweighed_;
  // Decisions that were said, while the prediction that they are about is open.
  std::set<std::tuple<ModelId, PredictionId, ChainingStatus>> reported_;
  // Models that fire on a composite state are few; all others are found by what is predicted.
  std::set<ModelId> on_states_;
  ModelId last_seen_;
};

}  // namespace aerascope
