// The canonical form of knowledge: what a composite state or model says, whatever its numbers and order.
//
// Variables are renumbered by first appearance, the components of a composite state are put in a fixed order,
// and each reference to other knowledge is replaced by that knowledge's own hash (with its argument list in
// that knowledge's canonical order). Two runs that learned the same thing in another order have equal hashes.
// Names of variables, evidence and ids play no part. Deduplication, diff, snapshots and black lists use this
// one identity.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/kb/composite_state.h"
#include "engine/kb/model.h"

namespace aerascope {

struct Canonical {
  std::string text;             // the encoded canonical definition
  Hash128 hash;                 // of the text
  std::vector<int> variables;   // canonical number -> the definition's own variable number
  std::vector<int> components;  // of a composite state: canonical position -> position in the definition
  // Other orders of the variables with the same text, where parts are interchangeable: (x large) and (y
  // large).
  std::vector<std::vector<int>> symmetric_variables;
};

// The canonical form of a referenced composite state or model (a kCompositeState or kModel term); null if
// unknown.
using CanonicalOf = std::function<const Canonical*(const Term& reference)>;
// The referenced definitions, needed to put argument lists into canonical order; null if unknown.
struct Definitions {
  std::function<const CompositeState*(CompositeStateId)> composite_state;
  std::function<const Model*(ModelId)> model;
};

// The work is bounded: a definition with more than six interchangeable components, or thousands of
// components, is still given a form, but that may depend on their order. A reference that is unknown is
// written "?" and hashes as that.
Canonical Canonicalise(const CompositeState& state, const CanonicalOf& canonical_of,
                       const Definitions& definitions);
Canonical Canonicalise(const Model& model, const CanonicalOf& canonical_of, const Definitions& definitions);

}  // namespace aerascope
