// The difference of two knowledge bases for people (text, Markdown) and programs (JSON): totals first, then
// what went into the runs differently and where they part, then one sentence a difference and what the item
// says, part by part.
#pragma once

#include <iosfwd>
#include <string>

#include "engine/base/result.h"
#include "engine/query/kb_diff.h"
#include "engine/query/run_diff.h"

namespace aerascope {

// What the two sides are called: file names, or "before" and "after".
struct DiffNames {
  std::string left = "left";
  std::string right = "right";
};

struct DiffReport {
  const KbDiffResult& knowledge;
  DiffNames names;
  RunDiff runs = {};  // empty where only knowledge bases are compared
};

Status WriteDiffText(const DiffReport& report, std::ostream& out);
Status WriteDiffMarkdown(const DiffReport& report, std::ostream& out);
Status WriteDiffJson(const DiffReport& report, std::ostream& out);

}  // namespace aerascope
