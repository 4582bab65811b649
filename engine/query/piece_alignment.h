// Two pieces of knowledge laid beside each other, part by part: which condition, command, effect or guard is
// in both, in one of them, or in both with another number. So one can say that a piece of one agent is more
// general than a piece of another, whatever the numbers and names of either.
//
// A requirement model is laid out with the composite state it asks for and the command and effect of the
// model it speaks about: the triad. Variables may be called differently; one renaming has to serve for all
// parts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/hash.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

enum class PartRole { kCondition, kLeft, kRight, kGuard };
std::string_view NameOf(PartRole role);  // "condition", "left side", ...: stable names for exports

// What a piece says, in a form that does not depend on the numbers of its knowledge base.
struct PieceForm {
  struct Part {
    PartRole role = PartRole::kCondition;
    bool positive = true;
    bool denied = false;  // the effect that a veto speaks against; all parts of one kind of piece agree in it
    Term payload;         // as the piece has it, nested states written out
    std::size_t instance = 0;  // which nested state it is from, as in parts.h: what makes a line together
    Term compared;             // the same with references to knowledge by content
    Hash128 shape;  // of `compared` without variables and numbers: parts of other shapes never agree
  };
  std::vector<Part> parts;             // conditions in canonical order, then the sides, then guards
  std::vector<Hash128> shapes;         // of its parts, ascending
  std::vector<std::string> given;      // names of all its variables, as everywhere else
  std::vector<std::string> canonical;  // the same by role only
  Hash128 content;
  const KnowledgeBase* knowledge = nullptr;  // where it is from; outlives this
};
PieceForm FormOf(const KnowledgeBase& knowledge, const CompositeStateRecord& record);
PieceForm FormOf(const KnowledgeBase& knowledge, const ModelRecord& record);

enum class PartStatus { kSame, kLeftOnly, kRightOnly, kOtherValue };
std::string_view NameOf(PartStatus status);  // "same", "left", "right", "changed"

// One line of the comparison, in names that both sides share.
struct AlignedRow {
  PartRole role = PartRole::kCondition;
  PartStatus status = PartStatus::kSame;
  std::string left;   // empty if only the right has it
  std::string right;  // empty if only the left has it
  std::vector<std::string> variables;

  bool operator==(const AlignedRow&) const = default;
};

// How the right piece relates to the left one.
enum class PieceRelation {
  kSame,         // part for part
  kOtherValues,  // part for part, but for numbers
  kGeneralised,  // the right asks for less
  kSpecialised,  // the right asks for more
  kOverlapping,  // each asks for something that the other does not
  kUnrelated,    // other commands or effects, or nothing in common
};
PieceRelation Exchanged(PieceRelation relation);
std::string_view NameOf(PieceRelation relation);  // "same", "other_values", "generalised" ...

struct Alignment {
  PieceRelation relation = PieceRelation::kUnrelated;
  std::int64_t shared = 0;      // conditions in both, also those with another number
  std::int64_t left_only = 0;   // conditions and guards
  std::int64_t right_only = 0;  // the same
  std::vector<AlignedRow> rows;
};

// The same whichever side is called left (with rows and relation exchanged). The search is bounded: of very
// large pieces it may find less in common than there is.
Alignment Align(const PieceForm& left, const PieceForm& right);
Alignment Exchanged(Alignment alignment);
std::vector<AlignedRow> Exchanged(std::vector<AlignedRow> rows);

// How many parts could agree at most, told by their shapes: a quick look before Align.
std::size_t CommonShapes(const PieceForm& a, const PieceForm& b);

// The rows of a piece that stands alone, all on one side.
std::vector<AlignedRow> RowsOf(const PieceForm& form, PartStatus side);

}  // namespace aerascope
