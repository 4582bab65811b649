// The model graph as GraphML, for yEd, Gephi, Cytoscape, networkx, igraph and others. Every attribute has one
// type; there are none on the graph itself, which some readers stumble over.
#pragma once

#include <iosfwd>

#include "engine/base/result.h"
#include "engine/query/model_graph.h"

namespace aerascope {

Status WriteGraphml(const ModelGraph& graph, std::ostream& out);

}  // namespace aerascope
