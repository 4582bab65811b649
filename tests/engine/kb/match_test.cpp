// Bindings, unification and guards.
#include "engine/kb/match.h"

#include <gtest/gtest.h>

#include "tests/engine/kb/build_terms.h"

namespace aerascope {
namespace {

TEST(SameValue, HasTolerancesForNumbersAndTimes) {
  EXPECT_TRUE(SameValue(N(0.1), N(0.100009)));
  EXPECT_FALSE(SameValue(N(0.1), N(0.10002)));
  EXPECT_TRUE(SameValue(Term::Instant({700'000}), Term::Instant({709'999})));
  EXPECT_FALSE(SameValue(T(700), T(710)));
  EXPECT_TRUE(SameValue(Struct("vec2", {N(1), N(2)}), Struct("vec2", {N(1.000001), N(2)})));
  EXPECT_FALSE(SameValue(Struct("vec2", {N(1), N(2)}), Struct("vec2", {N(1)})));
  EXPECT_FALSE(SameValue(N(700), T(700)));
}

TEST(Match, BindsAnUnboundVariableAndHoldsABoundOne) {
  Bindings bindings;
  EXPECT_TRUE(Match(Set({V(0), V(0)}), Set({N(5), N(5.000001)}), bindings));
  EXPECT_EQ(*bindings.Find(0), N(5));
  EXPECT_FALSE(Match(V(0), N(6), bindings));
  Bindings other;
  EXPECT_FALSE(Match(Set({V(0), V(0)}), Set({N(5), N(6)}), other));
}

TEST(Match, WildcardOrVariableInTheObjectMatchesAnythingAndBindsNothing) {
  Bindings bindings;
  EXPECT_TRUE(Match(Set({V(0), E("h")}), Set({W(), V(7)}), bindings));
  EXPECT_EQ(bindings.Find(0), nullptr);
}

TEST(Match, WildcardInThePatternMatchesAnythingAndBindsNothing) {
  Bindings bindings;
  EXPECT_TRUE(Match(W(), Set({N(1)}), bindings));
  EXPECT_EQ(bindings.size(), 0u);
}

TEST(Match, IsStructural) {
  Bindings bindings;
  EXPECT_FALSE(Match(Set({V(0)}), Set({N(1), N(2)}), bindings));
  EXPECT_FALSE(Match(Struct("vec2", {V(0)}), Struct("vec3", {N(1)}), bindings));
  EXPECT_FALSE(Match(E("h"), O("h"), bindings));
  EXPECT_FALSE(Match(N(1), T(1), bindings));
}

TEST(Substitute, ReplacesBoundVariablesOnly) {
  Bindings bindings;
  bindings.Set(1, N(5));
  EXPECT_EQ(Substitute(Set({V(0), V(1), Struct("vec2", {V(1), N(1)})}), bindings),
            Set({V(0), N(5), Struct("vec2", {N(5), N(1)})}));
}

TEST(Evaluate, ComputesWithNumbersVectorsAndTimes) {
  const Bindings none;
  EXPECT_EQ(Evaluate(Struct("+", {N(1), N(2)}), none), N(3));
  EXPECT_EQ(Evaluate(Struct("-", {T(900), D(80)}), none), T(820));
  EXPECT_EQ(Evaluate(Struct("-", {T(900), T(800)}), none), D(100));
  EXPECT_EQ(Evaluate(Struct("+", {Struct("vec2", {N(1), N(2)}), Struct("vec2", {N(3), N(4)})}), none),
            Struct("vec2", {N(4), N(6)}));
  EXPECT_EQ(Evaluate(Struct("*", {Struct("vec2", {N(1), N(2)}), N(3)}), none), Struct("vec2", {N(3), N(6)}));
  EXPECT_EQ(Evaluate(Struct("-", {Struct("*", {N(2), N(3)}), N(1)}), none), N(5));
}

TEST(Evaluate, GivesNothingWhereItCannotCompute) {
  const Bindings none;
  EXPECT_EQ(Evaluate(Struct("/", {N(1), N(0)}), none), std::nullopt);
  EXPECT_EQ(Evaluate(Struct("+", {N(1), V(0)}), none), std::nullopt);
  EXPECT_EQ(Evaluate(Struct("+", {N(1), T(1)}), none), std::nullopt);
  EXPECT_EQ(Evaluate(Struct("+", {T(1), T(1)}), none), std::nullopt);
  EXPECT_EQ(Evaluate(Struct("*", {N(1e300), N(1e300)}), none), std::nullopt);
  EXPECT_EQ(Evaluate(Struct("+", {Struct("vec2", {N(1), N(2)}), N(3)}), none), std::nullopt);
}

// Sums of times could overflow, which is undefined.
TEST(Evaluate, TimesBeyondAllClocksHaveNoValue) {
  const auto sum = [](const Term& a, const Term& b) {
    return Evaluate(Term::Struct("+", {a, b}), Bindings());
  };
  const Term forever = Term::Instant(kForever);
  const Term eternity = Term::Span({kForever.us});
  EXPECT_EQ(sum(forever, Term::Span(Milliseconds(100))), Term::Instant(kForever + Milliseconds(100)));
  const auto twice = sum(forever, eternity);
  ASSERT_TRUE(twice.has_value());
  EXPECT_FALSE(sum(*twice, eternity).has_value());
  EXPECT_FALSE(sum(*sum(eternity, eternity), eternity).has_value());
  const Term past = Term::Instant({-kForever.us});
  EXPECT_EQ(Evaluate(Term::Struct("-", {forever, past}), Bindings()), Term::Span({2 * kForever.us}));
  EXPECT_FALSE(Evaluate(Term::Struct("*", {forever, eternity}), Bindings()).has_value());
}

TEST(Guards, RunInOrderAndOverwriteAPassedValue) {
  Bindings bindings;
  bindings.Set(0, N(20));
  bindings.Set(1, N(-5));
  bindings.Set(2, N(99));
  EXPECT_TRUE(RunGuards({{2, Struct("+", {V(0), V(1)})}, {3, Struct("*", {V(2), N(2)})}}, bindings));
  EXPECT_EQ(*bindings.Find(2), N(15));
  EXPECT_EQ(*bindings.Find(3), N(30));
}

TEST(Guards, AssignmentThatCannotBeEvaluatedNeedsABoundTarget) {
  Bindings bindings;
  EXPECT_FALSE(RunGuards({{2, Struct("+", {V(0), N(1)})}}, bindings));
  EXPECT_TRUE(RunGuards({{2, Struct("+", {V(0), N(1)})}}, bindings, OnUnbound::kDefer));
  bindings.Set(2, N(7));
  EXPECT_TRUE(RunGuards({{2, Struct("+", {V(0), N(1)})}}, bindings));
  EXPECT_EQ(*bindings.Find(2), N(7));
}

TEST(Guards, TestsDecide) {
  Bindings bindings;
  bindings.Set(0, N(5));
  const auto holds = [&](const char* op, Term other) {
    return RunGuards({{std::nullopt, Struct(op, {V(0), std::move(other)})}}, bindings);
  };
  EXPECT_TRUE(holds("=", N(5)));
  EXPECT_FALSE(holds("<>", N(5.000001)));
  EXPECT_TRUE(holds("<>", N(6)));
  EXPECT_TRUE(holds("<", N(6)));
  EXPECT_TRUE(holds("<=", N(5)));
  EXPECT_FALSE(holds(">", N(5)));
  EXPECT_FALSE(holds("<", E("h")));  // cannot be compared
  EXPECT_FALSE(holds("~", N(5)));    // no such test
}

// The move model of the semantics, forwards and backwards (section 2).
TEST(Guards, MoveModelComputesBothWays) {
  enum { kP0, kT0, kT1, kH, kDelta, kTc0, kTc1, kP1, kT2, kT3 };
  Bindings forward;
  forward.Set(kP0, N(20));
  forward.Set(kT0, T(100));
  forward.Set(kT1, T(200));
  forward.Set(kDelta, N(-5));
  EXPECT_TRUE(RunGuards({{kT2, Struct("+", {V(kT0), D(100)})},
                         {kT3, Struct("+", {V(kT1), D(100)})},
                         {kP1, Struct("+", {V(kP0), V(kDelta)})}},
                        forward));
  EXPECT_EQ(*forward.Find(kP1), N(15));
  EXPECT_EQ(*forward.Find(kT2), T(200));
  Bindings backward;
  backward.Set(kP0, N(10));
  backward.Set(kP1, N(15));
  backward.Set(kT2, T(800));
  backward.Set(kT3, T(900));
  EXPECT_TRUE(RunGuards({{kTc0, Struct("-", {V(kT2), D(80)})},
                         {kTc1, Struct("-", {V(kT3), D(100)})},
                         {kDelta, Struct("-", {V(kP1), V(kP0)})}},
                        backward));
  EXPECT_EQ(*backward.Find(kDelta), N(5));
  EXPECT_EQ(*backward.Find(kTc0), T(720));
}

}  // namespace
}  // namespace aerascope
