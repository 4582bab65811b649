// Reads episode files: finished ones, those of a killed run (a -wal file lies beside them), and those of a
// run that is still going on (what is committed by now).
//
// The file may come from anyone. Every number, id, enum name and term in it is checked; what does not fit is
// an error of one sentence, and no file makes the reader crash, hang or take memory out of proportion to the
// file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/event/event.h"
#include "engine/store/episode_header.h"

namespace aerascope {

struct EpisodeFile {
  EpisodeHeader header;
  std::vector<Event> events;  // ids 1, 2, 3 ... without gaps
  bool complete = false;      // the run came to its end: EpisodeEnded is last, and the file was finished
  std::optional<Hash128>
      stored_digest;   // of the event stream, as the writer computed it; none if not finished, or if older
  bool older = false;  // of an earlier schema: what that lacks reads as none, so no digest can be compared
};

Result<EpisodeFile> ReadEpisode(const std::string& path);

// The header alone, without reading events.
Result<EpisodeHeader> ReadEpisodeHeader(const std::string& path);

}  // namespace aerascope
