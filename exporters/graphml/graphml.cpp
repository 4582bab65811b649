#include "exporters/graphml/graphml.h"

#include <functional>
#include <optional>
#include <ostream>

#include "engine/base/markup.h"
#include "engine/base/text.h"
#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

// One attribute of nodes: its name, its GraphML type, and its value; nothing where a node has none.
struct NodeAttribute {
  std::string_view name;
  std::string_view type;
  std::function<std::optional<std::string>(const ModelGraphNode&)> value;
};

std::string Exact(double number) {
  return FormatNumber(number, 17);
}

std::vector<NodeAttribute> NodeAttributes() {
  using Node = const ModelGraphNode&;
  using Value = std::optional<std::string>;
  const auto of_model = [](auto&& value) {
    return [value](Node node) -> Value { return node.is_model() ? Value(value(node)) : std::nullopt; };
  };
  return {
      {"kind", "string", [](Node node) -> Value { return std::string(NameOf(node.kind)); }},
      {"label", "string", [](Node node) -> Value { return node.title; }},
      {"definition", "string", [](Node node) -> Value { return Join(node.lines, "\n"); }},
      {"origin", "string", [](Node node) -> Value { return std::string(EnumName(node.origin)); }},
      {"created_us", "long", [](Node node) -> Value { return std::to_string(node.created.us); }},
      {"created_by_event", "long", [](Node node) -> Value { return std::to_string(node.event.value); }},
      {"content", "string", [](Node node) -> Value { return ToText(node.content); }},
      {"confidence", "double", of_model([](Node node) { return Exact(node.evidence.rate()); })},
      {"evidence_positive", "double", of_model([](Node node) { return Exact(node.evidence.positive); })},
      {"evidence_total", "double", of_model([](Node node) { return Exact(node.evidence.total); })},
      {"strong", "boolean", of_model([](Node node) { return std::string(node.strong ? "true" : "false"); })},
      {"state", "string", of_model([](Node node) { return std::string(EnumName(node.model_state)); })},
  };
}

}  // namespace

Status WriteGraphml(const ModelGraph& graph, std::ostream& out) {
  const std::vector<NodeAttribute> attributes = NodeAttributes();
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\"\n"
         "    xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
         "    xsi:schemaLocation=\"http://graphml.graphdrawing.org/xmlns "
         "http://graphml.graphdrawing.org/xmlns/1.0/graphml.xsd\">\n";
  for (const NodeAttribute& attribute : attributes) {
    out << "  <key id=\"node_" << attribute.name << "\" for=\"node\" attr.name=\"" << attribute.name
        << "\" attr.type=\"" << attribute.type << "\"/>\n";
  }
  out << "  <key id=\"edge_kind\" for=\"edge\" attr.name=\"kind\" attr.type=\"string\"/>\n"
         "  <graph id=\"knowledge\" edgedefault=\"directed\">\n";
  for (const ModelGraphNode& node : graph.nodes) {
    out << "    <node id=\"" << EscapeMarkup(node.id) << "\">\n";
    for (const NodeAttribute& attribute : attributes) {
      const std::optional<std::string> value = attribute.value(node);
      if (value)
        out << "      <data key=\"node_" << attribute.name << "\">" << EscapeMarkup(*value) << "</data>\n";
    }
    out << "    </node>\n";
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const ModelGraphEdge& edge = graph.edges[i];
    out << "    <edge id=\"e" << i + 1 << "\" source=\"" << EscapeMarkup(graph.nodes[edge.from].id)
        << "\" target=\"" << EscapeMarkup(graph.nodes[edge.to].id) << "\">\n      <data key=\"edge_kind\">"
        << NameOf(edge.kind) << "</data>\n    </edge>\n";
  }
  out << "  </graph>\n</graphml>\n";
  out.flush();
  return StatusOf(out, "the GraphML export");
}

}  // namespace aerascope
