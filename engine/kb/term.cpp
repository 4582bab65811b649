#include "engine/kb/term.h"

#include <bit>
#include <cassert>

#include "engine/base/text.h"

namespace aerascope {
namespace {

std::uint64_t Mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ULL + (hash << 6) + (hash >> 2);
  hash ^= hash >> 31;
  return hash * 0x7fb5d329728ea185ULL;
}

std::uint64_t HashText(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

Term Term::Make(Node node) {
  std::uint64_t hash =
      Mix(static_cast<std::uint64_t>(node.kind) + 1, static_cast<std::uint64_t>(node.integer));
  hash = Mix(hash, std::bit_cast<std::uint64_t>(node.number));
  hash = Mix(hash, HashText(node.text));
  if (node.kind == TermKind::kVariable || node.kind == TermKind::kWildcard) node.ground = false;
  for (const Term& item : node.items) {
    hash = Mix(hash, item.hash());
    node.ground = node.ground && item.ground();
    node.depth = std::max(node.depth, item.depth() + 1);
  }
  assert(node.depth <= kMaxTermDepth && "readers refuse deeper text; the engine builds nothing as deep");
  node.hash = hash;
  return Term(std::make_shared<const Node>(std::move(node)));
}

Term::Term() {
  static const Term nil = Make(Node{});
  node_ = nil.node_;
}

Term Term::Entity(std::string name) {
  return Make({.kind = TermKind::kEntity, .text = std::move(name), .items = {}});
}
Term Term::Ontology(std::string name) {
  return Make({.kind = TermKind::kOntology, .text = std::move(name), .items = {}});
}
Term Term::Number(double value) {
  return Make({.kind = TermKind::kNumber, .number = RoundNumber(value), .text = {}, .items = {}});
}
Term Term::Instant(Time time) {
  return Make({.kind = TermKind::kTime, .integer = time.us, .text = {}, .items = {}});
}
Term Term::Span(Duration duration) {
  return Make({.kind = TermKind::kDuration, .integer = duration.us, .text = {}, .items = {}});
}
Term Term::String(std::string text) {
  return Make({.kind = TermKind::kString, .text = std::move(text), .items = {}});
}
Term Term::Bool(bool value) {
  return Make({.kind = TermKind::kBool, .integer = value ? 1 : 0, .text = {}, .items = {}});
}
Term Term::Variable(int index) {
  assert(index >= 0);
  return Make({.kind = TermKind::kVariable, .integer = index, .text = {}, .items = {}});
}
Term Term::Wildcard() {
  return Make({.kind = TermKind::kWildcard, .text = {}, .items = {}});
}
Term Term::Set(std::vector<Term> items) {
  return Make({.kind = TermKind::kSet, .text = {}, .items = std::move(items)});
}
Term Term::Struct(std::string head, std::vector<Term> arguments) {
  return Make({.kind = TermKind::kStruct, .text = std::move(head), .items = std::move(arguments)});
}
Term Term::Reference(CompositeStateId id) {
  return Make({.kind = TermKind::kCompositeState, .integer = id.value, .text = {}, .items = {}});
}
Term Term::Reference(ModelId id) {
  return Make({.kind = TermKind::kModel, .integer = id.value, .text = {}, .items = {}});
}

bool Term::operator==(const Term& other) const {
  if (node_ == other.node_) return true;
  const Node& a = *node_;
  const Node& b = *other.node_;
  return a.hash == b.hash && a.kind == b.kind && a.integer == b.integer &&
         std::bit_cast<std::uint64_t>(a.number) == std::bit_cast<std::uint64_t>(b.number) &&
         a.text == b.text && a.items == b.items;
}

bool Term::operator<(const Term& other) const {
  const Node& a = *node_;
  const Node& b = *other.node_;
  if (node_ == other.node_) return false;
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.integer != b.integer) return a.integer < b.integer;
  if (a.number != b.number) return a.number < b.number;
  if (a.text != b.text) return a.text < b.text;
  if (a.items.size() != b.items.size()) return a.items.size() < b.items.size();
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    if (a.items[i] < b.items[i]) return true;
    if (b.items[i] < a.items[i]) return false;
  }
  return false;
}

std::string ToText(const Term& term, std::span<const std::string> variable_names) {
  const auto list = [&](std::string text, std::string_view open, std::string_view close) {
    for (const Term& item : term.items()) {
      if (!text.empty()) text += ' ';
      text += ToText(item, variable_names);
    }
    return std::string(open) + text + std::string(close);
  };
  switch (term.kind()) {
    case TermKind::kNil:
      return "nil";
    case TermKind::kEntity:
    case TermKind::kOntology:
      return Printable(term.name());
    case TermKind::kNumber:
      return FormatNumber(term.number());
    case TermKind::kTime:
      return ToText(term.time());
    case TermKind::kDuration:
      return ToText(term.duration());
    case TermKind::kString:
      return "\"" + Printable(term.name()) + "\"";
    case TermKind::kBool:
      return term.boolean() ? "true" : "false";
    case TermKind::kVariable: {
      const auto index = static_cast<std::size_t>(term.variable());
      if (index < variable_names.size() && !variable_names[index].empty())
        return Printable(variable_names[index]);
      return "v" + std::to_string(index);
    }
    case TermKind::kWildcard:
      return ":";
    case TermKind::kSet:
      return list("", "[", "]");
    case TermKind::kStruct:
      return list(Printable(term.name()), "(", ")");
    case TermKind::kCompositeState:
      return "cst_" + std::to_string(term.composite_state().value);
    case TermKind::kModel:
      return "mdl_" + std::to_string(term.model().value);
  }
  return {};
}

Term MakeValue(Term object, Term attribute, Term value) {
  return Term::Struct("mk.val", {std::move(object), std::move(attribute), std::move(value)});
}
Term MakeCommand(Term function, std::vector<Term> arguments) {
  return Term::Struct("cmd", {std::move(function), Term::Set(std::move(arguments))});
}
Term MakeIcst(CompositeStateId state, std::vector<Term> template_arguments, std::vector<Term> arguments) {
  return Term::Struct("icst", {Term::Reference(state), Term::Set(std::move(template_arguments)),
                               Term::Set(std::move(arguments))});
}
Term MakeImdl(ModelId model, std::vector<Term> template_arguments, std::vector<Term> exposed) {
  return Term::Struct("imdl", {Term::Reference(model), Term::Set(std::move(template_arguments)),
                               Term::Set(std::move(exposed))});
}

}  // namespace aerascope
