#include "viewer/page/text_columns.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/viewer/page/page_reader.h"

namespace aerascope {
namespace {

using Texts = std::vector<std::optional<std::string>>;

std::vector<TextCell> Column(const Texts& texts, std::int64_t first_row = 1) {
  std::vector<TextCell> cells;
  for (const auto& text : texts) cells.push_back({first_row + static_cast<std::int64_t>(cells.size()), text});
  return cells;
}

Texts ReadBack(const std::vector<TextCell>& column) {
  TextColumns columns;
  columns.Add(column);
  TextColumnReader reader(columns.bytes());
  std::vector<std::int64_t> rows;
  for (const TextCell& cell : column) rows.push_back(cell.row);
  Texts texts = reader.Next(rows);
  EXPECT_TRUE(reader.AtEnd());
  return texts;
}

TEST(TextColumns, EveryWritingOfANumberComesBackAsItWas) {
  const Texts texts = {"",
                       std::nullopt,
                       "h at 60, 154.1 s to 154.2 s",
                       "h at -60.25, 154 s to 154.2 s",
                       "007, 1.50, -0, -0.5, 0.05, 1.2.3, .5, 5., a-2, 5-2, (-2, -3)",
                       "12345678901234567890 and 3.14159265358979 and 999999999.999999 and -999999999.999999",
                       "#1, mdl_12, 1e9, \u03c8 = 3/4, \u2212 1, --5, - 5",
                       "0",
                       "-1",
                       "{\"at\":-12.5,\"rows\":[1,2,3]}"};
  EXPECT_EQ(ReadBack(Column(texts)), texts);
}

TEST(TextColumns, AnyTextsComeBackAsTheyWere) {
  std::mt19937 random(7);
  const std::string letters = "0123456789.-#_ ,(a";
  for (int round = 0; round < 200; ++round) {
    Texts texts;
    for (int row = 0; row < 30; ++row) {
      if (random() % 8 == 0) {
        texts.emplace_back();
        continue;
      }
      std::string& text = *texts.emplace_back("");
      for (std::size_t length = random() % 24; length > 0; --length)
        text += letters[random() % letters.size()];
    }
    ASSERT_EQ(ReadBack(Column(texts, static_cast<std::int64_t>(random() % 1'000'000))), texts);
  }
}

TEST(TextColumns, ColumnsShareTheirForms) {
  TextColumns columns;
  columns.Add(Column({"Seen: h at 60.", "Seen: h at 61."}));
  const std::size_t one = columns.bytes().size();
  columns.Add(Column({"Seen: h at 62.", std::nullopt}));
  EXPECT_LT(columns.bytes().size(), one + 8);
  TextColumnReader reader(columns.bytes());
  EXPECT_EQ(reader.Next({1, 2}), (Texts{"Seen: h at 60.", "Seen: h at 61."}));
  EXPECT_EQ(reader.Next({1, 2}), (Texts{"Seen: h at 62.", std::nullopt}));
}

TEST(TextColumns, WhatNamesTheRowItselfTakesAByteEach) {
  Texts own;
  for (int row = 0; row < 1000; ++row) own.emplace_back("#" + std::to_string(500'000 + row));
  TextColumns columns;
  columns.Add(Column(own, 500'000));
  EXPECT_LT(columns.bytes().size(), 2'020u);
  EXPECT_EQ(ReadBack(Column(own, 500'000)), own);
}

TEST(TextColumns, ControlCharactersDoNotBreakTheColumns) {
  EXPECT_EQ(ReadBack(Column({"a\nb\x01 7", "c"})), (Texts{"a b  7", "c"}));
}

}  // namespace
}  // namespace aerascope
