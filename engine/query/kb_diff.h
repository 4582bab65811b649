// The difference of two knowledge bases by what they say, not by their numbers (canonical.h).
//
// It is told in pieces of knowledge: each model, a requirement model together with the composite state it
// asks for, and each composite state that no requirement model asks for. Pieces with equal content are one
// piece. Of the others, a piece of the left that has a more general or more specific form on the right, or
// one with other numbers, is one item with it; what is left stands alone, with its nearest relative on the
// other side.
//
// Always true: (1) a base differs from itself, or from one with the same content under other numbers or in
// another order, in nothing; (2) Diff(a, b) with sides exchanged is Diff(b, a); (3) counts equal the listed
// items; (4) order is by kind, then title, then content hash, never by number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/kb/knowledge_base.h"
#include "engine/query/model_graph.h"
#include "engine/query/piece_alignment.h"

namespace aerascope {

// One side of a difference: everything that a reader may want to show, as text.
struct KbDiffSide {
  std::string id;  // of the (first) item with this content
  Hash128 content;
  std::string title;
  std::string state;               // of a requirement model: the composite state it asks for; may be empty
  std::string target;              // of a requirement or reuse model: the model it speaks about
  Duration delay;                  // of a requirement model: how long before that its state is seen
  std::size_t copies = 1;          // items with this content
  std::vector<std::string> lines;  // conditions, or left and right side
  Evidence evidence;
  bool strong = false;
  ModelState model_state = ModelState::kActive;
  Origin origin = Origin::kSeed;
  std::string derived_from;  // id of the source on the same side; empty if none
};

enum class KbChange {
  kAdded,        // only the right has it
  kRemoved,      // only the left has it
  kGeneralised,  // the right has it in a more general form
  kSpecialised,  // the right has it in a more specific form
  kOtherValues,  // the right has it with other numbers, or about a model with other numbers
  kChanged,      // both have it, with other evidence, state or history
};
inline constexpr KbChange kKbChanges[] = {KbChange::kRemoved,     KbChange::kAdded,
                                          KbChange::kGeneralised, KbChange::kSpecialised,
                                          KbChange::kOtherValues, KbChange::kChanged};
KbChange Exchanged(KbChange change);       // from the other side
std::string_view NameOf(KbChange change);  // "added", "removed", "generalised" ...: stable names for exports

// The piece of the other side that is most like one which only this side has.
struct KbRelative {
  PieceRelation relation = PieceRelation::kOverlapping;  // of the right one to the left one, as in Alignment
  std::string id;                                        // on the other side
  std::string title;
  Hash128 content;
};

struct KbDiffItem {
  KbChange change = KbChange::kAdded;
  ModelGraphNodeKind kind = ModelGraphNodeKind::kCompositeState;
  Hash128 content;                     // of the left side, of the right if there is no left
  std::string title;                   // the same
  std::optional<KbDiffSide> left;      // none if added
  std::optional<KbDiffSide> right;     // none if removed
  std::optional<KbRelative> relative;  // of an item on one side only
  // Part by part, against the other side or the relative; else what the one side says.
  std::vector<AlignedRow> rows;
  // What differs of an item on both sides, as words: "confidence", "evidence", "strength", "state", "origin",
  // "derivation", "copies". Of a pair with different contents without the last two.
  std::vector<std::string> aspects;

  bool has_aspect(std::string_view aspect) const;
  // Of whoever has it; active where two sides differ in it.
  ModelState state() const;
};

struct KbDiffResult {
  std::vector<KbDiffItem> items;
  std::vector<KbDiffItem> same;  // equal in everything, ordered alike

  bool empty() const { return items.empty(); }
  std::int64_t Count(KbChange change) const;
  std::int64_t CountGivenUp(KbChange change) const;  // of these the deleted ones
};

// Deleted models are pieces, too, in state "deleted": whoever tells of one says that it was given up.
KbDiffResult DiffKnowledge(const KnowledgeBase& left, const KnowledgeBase& right);

// The same difference seen from the other side.
KbDiffResult Exchanged(KbDiffResult difference);

// "given up" or "phased out"; empty of what is active.
std::string_view WordsOf(ModelState state);

// One sentence for an item: "Only the right side knows grab_type_2 something large (mdl_33)."
std::string SentenceOf(const KbDiffItem& item, const std::string& left_name, const std::string& right_name);

}  // namespace aerascope
