// Report and sheet of an episode, made and written.
#pragma once

#include <string>

#include "engine/query/run.h"
#include "viewer/app/film.h"

namespace aerascope {

// Everything the page and the sheet need, made from a run and written to files.
struct ReportFiles {
  std::string html;   // path, or empty for none
  std::string sheet;  // path of the PNG, or empty for none
  bool frames = true;
  bool folder = false;  // pictures and video go into a folder beside the page: report_files for report.html
  FilmOptions film{};
  double sheet_scale = 1.5;
};
Status WriteReports(const Run& run, const std::string& episode_path, const ReportFiles& files);

}  // namespace aerascope
