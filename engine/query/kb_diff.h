// The difference of two knowledge bases by what they say, not by their numbers (canonical.h).
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

namespace aerascope {

// One side of a difference: everything that a reader may want to show, as text.
struct KbDiffSide {
  std::string id;                  // of the (first) item with this content
  std::size_t copies = 1;          // items with this content
  std::vector<std::string> lines;  // conditions, or left and right side
  Evidence evidence;
  bool strong = false;
  ModelState state = ModelState::kActive;
  Origin origin = Origin::kSeed;
  std::string derived_from;  // id of the source on the same side; empty if none
};

enum class KbChange { kAdded, kRemoved, kChanged };
std::string_view NameOf(KbChange change);

struct KbDiffItem {
  KbChange change = KbChange::kAdded;
  ModelGraphNodeKind kind = ModelGraphNodeKind::kCompositeState;
  Hash128 content;
  std::string title;                // the same on both sides
  std::optional<KbDiffSide> left;   // none if added
  std::optional<KbDiffSide> right;  // none if removed
  // What differs of an item on both sides, as words: "confidence", "evidence", "strength", "state", "origin",
  // "derivation", "copies".
  std::vector<std::string> aspects;
};

struct KbDiffResult {
  std::vector<KbDiffItem> items;
  std::int64_t added = 0;
  std::int64_t removed = 0;
  std::int64_t changed = 0;
  std::int64_t same = 0;  // contents equal in everything

  bool empty() const { return items.empty(); }
};

// Deleted models count as knowledge in state "deleted".
KbDiffResult DiffKnowledge(const KnowledgeBase& left, const KnowledgeBase& right);

// The same difference seen from the other side.
KbDiffResult Exchanged(KbDiffResult difference);

// One sentence for an item: "Only the right side knows grab_type_2 something large (mdl_33)."
std::string SentenceOf(const KbDiffItem& item, const std::string& left_name, const std::string& right_name);

}  // namespace aerascope
