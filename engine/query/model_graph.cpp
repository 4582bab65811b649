#include "engine/query/model_graph.h"

#include <algorithm>
#include <map>
#include <set>

namespace aerascope {
namespace {

ModelGraphNodeKind NodeKindOf(const Model& model) {
  switch (KindOf(model)) {
    case ModelKind::kCausal:
      return ModelGraphNodeKind::kCausalModel;
    case ModelKind::kWeakRequirement:
      return ModelGraphNodeKind::kRequirementModel;
    case ModelKind::kStrongRequirement:
      return ModelGraphNodeKind::kStrongRequirementModel;
    case ModelKind::kReuse:
      return ModelGraphNodeKind::kReuseModel;
    case ModelKind::kDrive:
      return ModelGraphNodeKind::kDriveModel;
  }
  return ModelGraphNodeKind::kCausalModel;
}

ModelGraphNode NodeOf(const KnowledgeBase& knowledge, const CompositeStateRecord& record) {
  ModelGraphNode node;
  node.id = IdText(record.state.id);
  node.kind = ModelGraphNodeKind::kCompositeState;
  node.state = record.state.id;
  const std::vector<Condition> conditions = ConditionsOf(knowledge, record.state);
  node.title = OneLine(conditions);
  for (const Condition& condition : conditions) node.lines.push_back(condition.text);
  node.origin = record.origin;
  node.created = record.created;
  node.event = record.event;
  node.content = record.canonical.hash;
  return node;
}

ModelGraphNode NodeOf(const KnowledgeBase& knowledge, const ModelRecord& record) {
  ModelGraphNode node;
  node.id = IdText(record.model.id);
  node.kind = NodeKindOf(record.model);
  node.model = record.model.id;
  node.title = TitleOf(knowledge, record.model.id);
  ModelLines lines = LinesOf(knowledge, record.model);
  node.lines = {std::move(lines.lhs), std::move(lines.rhs)};
  node.origin = record.origin;
  node.created = record.created;
  node.event = record.event;
  node.evidence = record.evidence;
  node.strong = record.strong;
  node.model_state = record.state;
  node.content = record.canonical.hash;
  return node;
}

class GraphMaker {
 public:
  GraphMaker(const KnowledgeBase& knowledge, DeletedModels deleted)
      : knowledge_(knowledge), deleted_(deleted) {}

  ModelGraph Make() {
    MakeNodes();
    for (const auto& [id, record] : knowledge_.composite_states()) MakeEdges(record);
    for (const auto& [id, record] : knowledge_.models()) {
      if (Shown(record)) MakeEdges(record);
    }
    std::sort(graph_.edges.begin(), graph_.edges.end());
    graph_.edges.erase(std::unique(graph_.edges.begin(), graph_.edges.end()), graph_.edges.end());
    MakeGroups();
    return std::move(graph_);
  }

 private:
  bool Shown(const ModelRecord& record) const {
    return deleted_ == DeletedModels::kInclude || record.state != ModelState::kDeleted;
  }

  // Composite states and models share one numbering, the order of creation.
  void MakeNodes() {
    for (const auto& [id, record] : knowledge_.composite_states())
      graph_.nodes.push_back(NodeOf(knowledge_, record));
    for (const auto& [id, record] : knowledge_.models()) {
      if (Shown(record)) graph_.nodes.push_back(NodeOf(knowledge_, record));
    }
    const auto number = [](const ModelGraphNode& node) {
      return node.is_model() ? node.model.value : node.state.value;
    };
    std::stable_sort(graph_.nodes.begin(), graph_.nodes.end(),
                     [&](const auto& a, const auto& b) { return number(a) < number(b); });
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) position_[graph_.nodes[i].id] = i;
  }

  void Connect(const ObjectId& from, const ObjectId& to, ModelGraphEdgeKind kind) {
    const auto a = position_.find(IdText(from));
    const auto b = position_.find(IdText(to));
    if (a != position_.end() && b != position_.end()) graph_.edges.push_back({a->second, b->second, kind});
  }

  template <class Visit>
  void ForEachState(const Term& payload, Visit&& visit) {
    ForEachTerm(payload, [&](const Term& term) {
      if (term.is(TermKind::kCompositeState)) visit(term.composite_state());
    });
  }

  void MakeEdges(const CompositeStateRecord& record) {
    for (const FactPattern& component : record.state.components) {
      ForEachState(component.payload, [&](CompositeStateId nested) {
        Connect(record.state.id, nested, ModelGraphEdgeKind::kContains);
      });
    }
    if (record.derived_from.valid())
      Connect(record.state.id, record.derived_from, ModelGraphEdgeKind::kDerivedFrom);
  }

  void MakeEdges(const ModelRecord& record) {
    const ModelId id = record.model.id;
    if (record.derived_from.valid()) Connect(id, record.derived_from, ModelGraphEdgeKind::kDerivedFrom);
    const ModelGraphEdgeKind of_state =
        IsRequirement(record.model) ? ModelGraphEdgeKind::kRequires : ModelGraphEdgeKind::kUses;
    for (const Term* side : {&record.model.lhs.payload, &record.model.rhs.payload}) {
      ForEachState(*side, [&](CompositeStateId state) { Connect(state, id, of_state); });
    }
    if (IsRequirement(record.model)) Connect(id, TargetModel(record.model), ModelGraphEdgeKind::kEnables);
    if (KindOf(record.model) == ModelKind::kReuse)
      Connect(TargetModel(record.model), id, ModelGraphEdgeKind::kReuses);
  }

  void MakeGroups() {
    std::map<ModelId, std::vector<const ModelRecord*>> by_target;
    for (const auto& [id, record] : knowledge_.models()) {
      if (!Shown(record)) continue;
      if (IsRequirement(record.model))
        by_target[TargetModel(record.model)].push_back(&record);
      else
        by_target.try_emplace(id);
    }
    for (const auto& [target, requirements] : by_target) {
      TriadGroup group{target, {}};
      // By source, so that the derived ones can follow; a source that is not in the group counts as none.
      std::map<ModelId, std::vector<const ModelRecord*>> by_source;
      std::set<ModelId> members;
      for (const ModelRecord* record : requirements) members.insert(record->model.id);
      for (const ModelRecord* record : requirements) {
        by_source[members.contains(record->derived_from) ? record->derived_from : ModelId{}].push_back(
            record);
      }
      AddTriads(by_source, &group);
      graph_.groups.push_back(std::move(group));
    }
  }

  // Depth first with a stack of our own: a chain of derivations may be long.
  static void AddTriads(const std::map<ModelId, std::vector<const ModelRecord*>>& by_source,
                        TriadGroup* group) {
    std::vector<std::pair<const ModelRecord*, int>> open;
    const auto push = [&](ModelId source, int generation) {
      const auto it = by_source.find(source);
      if (it == by_source.end()) return;
      for (auto record = it->second.rbegin(); record != it->second.rend(); ++record)
        open.emplace_back(*record, generation);
    };
    std::set<ModelId> added;
    const auto add_all = [&] {
      while (!open.empty()) {
        const auto [record, generation] = open.back();
        open.pop_back();
        if (!added.insert(record->model.id).second) continue;
        group->triads.push_back({RequiredState(record->model), record->model.id, TargetModel(record->model),
                                 record->derived_from, generation, record->origin, record->created});
        push(record->model.id, generation + 1);
      }
    };
    push(ModelId{}, 0);
    add_all();
    // Nothing is left out, not even models that a broken file derives from each other in a circle.
    for (const auto& [source, records] : by_source) {
      push(source, 1);
      add_all();
    }
  }

  const KnowledgeBase& knowledge_;
  DeletedModels deleted_;
  ModelGraph graph_;
  std::map<std::string, std::size_t> position_;
};

}  // namespace

std::string_view NameOf(ModelGraphNodeKind kind) {
  switch (kind) {
    case ModelGraphNodeKind::kCompositeState:
      return "composite_state";
    case ModelGraphNodeKind::kCausalModel:
      return "causal_model";
    case ModelGraphNodeKind::kRequirementModel:
      return "requirement_model";
    case ModelGraphNodeKind::kStrongRequirementModel:
      return "strong_requirement_model";
    case ModelGraphNodeKind::kReuseModel:
      return "reuse_model";
    case ModelGraphNodeKind::kDriveModel:
      return "drive_model";
  }
  return {};
}

std::string_view NameOf(ModelGraphEdgeKind kind) {
  switch (kind) {
    case ModelGraphEdgeKind::kRequires:
      return "requires";
    case ModelGraphEdgeKind::kEnables:
      return "enables";
    case ModelGraphEdgeKind::kContains:
      return "contains";
    case ModelGraphEdgeKind::kDerivedFrom:
      return "derived_from";
    case ModelGraphEdgeKind::kReuses:
      return "reuses";
    case ModelGraphEdgeKind::kUses:
      return "uses";
  }
  return {};
}

std::size_t ModelGraph::Find(const std::string& id) const {
  const auto it =
      std::find_if(nodes.begin(), nodes.end(), [&](const ModelGraphNode& node) { return node.id == id; });
  return static_cast<std::size_t>(it - nodes.begin());
}

ModelGraph MakeModelGraph(const KnowledgeBase& knowledge, DeletedModels deleted) {
  return GraphMaker(knowledge, deleted).Make();
}

}  // namespace aerascope
