// Any bytes: the reader answers, never crashes, and does not take long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "engine/replicode/reader.h"
#include "engine/replicode/syntax.h"
#include "engine/replicode/writer.h"
#include "tests/support/slowness.h"

namespace aerascope {
namespace {

std::string Repeated(std::string_view text, std::size_t count) {
  std::string repeated;
  repeated.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) repeated += text;
  return repeated;
}

std::string ErrorOf(std::string_view text) {
  const Result<SeedKnowledge> seed = ReadReplicode(text, "t");
  return seed ? "" : seed.error().message;
}

TEST(HostileInput, NestingEndsAtALimit) {
  EXPECT_EQ(ErrorOf(Repeated("(a ", 1'000'000)), "t:1:97: expected at most 32 expressions inside each other");
  EXPECT_EQ(ErrorOf("x:(a " + Repeated("[", 1'000'000)),
            "t:1:37: expected at most 32 expressions inside each other");
  // Lists by indentation nest too.
  std::string indented = "x:(a []\n";
  for (int i = 1; i < 2000; ++i) indented += std::string(static_cast<std::size_t>(i), ' ') + "(b []\n";
  EXPECT_NE(ErrorOf(indented).find("expected at most 32 expressions inside each other"), std::string::npos);
}

TEST(HostileInput, NestingThatIsAllowedFitsIntoTerms) {
  const std::string text = "h:(ent 1) position:(ont 1) (fact (mk.val h position " + Repeated("[", 28) +
                           Repeated("]", 28) + " 1) 0s:0ms:0us GIGASEC 1 1)";
  EXPECT_EQ(ErrorOf(text), "");
}

TEST(HostileInput, DefinitionsDoNotMultiplyTheText) {
  std::string text = "!def a [1 1 1 1 1 1 1 1 1]\n";
  for (char c = 'b'; c < 'z'; ++c) {
    const char before = static_cast<char>(c - 1);
    text += std::string("!def ") + c + " [" + Repeated(std::string(1, before) + " ", 8) + "]\n";
  }
  EXPECT_EQ(ErrorOf(text), "t:2:8: expected at most 64 words in the value of a !def");
}

TEST(HostileInput, TooLargeATextIsRefusedBeforeReading) {
  EXPECT_EQ(ErrorOf(std::string(kMaxReplicodeBytes + 1, ' ')),
            "t: expected at most 16 MiB of Replicode, found 16 MiB");
}

TEST(HostileInput, ManyConditionsAreRefused) {
  const std::string text = "p:(ont 1)\nS:(cst [] []\n" +
                           Repeated("   (fact (mk.val A: p B: :) T0: T1: : :)\n", 20'000) + "|[] |[])";
  EXPECT_EQ(ErrorOf(text), "t:2:11: expected 1 to 64 conditions in a composite state, found 20000");
}

// The fuzzer found that a symbol with a bar in front of its name was read, but could not be written.
TEST(HostileInput, ALabelWithABarInFrontIsRefused) {
  EXPECT_THAT(ErrorOf("h:(ent 1)\n|release:(ont 1)\n"),
              testing::StartsWith("t:2:1: expected a label without a bar in front"));
}

TEST(HostileInput, NumbersOutOfRange) {
  for (const char* number :
       {"1e999", "99999999999999999999s", "9223372036854775806us", "1s:1ms", "1s:1ms:1us:1us", "0x10", "--5",
        "1s:99999999999999999ms:0us", "-", "1e", "5.5.5"}) {
    EXPECT_NE(ErrorOf("h:(ent 1) p:(ont 1) (fact (mk.val h p " + std::string(number) +
                      " 1) 0s:0ms:0us GIGASEC 1 1)"),
              "")
        << number;
  }
}

TEST(HostileInput, EveryShortPrefixOfASeedIsAnswered) {
  std::ifstream file(std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios/pick_and_place.replicode");
  std::stringstream buffer;
  buffer << file.rdbuf();
  const std::string seed = buffer.str();
  ASSERT_GT(seed.size(), 1000u);
  for (std::size_t length = 0; length < seed.size(); length += 3) {
    (void)ReadReplicode(std::string_view(seed).substr(0, length), "t");
  }
}

// The fuzzer begins from these; they are worth keeping only while they get far.
TEST(HostileInput, TheKeptCorpusOfTheFuzzerIsUnderstood) {
  int accepted = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(AERASCOPE_SOURCE_DIR) +
                                                               "/tests/fuzz/corpus/replicode")) {
    std::ifstream file(entry.path(), std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_EQ(ErrorOf(text.str()), "") << entry.path();
    ++accepted;
  }
  EXPECT_GT(accepted, 3);
}

TEST(HostileInput, RandomlyDamagedSeedsAreAnsweredAndWhatIsReadCanBeWritten) {
  constexpr std::string_view kSeed = R"(h:(ent 1) |[]
position:(ont 1) |[]
move:(ont 1) |[]
!def d 5
(fact (mk.val h position (vec2 d 1e-3) 1) 0s:0ms:0us GIGASEC 1 1) [[SYNC_AXIOM now 1 forever stdin nil]]
S:(cst [] []
   (fact (mk.val H: position P: :) T0: T1: : :) ; at P
   (|fact (mk.val H: position "a\x20b" :) T0: T1: : :)
|[]
|[]
[stdin] 1) |[]
M:(mdl [P0: (ti T0: T1:)] []
   (fact (cmd move [H: D:] :) T2: T3: : :)
   (fact (mk.val H: position P1: :) T4: T5: : :)
[]
   P1:(+ P0 D)
   T4:(+ T0 100ms)
[]
   (<> P1 P0)
   D:(- P1 P0)
[stdin] 1 4 0.75 1 1) |[]
R:(mdl [] []
   (fact (icst S [] [H: P:] : :) T0: T1: : :)
   (fact (imdl M [P: (ti T0: T1:)] [H: D: P1: T4: T5:] : :) T0: T1: : :)
|[]
|[]
[stdin] 0 1 1 1 1) |[]
)";
  ASSERT_EQ(ErrorOf(kSeed), "");
  const std::string_view pieces[] = {"(",          ")",  "[",       "]",     "|[]", "[]\n   ", ":",
                                     "::",         "\"", ";",       "\n",    " ",   "H:",      "x:(",
                                     "0s:1ms:2us", "-",  "9",       "(fact", "(ti", "!def ",   "\0",
                                     "\xff",       "S",  "GIGASEC", "true",  "(+ ", "|"};
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int read = 0;
  for (int round = 0; round < CasesToTry(6'000); ++round) {
    std::string text(kSeed);
    const std::size_t damages = 1 + below(4);
    for (std::size_t i = 0; i < damages; ++i) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text.erase(at, 1 + below(12));
          break;
        case 1:
          text.insert(at, pieces[below(std::size(pieces))]);
          break;
        case 2:
          text[at] = static_cast<char>(random());
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(40)));
          break;
      }
    }
    for (const bool foreign : {false, true}) {
      const Result<SeedKnowledge> seed = ReadReplicode(text, "t", {Milliseconds(100), {}, foreign});
      if (!seed) {
        EXPECT_EQ(seed.error().message.substr(0, 2), "t:") << seed.error().message;
        continue;
      }
      ++read;
      const Result<std::string> written = WriteReplicode(*seed);
      if (foreign) continue;
      ASSERT_TRUE(written.ok()) << written.error().message << "\n" << text;
      const Result<SeedKnowledge> back = ReadReplicode(*written, "back");
      ASSERT_TRUE(back.ok()) << back.error().message << "\n" << *written;
    }
  }
  EXPECT_GT(read, CasesToTry(100)) << "the damage is so heavy that nothing was tested";
}

}  // namespace
}  // namespace aerascope
