// How long the bars of time lanes are and what they say in few words: the same in drawings and in the
// report's page.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/query/episode_summary.h"

namespace aerascope {

// Bars cover whole frames, since reasoning and commands begin a little after a frame does: from the start of
// the frame of `from` to the start of that of `until`, or to its own frame's end where nothing would be left.
TimeInterval InWholeFrames(const Run& run, Time from, Time until);

// A command by its function, as words: "grab type 2"; anything else in full.
std::string CommandWords(const KnowledgeBase& knowledge, const Term& command);

// What each prediction expects in a word or two: its value, or, for a place in the plane or in space, the
// thing that is there at that moment ("at s1"). With "not " in front of an anti-fact.
std::map<PredictionId, std::string> ShortTargets(const Run& run,
                                                 const std::vector<PredictionRecordOfRun>& predictions);

// What is left where there is room for one word only: "at s1" is "s1", "not [s1]" is "not".
std::string LastResort(const std::string& short_target);

}  // namespace aerascope
