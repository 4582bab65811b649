// Outweighing: of two open predictions that cannot both come true the less sure one is given up, unrated
// (semantics 3.4: predicted counter-evidence of higher confidence).
//
// Own rules: equally sure ones both stand; a silent prediction (confidence 0) promises nothing, so it neither
// outweighs nor is outweighed, and can still show that a veto was wrong; what is outweighed itself outweighs
// nothing, so the order in which predictions of one instant are made does not matter.
#pragma once

#include <vector>

#include "engine/kb/knowledge_base.h"

namespace aerascope {

struct Outweighed {
  PredictionId prediction;
  PredictionId surer;
};

// The open predictions that are outweighed, the surest first, looking only at pairs of which one is newer
// than `since`: the others were looked at when the newer of them was made.
std::vector<Outweighed> FindOutweighed(const KnowledgeBase& knowledge, PredictionId since);

}  // namespace aerascope
