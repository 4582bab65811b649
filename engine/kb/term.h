// A Term is an immutable value of the language: everything a fact, pattern, guard or definition is made of.
//
// Atoms are names (entities, ontology symbols), numbers, times, strings, variables and references to
// knowledge; sets and structs hold other terms. `(mk.val h position (vec2 0.1 0.2))` is a struct "mk.val" of
// an entity, an ontology symbol and a struct "vec2" of two numbers. Terms are hash-consed (semantics 11.2):
// one node for each content in the whole process, counted by its users and freed with the last. So copies are
// cheap, equality is a comparison of pointers, and terms may be made, copied and dropped in any thread.
//
// A TermSpace is a world of terms apart, for work on copies of terms beside the thread that has the
// originals.
//
// Always true: (1) equal terms of one space share one node, and equal terms have equal hashes on every
// machine; (2) every number has at most 9 significant decimal digits; (3) a term is never deeper than
// kMaxTermDepth.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

// The structs that facts are made of, told apart without comparing names.
enum class PayloadKind : std::uint8_t {
  kOther,
  kValue,    // (mk.val object attribute value)
  kCommand,  // (cmd function [arguments])
  kIcst,     // (icst cst_1 [template] [arguments])
  kImdl,     // (imdl mdl_1 [template] [exposed])
};

inline constexpr int kMaxTermDepth = 64;

class Term {
 public:
  Term() : node_(&kNil) {}
  Term(const Term& other) : node_(other.node_) { Retain(node_); }
  Term(Term&& other) noexcept : node_(std::exchange(other.node_, &kNil)) {}
  Term& operator=(const Term& other) {
    Term copy(other);
    std::swap(node_, copy.node_);
    return *this;
  }
  Term& operator=(Term&& other) noexcept {
    std::swap(node_, other.node_);
    return *this;
  }
  ~Term() { Release(node_); }

  static Term Nil() { return Term(); }
  static Term Entity(std::string_view name);
  static Term Ontology(std::string_view name);
  static Term Number(double value);  // rounded to 9 significant digits
  static Term Instant(Time time);
  static Term Span(Duration duration);
  static Term String(std::string_view text);
  static Term Bool(bool value);
  static Term Variable(int index);
  static Term Wildcard();
  static Term Set(std::span<const Term> items);
  static Term Set(std::initializer_list<Term> items) { return Set(std::span(items.begin(), items.size())); }
  static Term Struct(std::string_view head, std::span<const Term> arguments);
  static Term Struct(std::string_view head, std::initializer_list<Term> arguments) {
    return Struct(head, std::span(arguments.begin(), arguments.size()));
  }
  static Term Reference(CompositeStateId id);
  static Term Reference(ModelId id);

  TermKind kind() const { return node_->kind; }
  bool is(TermKind kind) const { return node_->kind == kind; }
  PayloadKind payload_kind() const { return node_->payload_kind; }
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
  std::span<const Term> items() const { return {node_->items, node_->size}; }
  std::size_t size() const { return node_->size; }
  const Term& operator[](std::size_t i) const { return node_->items[i]; }

  std::uint64_t hash() const { return node_->hash; }
  bool ground() const { return node_->ground; }  // no variable and no wildcard inside
  int depth() const { return node_->depth; }     // 1 for an atom

  // Exact equality; numbers are compared without tolerance (matching has the tolerance, match.h).
  bool operator==(const Term& other) const { return node_ == other.node_; }
  // A total order by content, the same on every machine: kind, then value, then elements.
  bool operator<(const Term& other) const;

  // How many different terms there are now outside of any TermSpace; for tests and measurements.
  static std::size_t CountNodes();

 private:
  friend class TermSpace;
  friend class TermPacker;
  friend class TermUnpacker;

  class Table;
  struct Node {
    TermKind kind = TermKind::kNil;
    PayloadKind payload_kind = PayloadKind::kOther;
    bool ground = true;
    int depth = 1;
    std::uint32_t size = 0;
    mutable std::atomic<std::uint32_t> uses{kForever};
    std::int64_t integer = 0;
    double number = 0;
    std::uint64_t hash = 0;
    const Term* items = nullptr;  // in the same block of memory
    Node* next = nullptr;         // in the table of nodes
    Table* table = nullptr;
    std::uint64_t serial = 0;  // never used twice in a space; 0: nil
    std::string text;
  };
  // What makes a term the one it is.
  struct Content {
    TermKind kind = TermKind::kNil;
    std::int64_t integer = 0;
    double number = 0;
    std::string_view text;
    std::span<const Term> items;
  };

  static constexpr std::uint32_t kForever = ~std::uint32_t{0};  // not counted, never freed
  static const Node kNil;

  explicit Term(const Node* node) : node_(node) {}  // takes over one use
  static Table& CommonTable();
  // Of the space this thread is in; null outside of any.
  static thread_local Table* own_table_;  // NOLINT(readability-identifier-naming): a member, not a global
  static Term Make(const Content& content);
  static Term Atom(TermKind kind, std::int64_t integer);
  static Term Everywhere(TermKind kind, std::int64_t integer);
  static void Retain(const Node* node) {
    if (node->uses.load(std::memory_order_relaxed) != kForever) {
      node->uses.fetch_add(1, std::memory_order_relaxed);
    }
  }
  static void Release(const Node* node) {
    std::uint32_t uses = node->uses.load(std::memory_order_relaxed);
    if (uses == kForever) return;
    while (uses > 1) {
      if (node->uses.compare_exchange_weak(uses, uses - 1, std::memory_order_acq_rel)) return;
    }
    ReleaseLast(node);
  }
  static void ReleaseLast(const Node* node);

  const Node* node_;
};

// A TermSpace has a table of terms of its own: terms made by a thread while it is in the space share nodes
// among themselves only. Counting the users of a node that another thread works with costs both threads; who
// works with copies in a space of its own (made from packed ones, term_packing.h) disturbs nobody.
//
// Terms of different spaces are never equal, nor equal to terms made outside; only nil, the wildcard and low
// variables are the same everywhere. A space outlives its terms.
class TermSpace {
 public:
  TermSpace();
  ~TermSpace();
  TermSpace(const TermSpace&) = delete;
  TermSpace& operator=(const TermSpace&) = delete;

  std::size_t CountNodes() const;

  // This thread is in the space until the Scope ends.
  class Scope {
   public:
    explicit Scope(TermSpace& space);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Term::Table* outer_;
  };

 private:
  std::unique_ptr<Term::Table> table_;
};

// For people: names bare, variables as v3, or by the given names (index = variable number) where there are
// some.
std::string ToText(const Term& term, std::span<const std::string> variable_names = {});

// The attribute and object of `(mk.val object attribute value)`, if it is one.
inline bool IsValue(const Term& payload) {
  return payload.payload_kind() == PayloadKind::kValue;
}
inline bool IsCommand(const Term& payload) {
  return payload.payload_kind() == PayloadKind::kCommand;
}
// `(icst cst_1 [template] [arguments])` and `(imdl mdl_1 [template] [exposed])`.
inline bool IsIcst(const Term& payload) {
  return payload.payload_kind() == PayloadKind::kIcst;
}
inline bool IsImdl(const Term& payload) {
  return payload.payload_kind() == PayloadKind::kImdl;
}

Term MakeValue(Term object, Term attribute, Term value);
Term MakeCommand(Term function, const std::vector<Term>& arguments);
Term MakeIcst(CompositeStateId state, const std::vector<Term>& template_arguments,
              const std::vector<Term>& arguments);
Term MakeImdl(ModelId model, const std::vector<Term>& template_arguments, const std::vector<Term>& exposed);

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
  if (auto replacement = replace(term)) return std::move(*replacement);
  // Most parts stay as they are: a list of items is made only when the first one changes.
  constexpr std::size_t kFew = 8;
  Term few[kFew];
  std::vector<Term> many;
  Term* items = few;
  bool changed = false;
  for (std::size_t i = 0; i < term.size(); ++i) {
    Term item = Rewritten(term[i], replace);
    if (!changed) {
      if (item == term[i]) continue;
      changed = true;
      if (term.size() > kFew) {
        many.resize(term.size());
        items = many.data();
      }
      for (std::size_t k = 0; k < i; ++k) items[k] = term[k];
    }
    items[i] = std::move(item);
  }
  if (!changed) return term;
  const std::span<const Term> list(items, term.size());
  return term.is(TermKind::kSet) ? Term::Set(list) : Term::Struct(term.name(), list);
}

}  // namespace aerascope
