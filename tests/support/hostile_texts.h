// Texts that break what is careless with them: markup, quotes, control and bidirectional characters, bytes
// that are no text, and a megabyte. An episode may come from anyone, so each of them may stand wherever an
// episode holds text.
#pragma once

#include <string>
#include <vector>

#include "engine/event/event.h"
#include "engine/store/episode_header.h"

namespace aerascope {

// Short ones, each different. Those that try to run something set the global variable `pwned` of a page.
std::vector<std::string> HostileTexts();

// A megabyte, with markup at its beginning and at its end.
std::string EndlessText();

struct HostileEpisode {
  EpisodeHeader header;
  std::vector<Event> events;
};

// In so many turns every short text stands in every place.
inline constexpr int kHostileTurns = 5;

// The paper's episode with hostile texts as names of things, attributes, values, commands and variables, and
// in every field of an event and of the file's header that holds text. Which text stands where is another in
// each turn.
HostileEpisode MakeHostileEpisode(int turn);

// The same story with endless texts: the scenario's title, a thing's name, a command, a drive's title, a
// reason.
HostileEpisode MakeEndlessEpisode();

// The same with numbers that are none: not-a-number and infinities among states, confidences and evidence.
HostileEpisode MakeEpisodeWithoutNumbers();

}  // namespace aerascope
