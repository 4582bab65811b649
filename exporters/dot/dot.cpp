#include "exporters/dot/dot.h"

#include <ostream>

#include "engine/base/text.h"
#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

std::string_view ShapeOf(ModelGraphNodeKind kind) {
  switch (kind) {
    case ModelGraphNodeKind::kCompositeState:
      return "box";
    case ModelGraphNodeKind::kCausalModel:
      return "box";
    case ModelGraphNodeKind::kRequirementModel:
      return "ellipse";
    case ModelGraphNodeKind::kStrongRequirementModel:
      return "octagon";
    case ModelGraphNodeKind::kReuseModel:
      return "box";
    case ModelGraphNodeKind::kDriveModel:
      return "house";
  }
  return "box";
}

std::string LabelOf(const ModelGraphNode& node) {
  std::string label = node.id;
  const bool requirement = node.kind == ModelGraphNodeKind::kRequirementModel ||
                           node.kind == ModelGraphNodeKind::kStrongRequirementModel;
  // A requirement model's sides stand on its neighbours already.
  if (requirement) {
    label += "\n" + node.title;
  } else {
    for (const std::string& line : node.lines) label += "\n" + line;
  }
  if (node.is_model()) label += "\nconfidence " + FormatConfidence(node.evidence.rate());
  return label + "\n";
}

std::string StyleOf(const ModelGraphNode& node) {
  std::string style = node.kind == ModelGraphNodeKind::kCausalModel ? "bold" : "solid";
  if (node.origin == Origin::kAnalogy) style += ",rounded";
  if (node.is_model() && node.model_state != ModelState::kActive) style = "dashed";
  return node.kind == ModelGraphNodeKind::kRequirementModel && style != "dashed" ? "solid" : style;
}

std::string_view StyleOf(ModelGraphEdgeKind kind) {
  switch (kind) {
    case ModelGraphEdgeKind::kRequires:
    case ModelGraphEdgeKind::kEnables:
    case ModelGraphEdgeKind::kReuses:
    case ModelGraphEdgeKind::kUses:
      return "solid";
    case ModelGraphEdgeKind::kContains:
      return "dotted";
    case ModelGraphEdgeKind::kDerivedFrom:
      return "dashed";
  }
  return "solid";
}

}  // namespace

Status WriteDot(const ModelGraph& graph, std::ostream& out) {
  out << "digraph knowledge {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n  edge "
         "[fontname=\"sans-serif\"];\n";
  for (const ModelGraphNode& node : graph.nodes) {
    out << "  " << DotQuoted(node.id) << " [label=" << DotQuoted(LabelOf(node))
        << ", shape=" << ShapeOf(node.kind) << ", style=" << DotQuoted(StyleOf(node))
        << ", tooltip=" << DotQuoted(node.title) << "];\n";
  }
  for (const ModelGraphEdge& edge : graph.edges) {
    // Where something came from, or what it contains, does not order the drawing.
    const bool side =
        edge.kind == ModelGraphEdgeKind::kDerivedFrom || edge.kind == ModelGraphEdgeKind::kContains;
    out << "  " << DotQuoted(graph.nodes[edge.from].id) << " -> " << DotQuoted(graph.nodes[edge.to].id)
        << " [label=" << DotQuoted(NameOf(edge.kind)) << ", style=" << StyleOf(edge.kind)
        << (side ? ", constraint=false" : "") << "];\n";
  }
  out << "}\n";
  out.flush();
  return StatusOf(out, "the DOT export");
}

}  // namespace aerascope
