// The model graph as JSON in ASCII, with keys in a fixed order: {"format", "version", "nodes", "edges",
// "groups"}.
#pragma once

#include <iosfwd>

#include "engine/base/result.h"
#include "engine/query/model_graph.h"

namespace aerascope {

Status WriteModelGraphJson(const ModelGraph& graph, std::ostream& out);

}  // namespace aerascope
