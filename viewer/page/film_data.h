// What the report's page shows of the world: stills with the outlines of things over them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer/page/report.h"

namespace aerascope {

// `images` names, per still of `frames`, the block of the page that holds its bytes.
nlohmann::json FilmData(const ReportFrames& frames, const std::vector<std::string>& images);

}  // namespace aerascope
