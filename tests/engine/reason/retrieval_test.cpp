// The inverted index over conditions: it never misses what the full comparison would take, and looks at few
// others.
#include "engine/reason/retrieval.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "engine/reason/analogy.h"
#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kGrasp = 1000;

// Grasping a thing with these properties; the hand must be empty.
struct Lesson {
  std::vector<std::pair<std::string, std::string>> properties;
};

void Learn(ToyMind* mind, const std::vector<Lesson>& lessons) {
  const Model grasp = Causal(kGrasp, Command("grasp", {V(2)}), Value(V(2), "holding", Just(V(3))));
  std::vector<CompositeState> states;
  std::vector<SeedModelDefinition> models{{grasp, {}, false}};
  for (std::size_t i = 0; i < lessons.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i + 1);
    std::vector<Term> parts{Value(V(0), "holding", None())};
    for (const auto& [attribute, value] : lessons[i].properties)
      parts.push_back(Value(V(3), attribute, O(value)));
    states.push_back(State(id, parts, 1));
    models.push_back(
        {Requires(kGrasp + id, MakeIcst({id}, {}, {V(0), V(1)}), grasp, {V(0), V(1), V(4), V(5)}, 2),
         {},
         false});
  }
  mind->Know({}, states, models);
}

Situation Seeing(const std::vector<std::pair<std::string, std::string>>& properties) {
  Situation situation({Time{0}, Time{kFrame.us}});
  const auto add = [&](const Term& payload) {
    SituationFact fact;
    fact.fact = {true, payload, {Time{0}, Time{kFrame.us}}, 1};
    situation.Add(std::move(fact));
  };
  add(Value(E("h"), "holding", None()));
  for (const auto& [attribute, value] : properties) add(Value(E("x"), attribute, O(value)));
  return situation;
}

std::vector<ModelId> Requirements(const KnowledgeBase& kb) {
  std::vector<ModelId> found;
  for (const auto& [id, record] : kb.models()) {
    if (IsRequirement(record.model)) found.push_back(id);
  }
  return found;
}

ModelId Grasp(const KnowledgeBase& kb) {
  for (const auto& [id, record] : kb.models()) {
    if (!IsRequirement(record.model)) return id;
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> AnyProperties() {
  std::vector<std::pair<std::string, std::string>> properties;
  for (const char* attribute : {"size", "shape", "colour", "weight"}) {
    const int value = *rc::gen::inRange(0, 4);
    if (value > 0) properties.emplace_back(attribute, "v" + std::to_string(value));
  }
  return properties;
}

RC_GTEST_PROP(RetrievalLaw, NothingThatTheFullComparisonWouldTakeIsMissed, ()) {
  // own (semantics 11.2, point 5). Over generated conditions and things, in both modes.
  std::vector<Lesson> lessons(*rc::gen::inRange<std::size_t>(1, 12));
  for (Lesson& lesson : lessons) lesson.properties = AnyProperties();
  ToyMind mind;
  Learn(&mind, lessons);
  const KnowledgeBase& kb = mind.reasoner.knowledge();
  const Situation situation = Seeing(AnyProperties());
  ReasonerParameters parameters;
  parameters.analogy_mode = *rc::gen::element(AnalogyMode::kPaper, AnalogyMode::kOpenaera);
  Retrieval retrieval;
  const std::vector<ModelId> found =
      retrieval.Candidates(kb, Grasp(kb), {E("h"), E("x")}, situation, parameters, 0);
  RC_ASSERT(std::is_sorted(found.begin(), found.end()));
  for (const ModelId id : Requirements(kb)) {
    Bindings bindings;
    bindings.Set(0, E("h"));
    bindings.Set(3, E("x"));
    const Comparison comparison = Compare(
        kb, *kb.Find(id), situation, {}, bindings, Value(E("h"), "holding", Just(E("x"))),
        [](const Term&) { return false; }, parameters);
    const bool taken = !comparison.rejection || comparison.rejection == AnalogyVerdict::kFullMatch;
    if (taken) RC_ASSERT(std::find(found.begin(), found.end(), id) != found.end());
  }
}

TEST(Retrieval, FewOfManyConditionsAreLookedAt) {
  // own. Of a thousand conditions those that fit the thing are compared, and a few near misses; the rest is
  // not touched.
  std::vector<Lesson> lessons;
  for (int i = 0; i < 1000; ++i) {
    const std::string n = std::to_string(i);
    lessons.push_back({{{"size", "s" + n}, {"shape", "f" + n}, {"colour", "c" + n}}});
  }
  ToyMind mind;
  Learn(&mind, lessons);
  mind.See({Value(E("h"), "holding", None()), Value(E("x"), "size", O("s7")), Value(E("x"), "shape", O("f7")),
            Value(E("x"), "colour", O("blue")), Value(E("x"), "weight", O("heavy"))});
  mind.Want(Value(E("h"), "holding", Just(E("x"))));
  EXPECT_EQ(mind.Act(), "(cmd grasp [h])");
  EXPECT_LE(mind.All<AnalogyCompared>().size(), 5u);
  EXPECT_LE(mind.All<GoalSet>().size(), 12u);
}

TEST(Retrieval, WhatAModelCouldChangeIsNoReasonToLookAway) {
  // own. When the colour becomes something that can be changed, conditions on it are candidates again.
  ToyMind mind;
  const Model grasp = Causal(10, Command("grasp", {V(2)}), Value(V(2), "holding", Just(V(3))));
  const CompositeState red = State(1, {Value(V(0), "holding", None()), Value(V(3), "colour", O("red"))}, 1);
  const Model may = Requires(11, MakeIcst({1}, {}, {V(0), V(1)}), grasp, {V(0), V(1), V(4), V(5)}, 2);
  const Model paint = Free(12, Command("paint", {V(2)}), Value(V(2), "colour", O("red")));
  mind.Know({}, {red}, {{grasp, {}, false}, {may, {}, false}, {paint, {}, false}});
  mind.See({Value(E("h"), "holding", None()), Value(E("x"), "colour", O("blue"))});
  mind.Want(Value(E("h"), "holding", Just(E("x"))));
  EXPECT_EQ(mind.Act(), "(cmd paint [x])");
}

}  // namespace
}  // namespace aerascope::toy
