// A Term is an immutable value of the language: everything a fact, pattern, guard or definition is made of.
//
// Atoms are names (entities, ontology symbols), numbers, times, strings, variables and references to
// knowledge; sets and structs hold other terms. `(mk.val h position (vec2 0.1 0.2))` is a struct "mk.val" of
// an entity, an ontology symbol and a struct "vec2" of two numbers. Copies are cheap (a shared pointer to an
// immutable node) and may be used from any thread.
//
// Always true: (1) equal terms have equal hashes, on every machine; (2) every number has at most 9
// significant decimal digits; (3) a term is never deeper than kMaxTermDepth.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/ids.h"
#include "engine/base/time.h"

namespace aerascope {

enum class TermKind : std::uint8_t {
  kNil,
  kEntity,    // a named individual; learning may put a variable in its place
  kOntology,  // a named property or category; never abstracted
  kNumber,
  kTime,  // an instant
  kDuration,
  kString,
  kBool,
  kVariable,        // numbered from 0 within one model, composite state or goal
  kWildcard,        // matches anything, binds nothing
  kSet,             // an ordered list, repeats allowed (the language calls it a set)
  kStruct,          // a head word and arguments
  kCompositeState,  // a reference to a composite state of this episode
  kModel,           // a reference to a model of this episode
};

inline constexpr int kMaxTermDepth = 64;

class Term {
 public:
  Term();  // nil
  static Term Nil() { return Term(); }
  static Term Entity(std::string name);
  static Term Ontology(std::string name);
  static Term Number(double value);  // rounded to 9 significant digits
  static Term Instant(Time time);
  static Term Span(Duration duration);
  static Term String(std::string text);
  static Term Bool(bool value);
  static Term Variable(int index);
  static Term Wildcard();
  static Term Set(std::vector<Term> items);
  static Term Struct(std::string head, std::vector<Term> arguments);
  static Term Reference(CompositeStateId id);
  static Term Reference(ModelId id);

  TermKind kind() const { return node_->kind; }
  bool is(TermKind kind) const { return node_->kind == kind; }
  bool IsStruct(std::string_view head) const { return is(TermKind::kStruct) && node_->text == head; }

  // The name of an entity or ontology symbol, the head of a struct, the text of a string; else empty.
  const std::string& name() const { return node_->text; }
  double number() const { return node_->number; }                                        // of a number
  Time time() const { return {node_->integer}; }                                         // of an instant
  Duration duration() const { return {node_->integer}; }                                 // of a duration
  bool boolean() const { return node_->integer != 0; }                                   // of a bool
  int variable() const { return static_cast<int>(node_->integer); }                      // of a variable
  CompositeStateId composite_state() const { return CompositeStateId{node_->integer}; }  // of a reference
  ModelId model() const { return ModelId{node_->integer}; }                              // of a reference

  // The elements of a set or the arguments of a struct; empty for atoms.
  std::span<const Term> items() const { return node_->items; }
  std::size_t size() const { return node_->items.size(); }
  const Term& operator[](std::size_t i) const { return node_->items[i]; }

  std::uint64_t hash() const { return node_->hash; }
  bool ground() const { return node_->ground; }  // no variable and no wildcard inside
  int depth() const { return node_->depth; }     // 1 for an atom

  // Exact equality; numbers are compared without tolerance (matching has the tolerance, match.h).
  bool operator==(const Term& other) const;
  // A total order by content, the same on every machine: kind, then value, then elements.
  bool operator<(const Term& other) const;

 private:
  struct Node {
    TermKind kind = TermKind::kNil;
    bool ground = true;
    int depth = 1;
    std::int64_t integer = 0;
    double number = 0;
    std::string text;
    std::vector<Term> items;
    std::uint64_t hash = 0;
  };
  explicit Term(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  static Term Make(Node node);

  std::shared_ptr<const Node> node_;  // shared: terms are values, copied freely between threads
};

// For people: names bare, variables as v3, or by the given names (index = variable number) where there are
// some.
std::string ToText(const Term& term, std::span<const std::string> variable_names = {});

// The attribute and object of `(mk.val object attribute value)`, if it is one.
inline bool IsValue(const Term& payload) {
  return payload.IsStruct("mk.val") && payload.size() == 3;
}
inline bool IsCommand(const Term& payload) {
  return payload.IsStruct("cmd") && payload.size() == 2;
}
// `(icst cst_1 [template] [arguments])` and `(imdl mdl_1 [template] [exposed])`.
inline bool IsIcst(const Term& payload) {
  return payload.IsStruct("icst") && payload.size() == 3;
}
inline bool IsImdl(const Term& payload) {
  return payload.IsStruct("imdl") && payload.size() == 3;
}

Term MakeValue(Term object, Term attribute, Term value);
Term MakeCommand(Term function, std::vector<Term> arguments);
Term MakeIcst(CompositeStateId state, std::vector<Term> template_arguments, std::vector<Term> arguments);
Term MakeImdl(ModelId model, std::vector<Term> template_arguments, std::vector<Term> exposed);

// Calls visit(index) for each variable inside, in reading order, repeats included.
template <class Visit>
void ForEachVariable(const Term& term, Visit&& visit) {
  if (term.is(TermKind::kVariable)) visit(term.variable());
  if (term.ground()) return;
  for (const Term& item : term.items()) ForEachVariable(item, visit);
}

// Calls visit(term) for this term and every term inside, in reading order.
template <class Visit>
void ForEachTerm(const Term& term, Visit&& visit) {
  visit(term);
  for (const Term& item : term.items()) ForEachTerm(item, visit);
}

// The term with every leaf or inner term t replaced by replace(t) where that gives a value
// (std::optional<Term>); replaced terms are not looked into again.
template <class Replace>
Term Rewritten(const Term& term, Replace&& replace) {
  if (auto replacement = replace(term)) return *replacement;
  if (term.items().empty()) return term;
  std::vector<Term> items;
  items.reserve(term.size());
  for (const Term& item : term.items()) items.push_back(Rewritten(item, replace));
  return term.is(TermKind::kSet) ? Term::Set(std::move(items)) : Term::Struct(term.name(), std::move(items));
}

}  // namespace aerascope
