// What the report's page shows, as blocks of the page; page.html and its scripts are the only readers.
#pragma once

#include <string>
#include <vector>

#include "viewer/page/page_blocks.h"
#include "viewer/page/report.h"

namespace aerascope {

// The blocks of a report: those it opens with, and those that are asked for later.
struct ReportBlocks {
  PageBlocks first;
  PageBlocks later;
};

// Adds block `report-data` (what the page needs at once) and those it names: the event log and the details of
// subjects. `images` names, per still of `frames`, the block that holds its bytes.
Status AddReportData(const Run& run, const ReportFrames& frames, const std::vector<std::string>& images,
                     const ReportOptions& options, ReportBlocks* blocks);

// The title of the page.
std::string ReportTitle(const Run& run);

}  // namespace aerascope
