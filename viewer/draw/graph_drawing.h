// The model graph at one moment: cards, rings and links at the places of a TriadLayout.
//
// What is known later keeps its place as a dotted card that says when; conditions dropped by an analogy are
// struck.
#pragma once

#include <map>
#include <set>
#include <string>

#include "engine/query/run.h"
#include "viewer/draw/svg.h"
#include "viewer/draw/theme.h"
#include "viewer/layout/triad_layout.h"

namespace aerascope {

// Lines that open cards of composite states show, struck ones included: for TriadOptions::lines.
std::map<CompositeStateId, int> LineCounts(const KnowledgeBase& final_knowledge);

// The layout of a run's knowledge at its end, with room for its texts.
TriadLayout LayOutKnowledge(const Run& run, TriadOptions options = {});

struct ModelGraphView {
  Time at;                           // what was known after all events up to here
  std::set<std::size_t> open_bands;  // the others are folded
  ModelId chosen;                    // drawn as what was asked about; none if invalid
};

inline constexpr int kColumnHeadHeight = 26;  // over the cards: what each column says

// The size that the drawing takes, heads of the columns included.
Size ModelGraphSize(const TriadLayout& layout, const ModelGraphView& view);
// Draws into `svg` from its origin on.
void DrawModelGraph(Svg& svg, const Run& run, const TriadLayout& layout, const ModelGraphView& view);
// A document of its own.
std::string ModelGraphSvg(const Run& run, const TriadLayout& layout, const ModelGraphView& view,
                          const Theme& theme);

}  // namespace aerascope
