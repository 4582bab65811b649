// The items of a difference in words.
#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/kb_diff.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

std::string_view KindWords(ModelGraphNodeKind kind) {
  switch (kind) {
    case ModelGraphNodeKind::kCompositeState:
      return "the composite state";
    case ModelGraphNodeKind::kCausalModel:
      return "the causal model";
    case ModelGraphNodeKind::kRequirementModel:
      return "the requirement model";
    case ModelGraphNodeKind::kStrongRequirementModel:
      return "the strong requirement model";
    case ModelGraphNodeKind::kReuseModel:
      return "the reuse model";
    case ModelGraphNodeKind::kDriveModel:
      return "the drive model";
  }
  return {};
}

std::string Quoted(const std::string& text) {
  return "\"" + text + "\"";
}

// "mdl_42 on cst_40".
std::string IdsOf(const KbDiffSide& side) {
  return side.state.empty() ? side.id : side.id + " on " + side.state;
}

std::string EvidenceText(const Evidence& evidence) {
  return FormatConfidence(evidence.rate()) + " (" + FormatNumber(evidence.positive, 6) + " of " +
         FormatNumber(evidence.total, 6) + ")";
}

std::string StateText(ModelState state) {
  return state == ModelState::kActive ? "active" : std::string(WordsOf(state));
}

std::string AspectText(const std::string& aspect, const KbDiffSide& left, const KbDiffSide& right) {
  const auto from_to = [&](const std::string& a, const std::string& b) {
    return aspect + " " + a + " and " + b;
  };
  if (aspect == "confidence" || aspect == "evidence")
    return from_to(EvidenceText(left.evidence), EvidenceText(right.evidence));
  if (aspect == "strength")
    return from_to(left.strong ? "confirmed" : "open", right.strong ? "confirmed" : "open");
  if (aspect == "state") return from_to(StateText(left.model_state), StateText(right.model_state));
  if (aspect == "origin")
    return from_to(std::string(WordsOf(left.origin)), std::string(WordsOf(right.origin)));
  if (aspect == "copies") return from_to(std::to_string(left.copies), std::to_string(right.copies));
  const auto source = [](const KbDiffSide& side) {
    return side.derived_from.empty() ? std::string("from nothing") : "from " + side.derived_from;
  };
  return from_to(source(left), source(right));
}

// What only one side of the rows has, quoted.
std::string OnlyIn(PartStatus side, const std::vector<AlignedRow>& rows) {
  std::vector<std::string> texts;
  for (const AlignedRow& row : rows)
    if (row.status == side) texts.push_back(Quoted(side == PartStatus::kLeftOnly ? row.left : row.right));
  return InWords(texts);
}

std::string OtherValues(const std::vector<AlignedRow>& rows) {
  std::vector<std::string> texts;
  for (const AlignedRow& row : rows) {
    if (row.status == PartStatus::kOtherValue)
      texts.push_back(Quoted(row.left) + " and " + Quoted(row.right));
  }
  return Join(texts, "; ");
}

// How one piece differs in content from the other, which is the left or the right one of the rows.
std::string ContentText(const std::vector<AlignedRow>& rows, bool from_left) {
  const std::string gone = OnlyIn(from_left ? PartStatus::kLeftOnly : PartStatus::kRightOnly, rows);
  const std::string more = OnlyIn(from_left ? PartStatus::kRightOnly : PartStatus::kLeftOnly, rows);
  const std::string other = OtherValues(rows);
  std::vector<std::string> texts;
  if (!gone.empty()) texts.push_back("without " + gone);
  if (!more.empty()) texts.push_back("with " + more);
  if (!other.empty()) texts.push_back("other numbers: " + other);
  return Join(texts, "; ");
}

std::string AloneText(const KbDiffItem& item, const std::string& left_name, const std::string& right_name) {
  const bool on_left = item.left.has_value();
  const KbDiffSide& side = on_left ? *item.left : *item.right;
  const std::string_view verb = side.model_state == ModelState::kDeleted ? " had " : " has ";
  std::string text = "Only " + (on_left ? left_name : right_name) + std::string(verb) +
                     std::string(KindWords(item.kind)) + " " + Quoted(side.title) + " (" + IdsOf(side) + ")";
  if (const std::string_view state = WordsOf(side.model_state); !state.empty())
    text += ", " + std::string(state);
  if (!item.relative) return text + ".";
  // The relation is told of the right one; of the left one it is the other way round.
  const PieceRelation relation = on_left ? Exchanged(item.relative->relation) : item.relative->relation;
  const std::string what = relation == PieceRelation::kGeneralised   ? ", more general than "
                           : relation == PieceRelation::kSpecialised ? ", more specific than "
                                                                     : ", nearest to ";
  text += what + item.relative->id + " of " + (on_left ? right_name : left_name);
  if (item.relative->title != side.title) text += ", " + Quoted(item.relative->title);
  const std::string content = ContentText(item.rows, !on_left);
  return text + (content.empty() ? "." : ": " + content + ".");
}

std::string PairText(const KbDiffItem& item, const std::string& left_name, const std::string& right_name) {
  const KbDiffSide& left = *item.left;
  const KbDiffSide& right = *item.right;
  const std::string_view form = item.change == KbChange::kGeneralised   ? "in a more general form"
                                : item.change == KbChange::kSpecialised ? "in a more specific form"
                                                                        : "with other numbers";
  std::string text = right_name + " has " + std::string(KindWords(item.kind)) + " " + Quoted(left.title) +
                     " of " + left_name + " (" + IdsOf(left) + ") " + std::string(form);
  text += right.title == left.title ? "" : ", " + Quoted(right.title);
  text += " (" + IdsOf(right) + ")";
  const std::string content = ContentText(item.rows, true);
  return content.empty() ? text : text + ": " + content;
}

}  // namespace

std::string_view NameOf(KbChange change) {
  switch (change) {
    case KbChange::kAdded:
      return "added";
    case KbChange::kRemoved:
      return "removed";
    case KbChange::kGeneralised:
      return "generalised";
    case KbChange::kSpecialised:
      return "specialised";
    case KbChange::kOtherValues:
      return "other_values";
    case KbChange::kChanged:
      return "changed";
  }
  return {};
}

std::string_view WordsOf(ModelState state) {
  switch (state) {
    case ModelState::kActive:
      return {};
    case ModelState::kPhasedOut:
      return "phased out";
    case ModelState::kDeleted:
      return "given up";
  }
  return {};
}

std::string SentenceOf(const KbDiffItem& item, const std::string& left_name, const std::string& right_name) {
  if (!item.left || !item.right) return AloneText(item, left_name, right_name);
  std::vector<std::string> aspects;
  for (const std::string& aspect : item.aspects)
    aspects.push_back(AspectText(aspect, *item.left, *item.right));
  if (const std::string_view state = WordsOf(item.state()); !state.empty())
    aspects.push_back(std::string(state) + " in both");
  const std::string how = Join(aspects, "; ");
  if (item.change != KbChange::kChanged)
    return PairText(item, left_name, right_name) + (how.empty() ? "." : "; " + how + ".");
  return "Both have " + std::string(KindWords(item.kind)) + " " + Quoted(item.title) + " (" + item.left->id +
         ", " + item.right->id + "), with " + how + ".";
}

}  // namespace aerascope
