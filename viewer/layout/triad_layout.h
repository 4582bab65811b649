// TriadLayout: where each piece of knowledge stands in the drawn model graph.
//
// Three columns, CST | M_req | CM. One band a causal model, in order of creation; in it one row a requirement
// model with the composite state it asks for; what was derived by analogy stands directly under its source. A
// band has two forms, folded (a line a card) and open (a line a condition); both are laid out, so that a
// viewer opens a band by moving the bands below it and nothing else.
//
// Always true: (1) positions follow from the knowledge base given and nothing else; give the one at the end
// of the episode, and no card moves while time does; (2) coordinates are whole numbers and no text is
// measured; (3) cards of one form never overlap; (4) the work is linear in the number of models and composite
// states, apart from look-ups.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "viewer/layout/geometry.h"

namespace aerascope {

enum class CardKind {
  kState,         // a composite state: `state`
  kStateAgain,    // a composite state that has its card in an earlier row: `state`; one line even when open
  kCondition,     // a requirement model's left side that is a plain fact: `model` is the requirement model
  kRequirement,   // a requirement model, drawn as a ring; the rectangle is the ring's square: `model`
  kModel,         // a causal, reuse or drive model: `model`
  kUnknownModel,  // a model that is spoken about but not in the knowledge base: `model`
};

struct Card {
  CardKind kind = CardKind::kState;
  CompositeStateId state;
  ModelId model;
  std::size_t row = 0;  // in its band, from 0; 0 for the model of the band
  int lines = 1;        // text lines it has room for when open, headings not counted
};

enum class EdgeKind {
  kRequires,  // composite state or condition -> requirement model
  kEnables,   // requirement model -> model, or -> the requirement model it speaks about
  kDerived,   // composite state -> the one made from it by analogy
};

struct Edge {
  EdgeKind kind = EdgeKind::kRequires;
  std::size_t from = 0;  // positions in TriadBand::cards
  std::size_t to = 0;
};

// The course of an edge: the corners of a polyline, or the four control points of a cubic curve.
struct EdgePath {
  bool cubic = false;
  std::vector<Point> points;
  Point mark;  // where a sign belongs (the star of an analogy); the note of a derived edge stands right of it
};

// One form of a band, relative to the band's own top left corner.
struct BandForm {
  int height = 0;
  std::vector<Rect> cards;      // as TriadBand::cards
  std::vector<EdgePath> edges;  // as TriadBand::edges
  // Per edge: the free line over a derived card, for "by analogy: 3 of 4 conditions hold for s1"; empty
  // elsewhere and in the folded form.
  std::vector<Rect> notes;
};

enum class BandKind {
  kCausalModel,  // a causal (or reuse) model and what it requires
  kDriveModels,  // models that lead to a drive
  kOtherStates,  // composite states no requirement model asks for directly: given by hand, or parts of others
};

struct TriadBand {
  BandKind kind = BandKind::kCausalModel;
  ModelId model;  // of a causal-model band; else invalid
  std::size_t rows = 0;
  std::size_t hidden_rows =
      0;  // left out because of TriadOptions::max_rows; a free line under the rows says so
  std::vector<Card> cards;
  std::vector<Edge> edges;
  BandForm folded;
  BandForm open;
};

struct TriadOptions {
  int left_margin = 34;  // room for the links of analogies
  int state_width = 272;
  int ring_column_width = 142;  // with room for a number left of a ring
  int model_width = 204;
  int max_lines = 12;  // conditions shown in an open card; beyond, the last line says how many more
  // Rows of a band, and cards of a list; more are counted, not shown. For paper: a page shows all.
  std::size_t max_rows = std::numeric_limits<std::size_t>::max();
  // Text lines of composite states that differ from their number of components (struck ones of an analogy,
  // nested states written out). Missing: one a component.
  std::map<CompositeStateId, int> lines;
};

inline constexpr int kBandGap = 18;
inline constexpr int kRingRadiusFolded = 14;
inline constexpr int kRingRadiusOpen = 18;
inline constexpr int kCardHeadHeight = 28;  // the heading of an open card
inline constexpr int kCardLineHeight = 18;
inline constexpr int kFoldedCardHeight = 28;
inline constexpr int kModelSideHeight = 24;  // one side of a causal model's card, folded
inline constexpr int kOpenModelSideHeight = 28;

struct TriadLayout {
  int width = 0;
  Rect states;  // the columns; only x and width say something
  Rect requirements;
  Rect models;
  std::vector<TriadBand> bands;
};

// The heading of a band that is not a causal model's; empty for one that is.
std::string_view BandTitle(BandKind kind);
// Height of the free line over the cards of a band with a title; included in its forms.
inline constexpr int kBandTitleHeight = 22;
// Height of the free line that counts hidden rows; included in the forms of a band that has some.
inline constexpr int kHiddenRowsHeight = 24;

TriadLayout LayOutTriads(const KnowledgeBase& final_knowledge, const TriadOptions& options = {});

// A layout with chosen bands open: top of each band, and the height of all.
struct StackedBands {
  std::vector<int> tops;
  int height = 0;
};
StackedBands StackBands(const TriadLayout& layout, const std::set<std::size_t>& open_bands);

}  // namespace aerascope
