// The difference of two knowledge bases for people (text, Markdown) and programs (JSON): totals first, then
// one sentence a difference and what the item says.
#pragma once

#include <iosfwd>
#include <string>

#include "engine/base/result.h"
#include "engine/query/kb_diff.h"

namespace aerascope {

// What the two sides are called: file names, or "before" and "after".
struct DiffNames {
  std::string left = "left";
  std::string right = "right";
};

Status WriteDiffText(const KbDiffResult& difference, const DiffNames& names, std::ostream& out);
Status WriteDiffMarkdown(const KbDiffResult& difference, const DiffNames& names, std::ostream& out);
Status WriteDiffJson(const KbDiffResult& difference, const DiffNames& names, std::ostream& out);

}  // namespace aerascope
