#include "engine/query/piece_alignment.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "engine/base/text.h"
#include "engine/kb/term_codec.h"
#include "engine/query/describe.h"
#include "engine/query/parts.h"
#include "engine/query/without_numbers.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

using Names = std::vector<std::string>;

bool IsNumber(const Term& term) {
  return term.is(TermKind::kNumber) || term.is(TermKind::kTime) || term.is(TermKind::kDuration);
}

class FormMaker {
 public:
  FormMaker(const KnowledgeBase& knowledge, Hash128 content) : knowledge_(knowledge) {
    form_.content = content;
    form_.knowledge = &knowledge;
  }

  void Add(PartRole role, const FactPattern& pattern) {
    Parts parts;
    AddParts(knowledge_, pattern, 0, &parts, Writing::kCanonical);
    for (const Part& part : parts.parts) Add(role, part.positive, part.payload, instances_ + part.instance);
    instances_ += parts.instances + 1;
  }
  void Add(PartRole role, bool positive, const Term& payload, std::size_t instance = 0, bool denied = false) {
    PieceForm::Part part{role, positive, denied, payload, instance, Compared(payload), {}};
    part.shape = ShapeOf(part);
    form_.parts.push_back(std::move(part));
  }
  void Add(const Guard& guard, const std::vector<Term>* arguments = nullptr) {
    Term term = guard.target ? Term::Struct(":=", {Term::Variable(*guard.target), guard.expression})
                             : guard.expression;
    Add(PartRole::kGuard, true, arguments ? WithArguments(term, *arguments) : term);
  }
  PieceForm Take(Names given, Names canonical) {
    std::size_t count = std::max(given.size(), canonical.size());
    for (const PieceForm::Part& part : form_.parts) {
      form_.shapes.push_back(part.shape);
      ForEachVariable(part.payload, [&](int v) { count = std::max(count, static_cast<std::size_t>(v) + 1); });
    }
    std::sort(form_.shapes.begin(), form_.shapes.end());
    form_.given = Complete(std::move(given), count);
    form_.canonical = Complete(std::move(canonical), count);
    return std::move(form_);
  }

 private:
  static Names Complete(Names names, std::size_t count) {
    names.resize(count);
    for (std::size_t v = 0; v < count; ++v)
      if (names[v].empty()) names[v] = ValueText(Term::Variable(static_cast<int>(v)));
    return names;
  }

  Term Compared(const Term& payload) const {
    return Rewritten(payload, [&](const Term& part) -> std::optional<Term> {
      if (part.is(TermKind::kCompositeState)) {
        const CompositeStateRecord* record = knowledge_.Find(part.composite_state());
        return Term::String(record ? ToText(record->canonical.hash) : "?");
      }
      if (part.is(TermKind::kModel)) {
        const ModelRecord* record = knowledge_.Find(part.model());
        return Term::String(record ? ToText(record->canonical.hash) : "?");
      }
      return std::nullopt;
    });
  }

  static Hash128 ShapeOf(const PieceForm::Part& part) {
    const Term shape = Rewritten(WithZeros(part.compared), [](const Term& term) -> std::optional<Term> {
      if (term.is(TermKind::kVariable)) return Term::Wildcard();
      return std::nullopt;
    });
    return HashOf(std::string(NameOf(part.role)) + (part.positive ? " + " : " - ") + Encode(shape));
  }

  const KnowledgeBase& knowledge_;
  PieceForm form_;
  std::size_t instances_ = 0;
};

PieceForm FormOfRequirement(const KnowledgeBase& knowledge, const ModelRecord& record) {
  const Model& model = record.model;
  FormMaker maker(knowledge, record.canonical.hash);
  maker.Add(PartRole::kCondition, model.lhs);
  Names given = NamesLikeItsState(knowledge, model);
  Names canonical = CanonicalNames(knowledge, record);
  if (const auto sides = SidesOfInstance(knowledge, model.rhs.payload, given)) {
    canonical.resize(given.size());
    canonical.insert(canonical.end(), sides->rhs_names.begin() + static_cast<std::ptrdiff_t>(given.size()),
                     sides->rhs_names.end());
    given = sides->rhs_names;
    maker.Add(PartRole::kLeft, sides->lhs_positive, sides->lhs);
    maker.Add(PartRole::kRight, sides->rhs_positive, sides->rhs, 0, !model.rhs.positive);
  } else {
    maker.Add(PartRole::kRight, model.rhs);
  }
  const CompositeStateRecord* state = knowledge.Find(RequiredState(model));
  std::vector<Term> arguments;
  if (state && ArgumentsOf(state->state, model.lhs.payload, &arguments)) {
    for (const Guard& guard : state->state.guards) maker.Add(guard, &arguments);
  }
  for (const Guard& guard : model.forward) maker.Add(guard);
  for (const Guard& guard : model.backward) maker.Add(guard);
  return maker.Take(std::move(given), std::move(canonical));
}

// Each part of the smaller piece beside a part of the larger one, under one renaming of variables: as many as
// possible; then parts of one nested state beside parts of one; then equal numbers. Goes back where that
// fails, for a bounded number of steps.
class Matching {
 public:
  Matching(const PieceForm& small, const PieceForm& large)
      : small_(small),
        large_(large),
        variable_(small.given.size(), -1),
        taken_(large.given.size(), false),
        partner_(small.parts.size(), -1),
        changed_(small.parts.size(), false),
        used_(large.parts.size(), false) {
    // The sides first: they bind what the conditions are about.
    for (const bool sides : {true, false}) {
      for (std::size_t i = 0; i < small.parts.size(); ++i)
        if (IsSide(small.parts[i].role) == sides) order_.push_back(i);
    }
  }

  // False if the two have other commands or effects.
  bool Find() {
    Place(0, 0);
    return best_score_ >= 0;
  }
  const std::vector<int>& partner() const { return best_partner_; }    // -1: only in the smaller
  const std::vector<bool>& changed() const { return best_changed_; }   // with another number
  const std::vector<int>& variable() const { return best_variable_; }  // small's -> large's; -1: none

 private:
  static constexpr int kMaxSteps = 20'000;
  static constexpr std::int64_t kTogether = 10'000;        // outweighs any number of changed numbers
  static constexpr std::int64_t kAgreement = 100'000'000;  // outweighs any number of those

  static bool IsSide(PartRole role) { return role == PartRole::kLeft || role == PartRole::kRight; }

  void Place(std::size_t at, std::int64_t score) {
    if (score + (kAgreement + kTogether) * static_cast<std::int64_t>(order_.size() - at) <= best_score_)
      return;
    if (at == order_.size()) {
      best_score_ = score;
      best_partner_ = partner_;
      best_changed_ = changed_;
      best_variable_ = variable_;
      return;
    }
    const std::size_t i = order_[at];
    const PieceForm::Part& part = small_.parts[i];
    for (const bool with_changes : {false, true}) {
      for (std::size_t j = 0; j < large_.parts.size(); ++j) {
        if (used_[j] || large_.parts[j].shape != part.shape) continue;
        if (++steps_ > kMaxSteps) return;
        const std::vector<int> variable = variable_;
        const std::vector<bool> taken = taken_;
        bool changed = false;
        if (Same(part.compared, large_.parts[j].compared, &changed) && changed == with_changes) {
          used_[j] = true;
          partner_[i] = static_cast<int>(j);
          changed_[i] = changed;
          const std::int64_t together = InOneState(i, j) ? kTogether : 0;
          Place(at + 1, score + kAgreement + together - (changed ? 1 : 0));
          used_[j] = false;
        }
        partner_[i] = -1;
        changed_[i] = false;
        variable_ = variable;
        taken_ = taken;
      }
    }
    if (!IsSide(part.role) && steps_ <= kMaxSteps) Place(at + 1, score);
  }

  // Whether part i beside part j keeps nested states together, so far.
  bool InOneState(std::size_t i, std::size_t j) const {
    for (std::size_t k = 0; k < small_.parts.size(); ++k) {
      if (k == i || partner_[k] < 0) continue;
      const auto other = static_cast<std::size_t>(partner_[k]);
      const bool together = small_.parts[k].instance == small_.parts[i].instance;
      if (together != (large_.parts[other].instance == large_.parts[j].instance)) return false;
    }
    return true;
  }

  bool Same(const Term& a, const Term& b, bool* changed) {
    if (a.is(TermKind::kVariable) && b.is(TermKind::kVariable)) {
      int& renamed = variable_[static_cast<std::size_t>(a.variable())];
      const auto other = static_cast<std::size_t>(b.variable());
      if (renamed == -1 && !taken_[other]) {
        renamed = b.variable();
        taken_[other] = true;
      }
      return renamed == b.variable();
    }
    if (a.kind() != b.kind() || a.size() != b.size() || a.name() != b.name()) return false;
    if (IsNumber(a)) {
      *changed = *changed || !(a == b);
      return true;
    }
    if (a.items().empty()) return a == b;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!Same(a[i], b[i], changed)) return false;
    }
    return true;
  }

  const PieceForm& small_;
  const PieceForm& large_;
  std::vector<std::size_t> order_;
  std::vector<int> variable_;
  std::vector<bool> taken_;
  std::vector<int> partner_;
  std::vector<bool> changed_;
  std::vector<bool> used_;
  std::int64_t best_score_ = -1;
  std::vector<int> best_partner_;
  std::vector<bool> best_changed_;
  std::vector<int> best_variable_;
  int steps_ = 0;
};

// Names for the variables of both pieces, the same where a variable is the same.
struct SharedNames {
  Names small;
  Names large;
};

void MakeDifferent(Names* names, const Names& from) {
  for (std::string& name : *names) {
    while (std::find(from.begin(), from.end(), name) != from.end()) name += "'";
  }
}

SharedNames NamesFor(const PieceForm& small, const PieceForm& large, const std::vector<int>& variable) {
  // Given names read best, where both sides use them alike.
  bool alike = true;
  for (std::size_t v = 0; v < variable.size(); ++v)
    alike =
        alike && (variable[v] < 0 || small.given[v] == large.given[static_cast<std::size_t>(variable[v])]);
  SharedNames names{alike ? small.given : small.canonical, alike ? large.given : large.canonical};
  for (std::size_t v = 0; v < variable.size(); ++v) {
    Names own = {names.small[v]};
    if (variable[v] < 0)
      MakeDifferent(&own, names.large);
    else
      own[0] = names.large[static_cast<std::size_t>(variable[v])];
    names.small[v] = std::move(own[0]);
  }
  return names;
}

// Words of parts of one piece. Conditions on one thing make one line, as everywhere.
class RowWriter {
 public:
  RowWriter(const PieceForm& form, const Names& names) : form_(form), names_(names) {}

  struct Text {
    std::size_t at = 0;  // position of the first part it stands for
    std::string text;
    Names variables;
  };
  // Texts of parts of one role, in order.
  std::vector<Text> TextsOf(PartRole role, const std::vector<std::size_t>& positions) const {
    std::vector<Text> texts;
    if (role != PartRole::kCondition) {
      for (const std::size_t i : positions) texts.push_back(TextOf(i));
      return texts;
    }
    std::vector<Part> parts;
    for (const std::size_t i : positions)
      parts.push_back({form_.parts[i].positive, form_.parts[i].payload, i, form_.parts[i].instance, false});
    for (const Line& line : LinesOf(parts)) {
      Text text{line.components.front(), LineText(line, names_, ", "), {}};
      for (const std::size_t i : line.components) NoteNames(form_.parts[i].payload, &text.variables);
      texts.push_back(std::move(text));
    }
    return texts;
  }
  Text TextOf(std::size_t i) const {
    const PieceForm::Part& part = form_.parts[i];
    Text text{i, "", {}};
    if (part.role == PartRole::kCondition) return TextsOf(part.role, {i}).front();
    if (part.role == PartRole::kGuard && part.payload.IsStruct(":="))
      text.text = ValueText(part.payload[0], names_) + " := " + ValueText(part.payload[1], names_);
    else if (part.role == PartRole::kGuard)
      text.text = ValueText(part.payload, names_);
    else
      text.text = PayloadWords(*form_.knowledge, part.payload, names_, Writing::kCanonical);
    if (!part.positive) text.text = "not " + text.text;
    if (part.denied) text.text = part.positive ? "not " + text.text : "not (" + text.text + ")";
    NoteNames(part.payload, &text.variables);
    return text;
  }

 private:
  void NoteNames(const Term& term, Names* variables) const {
    ForEachVariable(term, [&](int v) {
      const std::string& name = names_[static_cast<std::size_t>(v)];
      if (std::find(variables->begin(), variables->end(), name) == variables->end())
        variables->push_back(name);
    });
  }

  const PieceForm& form_;
  const Names& names_;
};

constexpr PartRole kRoles[] = {PartRole::kCondition, PartRole::kLeft, PartRole::kRight, PartRole::kGuard};

// Rows of the larger piece as the left one, in its order; what only the smaller has comes last in its role.
std::vector<AlignedRow> RowsOf(const PieceForm& large, const PieceForm& small, const Matching& matching) {
  const SharedNames names = NamesFor(small, large, matching.variable());
  const RowWriter of_large(large, names.large);
  const RowWriter of_small(small, names.small);
  std::vector<int> partner(large.parts.size(), -1);
  for (std::size_t i = 0; i < small.parts.size(); ++i)
    if (matching.partner()[i] >= 0)
      partner[static_cast<std::size_t>(matching.partner()[i])] = static_cast<int>(i);
  std::vector<AlignedRow> rows;
  for (const PartRole role : kRoles) {
    std::vector<std::size_t> same, only_large, only_small;
    std::vector<std::pair<std::size_t, AlignedRow>> ordered;
    for (std::size_t i = 0; i < large.parts.size(); ++i) {
      if (large.parts[i].role != role) continue;
      if (partner[i] < 0) {
        only_large.push_back(i);
      } else if (!matching.changed()[static_cast<std::size_t>(partner[i])]) {
        same.push_back(i);
      } else {
        const auto here = of_large.TextOf(i);
        const auto there = of_small.TextOf(static_cast<std::size_t>(partner[i]));
        ordered.push_back({i, {role, PartStatus::kOtherValue, here.text, there.text, here.variables}});
      }
    }
    for (const auto& text : of_large.TextsOf(role, same))
      ordered.push_back({text.at, {role, PartStatus::kSame, text.text, text.text, text.variables}});
    for (const auto& text : of_large.TextsOf(role, only_large))
      ordered.push_back({text.at, {role, PartStatus::kLeftOnly, text.text, "", text.variables}});
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [at, row] : ordered) rows.push_back(std::move(row));
    for (std::size_t i = 0; i < small.parts.size(); ++i)
      if (small.parts[i].role == role && matching.partner()[i] < 0) only_small.push_back(i);
    for (const auto& text : of_small.TextsOf(role, only_small))
      rows.push_back({role, PartStatus::kRightOnly, "", text.text, text.variables});
  }
  return rows;
}

PieceRelation RelationOf(const Alignment& alignment, bool other_values) {
  if (alignment.left_only > 0 && alignment.right_only > 0) return PieceRelation::kOverlapping;
  if (alignment.left_only > 0) return PieceRelation::kGeneralised;
  if (alignment.right_only > 0) return PieceRelation::kSpecialised;
  return other_values ? PieceRelation::kOtherValues : PieceRelation::kSame;
}

bool IsSmaller(const PieceForm& a, const PieceForm& b) {
  return std::pair(a.parts.size(), a.content) < std::pair(b.parts.size(), b.content);
}

}  // namespace

std::string_view NameOf(PartRole role) {
  switch (role) {
    case PartRole::kCondition:
      return "condition";
    case PartRole::kLeft:
      return "left side";
    case PartRole::kRight:
      return "right side";
    case PartRole::kGuard:
      return "guard";
  }
  return {};
}

std::string_view NameOf(PartStatus status) {
  switch (status) {
    case PartStatus::kSame:
      return "same";
    case PartStatus::kLeftOnly:
      return "left";
    case PartStatus::kRightOnly:
      return "right";
    case PartStatus::kOtherValue:
      return "changed";
  }
  return {};
}

std::string_view NameOf(PieceRelation relation) {
  switch (relation) {
    case PieceRelation::kSame:
      return "same";
    case PieceRelation::kOtherValues:
      return "other_values";
    case PieceRelation::kGeneralised:
      return "generalised";
    case PieceRelation::kSpecialised:
      return "specialised";
    case PieceRelation::kOverlapping:
      return "overlapping";
    case PieceRelation::kUnrelated:
      return "unrelated";
  }
  return {};
}

PieceForm FormOf(const KnowledgeBase& knowledge, const CompositeStateRecord& record) {
  FormMaker maker(knowledge, record.canonical.hash);
  for (const FactPattern& component : InCanonicalOrder(record).components)
    maker.Add(PartRole::kCondition, component);
  for (const Guard& guard : record.state.guards) maker.Add(guard);
  return maker.Take(VariableNames(knowledge, record.state), CanonicalNames(knowledge, record));
}

PieceForm FormOf(const KnowledgeBase& knowledge, const ModelRecord& record) {
  if (IsRequirement(record.model)) return FormOfRequirement(knowledge, record);
  const Model& model = record.model;
  FormMaker maker(knowledge, record.canonical.hash);
  maker.Add(PartRole::kLeft, model.lhs);
  maker.Add(PartRole::kRight, {model.rhs.positive, RightSide(model), model.rhs.after, model.rhs.before});
  for (const Guard& guard : model.forward) maker.Add(guard);
  for (const Guard& guard : model.backward) maker.Add(guard);
  return maker.Take(VariableNames(knowledge, model), CanonicalNames(knowledge, record));
}

PieceRelation Exchanged(PieceRelation relation) {
  if (relation == PieceRelation::kGeneralised) return PieceRelation::kSpecialised;
  if (relation == PieceRelation::kSpecialised) return PieceRelation::kGeneralised;
  return relation;
}

Alignment Exchanged(Alignment alignment) {
  std::swap(alignment.left_only, alignment.right_only);
  alignment.relation = Exchanged(alignment.relation);
  alignment.rows = Exchanged(std::move(alignment.rows));
  return alignment;
}

std::vector<AlignedRow> Exchanged(std::vector<AlignedRow> rows) {
  for (AlignedRow& row : rows) {
    std::swap(row.left, row.right);
    if (row.status == PartStatus::kLeftOnly)
      row.status = PartStatus::kRightOnly;
    else if (row.status == PartStatus::kRightOnly)
      row.status = PartStatus::kLeftOnly;
  }
  return rows;
}

Alignment Align(const PieceForm& left, const PieceForm& right) {
  Alignment alignment;
  if (left.content == right.content) {
    // Equal by their canonical forms, so there is nothing to search for.
    const RowWriter writer(left, left.given == right.given ? left.given : left.canonical);
    alignment.relation = PieceRelation::kSame;
    for (const PartRole role : kRoles) {
      std::vector<std::size_t> positions;
      for (std::size_t i = 0; i < left.parts.size(); ++i)
        if (left.parts[i].role == role) positions.push_back(i);
      if (role == PartRole::kCondition) alignment.shared = static_cast<std::int64_t>(positions.size());
      for (const auto& text : writer.TextsOf(role, positions))
        alignment.rows.push_back({role, PartStatus::kSame, text.text, text.text, text.variables});
    }
    return alignment;
  }
  if (IsSmaller(left, right)) return Exchanged(Align(right, left));
  Matching matching(right, left);
  if (!matching.Find()) return alignment;
  const auto counts = [](PartRole role) { return role == PartRole::kCondition || role == PartRole::kGuard; };
  bool other_values = false;
  std::size_t matched = 0;
  for (std::size_t i = 0; i < right.parts.size(); ++i) {
    const bool has_partner = matching.partner()[i] >= 0;
    matched += has_partner ? 1 : 0;
    other_values = other_values || matching.changed()[i];
    if (!counts(right.parts[i].role)) continue;
    alignment.right_only += has_partner ? 0 : 1;
    alignment.shared += has_partner && right.parts[i].role == PartRole::kCondition ? 1 : 0;
  }
  // A side of the larger that found no partner: another effect.
  for (const PartRole role : {PartRole::kLeft, PartRole::kRight}) {
    const auto of_role = [&](const PieceForm::Part& part) { return part.role == role; };
    if (std::count_if(left.parts.begin(), left.parts.end(), of_role) !=
        std::count_if(right.parts.begin(), right.parts.end(), of_role)) {
      return {};
    }
  }
  alignment.left_only = static_cast<std::int64_t>(left.parts.size() - matched);
  alignment.relation = RelationOf(alignment, other_values);
  alignment.rows = RowsOf(left, right, matching);
  return alignment;
}

std::size_t CommonShapes(const PieceForm& a, const PieceForm& b) {
  std::vector<Hash128> common;
  std::set_intersection(a.shapes.begin(), a.shapes.end(), b.shapes.begin(), b.shapes.end(),
                        std::back_inserter(common));
  return common.size();
}

std::vector<AlignedRow> RowsOf(const PieceForm& form, PartStatus side) {
  Alignment alignment = Align(form, form);
  for (AlignedRow& row : alignment.rows) {
    row.status = side;
    if (side == PartStatus::kLeftOnly) row.right.clear();
    if (side == PartStatus::kRightOnly) row.left.clear();
  }
  return alignment.rows;
}

}  // namespace aerascope
