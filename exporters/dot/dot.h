// The model graph as DOT, the language of Graphviz: composite states left, requirement models in the middle,
// causal models right. `dot -Tsvg` draws it.
#pragma once

#include <iosfwd>

#include "engine/base/result.h"
#include "engine/query/model_graph.h"

namespace aerascope {

Status WriteDot(const ModelGraph& graph, std::ostream& out);

}  // namespace aerascope
