// Terms and their exact text.
#include "engine/kb/term.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <limits>
#include <thread>
#include <vector>

#include "engine/kb/term_codec.h"
#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

// Own: equal terms are one, whoever makes, copies and drops them; meant for the thread sanitizer too.
TEST(Term, AreMadeCopiedAndDroppedInAnyThread) {
  const std::size_t before = Term::CountNodes();
  std::atomic<bool> same = true;
  {
    const Term shared = MakeValue(E("h"), O("position"), Term::Struct("vec2", {N(1), N(2)}));
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&shared, &same, t] {
        std::vector<Term> kept;
        for (int i = 0; i < 3000; ++i) {
          // All threads make the same few terms at about the same time, and let go of them again.
          const Term mine = MakeValue(E("h"), O("position"), Term::Struct("vec2", {N(1), N(i % 7)}));
          if ((mine == shared) != (i % 7 == 2)) same = false;
          kept.push_back(i % 3 == 0 ? shared : mine);
          if (i % 50 == t) kept.clear();
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_TRUE(same);
  EXPECT_EQ(Term::CountNodes(), before) << "terms are left over";
}

// Own: the terms of a space are its own; what has no content to share is the same everywhere.
TEST(TermSpace, KeepsItsTermsApartFromThoseOutside) {
  const Term outside = MakeValue(E("h"), O("position"), N(1));
  const std::size_t before = Term::CountNodes();
  TermSpace space;
  {
    Term inside;
    {
      const TermSpace::Scope in_space(space);
      inside = MakeValue(E("h"), O("position"), N(1));
      EXPECT_EQ(inside, MakeValue(E("h"), O("position"), N(1))) << "one node in the space";
      EXPECT_EQ(Term::Variable(3), V(3));
      EXPECT_EQ(Term::Nil(), Term());
    }
    EXPECT_NE(inside, outside);
    EXPECT_EQ(inside.hash(), outside.hash());
    EXPECT_EQ(Encode(inside), Encode(outside));
    EXPECT_EQ(Term::CountNodes(), before);
    EXPECT_EQ(space.CountNodes(), 4u) << "the struct and its three parts";
    EXPECT_EQ(MakeValue(E("h"), O("position"), N(1)), outside) << "the thread has left the space";
  }
  EXPECT_EQ(space.CountNodes(), 0u);
}

TEST(Term, IsEqualByContent) {
  EXPECT_EQ(Struct("vec2", {N(0.1), N(0.2)}), Struct("vec2", {N(0.1), N(0.2)}));
  EXPECT_NE(Struct("vec2", {N(0.1), N(0.2)}), Struct("vec3", {N(0.1), N(0.2)}));
  EXPECT_EQ(N(0.1 + 0.2), N(0.3));
}

TEST(Term, KindsOfTheSameTextDiffer) {
  const std::vector<Term> terms{E("h"),
                                O("h"),
                                Term::String("h"),
                                Struct("h", {}),
                                N(1),
                                T(1),
                                D(1),
                                Term::Bool(true),
                                V(1),
                                Term::Reference(CompositeStateId{1}),
                                Term::Reference(ModelId{1}),
                                W(),
                                Set({}),
                                Term::Nil()};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    for (std::size_t j = 0; j < terms.size(); ++j) {
      EXPECT_EQ(terms[i] == terms[j], i == j) << Encode(terms[i]) << " " << Encode(terms[j]);
      EXPECT_EQ(terms[i] < terms[j] || terms[j] < terms[i], i != j);
    }
  }
}

TEST(Term, GroundMeansNeitherVariableNorWildcardInside) {
  EXPECT_TRUE(Struct("vec2", {N(1), Set({E("h")})}).ground());
  EXPECT_FALSE(Struct("vec2", {N(1), Set({V(0)})}).ground());
  EXPECT_FALSE(Set({W()}).ground());
}

TEST(Term, OrderIsTotal) {
  EXPECT_TRUE(rc::check("exactly one of a < b, a = b, a > b; and transitive", [](std::uint64_t seed) {
    AnyEvents any(seed);
    std::vector<Term> terms;
    for (int i = 0; i < 12; ++i) terms.push_back(any.AnyTerm(2));
    for (const Term& a : terms) {
      for (const Term& b : terms) {
        RC_ASSERT((a < b) + (b < a) + (a == b) == 1);
        for (const Term& c : terms) RC_ASSERT(!(a < b && b < c) || a < c);
      }
    }
  }));
}

TEST(Term, TextForPeople) {
  const Term term = Struct("mk.val", {E("h"), O("position"), Struct("vec2", {N(0.1), V(3)})});
  EXPECT_EQ(ToText(term), "(mk.val h position (vec2 0.1 v3))");
  const std::vector<std::string> names{"", "", "", "P"};
  EXPECT_EQ(ToText(term, names), "(mk.val h position (vec2 0.1 P))");
  EXPECT_EQ(ToText(E("a\x1b[31m")), "a\\x1b[31m");
}

TEST(TermCodec, WritesCompactExactText) {
  EXPECT_EQ(Encode(MakeValue(E("h"), O("position"), Struct("vec2", {N(0.1), N(-2)}))),
            "(mk.val @h position (vec2 0.1 -2))");
  EXPECT_EQ(Encode(MakeImdl({14}, {V(0)}, {T(100), D(-20), Term::String("a\"b"), Term::Bool(true), W()})),
            "(imdl ~m14 [$0] [t100000 d-20000 \"a\\x22b\" #t :])");
  EXPECT_EQ(Encode(O("two words")), "|two words|");
}

TEST(TermCodec, AnyTermIsReadBack) {
  EXPECT_TRUE(rc::check("DecodeTerm(Encode(t)) == t", [](std::uint64_t seed) {
    const Term term = AnyEvents(seed).AnyTerm(5);
    const Result<Term> read = DecodeTerm(Encode(term));
    RC_ASSERT(read.ok());
    RC_ASSERT(*read == term);
  }));
}

TEST(TermCodec, AnyNameIsReadBack) {
  EXPECT_TRUE(rc::check("names of any bytes", [](const std::string& name) {
    for (const Term& term :
         {Term::Entity(name), Term::Ontology(name), Term::String(name), Term::Struct(name, {N(1)})}) {
      const Result<Term> read = DecodeTerm(Encode(term));
      RC_ASSERT(read.ok());
      RC_ASSERT(*read == term);
    }
  }));
}

// Names like Infinity were read back as numbers.
TEST(TermCodec, NamesThatLookLikeNumbersStayNames) {
  for (const char* name :
       {"Infinity", "infinity", "INF", "inf", "NaN", "nan", "t5", "d-7", "nil", "1e5", "-1", ""}) {
    const Result<Term> read = DecodeTerm(Encode(Term::Ontology(name)));
    ASSERT_TRUE(read.ok()) << name;
    EXPECT_EQ(*read, Term::Ontology(name)) << name;
  }
}

TEST(TermCodec, SpecialNumbersAreReadBack) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {infinity, -infinity, std::nan(""), -0.0, 5e-324, 1.7976931348623157e308, 1e15}) {
    EXPECT_EQ(*DecodeTerm(Encode(N(value))), N(value)) << value;
  }
}

TEST(TermCodec, DamagedTextIsRefusedWithItsPlace) {
  for (const char* text : {"",
                           "(",
                           "[",
                           "(a",
                           "[a",
                           "[a  b]",
                           "(a]",
                           "$",
                           "$-1",
                           "$99999999999",
                           "~",
                           "~c",
                           "~c0",
                           "~m-3",
                           "@",
                           "\"abc",
                           "|abc",
                           "\"\\y41\"",
                           "\"\\x4\"",
                           "a b",
                           "1x",
                           "--",
                           "#",
                           "#x",
                           ")",
                           "\xff",
                           "t9223372036854775807",
                           "[nil nil"}) {
    const Result<Term> read = DecodeTerm(text);
    ASSERT_FALSE(read.ok()) << text << " was read as " << Encode(*read);
    EXPECT_THAT(read.error().message, testing::HasSubstr("damaged at byte"));
  }
}

TEST(TermCodec, NestingIsBounded) {
  const std::string deep = std::string(kMaxTermDepth - 1, '[') + "nil" + std::string(kMaxTermDepth - 1, ']');
  EXPECT_TRUE(DecodeTerm(deep).ok());
  EXPECT_FALSE(DecodeTerm("[" + deep + "]").ok());
  EXPECT_FALSE(DecodeTerm(std::string(1'000'000, '[')).ok());
}

TEST(TermCodec, AnyBytesAreReadOrRefused) {
  EXPECT_TRUE(rc::check(
      "what is read is written back the same way or another, never crashing", [](std::uint64_t seed) {
        AnyEvents any(seed);
        std::string text = Encode(any.AnyTerm(4));
        for (int i = 0; i < 3 && !text.empty(); ++i) {
          text[static_cast<std::size_t>(any.Below(static_cast<std::int64_t>(text.size())))] =
              static_cast<char>(any.Below(256));
        }
        const Result<Term> read = DecodeTerm(text);
        if (read.ok()) RC_ASSERT(*DecodeTerm(Encode(*read)) == *read);
      }));
}

}  // namespace
}  // namespace aerascope
