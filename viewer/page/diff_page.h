// The page of a difference: what two runs know differently, in one self-contained HTML file.
//
// Like the report it loads nothing and may load nothing (page_template.h). The same runs, moments and names
// give the same bytes.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/query/kb_diff.h"
#include "engine/query/run_diff.h"

namespace aerascope {

struct DiffPageSide {
  const Run& run;
  Time at;           // what it knew then is compared
  std::string name;  // as the user called it: a file, with its moment
};

// `knowledge` and `runs` are the differences of these two sides.
Result<std::string> BuildDiffPage(const DiffPageSide& left, const DiffPageSide& right,
                                  const KbDiffResult& knowledge, const RunDiff& runs);

}  // namespace aerascope
