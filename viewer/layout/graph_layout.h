// Positions for general graphs: chains, causes, goal trees. Graphviz as a library for graphs of a size it
// lays out well and quickly; a plain layered layout of our own, in linear time, for larger ones and where
// Graphviz is not to be had.
//
// Node sizes are given, fonts play no part, and equal input gives equal output. Any thread may call; Graphviz
// itself is used by one at a time.
#pragma once

#include <cstddef>
#include <vector>

#include "viewer/layout/geometry.h"

namespace aerascope {

// Graphviz takes seconds beyond this many nodes (and a few more edges).
inline constexpr std::size_t kMaxGraphvizNodes = 500;
inline constexpr std::size_t kMaxGraphvizEdges = 1500;

struct GraphLink {
  std::size_t from = 0;  // positions in GraphToPlace::nodes; links to nowhere are left out
  std::size_t to = 0;
};

enum class GraphDirection { kTopDown, kLeftRight };

struct GraphToPlace {
  std::vector<Size> nodes;
  std::vector<GraphLink> links;
  GraphDirection direction = GraphDirection::kLeftRight;
  int node_gap = 16;   // between nodes of one layer
  int layer_gap = 48;  // between layers
};

struct PlacedLink {
  std::size_t link = 0;  // position in GraphToPlace::links
  // Control points of joined cubic curves: 1 + 3n points, from the middle of the side of its first node that
  // faces the next layer to the middle of the opposite side of its last node.
  std::vector<Point> curve;
};

struct PlacedGraph {
  Size size;
  std::vector<Rect> nodes;
  std::vector<PlacedLink> links;
  bool by_graphviz = false;  // else by the plain layered layout
};

// Never fails: what Graphviz refuses goes to the layered layout.
PlacedGraph PlaceGraph(const GraphToPlace& graph);

// The layered layout: a node stands behind all that lead to it (links that close a circle are not counted),
// in order of the input inside a layer.
PlacedGraph PlaceLayered(const GraphToPlace& graph);

}  // namespace aerascope
