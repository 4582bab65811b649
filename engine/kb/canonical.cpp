#include "engine/kb/canonical.h"

#include <algorithm>
#include <map>

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

// How many tied arrangements of components are tried before the first one found is taken. Ties need interchangeable
// components; 6 of them give 720.
constexpr int kMaxArrangements = 5000;

// The position, in canonical order, of each entry of an argument list whose entries stand for `listed` variables.
std::vector<std::size_t> CanonicalPositions(const std::vector<int>& listed, const Canonical& canonical) {
  std::vector<std::size_t> positions;
  for (const int variable : canonical.variables) {
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

// Replaces references by hashes and argument lists by their canonical order; variables are left alone.
Term WithoutReferences(const Term& term, const CanonicalOf& canonical_of, const Definitions& definitions) {
  const auto name_of = [&](const Term& reference) {
    const Canonical* canonical = canonical_of(reference);
    return Term::String(canonical ? ToText(canonical->hash) : "?");
  };
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (part.is(TermKind::kCompositeState) || part.is(TermKind::kModel)) return name_of(part);
    if (IsIcst(part) && part[0].is(TermKind::kCompositeState)) {
      const CompositeState* state = definitions.composite_state(part[0].composite_state());
      const Canonical* canonical = canonical_of(part[0]);
      Term arguments = part[2];
      if (state && canonical) arguments = Permuted(arguments, CanonicalPositions(ArgumentVariables(*state), *canonical));
      return Term::Struct("icst", {name_of(part[0]), part[1], arguments});
    }
    if (IsImdl(part) && part[0].is(TermKind::kModel)) {
      const Model* model = definitions.model(part[0].model());
      const Canonical* canonical = canonical_of(part[0]);
      Term exposed = part[2];
      if (model && canonical) exposed = Permuted(exposed, CanonicalPositions(ExposedVariables(*model), *canonical));
      return Term::Struct("imdl", {name_of(part[0]), part[1], exposed});
    }
    return std::nullopt;
  });
}

Term Renumbered(const Term& term, Renumbering& renumbering) {
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (part.is(TermKind::kVariable)) return Term::Variable(renumbering.Of(part.variable()));
    return std::nullopt;
  });
}

Term GuardTerm(const Guard& guard) {
  return guard.target ? Term::Struct(":=", {Term::Variable(*guard.target), guard.expression}) : guard.expression;
}

// Finds the arrangement of components with the smallest text: at each step the components whose text under the
// numbering so far is smallest are candidates; ties are all tried.
class Arranger {
 public:
  explicit Arranger(std::vector<Term> components) : components_(std::move(components)) {}

  struct Arrangement {
    std::vector<std::string> texts;
    std::vector<int> order;
    Renumbering renumbering;
  };

  Arrangement Smallest() {
    Arrange({}, std::vector<bool>(components_.size()));
    return std::move(*best_);
  }

 private:
  void Arrange(Arrangement so_far, std::vector<bool> used) {
    if (so_far.order.size() == components_.size()) {
      ++tried_;
      if (!best_ || so_far.texts < best_->texts) best_ = std::move(so_far);
      return;
    }
    std::string smallest;
    std::vector<std::pair<std::size_t, Renumbering>> candidates;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      if (used[i]) continue;
      Renumbering renumbering = so_far.renumbering;
      std::string text = Encode(Renumbered(components_[i], renumbering));
      if (candidates.empty() || text < smallest) {
        candidates.clear();
        smallest = text;
      }
      if (text == smallest) candidates.emplace_back(i, std::move(renumbering));
    }
    for (auto& [i, renumbering] : candidates) {
      Arrangement next = so_far;
      next.texts.push_back(smallest);
      next.order.push_back(static_cast<int>(i));
      next.renumbering = std::move(renumbering);
      std::vector<bool> next_used = used;
      next_used[i] = true;
      Arrange(std::move(next), std::move(next_used));
      if (tried_ >= kMaxArrangements) return;
    }
  }

  std::vector<Term> components_;
  std::optional<Arrangement> best_;
  int tried_ = 0;
};

Canonical Finish(const Term& definition, std::vector<int> variables) {
  Canonical canonical;
  canonical.text = Encode(definition);
  canonical.hash = HashOf(canonical.text);
  canonical.variables = std::move(variables);
  return canonical;
}

}  // namespace

Canonical Canonicalise(const CompositeState& state, const CanonicalOf& canonical_of, const Definitions& definitions) {
  std::vector<Term> components;
  for (const FactPattern& component : state.components) {
    components.push_back(WithoutReferences(ToTerm(component), canonical_of, definitions));
  }
  Arranger::Arrangement arrangement = Arranger(components).Smallest();
  std::vector<Term> parts;
  for (const int i : arrangement.order) {
    parts.push_back(Renumbered(components[static_cast<std::size_t>(i)], arrangement.renumbering));
  }
  std::vector<Term> guards;
  for (const Guard& guard : state.guards) {
    guards.push_back(Renumbered(WithoutReferences(GuardTerm(guard), canonical_of, definitions), arrangement.renumbering));
  }
  Canonical canonical = Finish(Term::Struct("cst", {Term::Set(std::move(parts)), Term::Set(std::move(guards))}),
                               arrangement.renumbering.order());
  canonical.components = std::move(arrangement.order);
  return canonical;
}

Canonical Canonicalise(const Model& model, const CanonicalOf& canonical_of, const Definitions& definitions) {
  Renumbering renumbering;
  const auto part = [&](const Term& term) {
    return Renumbered(WithoutReferences(term, canonical_of, definitions), renumbering);
  };
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

}  // namespace aerascope
