#include "engine/reason/retrieval.h"

#include <algorithm>
#include <optional>

#include "engine/reason/arrangement.h"

namespace aerascope {
namespace {

constexpr int kOpenaeraMinMatched = 3;

// Values that are the same only if they are identical; numbers have a tolerance and are not indexed.
bool IsExact(const Term& value) {
  return value.is(TermKind::kOntology) || value.is(TermKind::kEntity) || value.is(TermKind::kString) ||
         value.is(TermKind::kBool);
}

// Could so many of a condition's components be enough for a hypothesis, or be all of them?
bool Enough(int kept, int total, const ReasonerParameters& parameters) {
  if (kept >= total) return true;
  if (parameters.analogy_mode == AnalogyMode::kOpenaera) return kept >= kOpenaeraMinMatched;
  return kept >= parameters.analogy_min_matched && kept > parameters.analogy_min_psi * total;
}

// The variables of the composite state that stand for what the model's right side speaks about.
std::set<int> NamedByGoal(const CompositeState& state, const Model& requirement, const Model& model) {
  std::set<int> of_rhs;
  ForEachVariable(model.rhs.payload, [&](int v) { of_rhs.insert(v); });
  std::set<int> of_requirement;
  const std::vector<int> exposed = ExposedVariables(model);
  const Term& given = requirement.rhs.payload[2];
  for (std::size_t i = 0; i < exposed.size() && i < given.size(); ++i) {
    if (of_rhs.contains(exposed[i]) && given[i].is(TermKind::kVariable))
      of_requirement.insert(given[i].variable());
  }
  std::set<int> named;
  const std::vector<int> arguments = ArgumentVariables(state);
  const Term& passed = requirement.lhs.payload[2];
  for (std::size_t i = 0; i < arguments.size() && i < passed.size(); ++i) {
    if (passed[i].is(TermKind::kVariable) && of_requirement.contains(passed[i].variable()))
      named.insert(arguments[i]);
  }
  return named;
}

}  // namespace

// A new model that changes an attribute takes it out of the index: shelves are filled anew.
void Retrieval::NoteWhatCanChange(const KnowledgeBase& knowledge) {
  for (auto it = knowledge.models().upper_bound(last_model_); it != knowledge.models().end(); ++it) {
    last_model_ = it->first;
    const Model& model = it->second.model;
    if (IsRequirement(model)) continue;
    bool is_new = false;
    if (IsValue(model.rhs.payload) && model.rhs.payload[1].ground()) {
      is_new = changeable_.insert(model.rhs.payload[1]).second;
    } else if (IsValue(model.rhs.payload) && !anything_can_change_) {
      is_new = anything_can_change_ = true;
    }
    if (is_new) shelves_.clear();
  }
}

void Retrieval::CatchUp(const KnowledgeBase& knowledge, ModelId model, Shelf* shelf) {
  const ModelRecord* target = knowledge.Find(model);
  const std::vector<ModelId>& known = knowledge.RequirementsOf(model);
  for (auto it = std::upper_bound(known.begin(), known.end(), shelf->last); it != known.end(); ++it) {
    shelf->last = *it;
    const ModelRecord* record = knowledge.Find(*it);
    if (!record || !record->model.rhs.positive) continue;
    Condition condition;
    condition.components = 1;
    if (const CompositeStateRecord* state = knowledge.Find(RequiredState(record->model)); state && target) {
      const std::set<int> named = NamedByGoal(state->state, record->model, target->model);
      condition.components = static_cast<int>(state->state.components.size());
      for (int i = 0; i < condition.components; ++i) {
        CompositeState one = state->state;  // its guards and variable numbers are those of the whole
        one.components = {state->state.components[static_cast<std::size_t>(i)]};
        std::set<Key> keys;
        for (const FactPattern& part : Flatten(knowledge, one).parts) {
          const Term& payload = part.payload;
          if (!part.positive || !IsValue(payload) || !payload[0].is(TermKind::kVariable) ||
              !named.contains(payload[0].variable()) || !payload[1].ground() || !IsExact(payload[2])) {
            continue;
          }
          if (!anything_can_change_ && !changeable_.contains(payload[1]))
            keys.emplace(payload[1], payload[2]);
        }
        for (const Key& key : keys) shelf->postings[key].push_back({*it, i});
        if (!keys.empty()) condition.asks[i] = static_cast<int>(keys.size());
      }
    }
    shelf->by_size[{condition.components, static_cast<int>(condition.asks.size())}].push_back(*it);
    shelf->conditions.emplace(*it, std::move(condition));
  }
}

std::vector<ModelId> Retrieval::Candidates(const KnowledgeBase& knowledge, ModelId model,
                                           const std::vector<Term>& individuals, const Situation& situation,
                                           const ReasonerParameters& parameters, std::size_t near_misses) {
  NoteWhatCanChange(knowledge);
  Shelf& shelf = shelves_[model];
  CatchUp(knowledge, model, &shelf);

  // One pass over what is known of the individuals.
  std::set<Key> known;
  for (const Term& individual : individuals) {
    const Term any = MakeValue(individual, Term::Wildcard(), Term::Wildcard());
    for (const std::size_t i : situation.Candidates(any, {})) {
      const Fact& fact = situation[i].fact;
      if (fact.positive && IsValue(fact.payload) && fact.payload[0] == individual) {
        known.emplace(fact.payload[1], fact.payload[2]);
      }
    }
  }
  std::map<ModelId, std::map<int, int>> hits;  // requirement -> component -> keys it asks for that are there
  for (const Key& key : known) {
    const auto it = shelf.postings.find(key);
    if (it == shelf.postings.end()) continue;
    for (const Posting& posting : it->second) ++hits[posting.requirement][posting.component];
  }

  std::vector<ModelId> chosen;
  std::vector<std::pair<double, ModelId>> missed;  // (share that could be kept, negated; id)
  for (const auto& [id, by_component] : hits) {
    const Condition& condition = shelf.conditions.at(id);
    int kept = condition.components - static_cast<int>(condition.asks.size());
    for (const auto& [component, count] : by_component) kept += count == condition.asks.at(component) ? 1 : 0;
    if (Enough(kept, condition.components, parameters)) {
      chosen.push_back(id);
    } else {
      missed.emplace_back(-static_cast<double>(kept) / condition.components, id);
    }
  }
  for (const auto& [size, ids] : shelf.by_size) {
    if (!Enough(size.first - size.second, size.first, parameters)) continue;
    for (const ModelId id : ids) {
      if (!hits.contains(id)) chosen.push_back(id);
    }
  }
  std::sort(missed.begin(), missed.end());
  for (std::size_t i = 0; i < missed.size() && i < near_misses; ++i) chosen.push_back(missed[i].second);
  std::erase_if(chosen, [&](ModelId id) {
    const ModelRecord* record = knowledge.Find(id);
    return !record || record->state != ModelState::kActive;
  });
  std::sort(chosen.begin(), chosen.end(), [&](ModelId a, ModelId b) {
    const bool a_derived = knowledge.Find(a)->origin == Origin::kAnalogy;
    const bool b_derived = knowledge.Find(b)->origin == Origin::kAnalogy;
    return std::pair(a_derived, a) < std::pair(b_derived, b);
  });
  return chosen;
}

}  // namespace aerascope
