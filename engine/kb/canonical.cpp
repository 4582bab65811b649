#include "engine/kb/canonical.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/kb/term_codec.h"

namespace aerascope {
namespace {

// Own variable number <-> canonical number, growing by first appearance.
class Renumbering {
 public:
  int Of(int variable) {
    const auto [it, is_new] = canonical_.try_emplace(variable, static_cast<int>(order_.size()));
    if (is_new) order_.push_back(variable);
    return it->second;
  }
  const std::vector<int>& order() const { return order_; }

 private:
  std::map<int, int> canonical_;
  std::vector<int> order_;
};

// Interchangeable components tie, and each of their arrangements is tried: 6 of them give 720.
constexpr int kMaxArrangements = 720;
// The text that may be encoded in search of the smallest form; far more than any learned definition needs.
constexpr std::int64_t kMaxEncodedBytes = 1 << 20;
// Combinations of symmetric orders of referenced definitions that are tried.
constexpr int kMaxCombinations = 1000;
constexpr std::size_t kMaxSymmetricOrders = 720;

// The position, in canonical order, of each entry of an argument list whose entries stand for `listed`
// variables.
std::vector<std::size_t> CanonicalPositions(const std::vector<int>& listed,
                                            const std::vector<int>& canonical_order) {
  std::vector<std::size_t> positions;
  for (const int variable : canonical_order) {
    const auto it = std::find(listed.begin(), listed.end(), variable);
    if (it != listed.end()) positions.push_back(static_cast<std::size_t>(it - listed.begin()));
  }
  return positions;
}

Term Permuted(const Term& list, const std::vector<std::size_t>& positions) {
  if (positions.size() != list.size()) return list;
  std::vector<Term> items;
  for (const std::size_t i : positions) items.push_back(list[i]);
  return Term::Set(std::move(items));
}

// Which of the equivalent orders of its arguments each reference uses, reference by reference in order of
// reading. All combinations are gone through like the digits of a counter; how many values a digit has shows
// while reading.
class Combination {
 public:
  // The order for the next reference, one of `orders`.
  std::size_t Next(std::size_t orders) {
    if (at_ == digits_.size()) {
      digits_.push_back(0);
      limits_.push_back(orders);
    }
    return digits_[at_++];
  }
  // To the next combination; false after the last.
  bool Advance() {
    at_ = 0;
    for (std::size_t i = digits_.size(); i-- > 0;) {
      if (++digits_[i] < limits_[i]) return true;
      digits_[i] = 0;
    }
    return false;
  }

 private:
  std::size_t at_ = 0;
  std::vector<std::size_t> digits_;
  std::vector<std::size_t> limits_;
};

// Replaces references by hashes and argument lists by their canonical order; variables are left alone.
class ReferenceReplacer {
 public:
  ReferenceReplacer(const CanonicalOf& canonical_of, const Definitions& definitions, Combination* combination)
      : canonical_of_(canonical_of), definitions_(definitions), combination_(combination) {}

  Term operator()(const Term& term) const {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (part.is(TermKind::kCompositeState) || part.is(TermKind::kModel)) return NameOf(part);
      if (IsIcst(part) && part[0].is(TermKind::kCompositeState)) {
        const CompositeState* state = definitions_.composite_state(part[0].composite_state());
        return Instance(part, state ? ArgumentVariables(*state) : std::vector<int>());
      }
      if (IsImdl(part) && part[0].is(TermKind::kModel)) {
        const Model* model = definitions_.model(part[0].model());
        return Instance(part, model ? ExposedVariables(*model) : std::vector<int>());
      }
      return std::nullopt;
    });
  }

 private:
  Term NameOf(const Term& reference) const {
    const Canonical* canonical = canonical_of_(reference);
    return Term::String(canonical ? ToText(canonical->hash) : "?");
  }

  Term Instance(const Term& instance, const std::vector<int>& listed) const {
    Term arguments = instance[2];
    if (const Canonical* canonical = canonical_of_(instance[0])) {
      const std::size_t order = combination_->Next(1 + canonical->symmetric_variables.size());
      const auto& variables = order == 0 ? canonical->variables : canonical->symmetric_variables[order - 1];
      arguments = Permuted(arguments, CanonicalPositions(listed, variables));
    }
    return Term::Struct(instance.name(), {NameOf(instance[0]), instance[1], std::move(arguments)});
  }

  const CanonicalOf& canonical_of_;
  const Definitions& definitions_;
  Combination* combination_;
};

Term Renumbered(const Term& term, Renumbering& renumbering) {
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (part.is(TermKind::kVariable)) return Term::Variable(renumbering.Of(part.variable()));
    return std::nullopt;
  });
}

Term GuardTerm(const Guard& guard) {
  return guard.target ? Term::Struct(":=", {Term::Variable(*guard.target), guard.expression})
                      : guard.expression;
}

// Finds the arrangement of components with the smallest text: at each step the components whose text under
// the numbering so far is smallest are candidates; ties are all tried. The guards' text decides between equal
// arrangements.
class Arranger {
 public:
  // `encoded_bytes` counts the work done so far for this definition.
  Arranger(const std::vector<Term>& components, const std::vector<Term>& guards, std::int64_t* encoded_bytes)
      : components_(components), guards_(guards), encoded_bytes_(encoded_bytes) {}

  struct Arrangement {
    std::vector<std::string> texts;  // of the components in order, and in the end of the guards
    std::vector<int> order;
    Renumbering renumbering;
  };

  // All arrangements with the smallest text, in the order found; at least one.
  std::vector<Arrangement> Smallest() {
    Arrange({}, std::vector<bool>(components_.size()));
    return std::move(best_);
  }

 private:
  void Arrange(Arrangement so_far, const std::vector<bool>& used) {
    if (Exhausted()) AddTheRest(&so_far, used);
    if (so_far.order.size() == components_.size()) return Compare(std::move(so_far));
    std::string smallest;
    for (const std::size_t i : Candidates(so_far, used, &smallest)) {
      Arrangement next = so_far;
      Encoded(components_[i], &next.renumbering);
      next.texts.push_back(smallest);
      next.order.push_back(static_cast<int>(i));
      std::vector<bool> next_used = used;
      next_used[i] = true;
      Arrange(std::move(next), next_used);
      if (tried_ >= kMaxArrangements || Exhausted()) return;
    }
  }

  // The unused components with the smallest text, equal ones once.
  std::vector<std::size_t> Candidates(const Arrangement& so_far, const std::vector<bool>& used,
                                      std::string* smallest) {
    std::vector<std::size_t> candidates;
    std::set<Term> different;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      if (used[i]) continue;
      Renumbering renumbering = so_far.renumbering;
      std::string text = Encoded(components_[i], &renumbering);
      if (candidates.empty() || text < *smallest) {
        candidates.clear();
        different.clear();
        *smallest = std::move(text);
      } else if (text != *smallest) {
        continue;
      }
      if (different.insert(components_[i]).second) candidates.push_back(i);
    }
    return candidates;
  }

  // Beyond the bound: what is left in the order of each component's own text.
  void AddTheRest(Arrangement* arrangement, const std::vector<bool>& used) {
    std::vector<std::pair<std::string, std::size_t>> rest;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      if (used[i]) continue;
      Renumbering own;
      rest.emplace_back(Encoded(components_[i], &own), i);
    }
    std::sort(rest.begin(), rest.end());
    for (const auto& [text, i] : rest) {
      arrangement->texts.push_back(Encoded(components_[i], &arrangement->renumbering));
      arrangement->order.push_back(static_cast<int>(i));
    }
  }

  void Compare(Arrangement arrangement) {
    ++tried_;
    for (const Term& guard : guards_) arrangement.texts.push_back(Encoded(guard, &arrangement.renumbering));
    if (!best_.empty() && best_[0].texts < arrangement.texts) return;
    if (!best_.empty() && arrangement.texts < best_[0].texts) best_.clear();
    best_.push_back(std::move(arrangement));
  }

  std::string Encoded(const Term& term, Renumbering* renumbering) {
    std::string text = Encode(Renumbered(term, *renumbering));
    *encoded_bytes_ += static_cast<std::int64_t>(text.size());
    return text;
  }
  bool Exhausted() const { return *encoded_bytes_ > kMaxEncodedBytes; }

  const std::vector<Term>& components_;
  const std::vector<Term>& guards_;
  std::vector<Arrangement> best_;
  int tried_ = 0;
  std::int64_t* encoded_bytes_;
};

Canonical Finish(const Term& definition, std::vector<int> variables) {
  Canonical canonical;
  canonical.text = Encode(definition);
  canonical.variables = std::move(variables);
  return canonical;
}

void AddSymmetricOrder(const std::vector<int>& variables, Canonical* canonical) {
  auto& known = canonical->symmetric_variables;
  if (variables == canonical->variables || known.size() >= kMaxSymmetricOrders) return;
  if (std::find(known.begin(), known.end(), variables) == known.end()) known.push_back(variables);
}

// The smallest of the forms that build(combination) gives; forms with the same text are symmetric.
template <class Build>
Canonical SmallestForm(Build&& build) {
  Combination combination;
  std::int64_t encoded_bytes = 0;
  Canonical best = build(&combination, &encoded_bytes);
  for (int tried = 1; tried < kMaxCombinations && combination.Advance(); ++tried) {
    encoded_bytes += static_cast<std::int64_t>(best.text.size());
    if (encoded_bytes > kMaxEncodedBytes) break;
    Canonical other = build(&combination, &encoded_bytes);
    if (other.text < best.text) {
      best = std::move(other);
    } else if (other.text == best.text) {
      AddSymmetricOrder(other.variables, &best);
      for (const std::vector<int>& variables : other.symmetric_variables) AddSymmetricOrder(variables, &best);
    }
  }
  best.hash = HashOf(best.text);
  return best;
}

Canonical FormOf(const CompositeState& state, const ReferenceReplacer& without_references,
                 std::int64_t* encoded_bytes) {
  std::vector<Term> components;
  std::vector<Term> guards;
  for (const FactPattern& component : state.components)
    components.push_back(without_references(ToTerm(component)));
  for (const Guard& guard : state.guards) guards.push_back(without_references(GuardTerm(guard)));
  std::vector<Arranger::Arrangement> arrangements = Arranger(components, guards, encoded_bytes).Smallest();
  Arranger::Arrangement& first = arrangements[0];
  std::vector<Term> parts;
  std::vector<Term> tests;
  for (const int i : first.order)
    parts.push_back(Renumbered(components[static_cast<std::size_t>(i)], first.renumbering));
  for (const Term& guard : guards) tests.push_back(Renumbered(guard, first.renumbering));
  Canonical canonical =
      Finish(Term::Struct("cst", {Term::Set(std::move(parts)), Term::Set(std::move(tests))}),
             first.renumbering.order());
  canonical.components = std::move(first.order);
  for (const Arranger::Arrangement& other : arrangements)
    AddSymmetricOrder(other.renumbering.order(), &canonical);
  return canonical;
}

Canonical FormOf(const Model& model, const ReferenceReplacer& without_references) {
  Renumbering renumbering;
  const auto part = [&](const Term& term) { return Renumbered(without_references(term), renumbering); };
  const auto guards = [&](const std::vector<Guard>& list) {
    std::vector<Term> terms;
    for (const Guard& guard : list) terms.push_back(part(GuardTerm(guard)));
    return Term::Set(std::move(terms));
  };
  // One by one: the order of renumbering is the order of reading.
  Term template_arguments = part(Term::Set(model.template_arguments));
  Term lhs = part(ToTerm(model.lhs));
  Term rhs = part(ToTerm(model.rhs));
  Term forward = guards(model.forward);
  Term backward = guards(model.backward);
  return Finish(Term::Struct("mdl", {std::move(template_arguments), std::move(lhs), std::move(rhs),
                                     std::move(forward), std::move(backward)}),
                renumbering.order());
}

}  // namespace

Canonical Canonicalise(const CompositeState& state, const CanonicalOf& canonical_of,
                       const Definitions& definitions) {
  return SmallestForm([&](Combination* combination, std::int64_t* encoded_bytes) {
    return FormOf(state, ReferenceReplacer(canonical_of, definitions, combination), encoded_bytes);
  });
}

Canonical Canonicalise(const Model& model, const CanonicalOf& canonical_of, const Definitions& definitions) {
  return SmallestForm([&](Combination* combination, std::int64_t*) {
    return FormOf(model, ReferenceReplacer(canonical_of, definitions, combination));
  });
}

}  // namespace aerascope
