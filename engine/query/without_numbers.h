// What pieces of knowledge say but for their numbers: two that differ in nothing else are the same rule with
// other parameters.
#pragma once

#include <map>

#include "engine/base/hash.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

class WithoutNumbers {
 public:
  explicit WithoutNumbers(const KnowledgeBase& knowledge);

  // The hash of the canonical form in which every number, instant and duration is zero, also in what it
  // refers to.
  Hash128 HashOf(CompositeStateId id) const;
  Hash128 HashOf(ModelId id) const;  // of nothing for an unknown one

 private:
  std::map<CompositeStateId, Canonical> states_;
  std::map<ModelId, Canonical> models_;
};

// The term with zeros for its numbers, instants and durations.
Term WithZeros(const Term& term);

}  // namespace aerascope
