// What the page of a difference is told, as JSON; types.d.ts describes it to its script.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/page/diff_page.h"

namespace aerascope {

nlohmann::json DiffData(const DiffPageSide& left, const DiffPageSide& right, const KbDiffResult& knowledge,
                        const RunDiff& runs);

}  // namespace aerascope
