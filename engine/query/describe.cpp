#include "engine/query/describe.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "engine/base/text.h"
#include "engine/query/parts.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

using Kind = Line::Predicate::Kind;
using Names = std::vector<std::string>;

// At most four decimals; very small and very large numbers by significant digits.
std::string PlainNumber(double value) {
  if (!std::isfinite(value) || std::abs(value) >= 1e9 || (value != 0 && std::abs(value) < 5e-5)) {
    return FormatNumber(value, 4);
  }
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 4);
  if (error != std::errc()) return FormatNumber(value, 4);
  std::string text(buffer, end);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

bool IsExpression(const Term& term) {
  static const std::set<std::string, std::less<>> kOperators = {"+", "-", "*", "/",  "<>",
                                                                "=", "<", ">", "<=", ">="};
  return term.is(TermKind::kStruct) && term.size() == 2 && kOperators.contains(term.name());
}

std::string OperandText(const Term& term, const Names& names) {
  const std::string text = ValueText(term, names);
  return IsExpression(term) ? "(" + text + ")" : text;
}

std::string ItemsText(const Term& term, const Names& names, std::string_view separator) {
  std::vector<std::string> items;
  for (const Term& item : term.items()) items.push_back(ValueText(item, names));
  return Join(items, separator);
}

std::string PredicateText(const Line::Predicate& predicate, const Names& names) {
  const std::string value = ValueText(predicate.value, names);
  std::string text;
  switch (predicate.kind) {
    case Kind::kNoun:
      text = value;
      break;
    case Kind::kPlace:
      text = "at " + value;
      break;
    case Kind::kAttribute:
      text = Printable(predicate.attribute) + " " + value;
      break;
    case Kind::kOther:
      text = value;
      break;
  }
  return predicate.positive ? text : "not " + text;
}

// "hand at P" reads without a comma; other predicates of one thing are parted by the separator.
std::string PredicatesText(const Line& line, const Names& names, std::string_view separator,
                           std::size_t from = 0) {
  std::string text;
  for (std::size_t i = from; i < line.predicates.size(); ++i) {
    if (i > from) text += line.predicates[i - 1].kind == Kind::kNoun ? " " : separator;
    text += PredicateText(line.predicates[i], names);
  }
  return text;
}

Condition ConditionOf(const Line& line, const Names& names) {
  Condition condition;
  condition.components = line.components;
  condition.text = LineText(line, names, ", ");
  const auto note = [&](const Term& term) {
    ForEachVariable(term, [&](int v) {
      const auto i = static_cast<std::size_t>(v);
      const std::string name = i < names.size() ? names[i] : ValueText(Term::Variable(v));
      if (std::find(condition.variables.begin(), condition.variables.end(), name) ==
          condition.variables.end()) {
        condition.variables.push_back(name);
      }
    });
  };
  note(line.subject);
  for (const Line::Predicate& predicate : line.predicates) note(predicate.value);
  if (line.subject.is(TermKind::kNil)) {
    condition.value = condition.text;
    condition.brief = condition.text;
    return condition;
  }

  condition.subject = ValueText(line.subject, names);
  const Line::Predicate& first = line.predicates.front();
  std::size_t used = 1;
  condition.value = ValueText(first.value, names);
  if (first.kind == Kind::kAttribute) condition.relation = Printable(first.attribute);
  if (first.kind == Kind::kPlace) condition.relation = "at";
  if (!first.positive) condition.relation = condition.relation.empty() ? "not" : "not " + condition.relation;
  if (first.kind == Kind::kNoun && first.positive && line.predicates.size() > 1 &&
      line.predicates[1].kind == Kind::kPlace && line.predicates[1].positive) {
    condition.relation = condition.value + " at";
    condition.value = ValueText(line.predicates[1].value, names);
    used = 2;
  }
  if (used < line.predicates.size()) condition.value += ", " + PredicatesText(line, names, ", ", used);

  // The one-line form keeps what tells states apart: constants by value, places and kinds only if nothing
  // else is said.
  std::vector<std::string> brief;
  bool constants = true;
  for (const Line::Predicate& predicate : line.predicates) {
    if (predicate.kind != Kind::kAttribute) continue;
    constants = constants && predicate.positive && predicate.value.is(TermKind::kOntology);
    brief.push_back((NamesAPlace(predicate.attribute) ? "at " : "") + ValueText(predicate.value, names));
  }
  if (!brief.empty()) condition.brief = constants ? Join(brief, " ") : condition.text;
  return condition;
}

// The names that an instance's arguments have in the knowledge it is an instance of.
void BorrowNames(const KnowledgeBase& knowledge, const Term& payload, Names* names) {
  const auto borrow = [&](const std::vector<Term>& arguments, const Names& nested) {
    for (std::size_t i = 0; i < arguments.size() && i < nested.size(); ++i) {
      if (!arguments[i].is(TermKind::kVariable)) continue;
      const auto v = static_cast<std::size_t>(arguments[i].variable());
      if (v < names->size() && (*names)[v].empty()) (*names)[v] = nested[i];
    }
  };
  std::vector<Term> arguments;
  if (IsIcst(payload) && payload[0].is(TermKind::kCompositeState)) {
    const CompositeStateRecord* nested = knowledge.Find(payload[0].composite_state());
    if (nested && ArgumentsOf(nested->state, payload, &arguments))
      borrow(arguments, nested->state.variable_names);
  }
  if (IsImdl(payload) && payload[0].is(TermKind::kModel)) {
    const ModelRecord* nested = knowledge.Find(payload[0].model());
    if (nested && ArgumentsOf(nested->model, payload, &arguments))
      borrow(arguments, nested->model.variable_names);
  }
}

// Components of a generalised state -> the components of its source they are, by one renaming of variables
// for all. Tries positions in order and goes back where that fails, for a bounded number of steps.
class Alignment {
 public:
  Alignment(const CompositeState& source, const CompositeState& derived)
      : source_(source),
        derived_(derived),
        variable_(VariableCount(source), -1),
        used_(source.components.size(), false) {}

  bool Find() { return Place(0); }
  bool Kept(std::size_t source_component) const { return used_[source_component]; }
  // The derived state's variable for one of the source's; -1 if it was dropped.
  int VariableFor(std::size_t source_variable) const { return variable_[source_variable]; }

 private:
  static constexpr int kMaxSteps = 20'000;

  bool Place(std::size_t derived_component) {
    if (derived_component == derived_.components.size()) return true;
    for (std::size_t i = 0; i < source_.components.size(); ++i) {
      if (used_[i] || ++steps_ > kMaxSteps) continue;
      const std::vector<int> before = variable_;
      if (Same(source_.components[i], derived_.components[derived_component])) {
        used_[i] = true;
        if (Place(derived_component + 1)) return true;
        used_[i] = false;
      }
      variable_ = before;
    }
    return false;
  }

  bool Same(const FactPattern& source, const FactPattern& derived) {
    return source.positive == derived.positive && Same(source.payload, derived.payload) &&
           Same(source.after, derived.after) && Same(source.before, derived.before);
  }

  bool Same(const Term& source, const Term& derived) {
    if (source.is(TermKind::kVariable) && derived.is(TermKind::kVariable)) {
      int& renamed = variable_[static_cast<std::size_t>(source.variable())];
      const bool taken = std::find(variable_.begin(), variable_.end(), derived.variable()) != variable_.end();
      if (renamed == -1 && !taken) renamed = derived.variable();
      return renamed == derived.variable();
    }
    if (source.kind() != derived.kind() || source.size() != derived.size() ||
        source.name() != derived.name()) {
      return false;
    }
    if (source.items().empty()) return source == derived;
    for (std::size_t i = 0; i < source.size(); ++i) {
      if (!Same(source[i], derived[i])) return false;
    }
    return true;
  }

  const CompositeState& source_;
  const CompositeState& derived_;
  std::vector<int> variable_;
  std::vector<bool> used_;
  int steps_ = 0;
};

std::vector<int> AllVariables(std::size_t count) {
  std::vector<int> variables(count);
  for (std::size_t v = 0; v < count; ++v) variables[v] = static_cast<int>(v);
  return variables;
}

}  // namespace

std::string InWords(const std::vector<std::string>& items) {
  if (items.size() < 2) return Join(items, "");
  return Join({items.begin(), items.end() - 1}, ", ") + " and " + items.back();
}

std::string LineText(const Line& line, const std::vector<std::string>& names, std::string_view separator) {
  const std::string predicates = PredicatesText(line, names, separator);
  return line.subject.is(TermKind::kNil) ? predicates : ValueText(line.subject, names) + " " + predicates;
}

std::string ClauseOf(const Line& line, const std::vector<std::string>& names) {
  return LineText(line, names, " ");
}

std::vector<std::string> ClausesOf(const KnowledgeBase& knowledge, const Term& payload,
                                   const std::vector<std::string>& names, Writing writing) {
  Parts parts;
  AddParts(knowledge, {true, payload, Term::Wildcard(), Term::Wildcard()}, 0, &parts, writing);
  std::vector<std::string> clauses;
  for (const Line& line : LinesOf(parts.parts)) clauses.push_back(ClauseOf(line, names));
  return clauses;
}

std::vector<std::string> VariableNames(const KnowledgeBase& knowledge, const CompositeState& state) {
  const std::size_t count = VariableCount(state);
  Names names = state.variable_names;
  names.resize(count);
  for (const FactPattern& component : state.components) BorrowNames(knowledge, component.payload, &names);
  FillNames(RolesOf(PartsOf(knowledge, state), count), AllVariables(count), &names);
  return names;
}

std::vector<std::string> VariableNames(const KnowledgeBase& knowledge, const Model& model) {
  const std::size_t count = VariableCount(model);
  Names names = model.variable_names;
  names.resize(count);
  BorrowNames(knowledge, model.lhs.payload, &names);
  BorrowNames(knowledge, model.rhs.payload, &names);
  FillNames(RolesOf(PartsOf(knowledge, model), count), AllVariables(count), &names);
  return names;
}

std::vector<std::string> CanonicalNames(const KnowledgeBase& knowledge, const CompositeStateRecord& record) {
  Names names;
  FillNames(
      RolesOf(PartsOf(knowledge, InCanonicalOrder(record), Writing::kCanonical), VariableCount(record.state)),
      record.canonical.variables, &names);
  return names;
}

std::vector<std::string> CanonicalNames(const KnowledgeBase& knowledge, const ModelRecord& record) {
  Names names;
  FillNames(RolesOf(PartsOf(knowledge, record.model, Writing::kCanonical), VariableCount(record.model)),
            record.canonical.variables, &names);
  return names;
}

std::vector<Condition> ConditionsOf(const KnowledgeBase& knowledge, const CompositeState& state) {
  return ConditionsOf(knowledge, state, VariableNames(knowledge, state));
}

std::vector<Condition> ConditionsOf(const KnowledgeBase& knowledge, const CompositeState& state,
                                    const std::vector<std::string>& names) {
  std::vector<Condition> conditions;
  for (const Line& line : LinesOf(PartsOf(knowledge, state).parts))
    conditions.push_back(ConditionOf(line, names));
  return conditions;
}

std::vector<Condition> CanonicalConditions(const KnowledgeBase& knowledge,
                                           const CompositeStateRecord& record) {
  const Parts parts = PartsOf(knowledge, InCanonicalOrder(record), Writing::kCanonical);
  const Names names = CanonicalNames(knowledge, record);
  std::vector<Condition> conditions;
  for (const Line& line : LinesOf(parts.parts)) conditions.push_back(ConditionOf(line, names));
  return conditions;
}

std::vector<Condition> ConditionsWithPruned(const KnowledgeBase& knowledge, CompositeStateId id) {
  const CompositeStateRecord* record = knowledge.Find(id);
  if (!record) return {};
  const CompositeStateRecord* source = knowledge.Find(record->derived_from);
  if (!source) return ConditionsOf(knowledge, record->state);
  Alignment alignment(source->state, record->state);
  if (!alignment.Find()) return ConditionsOf(knowledge, record->state);

  // The source's lines in the derived state's words.
  const Names own = VariableNames(knowledge, record->state);
  const Names of_source = VariableNames(knowledge, source->state);
  Names names(of_source.size());
  for (std::size_t v = 0; v < names.size(); ++v) {
    const int renamed = alignment.VariableFor(v);
    names[v] = renamed >= 0 ? own[static_cast<std::size_t>(renamed)] : of_source[v];
    if (renamed < 0 && std::find(own.begin(), own.end(), names[v]) != own.end()) names[v] += "'";
  }
  Parts parts = PartsOf(knowledge, source->state);
  for (Part& part : parts.parts) part.apart = !alignment.Kept(part.component);
  std::vector<Condition> conditions;
  for (const Line& line : LinesOf(parts.parts)) {
    conditions.push_back(ConditionOf(line, names));
    conditions.back().pruned = line.apart;
  }
  return conditions;
}

std::vector<Condition> ConditionsOfRequirement(const KnowledgeBase& knowledge, const Model& requirement) {
  std::vector<Condition> conditions = ConditionsWithPruned(knowledge, RequiredState(requirement));
  const ModelRecord* record = knowledge.Find(requirement.id);
  if (record && !record->derived_from.valid())
    std::erase_if(conditions, [](const Condition& condition) { return condition.pruned; });
  return conditions;
}

std::string QuotedConditions(const KnowledgeBase& knowledge, const CompositeState& state,
                             const std::vector<std::size_t>& components) {
  std::vector<std::string> quoted;
  for (const Condition& condition : ConditionsOf(knowledge, state)) {
    const bool named =
        std::any_of(condition.components.begin(), condition.components.end(), [&](std::size_t i) {
          return std::find(components.begin(), components.end(), i) != components.end();
        });
    if (named) quoted.push_back("`" + condition.text + "`");
  }
  return InWords(quoted);
}

std::string OneLine(const std::vector<Condition>& conditions) {
  std::vector<std::string> brief;
  std::vector<std::string> texts;
  for (const Condition& condition : conditions) {
    if (condition.pruned) continue;
    if (!condition.brief.empty()) brief.push_back(condition.brief);
    texts.push_back(condition.text);
  }
  return Join(brief.empty() ? texts : brief, " \u00b7 ");
}

std::string ValueText(const Term& value, const std::vector<std::string>& names) {
  switch (value.kind()) {
    case TermKind::kNumber:
      return PlainNumber(value.number());
    case TermKind::kWildcard:
      return "anything";
    case TermKind::kSet:
      return "[" + ItemsText(value, names, " ") + "]";
    case TermKind::kStruct: {
      if (IsExpression(value)) {
        return OperandText(value[0], names) + " " + value.name() + " " + OperandText(value[1], names);
      }
      if (value.name() == "vec2" || value.name() == "vec3") return "(" + ItemsText(value, names, ", ") + ")";
      const std::string items = ItemsText(value, names, " ");
      return "(" + Printable(value.name()) + (items.empty() ? "" : " ") + items + ")";
    }
    case TermKind::kNil:
    case TermKind::kEntity:
    case TermKind::kOntology:
    case TermKind::kTime:
    case TermKind::kDuration:
    case TermKind::kString:
    case TermKind::kBool:
    case TermKind::kVariable:
    case TermKind::kCompositeState:
    case TermKind::kModel:
      return ToText(value, names);
  }
  return {};
}

std::string PayloadText(const KnowledgeBase& knowledge, const Term& payload,
                        const std::vector<std::string>& names) {
  return PayloadWords(knowledge, payload, names, Writing::kAsGiven);
}

std::string StepText(const KnowledgeBase& knowledge, const PlanStep& step) {
  return step.command.is(TermKind::kNil) ? "wait" : PayloadText(knowledge, step.command);
}

std::string PayloadWords(const KnowledgeBase& knowledge, const Term& payload,
                         const std::vector<std::string>& names, Writing writing) {
  if (IsCommand(payload)) return ValueText(payload[0], names) + " " + ValueText(payload[1], names);
  if (IsImdl(payload) && payload[0].is(TermKind::kModel))
    return ModelInstanceText(knowledge, payload, names, writing);
  // Open variables of an instance are called as in the knowledge it is an instance of.
  if (names.empty() && IsIcst(payload) && payload[0].is(TermKind::kCompositeState) && !payload.ground()) {
    const CompositeStateRecord* record = knowledge.Find(payload[0].composite_state());
    std::vector<Term> arguments;
    if (record && ArgumentsOf(record->state, payload, &arguments)) {
      std::size_t count = 0;
      ForEachVariable(payload, [&](int v) { count = std::max(count, static_cast<std::size_t>(v) + 1); });
      const Names own = VariableNames(knowledge, record->state);
      Names borrowed(count);
      for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i].is(TermKind::kVariable))
          borrowed[static_cast<std::size_t>(arguments[i].variable())] = own[i];
      }
      // A wildcard is a variable nobody named: it gets a number of its own behind those there are.
      std::vector<Term> named;
      for (const int variable : ArgumentVariables(record->state)) {
        const Term& argument = arguments[static_cast<std::size_t>(variable)];
        const bool open = argument.is(TermKind::kWildcard);
        named.push_back(open ? Term::Variable(static_cast<int>(borrowed.size())) : argument);
        if (open) borrowed.push_back(own[static_cast<std::size_t>(variable)]);
      }
      count = borrowed.size();
      if (count == 0) return InWords(ClausesOf(knowledge, payload, names, writing));
      FillNames(std::vector<RoleOfVariable>(count), AllVariables(count), &borrowed);
      const Term instance = MakeIcst(record->state.id, {}, std::move(named));
      return PayloadWords(knowledge, instance, borrowed, writing);
    }
  }
  return InWords(ClausesOf(knowledge, payload, names, writing));
}

std::string FactText(const KnowledgeBase& knowledge, const Fact& fact) {
  return (fact.positive ? "" : "not ") + PayloadText(knowledge, fact.payload);
}

std::vector<Binding> BindingsOf(const KnowledgeBase& knowledge, const Term& icst_payload) {
  std::vector<Binding> bindings;
  if (!IsIcst(icst_payload) || !icst_payload[0].is(TermKind::kCompositeState)) return bindings;
  const CompositeStateRecord* record = knowledge.Find(icst_payload[0].composite_state());
  std::vector<Term> arguments;
  if (!record || !ArgumentsOf(record->state, icst_payload, &arguments)) return bindings;
  const Names names = VariableNames(knowledge, record->state);
  for (const int variable : ArgumentVariables(record->state)) {
    const auto v = static_cast<std::size_t>(variable);
    if (arguments[v].ground()) bindings.push_back({names[v], ValueText(arguments[v])});
  }
  return bindings;
}

std::string BindingsText(const std::vector<Binding>& bindings) {
  std::vector<std::string> texts;
  for (const Binding& binding : bindings) texts.push_back(binding.variable + " = " + binding.value);
  return Join(texts, ", ");
}

std::string_view WordsOf(Origin origin) {
  switch (origin) {
    case Origin::kSeed:
      return "given";
    case Origin::kInduction:
      return "learned";
    case Origin::kPredictionFailure:
      return "learned from a failed prediction";
    case Origin::kGoalSuccess:
      return "learned from a goal that was reached";
    case Origin::kAnalogy:
      return "made by analogy";
  }
  return {};
}

std::string SecondsText(Time time) {
  if (time >= kForever) return "forever";
  return PlainNumber(static_cast<double>(time.us) / 1e6) + " s";
}

}  // namespace aerascope
