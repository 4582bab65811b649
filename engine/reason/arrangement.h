// How a composite state could come to hold: some of its parts matched by facts, the others left to be brought
// about.
//
// Nested composite states are opened up first, so that the parts of a part can be brought about one by one
// (semantics 4.3). A part may be left only if some model leads to it.
#pragma once

#include <functional>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/situation.h"

namespace aerascope {

// A composite state with its nested ones replaced by their components. The state keeps its variable numbers;
// equal parts are listed once. Parts that are anti-facts of instances stay as they are.
struct FlatState {
  std::vector<FactPattern> parts;
  std::vector<Guard> guards;
};
FlatState Flatten(const KnowledgeBase& knowledge, const CompositeState& state);

struct Arrangement {
  Bindings bindings;
  std::vector<std::size_t> left;  // positions in FlatState::parts, ascending
};

// May this part be left to be brought about, given what is bound?
using MayBeLeft = std::function<bool(const FactPattern& part)>;

// The arrangements that leave exactly `count` parts, in a fixed order; at most `limit`. `steps` is increased
// by the facts looked at and parts left on the way.
std::vector<Arrangement> Arrange(const FlatState& state, const Situation& situation, const Bindings& bindings,
                                 std::size_t count, const MayBeLeft& may_be_left, std::size_t limit,
                                 std::size_t* steps);

}  // namespace aerascope
