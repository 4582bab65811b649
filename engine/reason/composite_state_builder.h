// Builds the composite state of what held together in one situation: the conditions induction finds for a
// causal model (semantics 5.1, build CST).
//
// An instance of a known composite state stands for the facts it contains. Which facts come first in the
// situation plays no part in what is built.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

// A composite state together with its instance in a situation.
struct StateInstance {
  CompositeState state;            // its id is invalid if it is new
  Bindings values;                 // of the state's variables
  TimeInterval interval;           // in which the instance holds
  std::vector<std::size_t> facts;  // its components, as positions in the situation
};

// Does the instance at one position contain the fact at another, directly (depth 1) or through instances in
// it?
bool Contains(const Situation& situation, std::size_t instance, std::size_t fact, int depth);

// Started no later than the reference (up to the tolerance) and still holds when that begins (semantics 1.6).
bool InSync(const TimeInterval& interval, const TimeInterval& reference);

// Those of the positions that no other of them contains.
std::vector<std::size_t> Outermost(const std::vector<std::size_t>& positions, const Situation& situation);

// The state whose components are these facts and instances, as if it were new; nothing if they are fewer than
// two.
std::optional<StateInstance> PutTogether(const std::vector<std::size_t>& members, const Situation& situation,
                                         const KnowledgeBase& knowledge, ValueRoles roles);

// The same in terms of the equal composite state that is known already, if there is one.
StateInstance KnownOrNew(StateInstance instance, const KnowledgeBase& knowledge);

// An instance that is in the situation already.
StateInstance InstanceAt(std::size_t position, const Situation& situation, const KnowledgeBase& knowledge);

// Orders ground payloads by what they say, whatever the numbers of the knowledge they name.
std::string ContentKey(const Term& payload, const KnowledgeBase& knowledge);

}  // namespace aerascope
