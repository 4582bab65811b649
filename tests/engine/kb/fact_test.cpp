// Facts as evidence for or against others; patterns matched and instantiated.
#include "engine/kb/fact.h"

#include <gtest/gtest.h>

#include "tests/engine/kb/build_terms.h"

namespace aerascope {
namespace {

Term Holding(std::vector<Term> objects) {
  return MakeValue(E("h"), O("holding"), Set(std::move(objects)));
}

TEST(Oracle10_1, OtherValueThroughoutTheIntervalSpeaksAgainst) {
  // OpenAERA (semantics 10.1): empty hand and held s, both [900,1000): negative.
  EXPECT_EQ(EvidenceFor(Holds(Holding({}), Ms(900, 1000)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kNegative);
}

TEST(Oracle10_1, OtherValueInPartOfTheIntervalSaysNothing) {
  // OpenAERA (semantics 10.1): the same over [920,1000) only does not include the target: no evidence.
  EXPECT_EQ(EvidenceFor(Holds(Holding({}), Ms(920, 1000)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kNone);
}

TEST(Oracle10_1, AntiFactThatOverlapsSpeaksAgainst) {
  // OpenAERA (semantics 10.1): an anti-fact over [950,1100) overlaps, which is enough: negative.
  EXPECT_EQ(EvidenceFor(HoldsNot(Holding({E("s")}), Ms(950, 1100)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kNegative);
}

TEST(Oracle10_1, OtherValueSpeaksForAnAntiFact) {
  // OpenAERA (semantics 10.1): an empty hand over [900,1000) for "s is not held" then: positive.
  EXPECT_EQ(EvidenceFor(Holds(Holding({}), Ms(900, 1000)), HoldsNot(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kPositive);
}

// Semantics 1.6.
TEST(Evidence, SameContentThatOverlapsSpeaksFor) {
  EXPECT_EQ(EvidenceFor(Holds(Holding({E("s")}), Ms(950, 1100)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kPositive);
  EXPECT_EQ(
      EvidenceFor(HoldsNot(Holding({E("s")}), Ms(950, 1100)), HoldsNot(Holding({E("s")}), Ms(900, 1000))),
      EvidenceVerdict::kPositive);
}

TEST(Evidence, SameContentWithoutOverlapSaysNothing) {
  EXPECT_EQ(EvidenceFor(Holds(Holding({E("s")}), Ms(1000, 1100)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kNone);
  EXPECT_EQ(EvidenceFor(HoldsNot(Holding({E("s")}), Ms(1000, 1100)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kNone);
}

TEST(Evidence, WildcardInTheTargetIsMetByAnyValue) {
  const Fact target = Holds(MakeValue(E("h"), O("holding"), W()), Ms(900, 1000));
  EXPECT_EQ(EvidenceFor(Holds(Holding({}), Ms(900, 1000)), target), EvidenceVerdict::kPositive);
}

TEST(Evidence, OtherObjectOrAttributeSaysNothing) {
  const Fact target = Holds(MakeValue(E("c1"), O("position"), N(5)), Ms(900, 1000));
  EXPECT_EQ(EvidenceFor(Holds(MakeValue(E("c2"), O("position"), N(6)), Ms(900, 1000)), target),
            EvidenceVerdict::kNone);
  EXPECT_EQ(EvidenceFor(Holds(MakeValue(E("c1"), O("size"), N(6)), Ms(900, 1000)), target),
            EvidenceVerdict::kNone);
}

TEST(Evidence, AntiFactOfAnotherValueSaysNothing) {
  EXPECT_EQ(EvidenceFor(HoldsNot(Holding({}), Ms(900, 1000)), Holds(Holding({E("s")}), Ms(900, 1000))),
            EvidenceVerdict::kNone);
}

TEST(Evidence, NilContradictsAnObject) {
  const Fact nothing = Holds(MakeValue(E("h"), O("holding"), Term::Nil()), Ms(900, 1000));
  const Fact target = Holds(MakeValue(E("h"), O("holding"), E("s")), Ms(900, 1000));
  EXPECT_EQ(EvidenceFor(nothing, target), EvidenceVerdict::kNegative);
}

TEST(Evidence, InstancesOfModelsDoNotContradictEachOther) {
  const Fact one = Holds(MakeImdl({3}, {}, {N(1)}), Ms(900, 1000));
  const Fact other = Holds(MakeImdl({3}, {}, {N(2)}), Ms(900, 1000));
  EXPECT_EQ(EvidenceFor(one, other), EvidenceVerdict::kNone);
}

TEST(Evidence, NumbersWithinToleranceAreTheSameValue) {
  const Fact seen = Holds(MakeValue(E("h"), O("position"), N(0.100009)), Ms(900, 1000));
  const Fact target = Holds(MakeValue(E("h"), O("position"), N(0.1)), Ms(900, 1000));
  EXPECT_EQ(EvidenceFor(seen, target), EvidenceVerdict::kPositive);
}

TEST(FactPattern, BindsPayloadAndInterval) {
  const FactPattern pattern = Component(V(2), "position", V(3));
  Bindings bindings;
  EXPECT_TRUE(MatchFact(pattern, Holds(MakeValue(E("h"), O("position"), N(5)), Ms(200, 300)), bindings));
  EXPECT_EQ(*bindings.Find(0), T(200));
  EXPECT_EQ(*bindings.Find(1), T(300));
  EXPECT_EQ(*bindings.Find(2), E("h"));
  EXPECT_EQ(*bindings.Find(3), N(5));
}

TEST(FactPattern, WantsTheSamePolarityAndASynchronousInterval) {
  const FactPattern pattern = Component(V(2), "position", V(3));
  const Term payload = MakeValue(E("h"), O("position"), N(5));
  Bindings bindings;
  EXPECT_FALSE(MatchFact(pattern, HoldsNot(payload, Ms(200, 300)), bindings));
  bindings.Set(0, T(200));
  bindings.Set(1, T(300));
  EXPECT_TRUE(MatchFact(pattern, Holds(payload, Ms(205, 300)), bindings));
  EXPECT_FALSE(MatchFact(pattern, Holds(payload, Ms(220, 300)), bindings));
}

TEST(FactPattern, IsInstantiatedOnlyWhenGround) {
  const FactPattern pattern = Component(V(2), "position", V(3));
  Bindings bindings;
  bindings.Set(0, T(200));
  bindings.Set(1, T(300));
  bindings.Set(2, E("h"));
  EXPECT_EQ(Instantiate(pattern, bindings, 0.5), std::nullopt);
  bindings.Set(3, N(5));
  const auto fact = Instantiate(pattern, bindings, 0.5);
  ASSERT_TRUE(fact.has_value());
  EXPECT_EQ(*fact, (Fact{true, MakeValue(E("h"), O("position"), N(5)), Ms(200, 300), 0.5}));
}

TEST(FactTerm, IsReadBack) {
  const Fact fact{false, Holding({E("s")}), Ms(-5, 1000), 0.875};
  EXPECT_EQ(FactFromTerm(ToTerm(fact)), fact);
  const FactPattern pattern{false, Holding({V(2)}), V(0), T(5)};
  EXPECT_EQ(FactPatternFromTerm(ToTerm(pattern)), pattern);
  EXPECT_EQ(FactFromTerm(N(1)), std::nullopt);
  EXPECT_EQ(FactFromTerm(Struct("fact", {N(1), N(2), N(3), N(4)})), std::nullopt);
  EXPECT_EQ(FactPatternFromTerm(Struct("other", {N(1), N(2), N(3)})), std::nullopt);
}

}  // namespace
}  // namespace aerascope
