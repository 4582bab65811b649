// The paper's pick-and-place story written down by hand as events, for tests of everything that reads an
// episode.
//
// Fifteen frames of one second. Frames 1-6: the teacher commands move, grab_type_1, release on the small cube
// c1 and move, grab_type_2, release on the large cube c2. Then the agent pursues: hold s1, hold nothing, hold
// s2, hold nothing, hold cyl. Five pieces of knowledge are taught, four are made by analogy. Every event
// names its causes, so that readers can be tested without a world and without the reasoner.
#pragma once

#include <string>
#include <vector>

#include "engine/event/event.h"

namespace aerascope {

struct PaperEpisodeOptions {
  std::string scenario = "Pick and place by analogy";
  std::string world = "scripted";
  std::string cylinder = "cyl";  // the name of the last object, to try hostile ones
  bool cylinder_slips = false;   // the last grasp does not hold: prediction and goal fail
  int last_frame = 15;           // a run cut short stops after this frame, without EpisodeEnded
  bool second_lesson = true;     // without it nothing is taught about the large cube
  bool world_states = true;      // record one made-up world state a frame
};

std::vector<Event> PaperEpisode(const PaperEpisodeOptions& options = {});

}  // namespace aerascope
