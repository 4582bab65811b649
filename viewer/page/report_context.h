// What all parts of the report's data share: the run, what was asked of it once, and how things are called
// and linked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"
#include "engine/query/goal_tree.h"
#include "engine/query/model_history.h"
#include "engine/query/run.h"

namespace aerascope {

// A stretch of time in which the variables of a piece of knowledge stood for something: a prediction rests on
// it, the state of a requirement model is seen to hold (whatever comes of it), or a comparison put things in
// their place.
struct Use {
  Time from;
  Time until;
  std::vector<Binding> bindings;
  enum class Kind { kPrediction, kHolds, kCompared } kind = Kind::kPrediction;
};

struct ReportContext {
  explicit ReportContext(const Run& the_run);

  const Run& run;
  const KnowledgeBase& knowledge;  // at the end of the run
  EpisodeSummary summary;
  GoalTree goals;
  std::map<ModelId, ModelHistory> histories;
  std::map<ModelId, EventId> comparison_of;            // requirement model made by analogy -> the comparison
  std::map<CompositeStateId, ModelId> requirement_on;  // the first requirement model on a composite state
  std::map<ModelId, std::vector<Use>> uses;            // of requirement and causal models, by time

  // The id of the knowledge that a card of a composite state belongs to: its first requirement model, else
  // itself; empty if there is no such state.
  std::string SubjectOf(CompositeStateId state) const;
  // When a model left the knowledge base; nothing while it is there.
  std::optional<Time> DeletedAt(ModelId model) const;

 private:
  void CollectComparisons();
  void CollectUses();
  void CollectInstances();
};

// The mark of an event: the name of a symbol of the page without "m-".
std::string MarkOf(const Event& event);
std::string MarkOf(Origin origin);
bool TellsOfFailure(const Event& event);

// The thing an analogy is about: what the first missed condition speaks of, else the last entity bound; may
// be empty.
std::string ObjectOf(const AnalogyCompared& compared);

}  // namespace aerascope
