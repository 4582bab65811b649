// The identity of knowledge: independent of numbers, of names, and of the order of unordered parts.
#include "engine/kb/canonical.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/kb/knowledge_base.h"
#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"
#include "tests/support/any_knowledge.h"
#include "tests/support/knowledge_edits.h"
#include "tests/support/law.h"

namespace aerascope {
namespace {

// Definitions under test, found by their references.
class Library {
 public:
  Canonical Add(const CompositeState& state) {
    states_[state.id] = state;
    return state_forms_[state.id] = Canonicalise(state, Forms(), Here());
  }
  Canonical Add(const Model& model) {
    models_[model.id] = model;
    return model_forms_[model.id] = Canonicalise(model, Forms(), Here());
  }

 private:
  CanonicalOf Forms() {
    return [this](const Term& reference) -> const Canonical* {
      if (reference.is(TermKind::kCompositeState)) {
        const auto it = state_forms_.find(reference.composite_state());
        return it == state_forms_.end() ? nullptr : &it->second;
      }
      const auto it = model_forms_.find(reference.model());
      return it == model_forms_.end() ? nullptr : &it->second;
    };
  }
  Definitions Here() {
    return {[this](CompositeStateId id) { return states_.contains(id) ? &states_[id] : nullptr; },
            [this](ModelId id) { return models_.contains(id) ? &models_[id] : nullptr; }};
  }
  std::map<CompositeStateId, CompositeState> states_;
  std::map<ModelId, Model> models_;
  std::map<CompositeStateId, Canonical> state_forms_;
  std::map<ModelId, Canonical> model_forms_;
};

Term WithVariables(const Term& term, const std::vector<int>& numbers) {
  return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
    if (!part.is(TermKind::kVariable)) return std::nullopt;
    return V(numbers[static_cast<std::size_t>(part.variable())]);
  });
}
FactPattern WithVariables(const FactPattern& p, const std::vector<int>& numbers) {
  return {p.positive, WithVariables(p.payload, numbers), WithVariables(p.after, numbers),
          WithVariables(p.before, numbers)};
}

// Reading order of an instance's arguments: all variables but the interval's, ascending.
Term InstanceOf(const CompositeState& state, const std::map<int, Term>& values) {
  std::vector<Term> arguments;
  for (const int v : ArgumentVariables(state)) arguments.push_back(values.at(v));
  return MakeIcst(state.id, {}, arguments);
}

// The same condition learned in another order and under other numbers: first a shuffle of the components,
// then of the numbers of the variables (`numbers` holds at least as many as there are).
struct Variant {
  CompositeState state;
  std::vector<int> numbers;
};
Variant VariantOf(const CompositeState& state, int variables, std::mt19937_64& random) {
  Variant variant{state, {}};
  for (int i = 0; i < variables; ++i) variant.numbers.push_back(i);
  std::shuffle(variant.numbers.begin(), variant.numbers.end(), random);
  variant.state.id = {state.id.value + static_cast<std::int64_t>(random() % 1000) * 10 + 10};
  std::shuffle(variant.state.components.begin(), variant.state.components.end(), random);
  for (FactPattern& component : variant.state.components)
    component = WithVariables(component, variant.numbers);
  for (Guard& guard : variant.state.guards) {
    if (guard.target) guard.target = variant.numbers[static_cast<std::size_t>(*guard.target)];
    guard.expression = WithVariables(guard.expression, variant.numbers);
  }
  variant.state.variable_names = {"other", "names"};
  return variant;
}

// A condition of up to six components over few objects, so that many are alike.
CompositeState AnyState(AnyEvents& any) {
  static const char* kAttributes[] = {"position", "size", "shape"};
  CompositeState state{{1 + any.Below(9)}, {}, {}, {}};
  for (std::int64_t n = 1 + any.Below(6); n > 0; --n) {
    Term object = any.Chance() ? V(static_cast<int>(2 + any.Below(3))) : E("h");
    Term value = any.Chance() ? V(static_cast<int>(5 + any.Below(3))) : O("large");
    state.components.push_back(Component(std::move(object), kAttributes[any.Below(3)], std::move(value)));
    state.components.back().positive = any.Below(5) != 0;
  }
  if (any.Chance()) {
    state.guards.push_back({std::nullopt, Struct("<>", {V(static_cast<int>(2 + any.Below(6))), V(5)})});
  }
  return state;
}
constexpr int kVariablesOfAnyState = 8;

TEST(CanonicalForm, DoesNotDependOnOrderNumbersAndNames) {
  EXPECT_TRUE(Holds(2000, [](std::uint64_t seed) {
    AnyEvents any(seed);
    std::mt19937_64 random(seed);
    Library library;
    const CompositeState state = AnyState(any);
    const Canonical form = library.Add(state);
    for (int i = 0; i < 5; ++i) {
      const Canonical other = library.Add(VariantOf(state, kVariablesOfAnyState, random).state);
      RC_ASSERT(other.text == form.text);
      RC_ASSERT(other.hash == form.hash);
    }
  }));
}

TEST(CanonicalForm, OfAModelDoesNotDependOnTheOrderOfTheConditionItRefersTo) {
  EXPECT_TRUE(Holds(2000, [](std::uint64_t seed) {
    AnyEvents any(seed);
    std::mt19937_64 random(seed);
    Library library;
    const CompositeState state = AnyState(any);
    library.Add(state);
    // A requirement model with the instance of the condition on its left side; its right side uses some
    // arguments.
    const auto model_on = [&](const CompositeState& on, const std::vector<int>& numbers, std::int64_t id) {
      std::map<int, Term> values;
      for (int v = 0; v < kVariablesOfAnyState; ++v) values[numbers[static_cast<std::size_t>(v)]] = V(v);
      Model model;
      model.id = {id};
      model.lhs = {true, InstanceOf(on, values), V(0), V(1)};
      model.rhs = {true, MakeImdl({777}, {}, {V(2), V(5)}), V(0), V(1)};
      return model;
    };
    std::vector<int> same;
    for (int v = 0; v < kVariablesOfAnyState; ++v) same.push_back(v);
    const Canonical form = library.Add(model_on(state, same, 500));
    for (int i = 0; i < 5; ++i) {
      const Variant variant = VariantOf(state, kVariablesOfAnyState, random);
      library.Add(variant.state);
      RC_ASSERT(library.Add(model_on(variant.state, variant.numbers, 501 + i)).text == form.text);
    }
  }));
}

// What is known, by content: each piece of knowledge as often as it is there.
std::multiset<std::string> ContentOf(const KnowledgeBase& knowledge) {
  std::multiset<std::string> content;
  for (const auto& [id, record] : knowledge.composite_states())
    content.insert("cst " + ToText(record.canonical.hash));
  for (const auto& [id, record] : knowledge.models()) content.insert("mdl " + ToText(record.canonical.hash));
  return content;
}

// Own: models of every kind, requirements of requirements and nested conditions included.
TEST(CanonicalForm, OfAWholeKnowledgeBaseDoesNotDependOnNumbersOrderAndNames) {
  EXPECT_TRUE(Holds(2000, [](std::uint64_t seed) {
    const Result<SeedKnowledge> known = Normalised(AnyKnowledge(seed));
    RC_ASSERT(known.ok());
    KnowledgeBase knowledge;
    for (const SeedCompositeState& item : known->composite_states) {
      CompositeStateRecord record;
      record.state = item.state;
      knowledge.AddCompositeState(std::move(record));
    }
    for (const SeedModel& item : known->models) {
      ModelRecord record;
      record.model = item.model;
      knowledge.AddModel(std::move(record));
    }
    RC_ASSERT(ContentOf(Renumbered(knowledge, seed)) == ContentOf(knowledge));
  }));
}

TEST(CanonicalForm, TellsDifferentConditionsApart) {
  Library library;
  const CompositeState base{
      {1}, {Component(V(2), "size", O("large")), Component(V(2), "position", V(3))}, {}, {}};
  std::vector<CompositeState> others(5, base);
  others[0].components[0] = Component(V(2), "size", O("small"));
  others[1].components[0] = Component(V(4), "size", O("large"));  // another object
  others[2].components[0].positive = false;
  others[3].components.pop_back();
  others[4].guards.push_back({std::nullopt, Struct("<>", {V(3), N(0)})});
  std::vector<std::string> texts{library.Add(base).text};
  for (const CompositeState& other : others) texts.push_back(library.Add(other).text);
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(std::unique(texts.begin(), texts.end()), texts.end());
}

// Guards took part after the order was fixed, so a guard between two like components gave two forms.
TEST(CanonicalForm, GuardsDecideBetweenLikeComponents) {
  Library library;
  const Guard guard{std::nullopt, Struct("<", {V(3), V(5)})};
  const CompositeState one{
      {1}, {Component(V(2), "position", V(3)), Component(V(4), "position", V(5))}, {guard}, {}};
  const CompositeState other{
      {2}, {Component(V(4), "position", V(5)), Component(V(2), "position", V(3))}, {guard}, {}};
  EXPECT_EQ(library.Add(one).text, library.Add(other).text);
}

TEST(CanonicalForm, ReplacesReferencesByContent) {
  Library library;
  const auto nested = [](std::int64_t id, std::int64_t inner) {
    return CompositeState{{id}, {{true, MakeIcst({inner}, {}, {V(2)}), V(0), V(1)}}, {}, {}};
  };
  library.Add(CompositeState{{1}, {Component(V(2), "size", O("large"))}, {}, {}});
  library.Add(CompositeState{{7}, {Component(V(9), "size", O("large"))}, {}, {}});
  library.Add(CompositeState{{8}, {Component(V(2), "size", O("small"))}, {}, {}});
  EXPECT_EQ(library.Add(nested(11, 1)).hash, library.Add(nested(12, 7)).hash);
  EXPECT_NE(library.Add(nested(11, 1)).hash, library.Add(nested(13, 8)).hash);
}

TEST(CanonicalForm, UnknownReferenceIsAQuestionMark) {
  Library library;
  const CompositeState state{{1}, {{true, MakeIcst({99}, {}, {V(2)}), V(0), V(1)}}, {}, {}};
  EXPECT_NE(library.Add(state).text.find("(icst \"?\""), std::string::npos);
}

TEST(CanonicalForm, HugeConditionsTakeBoundedTime) {
  Library library;
  CompositeState alike{{1}, {}, {}, {}};
  CompositeState same{{2}, {}, {}, {}};
  for (int i = 0; i < 20'000; ++i) {
    alike.components.push_back(Component(V(i + 2), "size", O("large")));
    same.components.push_back(Component(V(2), "size", O("large")));
  }
  library.Add(alike);
  library.Add(same);
  CompositeState chain{{3}, {}, {}, {}};
  for (int i = 0; i < 300; ++i) chain.components.push_back(Component(V(i + 2), "left_of", V(i + 3)));
  library.Add(chain);
}

TEST(CanonicalForm, OfAModelDoesNotDependOnNumbers) {
  EXPECT_TRUE(Holds(2000, [](std::uint64_t seed) {
    AnyEvents any(seed);
    std::mt19937_64 random(seed);
    const Model model = any.AnyBody<ModelCreated>().model;
    std::vector<int> numbers;
    for (int i = 0; i < 20; ++i) numbers.push_back(i);
    std::shuffle(numbers.begin(), numbers.end(), random);
    Model other = model;
    other.id = {model.id.value + 5000};
    other.variable_names = {"x"};
    for (Term& argument : other.template_arguments) argument = WithVariables(argument, numbers);
    other.lhs = WithVariables(model.lhs, numbers);
    other.rhs = WithVariables(model.rhs, numbers);
    for (std::vector<Guard>* guards : {&other.forward, &other.backward}) {
      for (Guard& guard : *guards) {
        if (guard.target) guard.target = numbers[static_cast<std::size_t>(*guard.target)];
        guard.expression = WithVariables(guard.expression, numbers);
      }
    }
    Library library;
    RC_ASSERT(library.Add(model).text == library.Add(other).text);
  }));
}

}  // namespace
}  // namespace aerascope
