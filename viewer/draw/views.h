// Single views of a run as SVG documents, for a paper or a review: what was known at a moment, the time
// lanes, how sure the agent was, a picture of a moment. Others have their own file: analogy_drawing,
// tree_drawing.
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/query/run.h"
#include "viewer/draw/still_drawing.h"
#include "viewer/draw/theme.h"

namespace aerascope {

// What was known at a time; open where `chosen` is (or everywhere while the drawing stays small), and
// `chosen`, if valid, marked as what was asked about.
std::string KnowledgeViewSvg(const Run& run, Time at, ModelId chosen, const Theme& theme);

std::string LanesSvg(const Run& run, const Theme& theme);

// Of these models; of all requirement models that were learned or put to the test where none is named, the
// most tested ones first, and the drawing says how many are left out.
std::string CurvesSvg(const Run& run, const std::vector<ModelId>& models, const Theme& theme);

// The picture with its time, and what was told of its frame. An error if the picture is not a PNG.
Result<std::string> MomentSvg(const Run& run, const SheetFrame& frame, const Theme& theme);

}  // namespace aerascope
