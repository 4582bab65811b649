// Writes the reports that the browser tests open: paper_reports FOLDER.
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>

#include "tests/viewer/page/page_fixture.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: paper_reports FOLDER\n", stderr);
    return 2;
  }
  using aerascope::PageFixture;
  PageFixture full, no_frames, cut_short, slipped, hostile;
  no_frames.frames = false;
  cut_short.episode.last_frame = 9;
  slipped.episode.cylinder_slips = true;
  hostile.episode.cylinder = "<img src=x onerror=document.title='owned'>";
  hostile.episode.scenario = "</script><script>document.title='owned'</script>";
  const std::pair<const char*, PageFixture> reports[] = {{"full", full},
                                                         {"no_frames", no_frames},
                                                         {"cut_short", cut_short},
                                                         {"slipped", slipped},
                                                         {"hostile", hostile}};
  for (const auto& [name, fixture] : reports) {
    const std::string path = std::string(argv[1]) + "/" + name + ".html";
    std::ofstream out(path, std::ios::binary);
    out << aerascope::PaperReport(fixture).html;
    if (!out.flush()) {
      std::fprintf(stderr, "%s cannot be written\n", path.c_str());
      return 2;
    }
  }
  return 0;
}
