// What the inspector says about each thing that can be selected: requirement models with their composite
// states, other models, composite states on their own, goals, predictions and commands.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/page/report_context.h"

namespace aerascope {

// An object with a member a subject, by its id ("mdl_582", "goal_12", "pred_3", "#41", "thing:s1").
nlohmann::json SubjectData(const ReportContext& context);

}  // namespace aerascope
