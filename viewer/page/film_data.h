// What the report's page shows of the world: stills and video, and the outlines of things over them.
//
// Outlines are numbers: for each camera the names of things, their different shapes (place of the name, first
// corner, steps to the next corners, in whole pixels), and per instant which thing has which shape. What
// stands still costs two numbers an instant.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer/page/report.h"

namespace aerascope {

// `blocks` names the blocks of the page that hold the bytes: of each still, of the stills of each view, of
// the video if there is one.
nlohmann::json FilmData(const ReportFrames& frames, const std::vector<std::string>& blocks);

}  // namespace aerascope
