// The paper's episode as a loaded run with made-up stills, for the tests of the report and for the browser's.
#pragma once

#include "tests/support/paper_episode.h"
#include "viewer/page/report.h"

namespace aerascope {

struct PageFixture {
  PaperEpisodeOptions episode;
  bool frames = true;
  bool finished = true;  // the file was closed, with its digest
};

Run PaperRun(const PageFixture& fixture = {});

// Two small images a frame: a table seen from above with a disc for each thing, moved as the facts say.
ReportFrames MadeUpFrames(const Run& run);

Report PaperReport(const PageFixture& fixture = {});

}  // namespace aerascope
