// A CompositeState (CST) is a conjunction of simultaneous fact patterns: the conditions under which something
// works.
//
// All components share one interval, the variables `after` and `before` of the first one. Components may be
// instances of other composite states (icst), never commands. The first component is the premise: what the
// action changes. An instance is the payload `(icst cst_1 [] [arguments])`, its arguments being the values of
// all variables but the interval's, in order of their numbers (semantics 1.3).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/kb/fact.h"

namespace aerascope {

struct CompositeState {
  CompositeStateId id;
  std::vector<FactPattern> components;      // at least one
  std::vector<Guard> guards;                // tests and assignments, evaluated when all components match
  std::vector<std::string> variable_names;  // for people; index = variable number; not part of the identity

  bool operator==(const CompositeState&) const = default;
};

// The numbers of the variables an instance exposes: all but the interval's, ascending.
std::vector<int> ArgumentVariables(const CompositeState& state);

// The payload of an instance under bindings; unbound variables stay variables of the composite state.
Term InstancePayload(const CompositeState& state, const Bindings& bindings);

// Binds the variables of the state from an instance's argument list; false if the lengths or values do not
// agree. Arguments that are variables or wildcards bind nothing.
bool BindInstance(const CompositeState& state, const Term& icst_payload, Bindings& bindings);

// "H holding [] . C size large" style single line is viewer work; this is the definition, one component a
// line.
std::string ToText(const CompositeState& state);

// The definition without its id, as a term for storage.
Term DefinitionToTerm(const CompositeState& state);
std::optional<CompositeState> CompositeStateFromTerm(CompositeStateId id, const Term& definition);

}  // namespace aerascope
