// The episode sheet: one page that tells a stranger in a minute what was learned and why the agent did what
// it did. Title and outcome, key frames with captions, the model graph at the end, how sure the agent was,
// and where it all comes from. Pictures come from the caller, so that this folder needs no graphics;
// KeyMoments says which are wanted.
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/query/run.h"
#include "viewer/draw/key_moments.h"
#include "viewer/draw/still_drawing.h"

namespace aerascope {

inline constexpr std::size_t kSheetFrames = 6;
inline constexpr int kSheetWidth = 1600;  // pixels at scale 1
// The shape of a still on the sheet; others are cut at the sides or above and below.
inline constexpr int kSheetFrameWidth = 490;
inline constexpr int kSheetFrameHeight = 276;

struct SheetFrames {
  std::vector<SheetFrame> frames;  // in order of time; best at KeyMoments(run, kSheetFrames)
  std::string note;                // why there are none, one sentence; shown in their place
};

struct SheetOptions {
  std::string file_name;  // of the episode, as shown; without folder
};

// An error if a picture is not a PNG. Same run, pictures and options: the same bytes.
Result<std::string> BuildSheetSvg(const Run& run, const SheetFrames& frames,
                                  const SheetOptions& options = {});

}  // namespace aerascope
