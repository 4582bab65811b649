#include "engine/query/why.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/base/text.h"
#include "engine/query/describe.h"

namespace aerascope {
namespace {

using Neighbours = std::span<const EventId> (Run::*)(EventId) const;

// A node while the tree is made, level by level.
struct Draft {
  EventId event;
  int depth = 0;
  CauseMark mark = CauseMark::kExpanded;
  std::vector<std::size_t> children;
};

std::vector<Draft> Walk(const Run& run, EventId root, Neighbours neighbours, CauseLimits limits) {
  std::vector<Draft> drafts = {{root, 0, CauseMark::kExpanded, {}}};
  std::set<EventId> placed = {root};
  // Level by level, so that every event is expanded where it is nearest to the root.
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    if (drafts[i].mark == CauseMark::kReference) continue;
    const std::span<const EventId> next = (run.*neighbours)(drafts[i].event);
    if (!next.empty() && (drafts[i].depth >= limits.depth || drafts.size() + next.size() > limits.nodes)) {
      drafts[i].mark = CauseMark::kCut;
      continue;
    }
    for (const EventId event : next) {
      if (!run.Find(event)) continue;
      const bool is_new = placed.insert(event).second;
      const bool has_more = !(run.*neighbours)(event).empty();
      const CauseMark mark = is_new || !has_more ? CauseMark::kExpanded : CauseMark::kReference;
      drafts[i].children.push_back(drafts.size());
      drafts.push_back({event, drafts[i].depth + 1, mark, {}});
    }
  }
  return drafts;
}

CauseTree Flatten(const Run& run, const std::vector<Draft>& drafts, Neighbours neighbours) {
  CauseTree tree;
  std::set<EventId> first;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, 0}};  // draft, position of its parent
  while (!open.empty()) {
    const auto [i, parent] = open.back();
    open.pop_back();
    const Draft& draft = drafts[i];
    const std::size_t position = tree.nodes.size();
    tree.nodes.push_back({draft.event, draft.depth, parent, draft.mark});
    tree.levels = std::max(tree.levels, draft.depth + 1);
    tree.cut = tree.cut || draft.mark == CauseMark::kCut;
    if ((run.*neighbours)(draft.event).empty()) first.insert(draft.event);
    for (auto child = draft.children.rbegin(); child != draft.children.rend(); ++child)
      open.emplace_back(*child, position);
  }
  tree.first_causes.assign(first.begin(), first.end());
  return tree;
}

CauseTree MakeTree(const Run& run, EventId event, Neighbours neighbours, CauseLimits limits) {
  if (!run.Find(event)) return {};
  return Flatten(run, Walk(run, event, neighbours, limits), neighbours);
}

// Whether a node is the last child of its parent; counted from the end.
std::vector<bool> LastChildren(const CauseTree& tree) {
  std::vector<bool> last(tree.nodes.size(), false);
  std::set<std::size_t> seen;
  for (std::size_t i = tree.nodes.size(); i-- > 1;) last[i] = seen.insert(tree.nodes[i].parent).second;
  return last;
}

}  // namespace

CauseTree Why(const Run& run, EventId event, CauseLimits limits) {
  return MakeTree(run, event, &Run::Causes, limits);
}
CauseTree LedTo(const Run& run, EventId event, CauseLimits limits) {
  return MakeTree(run, event, &Run::Effects, limits);
}

std::string TreeText(const Run& run, const CauseTree& tree) {
  const std::vector<bool> last = LastChildren(tree);
  std::string text;
  std::vector<bool> lines;  // per depth, whether a line goes on below
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const CauseNode& node = tree.nodes[i];
    const Event& event = *run.Find(node.event);
    lines.resize(static_cast<std::size_t>(node.depth));
    for (std::size_t depth = 0; depth + 1 < lines.size(); ++depth) text += lines[depth] ? "│  " : "   ";
    if (node.depth > 0) {
      text += last[i] ? "└─ " : "├─ ";
      lines.back() = !last[i];
    }
    text += SecondsText(event.time) + "  " + SentenceOf(run, event) + "  " + IdText(node.event);
    if (node.mark == CauseMark::kReference) text += " (shown elsewhere)";
    if (node.mark == CauseMark::kCut) text += " (goes on)";
    text += "\n";
  }
  return text;
}

}  // namespace aerascope
