// What the reader understands, and what it says about what it does not.
#include "engine/replicode/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace aerascope {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

constexpr std::string_view kNames = R"(h:(ent 1) |[]
c:(ent 1) |[]
position:(ont 1) |[]
holding:(ont 1) |[]
essence:(ont 1) |[]
hand:(ont 1) |[]
move:(ont 1) |[]
)";

SeedKnowledge Read(const std::string& text, const ReplicodeOptions& options = {}) {
  Result<SeedKnowledge> seed = ReadReplicode(std::string(kNames) + text, "test.replicode", options);
  EXPECT_TRUE(seed.ok()) << seed.error().message;
  return seed ? std::move(*seed) : SeedKnowledge{};
}

// The message about `text`, whose first line is line 1.
std::string ErrorOf(const std::string& text) {
  ReplicodeOptions options;
  options.known_symbols = Read("").symbols;
  const Result<SeedKnowledge> seed = ReadReplicode(text, "t", options);
  EXPECT_FALSE(seed.ok()) << "expected an error in:\n" << text;
  return seed.ok() ? "" : seed.error().message;
}

constexpr std::string_view kHandAt = R"(
S0:(cst [] []
   (fact (mk.val H: essence hand :) T0: T1: : :)
   (fact (mk.val H: position P: :) T0: T1: : :)
|[]
|[]
[stdin] 1) |[]
)";

constexpr std::string_view kMove = R"(
m_move:(mdl [H: P0: (ti T0: T1:)] []
   (fact (cmd move [H: D:] :) T2: T3: : :)
   (fact (mk.val H: position P1: :) T4: T5: : :)
[]
   P1:(+ P0 D)
   T4:(+ T0 100ms)
   T5:(+ T1 100ms)
[]
   (<> P1 P0)
   D:(- P1 P0)
   T2:(- T4 80ms)
[stdin] 1 4 0.75 1 1) |[]
)";

TEST(Reader, EntitiesAndOntologySymbolsAreToldApart) {
  const SeedKnowledge seed = Read("");
  ASSERT_EQ(seed.symbols.size(), 7u);
  EXPECT_EQ(seed.symbols[0], Term::Entity("h"));
  EXPECT_EQ(seed.symbols[2], Term::Ontology("position"));
}

TEST(Reader, FactsNameTheirPayloadOrHoldIt) {
  const SeedKnowledge seed = Read(R"(
h_is_a_hand:(mk.val h essence hand 1) |[]
(fact h_is_a_hand 0s:0ms:0us GIGASEC 1 1) [[SYNC_AXIOM now 1 forever stdin nil]]
f2:(|fact (mk.val c essence hand 1) 0s:100ms:5us 2s:0ms:0us 0.5 1) []
   [SYNC_ONCE now 1 forever root nil]
)");
  ASSERT_EQ(seed.facts.size(), 2u);
  EXPECT_EQ(seed.facts[0].label, "");
  EXPECT_EQ(seed.facts[0].fact,
            (Fact{true, MakeValue(Term::Entity("h"), Term::Ontology("essence"), Term::Ontology("hand")),
                  kAlways, 1}));
  EXPECT_EQ(seed.facts[1].label, "f2");
  EXPECT_FALSE(seed.facts[1].fact.positive);
  EXPECT_EQ(seed.facts[1].fact.interval, (TimeInterval{{100'005}, {2'000'000}}));
  EXPECT_EQ(seed.facts[1].fact.confidence, 0.5);
}

TEST(Reader, ValuesOfAllKinds) {
  const SeedKnowledge seed = Read(R"(
(fact (mk.val h position (vec3 -2.5 0 1e-05) 1) 0s:0ms:0us GIGASEC 1 1) |[]
(fact (mk.val h position [c [1 2] "a \"b\" \x01" nil true] 1) 0s:0ms:0us GIGASEC 1 1) |[]
(fact (mk.val h position 5s 1) 0s:0ms:0us GIGASEC 1 1) |[]
(fact (mk.val h position -1s:500ms:0us 1) 0s:0ms:0us GIGASEC 1 1) |[]
(fact (mk.val h position sampling_period 1) 0s:0ms:0us GIGASEC 1 1) |[]
)",
                                  {Milliseconds(40), {}, false});
  ASSERT_EQ(seed.facts.size(), 5u);
  const auto value = [&](std::size_t i) { return seed.facts[i].fact.payload[2]; };
  EXPECT_EQ(value(0), Term::Struct("vec3", {Term::Number(-2.5), Term::Number(0), Term::Number(1e-5)}));
  EXPECT_EQ(value(1), Term::Set({Term::Entity("c"), Term::Set({Term::Number(1), Term::Number(2)}),
                                 Term::String("a \"b\" \x01"), Term::Nil(), Term::Bool(true)}));
  EXPECT_EQ(value(2), Term::Span(Seconds(5)));
  EXPECT_EQ(value(3), Term::Instant(Time{-1'500'000}));
  EXPECT_EQ(value(4), Term::Span(Milliseconds(40)));
}

TEST(Reader, ACompositeStateNumbersItsVariablesByFirstAppearance) {
  const SeedKnowledge seed = Read(std::string(kHandAt));
  ASSERT_EQ(seed.composite_states.size(), 1u);
  const CompositeState& state = seed.composite_states[0].state;
  EXPECT_EQ(seed.composite_states[0].label, "S0");
  EXPECT_EQ(state.id, CompositeStateId{1});
  EXPECT_THAT(state.variable_names, ElementsAre("H", "T0", "T1", "P"));
  EXPECT_THAT(ArgumentVariables(state), ElementsAre(0, 3));
  EXPECT_EQ(ToText(state),
            "cst_1\n"
            "  (mk.val H essence hand) [T0, T1)\n"
            "  (mk.val H position P) [T0, T1)\n");
}

TEST(Reader, WildcardsInAnIntervalBecomeTheSharedInterval) {
  const SeedKnowledge seed = Read(R"(
S:(cst [] []
   (fact (mk.val H: essence hand :) : : : :)
   (|fact (mk.val H: holding [] ::) ::)
|[] |[] [stdin] 1) |[]
)");
  ASSERT_EQ(seed.composite_states.size(), 1u);
  EXPECT_EQ(ToText(seed.composite_states[0].state),
            "cst_1\n"
            "  (mk.val H essence hand) [T0, T1)\n"
            "  not (mk.val H holding []) [T0, T1)\n");
}

TEST(Reader, AModelHasItsTemplateGuardsAndEvidence) {
  const SeedKnowledge seed = Read(std::string(kMove));
  ASSERT_EQ(seed.models.size(), 1u);
  const SeedModel& model = seed.models[0];
  EXPECT_EQ(KindOf(model.model), ModelKind::kCausal);
  EXPECT_TRUE(model.strong);
  EXPECT_EQ(model.evidence, (Evidence{3, 4}));
  EXPECT_EQ(ToText(model.model),
            "mdl_1 H P0 (ti T0 T1)\n"
            "  (cmd move [H D]) [T2, T3)\n"
            "  -> (mk.val H position P1) [T4, T5)\n"
            "  forward  P1 := (+ P0 D)\n"
            "  forward  T4 := (+ T0 0.1s)\n"
            "  forward  T5 := (+ T1 0.1s)\n"
            "  backward (<> P1 P0)\n"
            "  backward D := (- P1 P0)\n"
            "  backward T2 := (- T4 0.08s)\n");
}

TEST(Reader, ARequirementRefersToWhatWasDeclaredAbove) {
  const SeedKnowledge seed = Read(std::string(kHandAt) + std::string(kMove) + R"(
m_move_req:(mdl [] []
   (fact (icst S0 [] [H: P:] : :) T0: T1: : :)
   (fact (imdl m_move [H: P: (ti T0: T1:)] [D: P1: T4: T5:] : :) T0: T1: : :)
|[]
|[]
[stdin] 0 1 1 1 1) |[]
)");
  ASSERT_EQ(seed.models.size(), 2u);
  const Model& requirement = seed.models[1].model;
  EXPECT_EQ(requirement.id, ModelId{3}) << "composite states and models share one numbering";
  EXPECT_EQ(KindOf(requirement), ModelKind::kWeakRequirement);
  EXPECT_EQ(RequiredState(requirement), CompositeStateId{1});
  EXPECT_EQ(TargetModel(requirement), ModelId{2});

  const SeedKnowledge shifted = ShiftIds(seed, 10);
  EXPECT_EQ(RequiredState(shifted.models[1].model), CompositeStateId{11});
  EXPECT_EQ(TargetModel(shifted.models[1].model), ModelId{12});
  EXPECT_EQ(shifted.composite_states[0].state.id, CompositeStateId{11});
}

TEST(Reader, ADriveModelHasAnEntityOnItsRightSide) {
  const SeedKnowledge seed = Read(R"(run:(ent 1) |[]
drive:(mdl [] []
   ; the times are those of the drive
   (fact (mk.val h holding [c] 1) T0: T1: 1 1)
   (fact run T0: T1: ::)
|[]
|[]
[stdin drives] 1 1 1 0 1) [[SYNC_ONCE now 0 forever primary nil 1]]
)");
  ASSERT_EQ(seed.models.size(), 1u);
  EXPECT_EQ(KindOf(seed.models[0].model), ModelKind::kDrive);
  EXPECT_EQ(seed.models[0].model.rhs.payload, Term::Entity("run"));
}

TEST(Reader, TemplateArgumentsOfACompositeStateComeFirst) {
  const SeedKnowledge seed = Read(R"(
S:(cst [P:] []
   (fact (mk.val H: position P: :) T0: T1: : :)
|[] |[] [stdin] 1) |[]
(fact (icst S [5] [h] true 1) 0s:0ms:0us GIGASEC 1 1) |[]
)");
  EXPECT_EQ(seed.facts.at(0).fact.payload,
            MakeIcst(CompositeStateId{1}, {}, {Term::Number(5), Term::Entity("h")}));
}

TEST(Reader, GuardsMayUseTheOpcodeNamesOfDumps) {
  const SeedKnowledge seed = Read(R"(
m:(mdl [v0: (ti v1: v2:)] []
   (fact (cmd move [v3: v4:] :) v5: v6: : :)
   (fact (mk.val v3: position v7: :) v8: v9: : :)
[]
   v7:(add v0 (mul v4 2))
[]
   (neq v7 v0)
[stdin] 0 7 0.428571 0.5 1 ) []
   [0 0s:600ms:0us 0 forever secondary nil 0]
   [0 0s:600ms:0us 0 forever primary nil 1]
)");
  EXPECT_EQ(ToText(seed.models.at(0).model.forward.at(0)), "v7 := (+ v0 (* v4 2))");
  EXPECT_EQ(ToText(seed.models.at(0).model.backward.at(0)), "(<> v7 v0)");
  EXPECT_EQ(seed.models.at(0).evidence.total, 7);
}

TEST(Reader, DefinitionsNameValues) {
  const SeedKnowledge seed = Read(R"(
!def zero 0
!def home (vec2 zero 5)
(fact (mk.val h position home 1) 0s:0ms:0us GIGASEC 1 1) |[]
)");
  EXPECT_EQ(seed.facts.at(0).fact.payload[2], Term::Struct("vec2", {Term::Number(0), Term::Number(5)}));
}

TEST(Reader, AnotherAgentsTextIsReadForItsKnowledge) {
  // Given a dump with numbers before the labels, programs, predictions, and commands nobody declared
  const SeedKnowledge seed = Read(R"(
> DECOMPILATION. TimeReference 1s:2ms:3us

1(12) primary:(grp 2 0 0.4 [nil] 1) []
   [0 0s:0ms:0us 0 forever root nil false 0]
7(18) act:(pgm |[] [] [(add v0 (_now))] []
   (icmd _inj []
      v1:(cmd wave [h] 1)
      |[]
   )
1) |[]
8(20) fact_8:(fact (cmd wave [h] 1) 0s:20ms:0us 0s:100ms:0us 1 1) |[]
(8407) pred1:(pred fact_8 |[] 1) |[]
9(21) fact_9:(fact pred1 0s:20ms:0us 0s:100ms:0us 1 1) |[]
10(22) bad:(mk.val nobody position 1 1) |[]
> 5 objects
)",
                                  {Milliseconds(100), {}, true});
  EXPECT_EQ(seed.facts.size(), 1u);
  EXPECT_THAT(seed.passed_over, UnorderedElementsAre(Pair("grp", 1), Pair("pgm", 1), Pair("pred", 1),
                                                     Pair("fact about what was passed over", 1)));
  EXPECT_THAT(seed.problems,
              ElementsAre("test.replicode:22:20: expected a declared name, found 'nobody', which is not "
                          "declared above"));
}

TEST(Reader, APayloadOfItsOwn) {
  ReplicodeOptions options;
  options.known_symbols = Read("").symbols;
  const Result<Term> payload = ReadPayload("(mk.val h holding [c])", {"scenario.toml", 7, 9}, options);
  ASSERT_TRUE(payload.ok()) << payload.error().message;
  EXPECT_EQ(ToText(*payload), "(mk.val h holding [c])");
  EXPECT_EQ(ReadPayload("(mk.val h holdin [c])", {"scenario.toml", 7, 9}, options).error().message,
            "scenario.toml:7:19: expected a declared name, found 'holdin', which is not declared above; did "
            "you mean "
            "'holding'?");
  EXPECT_EQ(ReadPayload("(cmd move [h]) h", {"scenario.toml", 7, 9}, options).error().message,
            "scenario.toml:7:24: expected nothing after the expression, found 'h'");
}

TEST(ReaderErrors, SyntaxIsReportedWhereItIsWrong) {
  EXPECT_EQ(ErrorOf("h2:(ent 1"), "t:1:10: expected ')' to close (ent of line 1, found the end of the text");
  EXPECT_EQ(ErrorOf("h2:(ent 1]"), "t:1:10: expected ')' to close (ent of line 1, found ']'");
  EXPECT_EQ(ErrorOf("S:(cst [] [1 2) |[]"), "t:1:15: expected ']' to close the list of line 1, found ')'");
  EXPECT_EQ(
      ErrorOf("(fact (mk.val h position 5 1)\n   0s:0ms:0us 10x 1 1)"),
      "t:2:15: expected a number, a duration such as 100ms or a time such as 0s:100ms:0us, found '10x'");
  EXPECT_EQ(ErrorOf("  %"), "t:1:3: unexpected character '%'");
  EXPECT_EQ(ErrorOf("\x01"), "t:1:1: unexpected character '\\x01'");
  EXPECT_EQ(ErrorOf("5"), "t:1:1: expected an object such as name:(ent 1), found '5'");
  EXPECT_EQ(ErrorOf("x:[1]"), "t:1:1: expected an object in parentheses after the label 'x:'");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position \"abc 1)\n 0s:0ms:0us GIGASEC)"),
            "t:1:26: expected a closing '\"' on the same line as the text begins");
  EXPECT_EQ(
      ErrorOf("(fact (mk.val h position \"a\\q\" 1) 0s:0ms:0us GIGASEC)"),
      "t:1:28: expected \\\", \\\\, \\n, \\t or \\x and two hexadecimal digits after a backslash in a text");
  EXPECT_EQ(ErrorOf("x:(ent 1) |[1]"),
            "t:1:11: expected ']' after '|[', which is the empty list; a list with elements has no bar");
  EXPECT_EQ(ErrorOf("(5)"), "t:1:2: expected the name of a class or operator after '(', found '5'");
  EXPECT_EQ(ErrorOf("!def (f X) X"),
            "t:1:6: expected a name after !def (definitions with parameters are not read), found '('");
  EXPECT_EQ(ErrorOf("!lode x"), "t:1:1: expected !def, the only directive read here, found '!lode'");
}

TEST(ReaderErrors, UnknownWordsComeWithASuggestion) {
  EXPECT_EQ(ErrorOf("(fact (mk.val h posision 5 1) 0s:0ms:0us GIGASEC 1 1) |[]"),
            "t:1:17: expected a declared name, found 'posision', which is not declared above; did you mean "
            "'position'?");
  EXPECT_EQ(ErrorOf("(fact (mk.vel h position 5 1) 0s:0ms:0us GIGASEC 1 1) |[]"),
            "t:1:7: expected (mk.val ...), (cmd ...), (icst ...) or (imdl ...), found (mk.vel ...); did you "
            "mean 'mk.val'?");
  EXPECT_EQ(ErrorOf("p:(pgm [] [])"),
            "t:1:1: expected one of ent, ont, fact, |fact, mk.val, cst, mdl, found (pgm ...); programs, "
            "commands and drives "
            "belong into the scenario file");
  EXPECT_EQ(ErrorOf("p:(mdel [] [])"),
            "t:1:1: expected one of ent, ont, fact, |fact, mk.val, cst, mdl, found (mdel ...); programs, "
            "commands and drives "
            "belong into the scenario file; did you mean 'mdl'?");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position (vec4 1 2 3 4) 1) 0s:0ms:0us GIGASEC 1 1)"),
            "t:1:26: expected a value, found (vec4 ...); structured values are vec2, vec3, ti; did you mean "
            "'vec2'?");
  EXPECT_EQ(ErrorOf("m:(mdl [] []\n   (fact (icst S9 [] [] : :) T0: T1: : :)\n   (fact run T0: T1: ::)\n)"),
            "t:2:16: expected the label of a composite state declared above, found 'S9'");
}

TEST(ReaderErrors, FieldsOfTheWrongKind) {
  EXPECT_EQ(ErrorOf("(fact (mk.val h) 0s:0ms:0us GIGASEC 1 1)"),
            "t:1:7: expected the attribute in (mk.val ...), found only 1 field");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position 5 1 1) 0s:0ms:0us GIGASEC 1 1)"),
            "t:1:30: expected the end of (mk.val ...), found the number 1");
  EXPECT_EQ(ErrorOf("(fact (mk.val position position 5 1) 0s:0ms:0us GIGASEC 1 1)"),
            "t:1:15: expected an entity as the object, found 'position'");
  EXPECT_EQ(ErrorOf("(fact (mk.val h c 5 1) 0s:0ms:0us GIGASEC 1 1)"),
            "t:1:17: expected an ontology symbol as the attribute, found 'c'");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position X: 1) 0s:0ms:0us GIGASEC 1 1)"),
            "t:1:26: expected a value, found the variable 'X:', which has none here");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position 5 1) 5 GIGASEC 1 1)"),
            "t:1:31: expected a time such as 0s:100ms:0us, found the number 5");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position 5 1) 2s:0ms:0us 1s:0ms:0us 1 1)"),
            "t:1:42: expected an end after the start 2s, found 1s");
  EXPECT_EQ(ErrorOf("(fact (mk.val h position 5 1) 0s:0ms:0us GIGASEC 2 1)"),
            "t:1:50: expected a confidence from 0 to 1, found 2");
  EXPECT_EQ(ErrorOf("h:(ent 1)\nh:(ont 1)"),
            "t:1:1: expected a new label, found 'h', which is declared already");
  EXPECT_EQ(ErrorOf("k:(ent 1)\nk:(ont 1)"),
            "t:2:1: expected a new label, found 'k', which is declared already in line 1");
  EXPECT_EQ(ErrorOf("nil:(ent 1)"), "t:1:1: expected a label, found 'nil', which is a word of the language");
  EXPECT_EQ(ErrorOf("(ent 1)"), "t:1:1: expected a label in front, such as h:(ent 1), found none");
}

TEST(ReaderErrors, CompositeStatesAndModels) {
  EXPECT_EQ(
      ErrorOf("S:(cst [] []\n   (fact (cmd move [H:] :) T0: T1: : :)\n|[])"),
      "t:2:4: expected (mk.val ...) or (icst ...) as a condition of a composite state, found (cmd ...)");
  EXPECT_EQ(ErrorOf("S:(cst [] []\n   (fact (mk.val H: essence hand :) T0: T1: : :)\n"
                    "   (fact (mk.val H: position P: :) T2: T3: : :)\n|[])"),
            "t:3:4: expected the interval of the first condition (T0: T1:), which all conditions of a "
            "composite state share");
  EXPECT_EQ(ErrorOf("S:(cst [] |[])"), "t:1:11: expected 1 to 64 conditions in a composite state, found 0");
  EXPECT_EQ(ErrorOf("m:(mdl [] []\n   (fact (mk.val H: essence hand :) T0: T1: : :)\n|[])"),
            "t:1:11: expected two facts, the left and the right side of the model, found 1");
  EXPECT_EQ(ErrorOf("m:(mdl [:] []\n   (fact (mk.val H: essence hand :) T0: T1: : :)\n|[])"),
            "t:1:9: expected a variable, (ti T0: T1:) or another value as a template argument, found ':'");
  EXPECT_EQ(ErrorOf(std::string(kHandAt) + "(fact (icst S0 [] [h] : :) 0s:0ms:0us GIGASEC 1 1)"),
            "t:8:19: expected 2 arguments for S0 (H P), found 1");
  EXPECT_EQ(ErrorOf(std::string(kMove) + "(fact (imdl m_move [] [h] : :) 0s:0ms:0us GIGASEC 1 1)"),
            "t:14:20: expected 3 template arguments for m_move, found 0");
  const std::string guarded =
      "m:(mdl [] []\n   (fact (cmd move [H: D:] :) T0: T1: : :)\n"
      "   (fact (mk.val H: position P: :) T2: T3: : :)\n[]\n   ";
  EXPECT_EQ(ErrorOf(guarded + "(+ P D)\n|[])"),
            "t:5:4: expected an assignment such as P1:(+ P0 D) or a test such as (<> P1 P0), found (+ ...)");
  EXPECT_EQ(ErrorOf(guarded + "P:(max P D)\n|[])"), "t:5:4: expected +, -, *, / or a value, found (max ...)");
  EXPECT_EQ(ErrorOf(guarded + "P:(+ P DD)\n|[])"),
            "t:5:11: expected a declared name, found 'DD', which is not declared above; did you mean 'D'?");
  EXPECT_EQ(ErrorOf(guarded + "P:(+ P)\n|[])"), "t:5:4: expected two operands of +, found 1");
}

TEST(ReaderErrors, NothingIsReadBeforeItIsDeclared) {
  EXPECT_EQ(
      ErrorOf("m:(mdl [] []\n   (fact (icst S0 [] [H: P:] : :) T0: T1: : :)\n   (fact run T0: T1: ::)\n)\n" +
              std::string(kHandAt)),
      "t:2:16: expected the label of a composite state declared above, found 'S0'");
}

TEST(Reader, ThePickAndPlaceSeed) {
  std::ifstream file(std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios/pick_and_place.replicode");
  std::stringstream text;
  text << file.rdbuf();
  const Result<SeedKnowledge> seed = ReadReplicode(text.str(), "pick_and_place.replicode");
  ASSERT_TRUE(seed.ok()) << seed.error().message;
  EXPECT_EQ(seed->facts.size(), 11u);
  EXPECT_EQ(seed->composite_states.size(), 3u);
  EXPECT_THAT(seed->problems, IsEmpty());
  for (const SeedModel& model : seed->models)
    EXPECT_EQ(KindOf(model.model), ModelKind::kDrive) << model.label;
  EXPECT_NE(FindModel(*seed, "drive_hold_cyl"), nullptr);
}

}  // namespace
}  // namespace aerascope
