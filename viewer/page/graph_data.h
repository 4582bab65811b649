// The model graph of the report: cards, rings and links with the places that viewer/layout gives them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/page/report_context.h"

namespace aerascope {

nlohmann::json GraphData(const ReportContext& context);

}  // namespace aerascope
