// "Why?" and "What did it lead to?": walks along the causes that every event names.
//
// Each event is expanded once, at the place nearest to the root; further places are references. So the tree
// is never larger than the edges it covers, and circles cannot be.
#pragma once

#include <string>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

enum class CauseMark {
  kExpanded,   // its own causes (or effects) follow, if it has any
  kReference,  // expanded elsewhere in this tree
  kCut,        // has more, beyond the limit of depth or size
};

struct CauseNode {
  EventId event;
  int depth = 0;           // 0 for the root
  std::size_t parent = 0;  // position in CauseTree::nodes; of the root itself
  CauseMark mark = CauseMark::kExpanded;
};

struct CauseTree {
  std::vector<CauseNode> nodes;       // preorder: children follow their parent; most direct causes first
  int levels = 0;                     // greatest depth + 1
  std::vector<EventId> first_causes;  // leaves without causes (or effects), by number
  bool cut = false;                   // some node is kCut
};

struct CauseLimits {
  int depth = 12;
  std::size_t nodes = 2000;
};

// Empty if there is no such event.
CauseTree Why(const Run& run, EventId event, CauseLimits limits = {});
CauseTree LedTo(const Run& run, EventId event, CauseLimits limits = {});

// As a drawn tree, one event a line: time, sentence, event number.
std::string TreeText(const Run& run, const CauseTree& tree);

}  // namespace aerascope
