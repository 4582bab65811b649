#include "viewer/layout/graph_layout.h"

#include <gtest/gtest.h>

#include <random>

namespace aerascope {
namespace {

GraphToPlace Tree(std::size_t nodes) {
  GraphToPlace graph;
  for (std::size_t i = 0; i < nodes; ++i) {
    graph.nodes.push_back({80 + static_cast<int>(i % 3) * 20, 28});
    if (i > 0) graph.links.push_back({(i - 1) / 3, i});
  }
  return graph;
}

void ExpectSound(const GraphToPlace& graph, const PlacedGraph& placed) {
  ASSERT_EQ(placed.nodes.size(), graph.nodes.size());
  for (std::size_t i = 0; i < placed.nodes.size(); ++i) {
    EXPECT_EQ((Size{placed.nodes[i].width, placed.nodes[i].height}), graph.nodes[i]);
    EXPECT_GE(placed.nodes[i].x, 0);
    EXPECT_GE(placed.nodes[i].y, 0);
    EXPECT_LE(placed.nodes[i].right(), placed.size.width);
    EXPECT_LE(placed.nodes[i].bottom(), placed.size.height);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(Overlap(placed.nodes[i], placed.nodes[j])) << i << " and " << j;
  }
  for (const PlacedLink& link : placed.links) {
    EXPECT_GE(link.curve.size(), 4u);
    EXPECT_EQ(link.curve.size() % 3, 1u);
  }
}

TEST(GraphLayout, GraphvizPlacesASmallGraphFromLeftToRight) {
  const GraphToPlace tree = Tree(10);

  const PlacedGraph placed = PlaceGraph(tree);

  EXPECT_TRUE(placed.by_graphviz);
  ExpectSound(tree, placed);
  for (const GraphLink& link : tree.links)
    EXPECT_LT(placed.nodes[link.from].right(), placed.nodes[link.to].x);
  EXPECT_EQ(placed.links.size(), tree.links.size());
}

TEST(GraphLayout, TopDownPutsEffectsBelowCauses) {
  GraphToPlace tree = Tree(10);
  tree.direction = GraphDirection::kTopDown;

  for (const PlacedGraph& placed : {PlaceGraph(tree), PlaceLayered(tree)}) {
    ExpectSound(tree, placed);
    for (const GraphLink& link : tree.links)
      EXPECT_LT(placed.nodes[link.from].bottom(), placed.nodes[link.to].y);
  }
}

TEST(GraphLayout, LinksLeaveAndEnterNodesByTheSidesThatFaceEachOther) {
  // Steep links ended above or below a node, and the node covered half of the arrow head.
  GraphToPlace graph = Tree(12);
  for (std::size_t i = 2; i < 12; ++i) graph.links.push_back({0, i});  // long and steep ones
  graph.nodes[4].height = 150;
  for (const GraphDirection direction : {GraphDirection::kLeftRight, GraphDirection::kTopDown}) {
    graph.direction = direction;
    for (const PlacedGraph& placed : {PlaceGraph(graph), PlaceLayered(graph)}) {
      ASSERT_EQ(placed.links.size(), graph.links.size());
      for (const PlacedLink& link : placed.links) {
        const Rect& from = placed.nodes[graph.links[link.link].from];
        const Rect& to = placed.nodes[graph.links[link.link].to];
        const bool across = direction == GraphDirection::kLeftRight;
        EXPECT_NEAR(across ? link.curve.front().x : link.curve.front().y,
                    across ? from.right() : from.bottom(), 2);
        EXPECT_NEAR(across ? link.curve.front().y : link.curve.front().x,
                    across ? from.centre().y : from.centre().x, 2);
        EXPECT_NEAR(across ? link.curve.back().x : link.curve.back().y, across ? to.x : to.y, 2);
        EXPECT_NEAR(across ? link.curve.back().y : link.curve.back().x,
                    across ? to.centre().y : to.centre().x, 2);
      }
    }
  }
}

TEST(GraphLayout, TheSameGraphIsPlacedTheSameEachTime) {
  const GraphToPlace tree = Tree(60);
  const PlacedGraph first = PlaceGraph(tree);

  for (int again = 0; again < 3; ++again) {
    const PlacedGraph placed = PlaceGraph(tree);
    EXPECT_EQ(placed.nodes, first.nodes);
    ASSERT_EQ(placed.links.size(), first.links.size());
    for (std::size_t i = 0; i < placed.links.size(); ++i)
      EXPECT_EQ(placed.links[i].curve, first.links[i].curve);
  }
}

TEST(GraphLayout, LargeGraphsGoToThePlainLayout) {
  const GraphToPlace tree = Tree(3000);

  const PlacedGraph placed = PlaceGraph(tree);

  EXPECT_FALSE(placed.by_graphviz);
  ExpectSound(tree, placed);
}

TEST(GraphLayout, CirclesAndLinksToItselfAreDrawnNotFollowed) {
  GraphToPlace graph;
  graph.nodes = {{40, 20}, {40, 20}, {40, 20}};
  graph.links = {{0, 1}, {1, 2}, {2, 0}, {1, 1}, {0, 99}};

  for (const PlacedGraph& placed : {PlaceGraph(graph), PlaceLayered(graph)}) {
    ExpectSound(graph, placed);
    EXPECT_EQ(placed.links.size(), 4u) << "the link to nowhere is left out";
  }
}

TEST(GraphLayout, CurvesBeginAtTheirSource) {
  GraphToPlace graph;
  graph.nodes = {{40, 20}, {40, 20}, {40, 20}};
  graph.links = {{0, 1}, {1, 2}, {2, 0}};

  const PlacedGraph placed = PlaceGraph(graph);

  for (const PlacedLink& link : placed.links) {
    const Rect& from = placed.nodes[graph.links[link.link].from];
    const Rect grown{from.x - 3, from.y - 3, from.width + 6, from.height + 6};
    EXPECT_TRUE(Overlap(grown, Rect{link.curve.front().x, link.curve.front().y, 1, 1}));
  }
}

TEST(GraphLayout, NothingGivesNothing) {
  EXPECT_TRUE(PlaceGraph({}).nodes.empty());
}

TEST(GraphLayout, LayersFollowTheLongestWay) {
  std::mt19937 random(7);
  GraphToPlace graph;
  for (std::size_t i = 0; i < 200; ++i) {
    graph.nodes.push_back({30, 20});
    for (int link = 0; link < 2 && i > 0; ++link) graph.links.push_back({random() % i, i});
  }

  const PlacedGraph placed = PlaceLayered(graph);

  ExpectSound(graph, placed);
  for (const GraphLink& link : graph.links)
    EXPECT_LT(placed.nodes[link.from].right(), placed.nodes[link.to].x);
}

}  // namespace
}  // namespace aerascope
