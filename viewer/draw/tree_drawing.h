// Why something happened, what it led to, and what the agent wanted, as graphs of boxes from left to right.
#pragma once

#include <optional>
#include <string>

#include "engine/query/goal_tree.h"
#include "engine/query/why.h"
#include "viewer/draw/theme.h"

namespace aerascope {

// Boxes beyond this many are left out, and the drawing says how many.
inline constexpr std::size_t kMaxDrawnBoxes = 400;
// Where nobody says how far to go, a drawing goes as far as it can be read on a page: so many boxes, so many
// of them side by side; at least one step.
inline constexpr std::size_t kReadableBoxes = 40;
inline constexpr int kReadableColumns = 6;

enum class CauseDirection {
  kWhy,    // causes lead to the root at the right
  kLedTo,  // the root at the left leads to its effects
};
// The causes or effects of an event, up to `depth` steps away from it, or as far as can be read. What lies
// beyond is counted, and the boxes behind which it lies are marked.
std::string CauseTreeSvg(const Run& run, EventId event, CauseDirection direction, const Theme& theme,
                         std::optional<int> depth = {});

// Drives at the left, their sub-goals to the right of them.
std::string GoalTreeSvg(const Run& run, const GoalTree& tree, const Theme& theme);

}  // namespace aerascope
