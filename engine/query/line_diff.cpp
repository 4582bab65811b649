#include "engine/query/line_diff.h"

#include <algorithm>
#include <cstdint>

namespace aerascope {
namespace {

constexpr std::size_t kMaxCells = 4'000'000;  // of the table of common lines

using Lines = std::vector<std::string_view>;

Lines LinesIn(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace

LineDifference DifferingLines(std::string_view left, std::string_view right, std::size_t most) {
  const Lines a = LinesIn(left);
  const Lines b = LinesIn(right);
  std::size_t begin = 0;
  while (begin < a.size() && begin < b.size() && a[begin] == b[begin]) ++begin;
  std::size_t tail = 0;
  while (tail < a.size() - begin && tail < b.size() - begin &&
         a[a.size() - 1 - tail] == b[b.size() - 1 - tail])
    ++tail;
  const std::size_t n = a.size() - begin - tail;
  const std::size_t m = b.size() - begin - tail;

  // common[i][j]: how many lines the rests from i and j have in common, in order.
  std::vector<std::uint32_t> common;
  const auto at = [&](std::size_t i, std::size_t j) -> std::uint32_t& { return common[i * (m + 1) + j]; };
  const bool searched = n > 0 && m > 0 && (n + 1) <= kMaxCells / (m + 1);
  if (searched) {
    common.assign((n + 1) * (m + 1), 0);
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t j = m; j-- > 0;) {
        at(i, j) = a[begin + i] == b[begin + j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
      }
    }
  }

  LineDifference difference;
  const auto add = [&](bool of_left, std::size_t i) {
    if (difference.lines.size() >= most) {
      ++difference.hidden;
      return;
    }
    const std::string_view text = of_left ? a[begin + i] : b[begin + i];
    difference.lines.push_back({of_left, begin + i + 1, std::string(text)});
  };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < n || j < m) {
    if (searched && i < n && j < m && a[begin + i] == b[begin + j]) {
      ++i;
      ++j;
    } else if (i < n && (j == m || !searched || at(i + 1, j) >= at(i, j + 1))) {
      add(true, i++);
    } else {
      add(false, j++);
    }
  }
  return difference;
}

}  // namespace aerascope
