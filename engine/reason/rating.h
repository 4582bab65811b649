// How one outcome moves a model's evidence, strength and state (semantics 3.5).
#pragma once

#include "engine/kb/knowledge_base.h"
#include "engine/reason/parameters.h"

namespace aerascope {

struct Rating {
  Evidence evidence;
  bool strong = false;
  ModelState state = ModelState::kActive;

  bool operator==(const Rating&) const = default;
};

// The rating after an outcome. Active models: total + 1, positive + 1 if right; a model that was right often
// enough becomes strong and its count starts anew at 1/1; one that falls to the activation threshold is
// phased out if strong, else deleted. Phased-out models count successes only and come back above the
// threshold; below the secondary one they are not watched any more. Unlike OpenAERA, the evidence of the
// failure that phased a model out is kept.
Rating Rate(const Rating& before, bool success, const ReasonerParameters& parameters);

}  // namespace aerascope
