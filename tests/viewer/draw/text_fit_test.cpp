#include "viewer/draw/text_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "engine/base/text.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;

TEST(TextFit, WhatFitsIsLeftAsItIs) {
  EXPECT_EQ(FitText("cube", 100, 12), "cube");
  EXPECT_EQ(FitText("", 0, 12), "");
}

TEST(TextFit, WhatDoesNotFitEndsInAnEllipsisAndFits) {
  const std::string fit = FitText("a rather long name of a thing", 80, 12);

  EXPECT_TRUE(fit.ends_with("…"));
  EXPECT_LE(TextWidth(fit, 12), 80);
  EXPECT_GT(TextWidth(fit, 12), 60) << "as much as fits, not less";
}

TEST(TextFit, NoRoomGivesNothing) {
  EXPECT_EQ(FitText("name", 3, 12), "");
}

TEST(TextFit, CharactersOfSeveralBytesAreNotCutInside) {
  std::mt19937 random(3);
  const std::vector<std::string> characters = {"a", "é", "я", "中", "😀", "…", "\xe2\x80\xae", "\xff"};
  for (int round = 0; round < 500; ++round) {
    std::string text;
    for (unsigned i = 0; i < random() % 20; ++i) text += characters[random() % characters.size()];
    const int width = static_cast<int>(random() % 150);

    const std::string fit = FitText(text, width, 12);

    EXPECT_LE(TextWidth(fit, 12), width);
    for (std::size_t i = 0; i < fit.size();) {
      const auto lead = static_cast<unsigned char>(fit[i]);
      const std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
      ASSERT_LE(i + length, fit.size());
      for (std::size_t k = 1; k < length; ++k) ASSERT_EQ(static_cast<unsigned char>(fit[i + k]) & 0xC0, 0x80);
      i += length;
    }
  }
}

TEST(TextFit, LinesBreakBetweenWords) {
  EXPECT_THAT(WrapText("one two three", 50, 12, 3), ElementsAre("one two", "three"));
}

TEST(TextFit, ALongWordIsBrokenAndTheLastLineCut) {
  const std::vector<std::string> lines = WrapText("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa", 60, 12, 2);

  ASSERT_EQ(lines.size(), 2u);
  for (const std::string& line : lines) EXPECT_LE(TextWidth(line, 12), 60);
  EXPECT_TRUE(lines[1].ends_with("…"));
}

TEST(TextFit, WrappingTextInNoRoomEnds) {
  EXPECT_EQ(WrapText("word word word word", 0, 12, 3).size(), 3u);
}

TEST(TextFit, VariablesAreFoundAsWholeWords) {
  const std::vector<TextRun> runs = WithVariables("H holding [C], Hand", {"H", "C"});

  std::vector<std::string> italic;
  for (const TextRun& run : runs) {
    if (run.classes == "d-v") italic.push_back(run.text);
  }
  EXPECT_THAT(italic, ElementsAre("H", "C"));
}

TEST(TextFit, BackQuotesBecomeTheQuotesOfPrint) {
  EXPECT_EQ(InPrint("`C shape cube` and `C size large` are dropped"),
            "\u201cC shape cube\u201d and \u201cC size large\u201d are dropped");
  EXPECT_EQ(InPrint("no quotes"), "no quotes");
}

TEST(TextFit, ConfidencesAreRoundedHalfUp) {
  EXPECT_EQ(TwoDecimals(0.875), "0.88");
  EXPECT_EQ(TwoDecimals(0.625), "0.63");
  EXPECT_EQ(TwoDecimals(1), "1.00");
  EXPECT_EQ(TwoDecimals(0.001), "0.00");
  EXPECT_EQ(RingText(0.75), ".75");
  EXPECT_EQ(RingText(0.999), "1.0");
}

TEST(TextFit, SentencesAreWholeOrLeftOut) {
  const std::vector<std::string> sentences = {"A short one.",
                                              "One that is far too long for what is left there.", "The end."};
  const int width = TextWidth("A short one. The end.", 14) + 4;

  EXPECT_EQ(FitSentences(sentences, width, 14, 1), "A short one. The end.");
  EXPECT_EQ(FitSentences(sentences, 10 * width, 14, 1), Join(sentences, " "));
  EXPECT_EQ(FitSentences(sentences, 10, 14, 1), "A short one.") << "the first in any case";
  EXPECT_EQ(FitSentences({}, width, 14, 1), "");
}

}  // namespace
}  // namespace aerascope
