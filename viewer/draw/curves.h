// How sure the agent was of a model over time, as a step curve.
//
// The first sign says where the model came from (star: analogy, circle: learned); a ring is a success, a
// cross a failure; the end carries the value.
#pragma once

#include "engine/query/model_history.h"
#include "viewer/draw/svg.h"
#include "viewer/draw/time_scale.h"

namespace aerascope {

struct CurveScale {
  TimeScale time;
  double lowest = 0;  // confidence at the lower edge; the upper edge is 1
};

// A quarter at or below everything in these histories, and below 1.
double LowestQuarter(const std::vector<ModelHistory>& histories);

// Draws into `area`, the time scale lying inside it; room for the last value is right of the scale.
void DrawConfidenceCurve(Svg& svg, const Run& run, const ModelHistory& history, const Rect& area,
                         const CurveScale& scale);

// The numbers of the time axis under curves or lanes.
void DrawTimeAxis(Svg& svg, const TimeScale& time, int base_line);

}  // namespace aerascope
