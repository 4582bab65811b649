// What the inspector shows of each thing that can be selected, beyond its line in the table of subjects: its
// definition, what its variables stood for, its plans, its comparisons.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "engine/base/result.h"
#include "viewer/page/page_blocks.h"
#include "viewer/page/report_context.h"
#include "viewer/page/subject_table.h"

namespace aerascope {

inline constexpr std::size_t kSubjectsABlock = 32;

// The table of subjects as columns: ids, titles and so on, each a list in the order of the table.
nlohmann::json SubjectIndex(const ReportContext& context, const SubjectTable& subjects);

// Adds blocks `subjects-0`, `subjects-1` ... with the details of kSubjectsABlock subjects each.
Status AddSubjectDetails(const ReportContext& context, const SubjectTable& subjects, PageBlocks* blocks);

}  // namespace aerascope
