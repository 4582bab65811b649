#include "engine/base/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace aerascope {
namespace {

const double kInfinity = std::numeric_limits<double>::infinity();

std::string Exact(double value) {
  std::string text;
  AppendExactNumber(value, &text);
  return text;
}

TEST(Numbers, AreRoundedToNineDigits) {
  EXPECT_EQ(RoundNumber(0.1 + 0.2), 0.3);
  EXPECT_EQ(RoundNumber(1.23456789012), 1.23456789);
  EXPECT_EQ(RoundNumber(123456789.4), 123456789);
  EXPECT_EQ(RoundNumber(RoundNumber(1.0 / 3)), RoundNumber(1.0 / 3));
}

TEST(Numbers, HaveOneZeroAndOneNaN) {
  EXPECT_FALSE(std::signbit(RoundNumber(-0.0)));
  EXPECT_FALSE(std::signbit(RoundNumber(-std::nan(""))));
  EXPECT_TRUE(std::isnan(RoundNumber(std::nan(""))));
  EXPECT_EQ(RoundNumber(-kInfinity), -kInfinity);
  EXPECT_TRUE(std::isfinite(RoundNumber(std::numeric_limits<double>::max())));
}

TEST(Numbers, HaveOneFormat) {
  EXPECT_EQ(FormatNumber(0), "0");
  EXPECT_EQ(FormatNumber(-0.0), "0");
  EXPECT_EQ(FormatNumber(0.75), "0.75");
  EXPECT_EQ(FormatNumber(100), "100");
  EXPECT_EQ(FormatNumber(1.0 / 3), "0.333333333");
  EXPECT_EQ(FormatNumber(1.0 / 3, 3), "0.333");
  EXPECT_EQ(FormatNumber(std::nan("")), "nan");
  EXPECT_EQ(FormatNumber(kInfinity), "inf");
  EXPECT_EQ(FormatNumber(-kInfinity), "-inf");
}

TEST(Numbers, ExactTextIsReadBackExactly) {
  for (const double value : {0.1, 1.0 / 3, 0.1 + 0.2, 1e-300, 5e-324, 1.7976931348623157e308, -2.5}) {
    EXPECT_EQ(std::strtod(Exact(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(Exact(0.1), "0.1");
  EXPECT_EQ(Exact(-0.0), "0");
}

TEST(Numbers, ConfidenceHasAtMostThreeDecimals) {
  EXPECT_EQ(FormatConfidence(0.75), "0.75");
  EXPECT_EQ(FormatConfidence(1), "1");
  EXPECT_EQ(FormatConfidence(0.875), "0.875");
  EXPECT_EQ(FormatConfidence(1.0 / 3), "0.333");
  EXPECT_EQ(FormatConfidence(0), "0");
  EXPECT_EQ(FormatConfidence(-0.0001), "0");
  EXPECT_EQ(FormatConfidence(std::nan("")), "nan");
}

TEST(PrintableText, KeepsWhatIsReadable) {
  EXPECT_EQ(Printable("plain"), "plain");
  EXPECT_EQ(Printable("gr\xc3\xb6\xc3\x9f"
                      "e \xe6\x97\xa5"),
            "gr\xc3\xb6\xc3\x9f"
            "e \xe6\x97\xa5");
}

TEST(PrintableText, ShowsWhatWouldDisturbATerminal) {
  EXPECT_EQ(Printable("a\nb\x1b[31m"), "a\\x0ab\\x1b[31m");
  EXPECT_EQ(Printable("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(Printable("\xe2\x80\xae"), "\\u{202e}");
  EXPECT_EQ(Printable(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(Printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a surrogate pair
  EXPECT_EQ(Printable("\xc0\xaf"), "\\xc0\\xaf");           // a longer spelling of "/"
}

TEST(ClosestWordTo, AMisspelledOne) {
  const std::vector<std::string> known{"report", "run", "diff", "export"};
  EXPECT_EQ(ClosestWord("reprot", known), "report");
  EXPECT_EQ(ClosestWord("dif", known), "diff");
  EXPECT_EQ(ClosestWord("zebra", known), "");
  EXPECT_EQ(ClosestWord("", known), "");
  EXPECT_EQ(ClosestWord("run", {}), "");
}

TEST(JoinedText, HasSeparatorsBetween) {
  EXPECT_EQ(Join({}, ", "), "");
  EXPECT_EQ(Join({"a"}, ", "), "a");
  EXPECT_EQ(Join({"a", "b", ""}, ", "), "a, b, ");
}

}  // namespace
}  // namespace aerascope
