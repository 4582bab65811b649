// Why something happened, what it led to, and what the agent wanted, as graphs of boxes from left to right.
#pragma once

#include <string>

#include "engine/query/goal_tree.h"
#include "engine/query/why.h"
#include "viewer/draw/theme.h"

namespace aerascope {

// Boxes beyond this many are left out, and the drawing says how many.
inline constexpr std::size_t kMaxDrawnBoxes = 400;

enum class CauseDirection {
  kWhy,    // causes lead to the root at the right
  kLedTo,  // the root at the left leads to its effects
};
std::string CauseTreeSvg(const Run& run, const CauseTree& tree, CauseDirection direction, const Theme& theme);

// Drives at the left, their sub-goals to the right of them.
std::string GoalTreeSvg(const Run& run, const GoalTree& tree, const Theme& theme);

}  // namespace aerascope
