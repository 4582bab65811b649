#include "viewer/draw/png.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "viewer/draw/svg.h"

namespace aerascope {
namespace {

std::string SmallSvg() {
  Svg svg;
  svg.Box({2, 2, 20, 10}, "d");
  svg.Text(4, 30, "text");
  return SvgDocument({40, 40}, "small", ".d{fill:#0b5cc2}", svg.content());
}

unsigned NumberAt(const std::string& png, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(png.at(at + i));
  return value;
}

TEST(Png, TheSizeIsThatOfTheSvgTimesTheScale) {
  const Result<std::string> png = SvgToPng(SmallSvg(), 2.5);

  ASSERT_TRUE(png.ok());
  EXPECT_EQ(png->substr(1, 3), "PNG");
  EXPECT_EQ(NumberAt(*png, 16), 100u);
  EXPECT_EQ(NumberAt(*png, 20), 100u);
}

TEST(Png, TheSameDrawingGivesTheSameBytes) {
  EXPECT_EQ(*SvgToPng(SmallSvg()), *SvgToPng(SmallSvg()));
}

TEST(Png, ItHoldsNothingButThePicture) {
  const Result<std::string> png = SvgToPng(SmallSvg());

  ASSERT_TRUE(png.ok());
  for (std::size_t at = 8; at < png->size(); at += NumberAt(*png, at) + 12) {
    const std::string kind = png->substr(at + 4, 4);
    EXPECT_TRUE(kind == "IHDR" || kind == "IDAT" || kind == "IEND" || kind == "bKGD") << kind;
  }
}

TEST(Png, WhatIsNoSvgIsAnErrorOfOneSentence) {
  for (const char* text : {"", "no svg", "<svg", "<html/>"}) {
    const Result<std::string> png = SvgToPng(text);
    ASSERT_FALSE(png.ok()) << text;
    EXPECT_EQ(png.error().message.find('\n'), std::string::npos);
    EXPECT_NE(png.error().message, "");
  }
}

TEST(Png, APictureTooLargeIsRefused) {
  const Result<std::string> png = SvgToPng(SvgDocument({200'000, 10}, "wide", "", ""));

  ASSERT_FALSE(png.ok());
  EXPECT_NE(png.error().message.find("200000 x 10"), std::string::npos);
  EXPECT_FALSE(SvgToPng(SmallSvg(), 0).ok());
  EXPECT_FALSE(SvgToPng(SmallSvg(), -1).ok());
}

TEST(Png, NoFileOutsideIsRead) {
  // A blue picture lies beside the test; a drawing that refers to it stays white.
  const std::string path = testing::TempDir() + "outside.png";
  std::ofstream(path, std::ios::binary) << *SvgToPng(SmallSvg());
  Svg svg;
  svg.Leaf("image", {{"href", "file://" + path}, {"width", 10}, {"height", 10}});

  const Result<std::string> drawn = SvgToPng(SvgDocument({10, 10}, "outside", "", svg.content()));

  std::remove(path.c_str());
  ASSERT_TRUE(drawn.ok());
  EXPECT_EQ(*drawn, *SvgToPng(SvgDocument({10, 10}, "empty", "", "")));
}

}  // namespace
}  // namespace aerascope
