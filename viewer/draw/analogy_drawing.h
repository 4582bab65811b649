// An analogy as a figure, like the paper's Figure 3: a known triad beside the one that was made from it.
//
// Left the composite state that was compared, right the generalised one, between them what the situation had
// for each component: the fact that matched, what a model could bring about, or what stood there instead, in
// which case the component is pruned. Below, the familiarity psi (equation 2), the confidence that follows
// from it (equation 4), and both requirement models with the causal model they share. A comparison that was
// rejected is drawn the same way, with the reason where the new knowledge would stand.
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/query/run.h"
#include "viewer/draw/theme.h"

namespace aerascope {

// The comparison that `object` means: itself (an event), the one that made it (a requirement model or
// composite state), or one it was compared in; without an object the first that was accepted, else the first.
// An error names what there is.
Result<EventId> FindComparison(const Run& run, const std::optional<ObjectId>& object);

// `comparison` is the event of an AnalogyCompared; the error says so if it is not.
Result<std::string> AnalogySvg(const Run& run, EventId comparison, const Theme& theme);

}  // namespace aerascope
