#include "exporters/json/json.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

using Json = nlohmann::ordered_json;

Json JsonOf(const ModelGraphNode& node) {
  Json json = {{"id", node.id},
               {"kind", NameOf(node.kind)},
               {"title", node.title},
               {"lines", node.lines},
               {"origin", EnumName(node.origin)},
               {"created_us", node.created.us},
               {"created_by_event", node.event.value},
               {"content", ToText(node.content)}};
  if (!node.is_model()) return json;
  json["confidence"] = node.evidence.rate();
  json["evidence"] = {{"positive", node.evidence.positive}, {"total", node.evidence.total}};
  json["strong"] = node.strong;
  json["state"] = EnumName(node.model_state);
  return json;
}

// null for a composite state, model or source that is not there.
template <class IdType>
Json JsonOf(IdType id) {
  return id.valid() ? Json(IdText(id)) : Json(nullptr);
}

Json JsonOf(const TriadGroup& group) {
  Json triads = Json::array();
  for (const Triad& triad : group.triads) {
    triads.push_back({{"state", JsonOf(triad.state)},
                      {"requirement", JsonOf(triad.requirement)},
                      {"derived_from", JsonOf(triad.derived_from)},
                      {"generation", triad.generation}});
  }
  return {{"model", JsonOf(group.causal_model)}, {"triads", std::move(triads)}};
}

}  // namespace

Status WriteModelGraphJson(const ModelGraph& graph, std::ostream& out) {
  Json nodes = Json::array();
  Json edges = Json::array();
  Json groups = Json::array();
  for (const ModelGraphNode& node : graph.nodes) nodes.push_back(JsonOf(node));
  for (const ModelGraphEdge& edge : graph.edges) {
    edges.push_back(
        {{"from", graph.nodes[edge.from].id}, {"to", graph.nodes[edge.to].id}, {"kind", NameOf(edge.kind)}});
  }
  for (const TriadGroup& group : graph.groups) groups.push_back(JsonOf(group));
  const Json json = {{"format", "aerascope model graph"},
                     {"version", 1},
                     {"nodes", std::move(nodes)},
                     {"edges", std::move(edges)},
                     {"groups", std::move(groups)}};
  out << json.dump(2, ' ', true, Json::error_handler_t::replace) << "\n";
  out.flush();
  return StatusOf(out, "the JSON export");
}

}  // namespace aerascope
