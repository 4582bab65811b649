// The events of a run as the page holds them: all of them, in columns and chunks that are decoded when they
// are asked for.
//
// Block `log` (columns, see columns.h), one after the other for n events:
//   kind       n bytes: position in EventBody
//   sign       n bytes: bits 0 to 2 the chapter of the story, 0 for none (StoryChapter); bit 3 tells of
//              failure; bit 4 happened in the head only; bit 5 is worth a line where effects are listed;
//              bit 6 says why something did not happen
//   mark       n bytes: position in the list of marks in the description
//   time       n signed: microseconds since the event before
//   simulation n unsigned: number of the simulation, 0 for none
//   mentions   lists (see below): the numbers of the subjects the event speaks of, the first most of all
//   sure       for each subject: count, then for each step of its confidence: signed microseconds since the
//              step before (the first: since 0), confidence in ten-thousandths, bits (1 an outcome was wrong,
//              2 deleted from here on, 4 strong, 8 phased out), signed event number since the step before
// Block `log-causes`: lists: how many events before this one each cause is.
//
// Lists stand kind by kind, since events of one kind name much the same: how long the list of each event is;
// then for each kind the first items of its lists, then the second ones of those that have one, and so on,
// each as the signed difference from the item before it, the first of each place from 0.
//
// Blocks `text-0`, `text-1` ...: the sentences of kEventsAChunk events each, as columns of texts
// (text_columns.h): a column for each kind that occurs in the chunk, a row for each of its events.
//
// Blocks `fields-0` ...: their fields, as columns of texts: for each kind that occurs in the chunk, two for
// each field of the kind: what it says, and the id of what a click on it goes to; of comparisons one more
// column: the comparison as JSON (analogy_data.h).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/base/result.h"
#include "viewer/page/page_blocks.h"
#include "viewer/page/report_context.h"
#include "viewer/page/subject_table.h"

namespace aerascope {

inline constexpr std::size_t kEventsAChunk = 4096;

// What a row of the story belongs to.
enum class StoryChapter { kNone, kGoal, kCommand, kPrediction, kLearned, kAnalogy };

StoryChapter ChapterOf(const ReportContext& context, const SubjectTable& subjects, const Event& event);

// Adds `log` and `log-causes` to the first blocks and the others to the later ones, and gives the description
// that the page needs to read them.
Result<nlohmann::json> AddEventLog(const ReportContext& context, const SubjectTable& subjects,
                                   PageBlocks* first, PageBlocks* later);

}  // namespace aerascope
