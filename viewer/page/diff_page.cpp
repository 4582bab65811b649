#include "viewer/page/diff_page.h"

#include "engine/base/markup.h"
#include "engine/base/text.h"
#include "viewer/page/diff_data.h"
#include "viewer/page/embedded_diff.inc"
#include "viewer/page/page_blocks.h"
#include "viewer/page/page_json.h"
#include "viewer/page/page_template.h"

namespace aerascope {

Result<std::string> BuildDiffPage(const DiffPageSide& left, const DiffPageSide& right,
                                  const KbDiffResult& knowledge, const RunDiff& runs) {
  PageBlocks blocks;
  const std::string data = PageJson(DiffData(left, right, knowledge, runs));
  if (Status added = blocks.AddPacked("data", "diff-data", "application/json", data); !added)
    return added.error();
  constexpr std::size_t kLongestName = 200;
  const std::string title = EscapeMarkup(Shortened(Printable(left.name), kLongestName) + " and " +
                                         Shortened(Printable(right.name), kLongestName) + ": what differs");
  return Filled(kPage, {{"policy", ContentPolicy(kScriptSha256, kStyleSha256)},
                        {"title", title},
                        {"style", kStyle},
                        {"script", kScript},
                        {"data", blocks.html()}});
}

}  // namespace aerascope
