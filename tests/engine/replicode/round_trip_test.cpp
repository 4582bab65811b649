// What is written is read back to the same content: the same canonical hashes, whatever the numbering and the
// names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/replicode/reader.h"
#include "engine/replicode/writer.h"

namespace aerascope {
namespace {

using testing::ElementsAre;

KnowledgeBase BaseOf(const SeedKnowledge& seed) {
  KnowledgeBase knowledge;
  for (const Term& symbol : seed.symbols) knowledge.AddSymbol(symbol);
  std::int64_t id = 1'000'000;
  for (const SeedFact& fact : seed.facts)
    knowledge.AddFact({FactId{++id}, fact.fact, FactSource::kProperty, {}});
  for (const SeedCompositeState& item : seed.composite_states) {
    CompositeStateRecord record;
    record.state = item.state;
    knowledge.AddCompositeState(std::move(record));
  }
  for (const SeedModel& item : seed.models) {
    ModelRecord record;
    record.model = item.model;
    record.evidence = item.evidence;
    record.strong = item.strong;
    knowledge.AddModel(std::move(record));
  }
  return knowledge;
}

// Everything that must survive, one line each: content hashes, evidence, facts.
std::vector<std::string> Content(const SeedKnowledge& seed) {
  const KnowledgeBase knowledge = BaseOf(seed);
  std::vector<std::string> lines;
  for (const auto& [id, record] : knowledge.composite_states())
    lines.push_back("cst " + ToText(record.canonical.hash));
  for (const auto& [id, record] : knowledge.models()) {
    lines.push_back("mdl " + ToText(record.canonical.hash) + (record.strong ? " strong " : " ") +
                    std::to_string(record.evidence.total) + " " + std::to_string(record.evidence.rate()));
  }
  std::sort(lines.begin(), lines.end());
  for (const SeedFact& fact : seed.facts) {
    if (fact.fact.payload.IsStruct("mk.val")) lines.push_back(ToText(fact.fact));
  }
  return lines;
}

const Term kHand = Term::Entity("h");
const Term kPosition = Term::Ontology("position");
const Term kHolding = Term::Ontology("holding");
const Term kSize = Term::Ontology("size");
const Term kMove = Term::Ontology("move");

Term V(int i) {
  return Term::Variable(i);
}

// Composite states over a handful of attributes, causal models and requirements over those, all with
// variables numbered in any order and called by any names.
class RandomSeed {
 public:
  SeedKnowledge Make() {
    seed_.symbols = {kHand, Term::Entity("c1"), kPosition, kHolding, kSize, kMove, Term::Ontology("large")};
    const int states = *rc::gen::inRange(1, 4);
    for (int i = 0; i < states; ++i) AddState();
    const int models = *rc::gen::inRange(0, 3);
    for (int i = 0; i < models; ++i) {
      AddCausalModel();
      if (*rc::gen::arbitrary<bool>()) AddRequirement();
    }
    const int facts = *rc::gen::inRange(0, 3);
    for (int i = 0; i < facts; ++i) AddFact();
    return seed_;
  }

 private:
  std::int64_t NextId() { return next_id_ += *rc::gen::inRange(1, 5); }

  // Distinct variable numbers 0..count-1 in random order.
  static std::vector<int> Numbers(int count) {
    std::vector<int> numbers;
    for (int i = 0; i < count; ++i) numbers.push_back(i);
    for (std::size_t i = numbers.size(); i > 1; --i) {
      std::swap(numbers[i - 1], numbers[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(i)))]);
    }
    return numbers;
  }
  static std::vector<std::string> Names(int count) {
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) {
      names.push_back(
          *rc::gen::element<std::string>("H", "P", "h", "c1", "T0", "", "nil", "v2", "a b", "cst_1"));
    }
    return names;
  }
  static Term ValueTerm(const std::vector<int>& v) {
    switch (*rc::gen::inRange(0, 6)) {
      case 0:
        return V(v[2]);
      case 1:
        return Term::Set({V(v[3])});
      case 2:
        return Term::Set({});
      case 3:
        return Term::Struct("vec2", {V(v[4]), Term::Number(*rc::gen::arbitrary<int>() / 7.0)});
      case 4:
        return Term::String(*rc::gen::arbitrary<std::string>());
      default:
        return Term::Ontology("large");
    }
  }

  void AddState() {
    const std::vector<int> v = Numbers(8);
    CompositeState state;
    const int count = *rc::gen::inRange(1, 4);
    for (int i = 0; i < count; ++i) {
      Term payload = MakeValue(V(v[*rc::gen::inRange<std::size_t>(0, 2)]),
                               *rc::gen::element(kPosition, kHolding, kSize), ValueTerm(v));
      if (!seed_.composite_states.empty() && *rc::gen::inRange(0, 3) == 0) {
        const CompositeState& inner = (*rc::gen::elementOf(seed_.composite_states)).state;
        std::vector<Term> arguments;
        for (std::size_t k = 0; k < ArgumentVariables(inner).size(); ++k) arguments.push_back(V(v[k % 6]));
        payload = MakeIcst(inner.id, {}, std::move(arguments));
      }
      state.components.push_back({*rc::gen::inRange(0, 4) > 0, std::move(payload), V(v[6]), V(v[7])});
    }
    if (*rc::gen::arbitrary<bool>())
      state.guards.push_back({std::nullopt, Term::Struct("<>", {V(v[0]), Term::Nil()})});
    state.id = {NextId()};
    state.variable_names = Names(8);
    seed_.composite_states.push_back({"", std::move(state)});
  }

  void AddCausalModel() {
    const std::vector<int> v = Numbers(11);
    Model model;
    model.template_arguments = {V(v[0]), Term::Struct("ti", {V(v[1]), V(v[2])})};
    model.lhs = {true, MakeCommand(kMove, {V(v[3]), V(v[4])}), V(v[5]), V(v[6])};
    model.rhs = {true, MakeValue(V(v[3]), kPosition, V(v[7])), V(v[8]), V(v[9])};
    model.forward = {
        {v[7],
         Term::Struct("+",
                      {V(v[0]), Term::Struct("*", {V(v[4]), Term::Number(*rc::gen::inRange(1, 9) / 3.0)})})},
        {v[8], Term::Struct("+", {V(v[1]), Term::Span({*rc::gen::inRange(-100'000, 2'000'000)})})}};
    model.backward = {{std::nullopt, Term::Struct("<>", {V(v[7]), V(v[0])})},
                      {v[4], Term::Struct("-", {V(v[7]), V(v[0])})}};
    model.id = {NextId()};
    model.variable_names = Names(11);
    const double total = *rc::gen::inRange(1, 9);
    seed_.models.push_back({"",
                            std::move(model),
                            {static_cast<double>(*rc::gen::inRange(0, static_cast<int>(total) + 1)), total},
                            *rc::gen::arbitrary<bool>()});
  }

  void AddRequirement() {
    const std::vector<int> v = Numbers(10);
    const CompositeState state = (*rc::gen::elementOf(seed_.composite_states)).state;
    const Model target = seed_.models.back().model;
    std::vector<Term> arguments;
    for (std::size_t k = 0; k < ArgumentVariables(state).size(); ++k) arguments.push_back(V(v[k % 8]));
    std::vector<Term> exposed;
    for (std::size_t k = 0; k < ExposedVariables(target).size(); ++k) exposed.push_back(V(v[k % 8]));
    Model model;
    model.lhs = {true, MakeIcst(state.id, {}, std::move(arguments)), V(v[8]), V(v[9])};
    model.rhs = {*rc::gen::arbitrary<bool>(),
                 MakeImdl(target.id, {V(v[0]), Term::Struct("ti", {V(v[8]), V(v[9])})}, std::move(exposed)),
                 V(v[8]), V(v[9])};
    model.id = {NextId()};
    model.variable_names = Names(10);
    if (KindOf(model) == ModelKind::kCausal) return;
    seed_.models.push_back({"", std::move(model), {1, 1}, false});
  }

  void AddFact() {
    const TimeInterval interval{
        {*rc::gen::inRange(-5, 5)},
        *rc::gen::arbitrary<bool>() ? kForever : Time{*rc::gen::inRange(5, 9'000'000)}};
    seed_.facts.push_back({"",
                           {*rc::gen::arbitrary<bool>(),
                            MakeValue(kHand, kPosition, Term::Number(*rc::gen::arbitrary<double>())),
                            interval, *rc::gen::inRange(0, 9) / 8.0}});
  }

  SeedKnowledge seed_;
  std::int64_t next_id_ = 0;
};

TEST(RoundTrip, WrittenKnowledgeIsReadBackToTheSameContent) {
  EXPECT_TRUE(rc::check([] {
    const SeedKnowledge seed = RandomSeed().Make();
    const Result<std::string> text = WriteReplicode(seed);
    RC_ASSERT(text.ok());
    const Result<SeedKnowledge> back = ReadReplicode(*text, "written.replicode");
    if (!back) RC_FAIL(back.error().message + "\n" + *text);
    RC_ASSERT(back->symbols == seed.symbols);
    RC_ASSERT(Content(*back) == Content(seed));
    // And the second time nothing changes, to the byte.
    RC_ASSERT(*WriteReplicode(*back) == *text);
  }));
}

TEST(RoundTrip, TheTextIsTheLanguageOfSeeds) {
  // Given a learned pair: a causal model and the composite state that must hold, with numbers of an episode
  SeedKnowledge seed;
  seed.symbols = {kHand, kPosition, kHolding, kMove};
  CompositeState state{CompositeStateId{12},
                       {{true, MakeValue(V(3), kPosition, V(0)), V(1), V(2)},
                        {false, MakeValue(V(3), kHolding, Term::Set({})), V(1), V(2)}},
                       {},
                       {"P", "T0", "T1", "H"}};
  Model model;
  model.id = {14};
  model.template_arguments = {V(0)};
  model.lhs = {true, MakeCommand(kMove, {V(1), V(2)}), V(3), V(4)};
  model.rhs = {true, MakeValue(V(1), kPosition, V(5)), V(6), V(7)};
  model.forward = {{5, Term::Struct("+", {V(0), V(2)})},
                   {6, Term::Struct("+", {V(3), Term::Span(Milliseconds(80))})}};
  Model requirement;
  requirement.id = {15};
  requirement.lhs = {true, MakeIcst(state.id, {}, {V(1), V(0)}), V(2), V(3)};  // P, H
  requirement.rhs = {true, MakeImdl(model.id, {V(1)}, {V(0), V(4), V(5), V(6), V(7)}), V(2), V(3)};
  seed.composite_states.push_back({"cst_12", state});
  seed.models.push_back({"mdl_14", model, {3, 4}, false});
  seed.models.push_back({"mdl_15", requirement, {1, 1}, true});
  seed.facts.push_back(
      {"at", {true, MakeValue(kHand, kPosition, Term::Number(2.5)), {Time{0}, Time{100'000}}, 1}});

  // Then it reads like a seed written by hand; the argument list follows the order in which variables appear
  EXPECT_EQ(*WriteReplicode(seed), R"(h:(ent 1) |[]
position:(ont 1) |[]
holding:(ont 1) |[]
move:(ont 1) |[]

cst_12:(cst [] []
   (fact (mk.val H: position P: :) T0: T1: : :)
   (|fact (mk.val H: holding [] :) T0: T1: : :)
|[]
|[]
[stdin] 1) |[]

mdl_14:(mdl [v0:] []
   (fact (cmd move [v1: v2:] :) v3: v4: : :)
   (fact (mk.val v1: position v5: :) v6: v7: : :)
[]
   v5:(+ v0 v2)
   v6:(+ v3 80ms)
|[]
[stdin] 0 4 0.75 1 1) |[]

mdl_15:(mdl [] []
   (fact (icst cst_12 [] [v0: v1:] : :) v2: v3: : :)
   (fact (imdl mdl_14 [v1:] [v0: v4: v5: v6: v7:] : :) v2: v3: : :)
|[]
|[]
[stdin] 1 1 1 1 1) |[]

at:(fact (mk.val h position 2.5 1) 0s:0ms:0us 0s:100ms:0us 1 1) |[]
)");
}

TEST(RoundTrip, DeletedModelsAndWhatSpeaksAboutThemAreLeftOut) {
  SeedKnowledge seed;
  seed.symbols = {kHand, kPosition, kMove};
  Model model;
  model.id = {1};
  model.lhs = {true, MakeCommand(kMove, {V(0)}), V(1), V(2)};
  model.rhs = {true, MakeValue(V(0), kPosition, Term::Number(1)), V(3), V(4)};
  Model requirement;
  requirement.id = {2};
  requirement.lhs = {true, MakeValue(V(0), kPosition, Term::Number(0)), V(1), V(2)};
  requirement.rhs = {true, MakeImdl(model.id, {}, {V(0), V(3), V(4)}), V(1), V(2)};
  seed.models = {{"a", model, {1, 1}, false}, {"b", requirement, {1, 1}, false}};
  KnowledgeBase knowledge = BaseOf(seed);
  EXPECT_EQ(SeedFrom(knowledge).models.size(), 2u);
  knowledge.SetState(model.id, ModelState::kDeleted);
  EXPECT_EQ(SeedFrom(knowledge).models.size(), 0u);
}

TEST(RoundTrip, WhatHasNoFormInReplicodeIsRefused) {
  SeedKnowledge seed;
  seed.symbols = {Term::Entity("a thing")};
  EXPECT_EQ(WriteReplicode(seed).error().message,
            "expected knowledge that Replicode can say, found the name 'a thing', which has no form there");
}

TEST(RoundTrip, DanglingAndCircularReferencesAreRefused) {
  SeedKnowledge seed;
  CompositeState state{
      CompositeStateId{1}, {{true, MakeIcst(CompositeStateId{7}, {}, {}), V(0), V(1)}}, {}, {}};
  seed.composite_states = {{"S1", state}};
  EXPECT_EQ(WriteReplicode(seed).error().message,
            "expected composite state 7, to which S1 refers, found nothing with this number");
  CompositeState other{
      CompositeStateId{7}, {{true, MakeIcst(CompositeStateId{1}, {}, {}), V(0), V(1)}}, {}, {}};
  seed.composite_states.push_back({"S7", other});
  EXPECT_EQ(WriteReplicode(seed).error().message,
            "expected knowledge without circles, found that S1 refers to itself");
}

TEST(RoundTrip, APayload) {
  EXPECT_EQ(*WritePayload(MakeValue(kHand, kHolding, Term::Set({Term::Entity("c1")}))),
            "(mk.val h holding [c1] 1)");
  EXPECT_EQ(*WritePayload(MakeIcst(CompositeStateId{3}, {}, {kHand})), "(icst cst_3 [] [h] true 1)");
}

}  // namespace
}  // namespace aerascope
