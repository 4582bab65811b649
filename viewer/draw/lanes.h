// Time lanes: who commanded, what was wanted, done, predicted, learned and made by analogy, under one time
// axis.
//
// Marks of one lane never overlap: a lane opens further rows, up to a limit, and then says how many marks it
// left out. A tag says in words what it is about, as far as it is wide; too short for that it keeps its
// check, its cross or a first letter, and a line below says so.
#pragma once

#include "engine/query/episode_summary.h"
#include "viewer/draw/svg.h"

namespace aerascope {

// Draws lanes `width` wide from the origin on and returns their height.
int DrawLanes(Svg& svg, const Run& run, const EpisodeSummary& summary, int width);

}  // namespace aerascope
