// Everything the report's page shows, as one JSON text; page.html and its scripts are the only readers.
#pragma once

#include <string>
#include <vector>

#include "viewer/page/report.h"

namespace aerascope {

// `images` names, per still of `frames`, the block of the page that holds its bytes.
std::string ReportData(const Run& run, const ReportFrames& frames, const std::vector<std::string>& images,
                       const ReportOptions& options);

// The title of the page.
std::string ReportTitle(const Run& run);

}  // namespace aerascope
