// A comparison made for an analogy, component by component, as the page shows it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/page/report_context.h"

namespace aerascope {

// One condition of a composite state as a line: its text, the names of the variables in it, whether it was
// dropped.
nlohmann::json ConditionData(const std::string& text, const std::vector<std::string>& variables,
                             bool cut = false);

// The compared conditions with what was found for each, psi, the Jaccard index, confidence and verdict
// (paper, equations 2 to 4).
nlohmann::json ComparisonData(const ReportContext& context, const Event& event);

}  // namespace aerascope
