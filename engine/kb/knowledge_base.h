// The KnowledgeBase is everything an agent holds at one moment: its symbols, its composite states and models
// with their evidence, the facts that are in force, and the goals and predictions that are still open.
//
// It is a value moved forward by events only: `Apply(event, &knowledge_base)` (engine/event/apply.h) is the
// one caller of the functions under "changes". Iteration is by id, so by order of creation.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/kb/canonical.h"
#include "engine/kb/composite_state.h"
#include "engine/kb/model.h"
#include "engine/kb/pattern_index.h"

namespace aerascope {

// Where a piece of knowledge came from.
enum class Origin {
  kSeed,               // given by hand in the scenario
  kInduction,          // from a change nothing predicted (CTPX)
  kPredictionFailure,  // from a failed prediction (PTPX)
  kGoalSuccess,        // from an unexpectedly reached goal (GTPX)
  kAnalogy,            // by goal-driven analogy
};

enum class ModelState {
  kActive,
  kPhasedOut,  // strong, but failed too often: predicts silently until it recovers
  kDeleted,    // remembered on the black list by its content
};

enum class FactSource {
  kSensor,    // a value observed in this frame
  kProperty,  // static: essence, shape, size; in force for the whole episode
  kExecuted,  // a command that was really executed (efference copy)
  kAbsence,   // concluded from something expected that did not happen
};

struct FactRecord {
  FactId id;
  Fact fact;
  FactSource source = FactSource::kSensor;
  EventId event;
};

struct CompositeStateRecord {
  CompositeState state;
  Origin origin = Origin::kSeed;
  CompositeStateId derived_from;  // by analogy; else invalid
  Time created;
  EventId event;
  Canonical canonical;
};

struct ModelRecord {
  Model model;
  Origin origin = Origin::kSeed;
  ModelId derived_from;  // by analogy; else invalid
  Time created;
  EventId event;
  Evidence evidence;
  bool strong = false;  // confirmed often enough (strength 1, semantics 3.5)
  ModelState state = ModelState::kActive;
  Canonical canonical;
  EventId rated = {};         // the last event that moved the evidence; invalid if none did
  bool black_listed = false;  // deleted because it failed: not to be learned again
  EventId moved = {};         // the last event that changed the state; invalid if none did
};

struct GoalRecord {
  GoalId id;
  GoalId super_goal;  // invalid for a drive
  Fact target;        // payload may hold variables and wildcards
  EventId event;
};

struct PredictionRecord {
  PredictionId id;
  ModelId model;
  std::vector<ModelId> requirements;  // the weak requirement models that allowed it
  Fact target;
  EventId event;
  std::vector<PredictionId> grounds = {};  // the predictions it was made from; none if it rests on facts
};

class KnowledgeBase {
 public:
  const std::vector<Term>& symbols() const { return symbols_; }
  const std::map<CompositeStateId, CompositeStateRecord>& composite_states() const {
    return composite_states_;
  }
  const std::map<ModelId, ModelRecord>& models() const { return models_; }  // deleted ones included
  const std::map<FactId, FactRecord>& facts() const { return facts_; }      // in force in the current frame
  const std::map<GoalId, GoalRecord>& goals() const { return goals_; }
  const std::map<PredictionId, PredictionRecord>& predictions() const { return predictions_; }
  std::size_t models_in_use() const { return models_in_use_; }  // not deleted
  Time now() const { return now_; }
  std::int64_t frame() const { return frame_; }

  const CompositeStateRecord* Find(CompositeStateId id) const;
  const ModelRecord* Find(ModelId id) const;
  // The knowledge with this content; an invalid id if there is none. Deleted models are included; but one
  // that is not black-listed gives way to an equal one made later.
  CompositeStateId FindState(Hash128 content) const;
  ModelId FindModel(Hash128 content) const;
  Canonical CanonicalOf(const CompositeState& state) const;
  Canonical CanonicalOf(const Model& model) const;
  // The weak and strong requirement models that speak about a causal model and are not deleted, by id.
  const std::vector<ModelId>& RequirementsOf(ModelId causal_model) const;

  // Found by index, so that the time does not grow with the knowledge that has nothing to do with it.
  // The models, not deleted, whose left side the payload of a fact can match; by id.
  std::vector<ModelId> ModelsByLhs(const Term& payload) const;
  // The models, not deleted, whose right side a wanted payload can match, variables and wildcards matching
  // anything; by id.
  std::vector<ModelId> ModelsByRhs(const Term& payload) const;
  // Calls visit(CompositeStateId) for composite states that may hold because the payload of a fact holds.
  // Each composite state is found by one of its components only, the one that fewest facts match: where all
  // its components hold, that one does too.
  template <class Visit>
  void ForEachStateFor(const Term& payload, Visit&& visit) const {
    key_components_.Find(payload, visit);
  }

  // Changes; called by Apply only.
  void SetNow(Time now, std::int64_t frame);
  void AddSymbol(Term symbol);
  void AddFact(FactRecord record);
  void ExpireFacts(Time now);                           // drops facts whose interval ended at or before now
  void AddCompositeState(CompositeStateRecord record);  // computes the canonical form
  void AddModel(ModelRecord record);                    // computes the canonical form
  void SetEvidence(ModelId id, Evidence evidence, bool strong, EventId event = {});
  void SetState(ModelId id, ModelState state, bool black_listed = false, EventId event = {});
  void OpenGoal(GoalRecord record);
  void CloseGoal(GoalId id);
  void OpenPrediction(PredictionRecord record);
  void ClosePrediction(PredictionId id);

 private:
  void Index(const ModelRecord& record);
  void Unindex(const ModelRecord& record);
  Definitions DefinitionsHere() const;
  aerascope::CanonicalOf CanonicalLookup() const;

  Time now_;
  std::int64_t frame_ = 0;
  std::size_t models_in_use_ = 0;
  std::vector<Term> symbols_;
  std::map<CompositeStateId, CompositeStateRecord> composite_states_;
  std::map<ModelId, ModelRecord> models_;
  std::map<FactId, FactRecord> facts_;
  std::map<GoalId, GoalRecord> goals_;
  std::map<PredictionId, PredictionRecord> predictions_;
  std::map<Hash128, CompositeStateId> state_by_content_;
  std::map<Hash128, ModelId> model_by_content_;
  std::map<ModelId, std::vector<ModelId>> requirements_;
  PatternIndex<CompositeStateId, false> key_components_;
  PatternIndex<ModelId, false> left_sides_;  // of models that are not deleted
  PatternIndex<ModelId, true> right_sides_;  // of the same
};

}  // namespace aerascope
