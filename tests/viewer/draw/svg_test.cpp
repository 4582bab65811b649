#include "viewer/draw/svg.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/viewer/draw/svg_check.h"

namespace aerascope {
namespace {

std::string DocumentWith(std::string_view text) {
  Svg svg;
  svg.Open("g", {{"data-name", std::string(text)}});
  svg.Text(10, 20, text, {"d-2"});
  svg.Words("title", text);
  svg.Close();
  return SvgDocument({100, 50}, text, "text{fill:#000}", svg.content());
}

TEST(Svg, MarkupInTextStaysText) {
  Svg svg;
  svg.Words("title", "</text><script>alert('x & \"y\"')</script>");
  EXPECT_EQ(
      svg.content(),
      "<title>&lt;/text&gt;&lt;script&gt;alert(&#39;x &amp; &quot;y&quot;&#39;)&lt;/script&gt;</title>\n");
}

TEST(Svg, WhatXmlForbidsIsWrittenVisibly) {
  const std::string_view nul("a\0b", 3);
  for (const std::string_view hostile :
       {std::string_view("\x1b[31mred"), nul, std::string_view("\xff\xfe not UTF-8"),
        std::string_view("\xe2\x80\xae evil"), std::string_view("\xef\xbf\xbf and \xef\xbf\xbe"),
        std::string_view("]]> --> <![CDATA["), std::string_view("line\nbreak\ttab"),
        std::string_view("&#0;")}) {
    const std::string said = WhatXmllintSays(DocumentWith(hostile));
    if (said == kNoXmllint) GTEST_SKIP() << said;
    EXPECT_EQ(said, "");
  }
}

TEST(Svg, BidirectionalOverridesDoNotReachTheReader) {
  EXPECT_EQ(DocumentWith("\xe2\x80\xae").find("\xe2\x80\xae"), std::string::npos);
}

TEST(Svg, NumbersHaveAtMostTwoDecimals) {
  EXPECT_EQ(SvgNumber(3), "3");
  EXPECT_EQ(SvgNumber(-0.001), "0");
  EXPECT_EQ(SvgNumber(1.005001), "1.01");
  EXPECT_EQ(SvgNumber(-12.5), "-12.5");
  EXPECT_EQ(SvgNumber(0.07), "0.07");
  EXPECT_EQ(SvgNumber(std::numeric_limits<double>::quiet_NaN()), "0");
  EXPECT_EQ(SvgNumber(1e300), "1000000000");
}

TEST(Svg, ADocumentSaysItsSizeAndTitle) {
  EXPECT_EQ(SvgDocument({30, 20}, "A & B", "", "<g/>\n"),
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"30\" height=\"20\" viewBox=\"0 0 30 20\" "
            "role=\"img\" "
            "xml:space=\"preserve\">\n"
            "<title>A &amp; B</title>\n"
            "<style></style>\n"
            "<g/>\n"
            "</svg>\n");
}

}  // namespace
}  // namespace aerascope
