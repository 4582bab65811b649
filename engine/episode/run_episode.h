// Running an episode: the loop observe, reason, act, record, from a scenario to its last drive.
//
// The same loop runs a live world and, for verification, a recorded one: what the world said is in the
// events, so an episode can be reasoned through again from its own file and must give the same digest.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/episode/scenario.h"
#include "engine/event/event.h"
#include "engine/store/episode_reader.h"
#include "engine/world/world.h"

namespace aerascope {

// What a person watching would want to hear at the end of each frame.
struct EpisodeProgress {
  std::int64_t frame = 0;
  std::int64_t last_frame = 0;  // the episode ends here at the latest
  Time time;
  std::string doing;  // "teacher: (cmd move [h 5])", "hold s1: (cmd grab_type_2 [h])", or empty
};
using OnProgress = std::function<void(const EpisodeProgress&)>;

struct EpisodeOutcome {
  std::int64_t frames = 0;
  std::int64_t drives = 0;
  std::int64_t drives_reached = 0;
  std::int64_t events = 0;
};

// Runs the scenario in the world; every event goes to the sink, from EpisodeStarted to EpisodeEnded. Fails
// where the world fails or a teacher's command cannot be completed; events so far have then been given to the
// sink.
Result<EpisodeOutcome> RunEpisode(const Scenario& scenario, World* world, EventSink* sink,
                                  const OnProgress& on_progress = {});

struct RecordedEpisode {
  EpisodeOutcome outcome;
  Hash128 digest;
};

// Makes the scenario's world, runs the episode and writes it to an episode file
// (engine/store/episode_writer.h).
Result<RecordedEpisode> RecordEpisode(const Scenario& scenario, const std::string& path,
                                      const std::string& program_version, const OnProgress& on_progress = {});

Result<std::unique_ptr<World>> MakeWorld(const Scenario& scenario);

// Reasons through a recorded episode again, from its own scenario, seed and observations, and returns the
// digest of the events this gives. Equal to the stored one if engine and file agree.
Result<Hash128> ReplayDigest(const EpisodeFile& episode);

}  // namespace aerascope
