// What is written is read back to the same content: the same canonical hashes, whatever the numbering and the
// names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/base/text.h"
#include "engine/kb/term_codec.h"
#include "engine/replicode/reader.h"
#include "engine/replicode/writer.h"
#include "tests/support/any_event.h"
#include "tests/support/any_knowledge.h"
#include "tests/support/law.h"

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
    record.state = item.state;
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
                    std::string(record.state == ModelState::kActive ? "" : "phased out ") +
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
const Term kMove = Term::Ontology("move");

Term V(int i) {
  return Term::Variable(i);
}

// Definitions exactly, but for the names of variables, which are only for people.
struct Said {
  std::vector<Term> symbols;
  std::vector<Term> definitions;  // states, then models
  std::vector<std::string> standing;
  std::vector<std::string> facts;

  bool operator==(const Said&) const = default;
};

// What the seed says, in the order of the text: states first, then models, both with these places as numbers.
Said WhatIsSaid(const SeedKnowledge& seed) {
  std::map<std::int64_t, std::int64_t> places;
  for (const SeedCompositeState& item : seed.composite_states)
    places.try_emplace(item.state.id.value, static_cast<std::int64_t>(places.size()) + 1);
  for (const SeedModel& item : seed.models)
    places.try_emplace(item.model.id.value, static_cast<std::int64_t>(places.size()) + 1);
  const auto placed = [&](const Term& term) {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (part.is(TermKind::kCompositeState))
        return Term::Reference(CompositeStateId{places.at(part.composite_state().value)});
      if (part.is(TermKind::kModel)) return Term::Reference(ModelId{places.at(part.model().value)});
      return std::nullopt;
    });
  };
  Said said;
  said.symbols = seed.symbols;
  for (const SeedCompositeState& item : seed.composite_states) {
    CompositeState state = item.state;
    state.variable_names.clear();
    said.definitions.push_back(placed(DefinitionToTerm(state)));
  }
  for (const SeedModel& item : seed.models) {
    Model model = item.model;
    model.variable_names.clear();
    said.definitions.push_back(placed(DefinitionToTerm(model)));
    std::string standing = item.strong ? "strong " : "weak ";
    standing += item.state == ModelState::kActive ? "active " : "phased out ";
    AppendExactNumber(item.evidence.positive, &standing);
    standing += " of ";
    AppendExactNumber(item.evidence.total, &standing);
    said.standing.push_back(std::move(standing));
  }
  for (const SeedFact& item : seed.facts) {
    std::string text = item.fact.positive ? "fact " : "anti-fact ";
    text += Encode(placed(item.fact.payload)) + " " + std::to_string(item.fact.interval.after.us) + " " +
            std::to_string(item.fact.interval.before.us) + " ";
    AppendExactNumber(item.fact.confidence, &text);
    said.facts.push_back(std::move(text));
  }
  return said;
}

std::set<ModelKind> KindsIn(const SeedKnowledge& seed) {
  std::set<ModelKind> kinds;
  for (const SeedModel& item : seed.models) kinds.insert(KindOf(item.model));
  return kinds;
}

// Own: parse(print(x)) = x.
TEST(RoundTrip, WhatIsWrittenIsReadBackAsTheSameKnowledge) {
  std::set<ModelKind> kinds;
  EXPECT_TRUE(Holds(2000, [&](std::uint64_t number) {
    const SeedKnowledge seed = AnyKnowledge(number);
    kinds.merge(KindsIn(seed));
    const Result<std::string> text = WriteReplicode(seed);
    if (!text) RC_FAIL(text.error().message);
    const Result<SeedKnowledge> back = ReadReplicode(*text, "written.replicode");
    if (!back) RC_FAIL(back.error().message + "\n" + *text);
    const Result<SeedKnowledge> normalised = Normalised(seed);
    RC_ASSERT(normalised.ok());
    if (WhatIsSaid(*back) != WhatIsSaid(*normalised)) RC_FAIL("read back as something else:\n" + *text);
    // And the second time nothing changes, to the byte.
    RC_ASSERT(*WriteReplicode(*back) == *text);
    // Nor does the identity of what is known, whatever numbers it had.
    RC_ASSERT(Content(*back) == Content(seed));
  }));
  EXPECT_EQ(kinds.size(), 5u) << "the law was not tried on models of every kind";
}

// Own: parse(print(x)) = x for the knowledge base an agent holds, not only for seeds.
TEST(RoundTrip, OfAWholeKnowledgeBase) {
  EXPECT_TRUE(Holds(1000, [](std::uint64_t number) {
    const Result<SeedKnowledge> known = Normalised(AnyKnowledge(number));
    RC_ASSERT(known.ok());
    const KnowledgeBase knowledge = BaseOf(*known);
    const Result<std::string> text = WriteReplicode(SeedFrom(knowledge));
    if (!text) RC_FAIL(text.error().message);
    const Result<SeedKnowledge> back = ReadReplicode(*text, "written.replicode");
    if (!back) RC_FAIL(back.error().message + "\n" + *text);
    const KnowledgeBase again = BaseOf(*back);
    RC_ASSERT(again.symbols() == knowledge.symbols());
    RC_ASSERT(again.composite_states().size() == knowledge.composite_states().size());
    RC_ASSERT(again.models().size() == knowledge.models().size());
    for (const auto& [id, record] : knowledge.models()) {
      const ModelRecord* same = again.Find(again.FindModel(record.canonical.hash));
      RC_ASSERT(same != nullptr);
      RC_ASSERT(KindOf(same->model) == KindOf(record.model));
    }
  }));
}

// Own: whatever stands in a damaged file, a text is written only if it says the same.
TEST(RoundTrip, ArbitraryKnowledgeIsWrittenFaithfullyOrRefused) {
  int written = 0;
  EXPECT_TRUE(Holds(2000, [&](std::uint64_t number) {
    AnyEvents any(number);
    SeedKnowledge seed = any.Chance() ? AnyKnowledge(number) : SeedKnowledge{};
    // Something made of arbitrary terms is put among sensible knowledge.
    const auto id = 500 + any.Below(500);
    switch (any.Below(4)) {
      case 0: {
        CompositeState state = any.AnyBody<CompositeStateCreated>().state;
        state.id = {id};
        seed.composite_states.push_back({any.Name(), std::move(state)});
        break;
      }
      case 1: {
        Model model = any.AnyBody<ModelCreated>().model;
        model.id = {id};
        seed.models.push_back({any.Name(), std::move(model), {any.Real(), any.Real()}, any.Chance()});
        break;
      }
      case 2:
        seed.facts.push_back({any.Name(), any.AnyBody<FactObserved>().fact});
        break;
      default:
        if (seed.models.empty()) break;
        seed.models.back().model.forward.push_back(
            {any.Chance() ? std::optional(3) : std::nullopt, any.AnyTerm()});
        seed.models.back().model.template_arguments.push_back(any.AnyTerm());
        break;
    }
    const Result<std::string> text = WriteReplicode(seed);
    if (!text) return;
    ++written;
    const Result<SeedKnowledge> back = ReadReplicode(*text, "written.replicode");
    if (!back) RC_FAIL(back.error().message + "\n" + *text);
    if (WhatIsSaid(*back).definitions != WhatIsSaid(*Normalised(seed)).definitions) RC_FAIL(*text);
  }));
  EXPECT_GT(written, CasesToTry(100)) << "nearly everything is refused, so nothing was tested";
}

TEST(RoundTrip, EvidenceIsReadBackExactly) {
  // Given evidence whose success rate has no end as a decimal fraction
  SeedKnowledge seed;
  for (std::uint64_t number = 0; seed.models.empty(); ++number) seed = AnyKnowledge(number);
  for (const Evidence evidence :
       {Evidence{1, 3}, Evidence{2, 3}, Evidence{1, 49}, Evidence{0.6, 1}, Evidence{1.6, 2},
        Evidence{2.33333333, 7}, Evidence{0, 5}, Evidence{123456789, 987654321}}) {
    seed.models.back().evidence = evidence;
    const Result<SeedKnowledge> back = ReadReplicode(*WriteReplicode(seed), "written.replicode");
    ASSERT_TRUE(back.ok()) << back.error().message;
    // Then no part of it is lost
    EXPECT_EQ(back->models.back().evidence, evidence) << evidence.positive << "/" << evidence.total;
  }
}

TEST(RoundTrip, SymbolsThatWereNeverDeclaredAreDeclared) {
  SeedKnowledge seed;
  seed.facts = {{"", {true, MakeValue(kHand, kPosition, Term::Number(1)), kAlways, 1}}};
  const Result<SeedKnowledge> back = ReadReplicode(*WriteReplicode(seed), "written.replicode");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_THAT(back->symbols, ElementsAre(kHand, kPosition));
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

TEST(RoundTrip, APhasedOutModelStaysSo) {
  // own. Given two equal models but for the effect, one phased out, then it is so after writing and reading,
  // and the other is not; what views say otherwise changes nothing.
  SeedKnowledge seed;
  seed.symbols = {kHand, kPosition, kMove};
  Model model;
  model.lhs = {true, MakeCommand(kMove, {V(0)}), V(1), V(2)};
  for (int i = 1; i <= 2; ++i) {
    model.id = {i};
    model.rhs = {true, MakeValue(V(0), kPosition, Term::Number(i)), V(3), V(4)};
    seed.models.push_back({i == 1 ? "a" : "b", model, {1, 3}, true});
  }
  seed.models[1].state = ModelState::kPhasedOut;
  const Result<std::string> text = WriteReplicode(seed);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_THAT(
      *text, testing::HasSubstr("[[SYNC_ONCE now 1 forever primary nil 0] [SYNC_ONCE now 1 forever secondary "
                                "nil 0.3333333333]]"));
  const Result<SeedKnowledge> read = ReadReplicode(*text, "seed.replicode");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->models[0].state, ModelState::kActive);
  EXPECT_EQ(read->models[1].state, ModelState::kPhasedOut);
  std::string active = *text;
  active.replace(active.find("primary nil 0]"), 14, "primary nil 1]");
  EXPECT_EQ(ReadReplicode(active, "seed.replicode")->models[1].state, ModelState::kActive);
}

TEST(RoundTrip, WhatHasNoFormInReplicodeIsRefused) {
  SeedKnowledge seed;
  seed.symbols = {Term::Entity("a thing")};
  EXPECT_EQ(WriteReplicode(seed).error().message,
            "expected knowledge that Replicode can say, found the name 'a thing', which has no form there");
}

TEST(RoundTrip, WhatWouldBeReadAsSomethingElseIsRefused) {
  const auto refused = [](const Fact& fact) {
    SeedKnowledge seed;
    seed.facts = {{"", fact}};
    const Result<std::string> text = WriteReplicode(seed);
    return text ? *text : text.error().message;
  };
  const Term payload = MakeValue(kHand, kPosition, Term::Number(1));
  const std::string found = "expected knowledge that Replicode can say, found in the fact ";
  EXPECT_EQ(refused({true, MakeValue(kHand, Term::Entity("h"), V(0)), kAlways, 1}),
            found + "(mk.val h h v0) [0s, forever) the attribute h, which has no form there");
  EXPECT_EQ(refused({true, MakeValue(kHand, Term::Ontology("h"), Term::Nil()), kAlways, 1}),
            found +
                "(mk.val h h nil) [0s, forever) the name 'h' for an entity and for a symbol, which has no "
                "form there");
  EXPECT_EQ(refused({true, payload, {Time{5'000'000}, Time{0}}, 1}),
            found + "(mk.val h position 1) [5s, 0s) an end before its start, which has no form there");
  Term deep = Term::Number(1);
  for (int i = 0; i < 40; ++i) deep = Term::Set({deep});
  EXPECT_THAT(refused({true, MakeValue(kHand, kPosition, deep), kAlways, 1}),
              testing::EndsWith("values inside each other to a depth of 42, which has no form there"));
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
