#include "engine/query/parts.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "engine/base/text.h"

namespace aerascope {
namespace {

constexpr int kMaxExpressionDepth = 8;

void Count(const Term& term, std::size_t* count) {
  ForEachVariable(term, [&](int v) { *count = std::max(*count, static_cast<std::size_t>(v) + 1); });
}
void Count(const FactPattern& pattern, std::size_t* count) {
  Count(pattern.payload, count);
  Count(pattern.after, count);
  Count(pattern.before, count);
}
void Count(const std::vector<Guard>& guards, std::size_t* count) {
  for (const Guard& guard : guards) {
    if (guard.target) *count = std::max(*count, static_cast<std::size_t>(*guard.target) + 1);
    Count(guard.expression, count);
  }
}

void Assign(const std::vector<int>& variables, const Term& values, std::vector<Term>* arguments) {
  for (std::size_t i = 0; i < variables.size(); ++i) {
    (*arguments)[static_cast<std::size_t>(variables[i])] = values[i];
  }
}

FactPattern WithArguments(const FactPattern& pattern, const std::vector<Term>& arguments) {
  return {pattern.positive, aerascope::WithArguments(pattern.payload, arguments),
          aerascope::WithArguments(pattern.after, arguments),
          aerascope::WithArguments(pattern.before, arguments)};
}

class Writer {
 public:
  Writer(const KnowledgeBase& knowledge, std::size_t component, Parts* parts, Writing writing)
      : knowledge_(knowledge), component_(component), parts_(*parts), writing_(writing) {}

  void Add(const FactPattern& pattern, int depth, std::size_t instance) {
    if (parts_.parts.size() >= kMaxParts) return;
    AddTimes(pattern);
    if (depth < kMaxNesting && AddNested(pattern, depth)) return;
    parts_.parts.push_back({pattern.positive, pattern.payload, component_, instance, false, pattern.after});
  }

 private:
  void AddTimes(const FactPattern& pattern) {
    parts_.times.push_back(pattern.after);
    parts_.times.push_back(pattern.before);
    ForEachTerm(pattern.payload, [&](const Term& term) {
      if (term.IsStruct("ti"))
        parts_.times.insert(parts_.times.end(), term.items().begin(), term.items().end());
    });
  }

  // A negative instance is not written out: "not (a and b)" is not "not a, not b".
  bool AddNested(const FactPattern& pattern, int depth) {
    std::vector<Term> arguments;
    if (IsIcst(pattern.payload) && pattern.payload[0].is(TermKind::kCompositeState) && pattern.positive) {
      const CompositeStateRecord* nested = knowledge_.Find(pattern.payload[0].composite_state());
      if (!nested || !ArgumentsOf(nested->state, pattern.payload, &arguments)) return false;
      const std::size_t instance = ++parts_.instances;
      const CompositeState state =
          writing_ == Writing::kCanonical ? InCanonicalOrder(*nested) : nested->state;
      // What it is made of holds when it holds.
      for (const FactPattern& component : state.components) {
        FactPattern part = WithArguments(component, arguments);
        part.after = pattern.after;
        part.before = pattern.before;
        Add(part, depth + 1, instance);
      }
      return true;
    }
    if (IsImdl(pattern.payload) && pattern.payload[0].is(TermKind::kModel)) {
      const ModelRecord* nested = knowledge_.Find(pattern.payload[0].model());
      if (!nested || !ArgumentsOf(nested->model, pattern.payload, &arguments)) return false;
      const std::size_t instance = ++parts_.instances;
      Add(WithArguments(nested->model.lhs, arguments), depth + 1, instance);
      Add(WithArguments(nested->model.rhs, arguments), depth + 1, instance);
      return true;
    }
    return false;
  }

  const KnowledgeBase& knowledge_;
  std::size_t component_;
  Parts& parts_;
  Writing writing_;
};

// A name not taken yet: the letter itself, else the letter and a number.
std::string FreeName(const std::string& base, const std::set<std::string>& taken) {
  if (!taken.contains(base)) return base;
  for (int i = 2;; ++i) {
    std::string name = base + std::to_string(i);
    if (!taken.contains(name)) return name;
  }
}

std::string FreeThing(const std::set<std::string>& taken) {
  for (const char* letter : {"X", "Y", "Z"}) {
    if (!taken.contains(letter)) return letter;
  }
  return FreeName("X", taken);
}

std::string LetterOf(const std::string& attribute) {
  const auto first = attribute.empty() ? 'V' : static_cast<unsigned char>(attribute[0]);
  if (!std::isalpha(first)) return "V";
  const std::string letter(1, static_cast<char>(std::toupper(first)));
  return letter == "T" || letter == "X" || letter == "Y" || letter == "Z" ? "V" : letter;
}

Line::Predicate PredicateOf(const Part& part) {
  using Kind = Line::Predicate::Kind;
  if (!IsValue(part.payload)) return {Kind::kOther, part.positive, "", part.payload, part.since};
  const std::string& attribute = part.payload[1].name();
  Kind kind = KindOfAttribute(attribute);
  // "C essence X" of a variable says which kind; only a constant reads as a noun.
  if (kind == Kind::kNoun && !part.payload[2].is(TermKind::kOntology)) kind = Kind::kAttribute;
  return {kind, part.positive, attribute, part.payload[2], part.since};
}

bool Says(const Line& line, const Line::Predicate& predicate) {
  return std::any_of(line.predicates.begin(), line.predicates.end(), [&](const Line::Predicate& other) {
    return other.positive == predicate.positive && other.attribute == predicate.attribute &&
           other.value == predicate.value && other.since == predicate.since;
  });
}

// Takes away what other composite states say whole, the later line; the lines that say it stand for its
// components too.
void SayOnce(std::vector<Line>* lines) {
  for (std::size_t i = lines->size(); i-- > 0;) {
    const Line line = (*lines)[i];
    std::vector<Line*> saying;
    for (const Line::Predicate& predicate : line.predicates) {
      const auto other = std::find_if(lines->begin(), lines->end(), [&](const Line& one) {
        return one.instance != line.instance && one.apart == line.apart && one.subject == line.subject &&
               Says(one, predicate);
      });
      if (other != lines->end()) saying.push_back(&*other);
    }
    if (saying.size() < line.predicates.size()) continue;
    for (Line* other : saying) {
      std::vector<std::size_t>& all = other->components;
      all.insert(all.end(), line.components.begin(), line.components.end());
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    lines->erase(lines->begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

void AddParts(const KnowledgeBase& knowledge, const FactPattern& pattern, std::size_t component, Parts* parts,
              Writing writing) {
  Writer(knowledge, component, parts, writing).Add(pattern, 0, 0);
}

Parts PartsOf(const KnowledgeBase& knowledge, const CompositeState& state, Writing writing) {
  Parts parts;
  for (std::size_t i = 0; i < state.components.size(); ++i)
    AddParts(knowledge, state.components[i], i, &parts, writing);
  return parts;
}

CompositeState InCanonicalOrder(const CompositeStateRecord& record) {
  if (record.canonical.components.size() != record.state.components.size()) return record.state;
  CompositeState state = record.state;
  for (std::size_t i = 0; i < state.components.size(); ++i) {
    state.components[i] = record.state.components[static_cast<std::size_t>(record.canonical.components[i])];
  }
  return state;
}

Parts PartsOf(const KnowledgeBase& knowledge, const Model& model, Writing writing) {
  Parts parts;
  AddParts(knowledge, model.lhs, 0, &parts, writing);
  AddParts(knowledge, model.rhs, 1, &parts, writing);
  for (const Term& argument : model.template_arguments) {
    if (argument.IsStruct("ti"))
      parts.times.insert(parts.times.end(), argument.items().begin(), argument.items().end());
  }
  return parts;
}

bool ArgumentsOf(const CompositeState& state, const Term& icst, std::vector<Term>* arguments) {
  arguments->assign(VariableCount(state), Term::Wildcard());
  const std::vector<int> variables = ArgumentVariables(state);
  if (!IsIcst(icst) || !icst[2].is(TermKind::kSet) || icst[2].size() != variables.size()) return false;
  Assign(variables, icst[2], arguments);
  return true;
}

bool ArgumentsOf(const Model& model, const Term& imdl, std::vector<Term>* arguments) {
  arguments->assign(VariableCount(model), Term::Wildcard());
  const std::vector<int> exposed = ExposedVariables(model);
  if (!IsImdl(imdl) || imdl[1].size() != model.template_arguments.size() ||
      imdl[2].size() != exposed.size()) {
    return false;
  }
  for (std::size_t i = 0; i < model.template_arguments.size(); ++i) {
    const Term& parameter = model.template_arguments[i];
    const Term& value = imdl[1][i];
    if (parameter.is(TermKind::kVariable)) Assign({parameter.variable()}, Term::Set({value}), arguments);
    if (!parameter.IsStruct("ti") || value.size() != parameter.size()) continue;
    for (std::size_t j = 0; j < parameter.size(); ++j) {
      if (parameter[j].is(TermKind::kVariable))
        Assign({parameter[j].variable()}, Term::Set({value[j]}), arguments);
    }
  }
  Assign(exposed, imdl[2], arguments);
  return true;
}

Term WithArguments(const Term& term, const std::vector<Term>& arguments) {
  if (term.depth() > kMaxTermDepth / 4 * 3) return Term::Wildcard();
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (!part.is(TermKind::kVariable)) return std::nullopt;
    const auto variable = static_cast<std::size_t>(part.variable());
    if (variable >= arguments.size()) return Term::Wildcard();
    // Together they may not be deeper than a term can be.
    return arguments[variable].depth() > kMaxTermDepth / 4 ? Term::Wildcard() : arguments[variable];
  });
}

std::size_t VariableCount(const CompositeState& state) {
  std::size_t count = 0;
  for (const FactPattern& component : state.components) Count(component, &count);
  Count(state.guards, &count);
  return count;
}

std::size_t VariableCount(const Model& model) {
  std::size_t count = 0;
  for (const Term& argument : model.template_arguments) Count(argument, &count);
  Count(model.lhs, &count);
  Count(model.rhs, &count);
  Count(model.forward, &count);
  Count(model.backward, &count);
  return count;
}

Term RightSide(const Model& model) {
  std::vector<Term> values(VariableCount(model));
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = Term::Variable(static_cast<int>(v));
  for (const Guard& guard : model.forward) {
    if (!guard.target) continue;
    Term value = WithArguments(guard.expression, values);
    if (value.depth() <= kMaxExpressionDepth)
      values[static_cast<std::size_t>(*guard.target)] = std::move(value);
  }
  return WithArguments(model.rhs.payload, values);
}

std::vector<RoleOfVariable> RolesOf(const Parts& parts, std::size_t variables) {
  std::vector<RoleOfVariable> roles(variables);
  // The most telling place wins: time, then thing, then value.
  const auto tell = [&](const Term& term, VariableRole role, const std::string& attribute) {
    ForEachVariable(term, [&](int v) {
      const auto i = static_cast<std::size_t>(v);
      if (i < variables && role < roles[i].role) roles[i] = {role, attribute};
    });
  };
  for (const Part& part : parts.parts) {
    if (!IsValue(part.payload)) continue;
    tell(part.payload[0], VariableRole::kThing, "");
    // What stands in a list is a thing again: the C of (h holding [C]).
    const bool list = part.payload[2].is(TermKind::kSet);
    tell(part.payload[2], list ? VariableRole::kThing : VariableRole::kValue, part.payload[1].name());
  }
  for (const Term& time : parts.times) tell(time, VariableRole::kTime, "");
  return roles;
}

void FillNames(const std::vector<RoleOfVariable>& roles, const std::vector<int>& order,
               std::vector<std::string>* names) {
  names->resize(roles.size());
  std::set<std::string> taken;
  for (std::string& name : *names) {
    if (name.empty()) continue;
    name = FreeName(Printable(name), taken);
    taken.insert(name);
  }
  const auto fill = [&](std::size_t i) {
    if (!(*names)[i].empty()) return;
    std::string name;
    switch (roles[i].role) {
      case VariableRole::kTime:
        name = FreeName("T", taken);
        break;
      case VariableRole::kThing:
        name = FreeThing(taken);
        break;
      case VariableRole::kValue:
        name = FreeName(LetterOf(roles[i].attribute), taken);
        break;
      case VariableRole::kOther:
        name = FreeName("V", taken);
        break;
    }
    taken.insert(name);
    (*names)[i] = std::move(name);
  };
  for (const int variable : order) {
    if (static_cast<std::size_t>(variable) < roles.size()) fill(static_cast<std::size_t>(variable));
  }
  for (std::size_t i = 0; i < roles.size(); ++i) fill(i);
}

Line::Predicate::Kind KindOfAttribute(std::string_view attribute) {
  if (attribute == "essence") return Line::Predicate::Kind::kNoun;
  return attribute == "position" ? Line::Predicate::Kind::kPlace : Line::Predicate::Kind::kAttribute;
}

bool NamesAKind(std::string_view attribute) {
  return attribute == "essence" || attribute == "shape";
}

bool NamesAPlace(std::string_view attribute) {
  return attribute == "position" || attribute == "at";
}

std::vector<Line> LinesOf(const std::vector<Part>& parts) {
  using Kind = Line::Predicate::Kind;
  std::vector<Line> lines;
  for (const Part& part : parts) {
    Line::Predicate predicate = PredicateOf(part);
    const Term subject = IsValue(part.payload) ? part.payload[0] : Term::Nil();
    if (!IsValue(part.payload)) {
      lines.push_back({subject, {std::move(predicate)}, {part.component}, part.instance, part.apart});
      continue;
    }
    const auto is_attribute = [](const Line::Predicate& p) { return p.kind == Kind::kAttribute; };
    const auto same = std::find_if(lines.begin(), lines.end(), [&](const Line& line) {
      return line.instance == part.instance && line.apart == part.apart && line.subject == part.payload[0] &&
             !(is_attribute(predicate) &&
               std::any_of(line.predicates.begin(), line.predicates.end(), is_attribute));
    });
    if (same == lines.end()) {
      lines.push_back({part.payload[0], {std::move(predicate)}, {part.component}, part.instance, part.apart});
      continue;
    }
    same->predicates.push_back(std::move(predicate));
    if (same->components.back() != part.component) same->components.push_back(part.component);
  }
  for (Line& line : lines) {
    std::stable_sort(line.predicates.begin(), line.predicates.end(), [](const auto& a, const auto& b) {
      return std::pair(!a.positive, a.kind) < std::pair(!b.positive, b.kind);
    });
  }
  SayOnce(&lines);
  return lines;
}

}  // namespace aerascope
