#include "viewer/layout/graph_layout.h"

#include <graphviz/gvc.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <string>

// The layout engine of Graphviz, linked in: no search for plug-ins at run time, so no configuration can
// change it.
extern "C" gvplugin_library_t gvplugin_dot_layout_LTX_library;

namespace aerascope {
namespace {

constexpr double kPointsPerInch = 72;
constexpr int kMargin = 8;

// Graphviz keeps state of its own and writes what it dislikes to standard error; one at a time, and silent.
std::mutex graphviz_mutex;
int IgnoreMessage(char*) {
  return 0;
}

void SetAttribute(void* object, const char* name, const std::string& value) {
  std::string key = name;
  std::string text = value;
  std::string none;
  agsafeset(object, key.data(), text.data(), none.data());
}

std::string Inches(int points) {
  // Whole points are exact in six decimals; std::to_string follows the C locale of a number, which has a
  // point here.
  const long long millionths =
      static_cast<long long>(points) * 1'000'000 / static_cast<long long>(kPointsPerInch);
  std::string fraction = std::to_string(millionths % 1'000'000);
  return std::to_string(millionths / 1'000'000) + "." + std::string(6 - fraction.size(), '0') + fraction;
}

int Whole(double value) {
  return static_cast<int>(std::lround(value));
}

// Owns the graph and context of one layout.
class Graphviz {
 public:
  Graphviz() {
    builtins_[0] = {"gvplugin_dot_layout_LTX_library", &gvplugin_dot_layout_LTX_library};
    agseterrf(IgnoreMessage);
    agseterr(AGMAX);
    context_ = gvContextPlugins(builtins_, 0);
    std::string name = "g";
    graph_ = agopen(name.data(), Agdirected, nullptr);
  }
  ~Graphviz() {
    if (laid_out_) gvFreeLayout(context_, graph_);
    if (graph_ != nullptr) agclose(graph_);
    if (context_ != nullptr) gvFreeContext(context_);
  }
  Graphviz(const Graphviz&) = delete;
  Graphviz& operator=(const Graphviz&) = delete;

  bool Ready() const { return context_ != nullptr && graph_ != nullptr; }
  Agraph_t* graph() { return graph_; }
  bool LayOut() {
    laid_out_ = gvLayout(context_, graph_, "dot") == 0;
    return laid_out_;
  }

 private:
  lt_symlist_t builtins_[2] = {};
  GVC_t* context_ = nullptr;
  Agraph_t* graph_ = nullptr;
  bool laid_out_ = false;
};

bool PlaceByGraphviz(const GraphToPlace& input, PlacedGraph& placed) {
  const std::lock_guard lock(graphviz_mutex);
  Graphviz graphviz;
  if (!graphviz.Ready()) return false;
  Agraph_t* graph = graphviz.graph();
  SetAttribute(graph, "rankdir", input.direction == GraphDirection::kLeftRight ? "LR" : "TB");
  SetAttribute(graph, "nodesep", Inches(input.node_gap));
  SetAttribute(graph, "ranksep", Inches(input.layer_gap));
  SetAttribute(graph, "nslimit", "4");
  SetAttribute(graph, "mclimit", "1");
  std::vector<Agnode_t*> nodes;
  for (std::size_t i = 0; i < input.nodes.size(); ++i) {
    std::string name = "n" + std::to_string(i);
    Agnode_t* node = agnode(graph, name.data(), 1);
    SetAttribute(node, "shape", "box");
    SetAttribute(node, "fixedsize", "true");
    SetAttribute(node, "label", "");
    SetAttribute(node, "width", Inches(std::max(1, input.nodes[i].width)));
    SetAttribute(node, "height", Inches(std::max(1, input.nodes[i].height)));
    nodes.push_back(node);
  }
  std::vector<std::pair<std::size_t, Agedge_t*>> links;
  for (std::size_t i = 0; i < input.links.size(); ++i) {
    const GraphLink& link = input.links[i];
    if (link.from >= nodes.size() || link.to >= nodes.size()) continue;
    std::string name = "e" + std::to_string(i);
    Agedge_t* edge = agedge(graph, nodes[link.from], nodes[link.to], name.data(), 1);
    SetAttribute(edge, "arrowhead", "none");
    // From the side that faces the next layer to the side that faces the last one. Left to itself, a steep
    // link begins or ends above or below a node, where an arrow head that points along the layers lies under
    // the node.
    const bool across = input.direction == GraphDirection::kLeftRight;
    SetAttribute(edge, "tailport", across ? "e" : "s");
    SetAttribute(edge, "headport", across ? "w" : "n");
    links.emplace_back(i, edge);
  }
  if (!graphviz.LayOut()) return false;

  const boxf box = GD_bb(graph);
  // Graphviz counts y upwards, and what comes first in the input ends up below in a graph from left to right:
  // not turned over there, the first stands at the top.
  const bool turn = input.direction == GraphDirection::kTopDown;
  const auto at = [&box, turn](pointf point) {
    const double y = turn ? box.UR.y - point.y : point.y - box.LL.y;
    return Point{Whole(point.x - box.LL.x) + kMargin, Whole(y) + kMargin};
  };
  placed.size = {Whole(box.UR.x - box.LL.x) + 2 * kMargin, Whole(box.UR.y - box.LL.y) + 2 * kMargin};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Point centre = at(ND_coord(nodes[i]));
    const Size size = input.nodes[i];
    placed.nodes.push_back({centre.x - size.width / 2, centre.y - size.height / 2, size.width, size.height});
  }
  for (const auto& [index, edge] : links) {
    PlacedLink link{index, {}};
    const splines* course = ED_spl(edge);
    if (course == nullptr || course->size < 1) return false;
    // A link drawn against the direction of the layers has its curve stored from its layer's side; turn it.
    const bezier& curve = course->list[0];
    for (int p = 0; p < curve.size; ++p) link.curve.push_back(at(curve.list[p]));
    const Rect& from = placed.nodes[input.links[index].from];
    const Point begin = turn ? Point{from.centre().x, from.bottom()} : Point{from.right(), from.centre().y};
    const auto distance = [&begin](Point point) {
      return std::abs(point.x - begin.x) + std::abs(point.y - begin.y);
    };
    if (!link.curve.empty() && distance(link.curve.back()) < distance(link.curve.front())) {
      std::reverse(link.curve.begin(), link.curve.end());
    }
    placed.links.push_back(std::move(link));
  }
  placed.by_graphviz = true;
  return true;
}

// The nodes so that all that lead to a node come before it, and the links that close circles left out. Depth
// first in order of the input, without recursion.
std::vector<int> LayersOf(const GraphToPlace& graph) {
  const std::size_t count = graph.nodes.size();
  std::vector<std::vector<std::size_t>> next(count);
  for (const GraphLink& link : graph.links) {
    if (link.from < count && link.to < count && link.from != link.to) next[link.from].push_back(link.to);
  }
  enum class Mark : unsigned char { kNew, kOnPath, kDone };
  std::vector<Mark> marks(count, Mark::kNew);
  std::vector<std::size_t> finished;
  std::vector<std::pair<std::size_t, std::size_t>> path;  // node, how many of its links are followed
  std::vector<std::vector<std::size_t>> forward(count);   // without those that close circles
  for (std::size_t root = 0; root < count; ++root) {
    if (marks[root] != Mark::kNew) continue;
    marks[root] = Mark::kOnPath;
    path.emplace_back(root, 0);
    while (!path.empty()) {
      auto& [node, followed] = path.back();
      if (followed == next[node].size()) {
        marks[node] = Mark::kDone;
        finished.push_back(node);
        path.pop_back();
        continue;
      }
      const std::size_t target = next[node][followed++];
      if (marks[target] == Mark::kOnPath) continue;
      forward[node].push_back(target);
      if (marks[target] == Mark::kNew) {
        marks[target] = Mark::kOnPath;
        path.emplace_back(target, 0);
      }
    }
  }
  std::vector<int> layers(count, 0);
  for (auto node = finished.rbegin(); node != finished.rend(); ++node) {
    for (const std::size_t target : forward[*node])
      layers[target] = std::max(layers[target], layers[*node] + 1);
  }
  return layers;
}

}  // namespace

PlacedGraph PlaceLayered(const GraphToPlace& graph) {
  const bool across = graph.direction == GraphDirection::kLeftRight;
  const std::vector<int> layer_of = LayersOf(graph);
  const int layers = layer_of.empty() ? 0 : *std::max_element(layer_of.begin(), layer_of.end()) + 1;
  std::vector<int> depth(static_cast<std::size_t>(layers), 0);   // of a layer, along the direction
  std::vector<int> length(static_cast<std::size_t>(layers), 0);  // of a layer, across it
  const auto along = [across](Size size) { return across ? size.width : size.height; };
  const auto beside = [across](Size size) { return across ? size.height : size.width; };
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto layer = static_cast<std::size_t>(layer_of[i]);
    depth[layer] = std::max(depth[layer], along(graph.nodes[i]));
    length[layer] += (length[layer] > 0 ? graph.node_gap : 0) + beside(graph.nodes[i]);
  }
  const int longest = length.empty() ? 0 : *std::max_element(length.begin(), length.end());
  std::vector<int> start(static_cast<std::size_t>(layers), kMargin);
  for (std::size_t layer = 1; layer < start.size(); ++layer) {
    start[layer] = start[layer - 1] + depth[layer - 1] + graph.layer_gap;
  }
  std::vector<int> used(static_cast<std::size_t>(layers), 0);

  PlacedGraph placed;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto layer = static_cast<std::size_t>(layer_of[i]);
    const Size size = graph.nodes[i];
    const int a = start[layer] + (depth[layer] - along(size)) / 2;
    const int b = kMargin + (longest - length[layer]) / 2 + used[layer];
    used[layer] += beside(size) + graph.node_gap;
    placed.nodes.push_back(across ? Rect{a, b, size.width, size.height}
                                  : Rect{b, a, size.width, size.height});
  }
  const int total = layers == 0 ? 0 : start.back() + depth.back() + kMargin;
  placed.size = across ? Size{total, longest + 2 * kMargin} : Size{longest + 2 * kMargin, total};
  for (std::size_t i = 0; i < graph.links.size(); ++i) {
    const GraphLink& link = graph.links[i];
    if (link.from >= placed.nodes.size() || link.to >= placed.nodes.size()) continue;
    const Rect& from = placed.nodes[link.from];
    const Rect& to = placed.nodes[link.to];
    const Point a = across ? Point{from.right(), from.centre().y} : Point{from.centre().x, from.bottom()};
    const Point b = across ? Point{to.x, to.centre().y} : Point{to.centre().x, to.y};
    const int reach = std::max(12, graph.layer_gap / 2);
    const Point out = across ? Point{a.x + reach, a.y} : Point{a.x, a.y + reach};
    const Point in = across ? Point{b.x - reach, b.y} : Point{b.x, b.y - reach};
    placed.links.push_back({i, {a, out, in, b}});
  }
  return placed;
}

PlacedGraph PlaceGraph(const GraphToPlace& graph) {
  if (!graph.nodes.empty() && graph.nodes.size() <= kMaxGraphvizNodes &&
      graph.links.size() <= kMaxGraphvizEdges) {
    PlacedGraph placed;
    if (PlaceByGraphviz(graph, placed)) return placed;
  }
  return PlaceLayered(graph);
}

}  // namespace aerascope
