#include "engine/kb/term.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <memory>
#include <mutex>
#include <new>

#include "engine/base/text.h"

namespace aerascope {
namespace {

constexpr std::uint64_t Mix(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ULL + (hash << 6) + (hash >> 2);
  hash ^= hash >> 31;
  return hash * 0x7fb5d329728ea185ULL;
}

constexpr std::uint64_t HashText(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

constexpr std::uint64_t HashAtom(TermKind kind, std::int64_t integer, double number, std::string_view text) {
  std::uint64_t hash = Mix(static_cast<std::uint64_t>(kind) + 1, static_cast<std::uint64_t>(integer));
  hash = Mix(hash, std::bit_cast<std::uint64_t>(number));
  return Mix(hash, HashText(text));
}

PayloadKind PayloadKindOf(TermKind kind, std::string_view head, std::size_t size) {
  if (kind != TermKind::kStruct) return PayloadKind::kOther;
  if (size == 2) return head == "cmd" ? PayloadKind::kCommand : PayloadKind::kOther;
  if (size != 3) return PayloadKind::kOther;
  if (head == "mk.val") return PayloadKind::kValue;
  if (head == "icst") return PayloadKind::kIcst;
  return head == "imdl" ? PayloadKind::kImdl : PayloadKind::kOther;
}

}  // namespace

// Before all other static objects, which may hold terms.
[[gnu::init_priority(101)]] const Term::Node Term::kNil{.hash = HashAtom(TermKind::kNil, 0, 0, ""),
                                                        .text = {}};

// All nodes of a space, found by content. In parts with a lock each, so that threads seldom meet.
class Term::Table {
 public:
  // One use of the node with this content is the caller's.
  const Node* Find(const Content& content) {
    std::uint64_t hash = HashAtom(content.kind, content.integer, content.number, content.text);
    for (const Term& item : content.items) hash = Mix(hash, item.hash());
    Part& part = PartOf(hash);
    const std::lock_guard lock(part.mutex);
    for (const Node* node = part.heads[hash & part.mask]; node; node = node->next) {
      if (node->hash == hash && Same(*node, content)) {
        Retain(node);
        return node;
      }
    }
    Node* node = Create(content, hash);
    node->table = this;
    node->serial = ++part.created * kParts + static_cast<std::uint64_t>(&part - parts_.data());
    if (part.count > part.mask) part.Grow();
    Node*& head = part.heads[hash & part.mask];
    node->next = head;
    head = node;
    ++part.count;
    return node;
  }

  // Gives back one use, most likely the last.
  void Drop(const Node* node) {
    Part& part = PartOf(node->hash);
    {
      const std::lock_guard lock(part.mutex);
      // Found again by another thread in the meantime?
      if (node->uses.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
      Node** link = &part.heads[node->hash & part.mask];
      while (*link != node) link = &(*link)->next;
      *link = node->next;
      --part.count;
    }
    Destroy(node);
  }

  // From now on the node's users are not counted, and it is never freed.
  static void KeepForever(const Node* node) { node->uses.store(kForever, std::memory_order_relaxed); }

  std::size_t Count() {
    std::size_t count = 0;
    for (Part& part : parts_) {
      const std::lock_guard lock(part.mutex);
      count += part.count;
    }
    return count;
  }

 private:
  static constexpr std::size_t kParts = 64;

  struct Part {
    std::mutex mutex;
    std::uint64_t mask = 255;
    std::size_t count = 0;
    std::uint64_t created = 0;
    std::vector<Node*> heads = std::vector<Node*>(256, nullptr);

    void Grow() {
      std::vector<Node*> wider(heads.size() * 2, nullptr);
      mask = wider.size() - 1;
      for (Node* node : heads) {
        while (node) {
          Node* const next = node->next;
          node->next = wider[node->hash & mask];
          wider[node->hash & mask] = node;
          node = next;
        }
      }
      heads = std::move(wider);
    }
  };

  Part& PartOf(std::uint64_t hash) {
    static_assert(kParts == 64);
    return parts_[hash >> 58];
  }

  static bool Same(const Node& node, const Content& content) {
    return node.kind == content.kind && node.integer == content.integer &&
           node.size == content.items.size() &&
           std::bit_cast<std::uint64_t>(node.number) == std::bit_cast<std::uint64_t>(content.number) &&
           node.text == content.text && std::equal(content.items.begin(), content.items.end(), node.items);
  }

  // A node and its items in one block.
  static Node* Create(const Content& content, std::uint64_t hash) {
    static_assert(alignof(Node) >= alignof(Term) && sizeof(Node) % alignof(Term) == 0);
    void* block = ::operator new(sizeof(Node) + content.items.size() * sizeof(Term));
    Node* node =
        new (block) Node{.kind = content.kind,
                         .payload_kind = PayloadKindOf(content.kind, content.text, content.items.size()),
                         .size = static_cast<std::uint32_t>(content.items.size()),
                         .uses = 1,
                         .integer = content.integer,
                         .number = content.number,
                         .hash = hash,
                         .text = std::string(content.text)};
    node->ground = content.kind != TermKind::kVariable && content.kind != TermKind::kWildcard;
    Term* items = reinterpret_cast<Term*>(node + 1);
    for (std::size_t i = 0; i < content.items.size(); ++i) {
      new (items + i) Term(content.items[i]);
      node->ground = node->ground && items[i].ground();
      node->depth = std::max(node->depth, items[i].depth() + 1);
    }
    node->items = items;
    assert(node->depth <= kMaxTermDepth && "readers refuse deeper text; the engine builds nothing as deep");
    return node;
  }

  // Kept out of line: inlined, the compiler believes that it might meet kNil, which is never dropped.
  [[gnu::noinline]] static void Destroy(const Node* node) {
    std::destroy_n(node->items, node->size);
    node->~Node();
    ::operator delete(const_cast<Node*>(node));
  }

  std::array<Part, kParts> parts_;
};

namespace {

// Variables in use are few and everywhere: each is looked up once and kept.
constexpr int kCommonVariables = 32;

}  // namespace

// Never destroyed: terms may outlive every other static object.
Term::Table& Term::CommonTable() {
  static Table* const table = new Table;
  return *table;
}

thread_local Term::Table* Term::own_table_ = nullptr;

Term Term::Make(const Content& content) {
  return Term((own_table_ ? *own_table_ : CommonTable()).Find(content));
}

void Term::ReleaseLast(const Node* node) {
  node->table->Drop(node);
}

std::size_t Term::CountNodes() {
  return CommonTable().Count();
}

// An atom that is the same in all spaces.
Term Term::Everywhere(TermKind kind, std::int64_t integer) {
  const Node* node = CommonTable().Find({.kind = kind, .integer = integer, .text = {}, .items = {}});
  Table::KeepForever(node);
  return Term(node);
}

TermSpace::TermSpace() : table_(std::make_unique<Term::Table>()) {}

TermSpace::~TermSpace() {
  assert(table_->Count() == 0 && "a space outlives its terms");
}

std::size_t TermSpace::CountNodes() const {
  return table_->Count();
}

TermSpace::Scope::Scope(TermSpace& space) : outer_(std::exchange(Term::own_table_, space.table_.get())) {}

TermSpace::Scope::~Scope() {
  Term::own_table_ = outer_;
}

Term Term::Atom(TermKind kind, std::int64_t integer) {
  return Make({.kind = kind, .integer = integer, .text = {}, .items = {}});
}

Term Term::Entity(std::string_view name) {
  return Make({.kind = TermKind::kEntity, .text = name, .items = {}});
}
Term Term::Ontology(std::string_view name) {
  return Make({.kind = TermKind::kOntology, .text = name, .items = {}});
}
Term Term::Number(double value) {
  return Make({.kind = TermKind::kNumber, .number = RoundNumber(value), .text = {}, .items = {}});
}
Term Term::Instant(Time time) {
  return Atom(TermKind::kTime, time.us);
}
Term Term::Span(Duration duration) {
  return Atom(TermKind::kDuration, duration.us);
}
Term Term::String(std::string_view text) {
  return Make({.kind = TermKind::kString, .text = text, .items = {}});
}
Term Term::Bool(bool value) {
  return Atom(TermKind::kBool, value ? 1 : 0);
}
Term Term::Variable(int index) {
  assert(index >= 0);
  static const std::vector<Term> common = [] {
    std::vector<Term> variables;
    for (int i = 0; i < kCommonVariables; ++i) variables.push_back(Everywhere(TermKind::kVariable, i));
    return variables;
  }();
  return index < kCommonVariables ? common[static_cast<std::size_t>(index)]
                                  : Atom(TermKind::kVariable, index);
}
Term Term::Wildcard() {
  static const Term wildcard = Everywhere(TermKind::kWildcard, 0);
  return wildcard;
}
Term Term::Set(std::span<const Term> items) {
  return Make({.kind = TermKind::kSet, .text = {}, .items = items});
}
Term Term::Struct(std::string_view head, std::span<const Term> arguments) {
  return Make({.kind = TermKind::kStruct, .text = head, .items = arguments});
}
Term Term::Reference(CompositeStateId id) {
  return Atom(TermKind::kCompositeState, id.value);
}
Term Term::Reference(ModelId id) {
  return Atom(TermKind::kModel, id.value);
}

bool Term::operator<(const Term& other) const {
  const Node& a = *node_;
  const Node& b = *other.node_;
  if (node_ == other.node_) return false;
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.integer != b.integer) return a.integer < b.integer;
  if (a.number != b.number) return a.number < b.number;
  if (a.text != b.text) return a.text < b.text;
  if (a.size != b.size) return a.size < b.size;
  for (std::size_t i = 0; i < a.size; ++i) {
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
Term MakeCommand(Term function, const std::vector<Term>& arguments) {
  return Term::Struct("cmd", {std::move(function), Term::Set(arguments)});
}
Term MakeIcst(CompositeStateId state, const std::vector<Term>& template_arguments,
              const std::vector<Term>& arguments) {
  return Term::Struct("icst", {Term::Reference(state), Term::Set(template_arguments), Term::Set(arguments)});
}
Term MakeImdl(ModelId model, const std::vector<Term>& template_arguments, const std::vector<Term>& exposed) {
  return Term::Struct("imdl", {Term::Reference(model), Term::Set(template_arguments), Term::Set(exposed)});
}

}  // namespace aerascope
