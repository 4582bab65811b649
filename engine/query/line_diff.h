// The lines in which two texts differ: for scenario files that are nearly the same.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace aerascope {

struct LineDifference {
  struct Line {
    bool left = false;       // of the left text, else of the right one
    std::size_t number = 0;  // in its own text, from 1
    std::string text;
    bool operator==(const Line&) const = default;
  };
  std::vector<Line> lines;  // in order; of lines in one place those of the left first
  std::size_t hidden = 0;   // lines that differ beyond those
};

// At most `most` lines are kept. The work is bounded: of long texts that have little in common, whole
// stretches count as different.
LineDifference DifferingLines(std::string_view left, std::string_view right, std::size_t most);

}  // namespace aerascope
