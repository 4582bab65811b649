// SeedKnowledge renumbered: ids in order with references backwards, variables by first appearance.
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/replicode/seed.h"

namespace aerascope {
namespace {

using MapTerm = std::function<Term(const Term&)>;

FactPattern Mapped(const FactPattern& pattern, const MapTerm& map) {
  // In this order: the order of calls numbers the variables.
  Term payload = map(pattern.payload);
  Term after = map(pattern.after);
  Term before = map(pattern.before);
  return {pattern.positive, std::move(payload), std::move(after), std::move(before)};
}

std::vector<Guard> Mapped(const std::vector<Guard>& guards, const MapTerm& map) {
  std::vector<Guard> mapped;
  for (const Guard& guard : guards) {
    // The expression first: in the text `X:(+ Y Z)` reading meets Y and Z before it gives X its number.
    Term expression = map(guard.expression);
    std::optional<int> target;
    if (guard.target) target = map(Term::Variable(*guard.target)).variable();
    mapped.push_back({target, std::move(expression)});
  }
  return mapped;
}

CompositeState Mapped(const CompositeState& state, const MapTerm& map) {
  CompositeState mapped{state.id, {}, {}, state.variable_names};
  for (const FactPattern& component : state.components) mapped.components.push_back(Mapped(component, map));
  mapped.guards = Mapped(state.guards, map);
  return mapped;
}

Model Mapped(const Model& model, const MapTerm& map) {
  Model mapped;
  mapped.id = model.id;
  for (const Term& argument : model.template_arguments) mapped.template_arguments.push_back(map(argument));
  mapped.lhs = Mapped(model.lhs, map);
  mapped.rhs = Mapped(model.rhs, map);
  mapped.forward = Mapped(model.forward, map);
  mapped.backward = Mapped(model.backward, map);
  mapped.variable_names = model.variable_names;
  return mapped;
}

// Gives variables new numbers by first appearance.
class Renumbering {
 public:
  Term Renumber(const Term& term) {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (part.ground()) return part;
      if (part.is(TermKind::kVariable)) return Term::Variable(Of(part.variable()));
      return std::nullopt;
    });
  }
  std::vector<std::string> NamesFrom(const std::vector<std::string>& names) const {
    std::vector<std::string> renumbered;
    for (const int old : order_) {
      const auto i = static_cast<std::size_t>(old);
      renumbered.push_back(i < names.size() && !names[i].empty() ? names[i]
                                                                 : "v" + std::to_string(renumbered.size()));
    }
    return renumbered;
  }
  // For the argument list `before` in old numbers and `after` in new ones: which old place each new place
  // takes.
  std::vector<std::size_t> Places(const std::vector<int>& before, const std::vector<int>& after) const {
    std::vector<std::size_t> places;
    for (const int variable : after) {
      const auto it = std::find(before.begin(), before.end(), order_[static_cast<std::size_t>(variable)]);
      places.push_back(static_cast<std::size_t>(it - before.begin()));
    }
    return places;
  }

 private:
  int Of(int variable) {
    const auto [it, is_new] = numbers_.try_emplace(variable, static_cast<int>(order_.size()));
    if (is_new) order_.push_back(variable);
    return it->second;
  }

  std::map<int, int> numbers_;
  std::vector<int> order_;
};

class Normaliser {
 public:
  explicit Normaliser(const SeedKnowledge& seed) : seed_(seed) {
    for (std::size_t i = 0; i < seed.composite_states.size(); ++i) items_.push_back({true, i});
    for (std::size_t i = 0; i < seed.models.size(); ++i) items_.push_back({false, i});
    std::stable_sort(items_.begin(), items_.end(),
                     [&](const Item& a, const Item& b) { return IdOf(a) < IdOf(b); });
    for (const Item& item : items_) by_id_.try_emplace({item.is_state, IdOf(item)}, item);
  }

  Result<SeedKnowledge> Run() {
    result_.symbols = seed_.symbols;
    result_.passed_over = seed_.passed_over;
    result_.problems = seed_.problems;
    for (const Item& item : items_) {
      if (Status status = Place(item); !status) return status.error();
    }
    for (const SeedFact& fact : seed_.facts) {
      if (Status status = CheckReferences(fact.fact.payload, "a fact"); !status) return status.error();
      SeedFact placed = fact;
      placed.fact.payload = WithNewReferences(fact.fact.payload);
      result_.facts.push_back(std::move(placed));
    }
    return std::move(result_);
  }

 private:
  struct Item {
    bool is_state;
    std::size_t index;
  };
  using Key = std::pair<bool, std::int64_t>;
  struct Placed {
    std::int64_t id;
    std::vector<std::size_t> places;  // of arguments
  };

  std::int64_t IdOf(const Item& item) const {
    return item.is_state ? seed_.composite_states[item.index].state.id.value
                         : seed_.models[item.index].model.id.value;
  }
  const std::string& LabelOf(const Item& item) const {
    return item.is_state ? seed_.composite_states[item.index].label : seed_.models[item.index].label;
  }

  static std::optional<Key> KeyOf(const Term& term) {
    if (term.is(TermKind::kCompositeState)) return Key{true, term.composite_state().value};
    if (term.is(TermKind::kModel)) return Key{false, term.model().value};
    return std::nullopt;
  }

  std::vector<Key> ReferencesOf(const Item& item) const {
    std::vector<Key> keys;
    const MapTerm collect = [&](const Term& term) {
      ForEachTerm(term, [&](const Term& part) {
        if (const auto key = KeyOf(part)) keys.push_back(*key);
      });
      return term;
    };
    if (item.is_state)
      Mapped(seed_.composite_states[item.index].state, collect);
    else
      Mapped(seed_.models[item.index].model, collect);
    return keys;
  }

  // Places what the item refers to, then the item. Without recursion: chains of references can be long.
  Status Place(const Item& first) {
    std::vector<Item> waiting{first};
    std::set<Key> open;
    while (!waiting.empty()) {
      const Item item = waiting.back();
      const Key key{item.is_state, IdOf(item)};
      if (placed_.contains(key)) {
        waiting.pop_back();
        continue;
      }
      open.insert(key);
      bool ready = true;
      for (const Key& reference : ReferencesOf(item)) {
        if (placed_.contains(reference)) continue;
        const auto it = by_id_.find(reference);
        if (it == by_id_.end()) return Error{Missing(reference, LabelOf(item))};
        if (open.contains(reference)) {
          return Error{"expected knowledge without circles, found that " + LabelOf(it->second) +
                       " refers to itself"};
        }
        waiting.push_back(it->second);
        ready = false;
      }
      if (!ready) continue;
      waiting.pop_back();
      open.erase(key);
      Append(item, key);
    }
    return Ok();
  }

  static std::string Missing(const Key& reference, const std::string& from) {
    return "expected " + std::string(reference.first ? "composite state " : "model ") +
           std::to_string(reference.second) + ", to which " + from +
           " refers, found nothing with this number";
  }

  Status CheckReferences(const Term& term, const std::string& from) const {
    std::optional<Key> missing;
    ForEachTerm(term, [&](const Term& part) {
      if (const auto key = KeyOf(part); key && !placed_.contains(*key)) missing = key;
    });
    if (missing) return Error{Missing(*missing, from)};
    return Ok();
  }

  static Term Permuted(const Term& list, const std::vector<std::size_t>& places) {
    if (!list.is(TermKind::kSet) || list.size() != places.size()) return list;
    std::vector<Term> items;
    for (const std::size_t place : places) items.push_back(list[place]);
    return Term::Set(std::move(items));
  }

  Term WithNewReferences(const Term& term) const {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (const auto key = KeyOf(part)) return Reference(*key, placed_.at(*key).id);
      if (!IsIcst(part) && !IsImdl(part)) return std::nullopt;
      const auto key = KeyOf(part[0]);
      if (!key) return std::nullopt;
      const Placed& target = placed_.at(*key);
      return Term::Struct(part.name(),
                          {Reference(*key, target.id), part[1], Permuted(part[2], target.places)});
    });
  }

  static Term Reference(const Key& key, std::int64_t id) {
    return key.first ? Term::Reference(CompositeStateId{id}) : Term::Reference(ModelId{id});
  }

  void Append(const Item& item, const Key& key) {
    const std::int64_t id = static_cast<std::int64_t>(placed_.size()) + 1;
    Renumbering renumbering;
    const MapTerm map = [&](const Term& term) { return renumbering.Renumber(WithNewReferences(term)); };
    Placed placed{id, {}};
    if (item.is_state) {
      const SeedCompositeState& old = seed_.composite_states[item.index];
      CompositeState state = Mapped(old.state, map);
      state.id = {id};
      state.variable_names = renumbering.NamesFrom(old.state.variable_names);
      placed.places = renumbering.Places(ArgumentVariables(old.state), ArgumentVariables(state));
      result_.composite_states.push_back({old.label, std::move(state)});
    } else {
      const SeedModel& old = seed_.models[item.index];
      Model model = Mapped(old.model, map);
      model.id = {id};
      model.variable_names = renumbering.NamesFrom(old.model.variable_names);
      placed.places = renumbering.Places(ExposedVariables(old.model), ExposedVariables(model));
      result_.models.push_back({old.label, std::move(model), old.evidence, old.strong, old.state});
    }
    placed_.emplace(key, std::move(placed));
  }

  const SeedKnowledge& seed_;
  std::vector<Item> items_;
  std::map<Key, Item> by_id_;
  std::map<Key, Placed> placed_;
  SeedKnowledge result_;
};

template <class List>
auto FindLabel(const List& list, std::string_view label) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.label == label; });
  return it == list.end() ? nullptr : &*it;
}

// The models that are not deleted and do not speak, however indirectly, about deleted ones.
std::set<ModelId> AliveModels(const KnowledgeBase& knowledge) {
  std::set<ModelId> alive;
  for (const auto& [id, record] : knowledge.models()) {
    if (record.state != ModelState::kDeleted) alive.insert(id);
  }
  const auto speaks_about_dead = [&](ModelId id) {
    bool found = false;
    const MapTerm look = [&](const Term& term) {
      ForEachTerm(term, [&](const Term& part) {
        found |= part.is(TermKind::kModel) && !alive.contains(part.model());
      });
      return term;
    };
    Mapped(knowledge.Find(id)->model, look);
    return found;
  };
  while (std::erase_if(alive, speaks_about_dead) > 0) {
  }
  return alive;
}

}  // namespace

Result<SeedKnowledge> Normalised(const SeedKnowledge& seed) {
  return Normaliser(seed).Run();
}

SeedKnowledge ShiftIds(SeedKnowledge seed, std::int64_t offset) {
  const MapTerm shift = [&](const Term& term) {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (part.is(TermKind::kCompositeState))
        return Term::Reference(CompositeStateId{part.composite_state().value + offset});
      if (part.is(TermKind::kModel)) return Term::Reference(ModelId{part.model().value + offset});
      return std::nullopt;
    });
  };
  for (SeedFact& fact : seed.facts) fact.fact.payload = shift(fact.fact.payload);
  for (SeedCompositeState& item : seed.composite_states) {
    item.state = Mapped(item.state, shift);
    item.state.id.value += offset;
  }
  for (SeedModel& item : seed.models) {
    item.model = Mapped(item.model, shift);
    item.model.id.value += offset;
  }
  return seed;
}

const Term* FindSymbol(const SeedKnowledge& seed, std::string_view name) {
  const auto it =
      std::find_if(seed.symbols.begin(), seed.symbols.end(), [&](const Term& s) { return s.name() == name; });
  return it == seed.symbols.end() ? nullptr : &*it;
}

const SeedCompositeState* FindState(const SeedKnowledge& seed, std::string_view label) {
  return FindLabel(seed.composite_states, label);
}

const SeedModel* FindModel(const SeedKnowledge& seed, std::string_view label) {
  return FindLabel(seed.models, label);
}

SeedKnowledge SeedFrom(const KnowledgeBase& knowledge) {
  SeedKnowledge seed;
  seed.symbols = knowledge.symbols();
  for (const auto& [id, record] : knowledge.facts()) {
    if (record.fact.interval.before < kForever) continue;  // of a moment, not knowledge to begin with
    seed.facts.push_back({"fact_" + std::to_string(id.value), record.fact});
  }
  for (const auto& [id, record] : knowledge.composite_states()) {
    seed.composite_states.push_back({"cst_" + std::to_string(id.value), record.state});
  }
  const std::set<ModelId> alive = AliveModels(knowledge);
  for (const auto& [id, record] : knowledge.models()) {
    if (!alive.contains(id)) continue;
    seed.models.push_back(
        {"mdl_" + std::to_string(id.value), record.model, record.evidence, record.strong, record.state});
  }
  return seed;
}

}  // namespace aerascope
