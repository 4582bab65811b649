#include "tests/support/knowledge_edits.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "engine/base/text.h"
#include "engine/event/apply.h"

namespace aerascope {
namespace {

// Old number -> new number; composite states and models share one numbering.
using Numbers = std::map<std::int64_t, std::int64_t>;

std::int64_t NewNumber(const Numbers& numbers, std::int64_t number) {
  const auto it = numbers.find(number);
  return it == numbers.end() ? 0 : it->second;
}

Term Renamed(const Term& term, const Numbers& numbers) {
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (part.is(TermKind::kCompositeState)) {
      return Term::Reference(CompositeStateId{NewNumber(numbers, part.composite_state().value)});
    }
    if (part.is(TermKind::kModel)) return Term::Reference(ModelId{NewNumber(numbers, part.model().value)});
    return std::nullopt;
  });
}

FactPattern Renamed(const FactPattern& pattern, const Numbers& numbers) {
  return {pattern.positive, Renamed(pattern.payload, numbers), pattern.after, pattern.before};
}

void Collect(const Term& term, std::set<std::int64_t>* references) {
  ForEachTerm(term, [&](const Term& part) {
    if (part.is(TermKind::kCompositeState)) references->insert(part.composite_state().value);
    if (part.is(TermKind::kModel)) references->insert(part.model().value);
  });
}

// What each piece of knowledge refers to.
std::map<std::int64_t, std::set<std::int64_t>> ReferencesOf(const KnowledgeBase& knowledge) {
  std::map<std::int64_t, std::set<std::int64_t>> references;
  for (const auto& [id, record] : knowledge.composite_states()) {
    std::set<std::int64_t>& of = references[id.value];
    for (const FactPattern& component : record.state.components) Collect(component.payload, &of);
    if (record.derived_from.valid()) of.insert(record.derived_from.value);
  }
  for (const auto& [id, record] : knowledge.models()) {
    std::set<std::int64_t>& of = references[id.value];
    Collect(record.model.lhs.payload, &of);
    Collect(record.model.rhs.payload, &of);
    if (record.derived_from.valid()) of.insert(record.derived_from.value);
  }
  return references;
}

// A random order in which everything comes after what it refers to.
std::vector<std::int64_t> RandomOrder(std::map<std::int64_t, std::set<std::int64_t>> waiting,
                                      std::mt19937_64* random) {
  std::vector<std::int64_t> order;
  std::set<std::int64_t> known;
  for (const auto& [number, references] : waiting) known.insert(number);
  while (!waiting.empty()) {
    std::vector<std::int64_t> ready;
    for (const auto& [number, references] : waiting) {
      const bool open = std::any_of(references.begin(), references.end(), [&](std::int64_t r) {
        return r != number && waiting.contains(r) && known.contains(r);
      });
      if (!open) ready.push_back(number);
    }
    if (ready.empty()) ready.push_back(waiting.begin()->first);
    const std::int64_t chosen = ready[(*random)() % ready.size()];
    order.push_back(chosen);
    waiting.erase(chosen);
  }
  return order;
}

}  // namespace

std::string Everything(const KnowledgeBase& knowledge) {
  std::string text = ToText(knowledge.now()) + " " + std::to_string(knowledge.frame()) + "\n";
  for (const Term& symbol : knowledge.symbols()) text += ToText(symbol) + "\n";
  for (const auto& [id, record] : knowledge.composite_states()) {
    text += ToText(record.state) + record.canonical.text + ToText(record.canonical.hash) + " " +
            std::string(EnumName(record.origin)) + " from " + std::to_string(record.derived_from.value) +
            " by #" + std::to_string(record.event.value) + ", found as " +
            std::to_string(knowledge.FindState(record.canonical.hash).value) + "\n";
  }
  for (const auto& [id, record] : knowledge.models()) {
    text += ToText(record.model) + record.canonical.text + ToText(record.canonical.hash) + " ";
    AppendExactNumber(record.evidence.positive, &text);
    text += "/";
    AppendExactNumber(record.evidence.total, &text);
    text += (record.strong ? " strong " : " weak ") + std::string(EnumName(record.state)) + " " +
            std::string(EnumName(record.origin)) + " from " + std::to_string(record.derived_from.value) +
            " by #" + std::to_string(record.event.value) + ", found as " +
            std::to_string(knowledge.FindModel(record.canonical.hash).value) + "; requirements:";
    for (const ModelId requirement : knowledge.RequirementsOf(id))
      text += " " + std::to_string(requirement.value);
    text += "\n";
  }
  for (const auto& [id, record] : knowledge.facts()) {
    text += std::to_string(id.value) + " " + ToText(record.fact) + " " +
            std::string(EnumName(record.source)) + " by #" + std::to_string(record.event.value) + "\n";
  }
  for (const auto& [id, record] : knowledge.goals()) {
    text += std::to_string(id.value) + " goal " + ToText(record.target) + " by #" +
            std::to_string(record.event.value) + "\n";
  }
  for (const auto& [id, record] : knowledge.predictions()) {
    text += std::to_string(id.value) + " prediction of mdl_" + std::to_string(record.model.value) + " " +
            ToText(record.target) + " by #" + std::to_string(record.event.value) + "\n";
  }
  return text;
}

KnowledgeBase KnowledgeFrom(const std::vector<Event>& events) {
  KnowledgeBase knowledge;
  for (const Event& event : events) Apply(event, &knowledge);
  return knowledge;
}

KnowledgeBase Renumbered(const KnowledgeBase& knowledge, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Numbers numbers;
  std::int64_t next = static_cast<std::int64_t>(random() % 50);
  const std::vector<std::int64_t> order = RandomOrder(ReferencesOf(knowledge), &random);
  for (const std::int64_t number : order)
    numbers[number] = next += 1 + static_cast<std::int64_t>(random() % 9);

  KnowledgeBase result;
  for (const Term& symbol : knowledge.symbols()) result.AddSymbol(symbol);
  for (const std::int64_t number : order) {
    if (const CompositeStateRecord* record = knowledge.Find(CompositeStateId{number})) {
      CompositeState state{{numbers[number]}, {}, record->state.guards, {}};
      for (const FactPattern& component : record->state.components)
        state.components.push_back(Renamed(component, numbers));
      std::shuffle(state.components.begin(), state.components.end(), random);
      result.AddCompositeState({state,
                                record->origin,
                                {NewNumber(numbers, record->derived_from.value)},
                                {static_cast<std::int64_t>(random() % 1000)},
                                {},
                                {}});
    } else if (const ModelRecord* model_record = knowledge.Find(ModelId{number})) {
      Model model = model_record->model;
      model.id = {numbers[number]};
      model.lhs = Renamed(model.lhs, numbers);
      model.rhs = Renamed(model.rhs, numbers);
      model.variable_names.clear();
      result.AddModel({model,
                       model_record->origin,
                       {NewNumber(numbers, model_record->derived_from.value)},
                       {static_cast<std::int64_t>(random() % 1000)},
                       {},
                       model_record->evidence,
                       model_record->strong,
                       ModelState::kActive,
                       {}});
      result.SetState(model.id, model_record->state);
    }
  }
  return result;
}

}  // namespace aerascope
