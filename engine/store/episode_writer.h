// An EpisodeWriter puts events into a new episode file while the engine reasons on.
//
// One thread appends; a thread of the writer's own stores the events in transactions of some thousand, or of
// what came within 50 ms. A run that is killed leaves a file with every event committed so far, readable as
// it is. Appending only waits where events come faster than the disk takes them (some thousand are queued at
// most).
//
// Always true: (1) what was committed is a gapless beginning of what was appended; (2) the same header and
// events give the same bytes once finished; (3) after Finish() the episode is one file with nothing beside
// it.
//
// What can fail: Create (the path cannot be written, or holds something that is not an episode) and Finish
// (any trouble since: a full disk, an unusable event). After trouble events are dropped and Finish removes
// the unusable file.
#pragma once

#include <memory>
#include <string>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/event/event.h"
#include "engine/store/episode_header.h"

namespace aerascope {

class EpisodeWriter : public EventSink {
 public:
  // An existing episode, or an empty file, at `path` is replaced; anything else there is refused. Until
  // Finish the earlier one stands beside as `path.earlier`: it comes back if this one fails, and stays there
  // if this process is killed.
  static Result<std::unique_ptr<EpisodeWriter>> Create(const std::string& path, EpisodeHeader header);

  // A writer that is not finished stores what was appended and closes; the episode is then incomplete.
  ~EpisodeWriter() override;

  // Events in order of id, from 1.
  void Append(Event event) override;

  // Waits until everything appended so far is committed (or trouble was met).
  void Flush();

  // The last event that no kill of this process can take away any more; none at first.
  EventId Committed() const;

  // Stores what is left, the digest, the counts and the indexes, and leaves one plain file. Returns the
  // digest of the event stream. Later calls return the same.
  Result<Hash128> Finish();

 private:
  struct State;
  explicit EpisodeWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace aerascope
