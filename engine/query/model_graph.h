// The model graph: a knowledge base as nodes and edges, and as triads grouped by what they make possible.
//
// Order is fixed: nodes by number of creation, edges by their nodes; a triad made by analogy stands behind
// its source.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/query/describe.h"

namespace aerascope {

enum class ModelGraphNodeKind {
  kCompositeState,
  kCausalModel,
  kRequirementModel,
  kStrongRequirementModel,
  kReuseModel,
  kDriveModel,
};
// "composite_state", "causal_model", ...: stable names for exports.
std::string_view NameOf(ModelGraphNodeKind kind);

struct ModelGraphNode {
  std::string id;  // "cst_12", "mdl_14"
  ModelGraphNodeKind kind = ModelGraphNodeKind::kCompositeState;
  CompositeStateId state;  // of a composite state
  ModelId model;           // of a model
  std::string title;
  std::vector<std::string> lines;  // conditions of a composite state; left and right side of a model
  Origin origin = Origin::kSeed;
  Time created;
  EventId event;
  Evidence evidence;  // of a model
  bool strong = false;
  ModelState model_state = ModelState::kActive;
  Hash128 content;  // hash of the canonical form

  bool is_model() const { return model.valid(); }
};

enum class ModelGraphEdgeKind {
  kRequires,     // composite state -> requirement model on it
  kEnables,      // requirement model -> the model it speaks about
  kContains,     // composite state -> composite state that is one of its components
  kDerivedFrom,  // made by analogy -> its source
  kReuses,       // model -> reuse model that rides on it
  kUses,         // composite state -> another kind of model with an instance of it on a side
};
std::string_view NameOf(ModelGraphEdgeKind kind);

struct ModelGraphEdge {
  std::size_t from = 0;  // positions in ModelGraph::nodes
  std::size_t to = 0;
  ModelGraphEdgeKind kind = ModelGraphEdgeKind::kRequires;
  auto operator<=>(const ModelGraphEdge&) const = default;
};

// A composite state, the requirement model on it, and the causal model that one speaks about: one piece of
// knowledge.
struct Triad {
  CompositeStateId state;  // invalid where the requirement model's left side is a plain fact
  ModelId requirement;
  ModelId causal_model;
  ModelId derived_from;  // the requirement model it was generalised from; else invalid
  int generation = 0;    // 0 taught or learned, 1 derived from one of those, ...
  Origin origin = Origin::kSeed;
  Time created;
};
struct TriadGroup {
  ModelId causal_model;
  std::vector<Triad> triads;  // a derived one stands behind its source and that one's earlier derived ones
};

struct ModelGraph {
  std::vector<ModelGraphNode> nodes;
  std::vector<ModelGraphEdge> edges;
  std::vector<TriadGroup> groups;  // by number of the causal model; also such without requirement models

  // Position of a node in `nodes`; nodes.size() if there is none.
  std::size_t Find(const std::string& id) const;
};

// Deleted models are left out unless asked for.
enum class DeletedModels { kLeaveOut, kInclude };
ModelGraph MakeModelGraph(const KnowledgeBase& knowledge, DeletedModels deleted = DeletedModels::kLeaveOut);

}  // namespace aerascope
