#include "viewer/render/encode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <webp/decode.h>

#include <cstdlib>

namespace aerascope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A smooth picture with a sharp corner in it.
Image Sample(int width, int height) {
  Image image{{width, height}, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool corner = x > width / 2 && y > height / 2;
      for (const int channel : {x, y, corner ? 255 : 0})
        image.rgb.push_back(static_cast<std::uint8_t>(channel % 256));
    }
  }
  return image;
}

Image DecodePng(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return {};
  png.format = PNG_FORMAT_RGB;
  Image image{{static_cast<int>(png.width), static_cast<int>(png.height)},
              std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  if (!png_image_finish_read(&png, nullptr, image.rgb.data(), 0, nullptr)) return {};
  return image;
}

TEST(EncodePng, KeepsEveryPixel) {
  for (const Image& image : {Sample(1, 1), Sample(37, 19), Sample(640, 360)}) {
    const Result<std::string> bytes = EncodePng(image);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(DecodePng(*bytes), image);
  }
}

TEST(EncodePng, HasNoTimeInside) {
  const Result<std::string> bytes = EncodePng(Sample(37, 19));
  ASSERT_TRUE(bytes);
  EXPECT_THAT(*bytes, Not(HasSubstr("tIME")));
  EXPECT_EQ(*bytes, *EncodePng(Sample(37, 19)));
}

TEST(EncodePng, AnEmptyPictureIsAnError) {
  const Result<std::string> bytes = EncodePng(Image{});
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("cannot be written as PNG"));
}

TEST(EncodeWebp, LooksLikeThePicture) {
  const Image image = Sample(160, 90);
  const Result<std::string> bytes = EncodeWebp(image, {90, 4});
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, *EncodeWebp(image, {90, 4}));
  int width = 0, height = 0;
  std::uint8_t* decoded =
      WebPDecodeRGB(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size(), &width, &height);
  ASSERT_NE(decoded, nullptr);
  ASSERT_EQ(width, 160);
  ASSERT_EQ(height, 90);
  double difference = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) difference += std::abs(decoded[i] - image.rgb[i]);
  WebPFree(decoded);
  EXPECT_LT(difference / static_cast<double>(image.rgb.size()), 4);
}

TEST(EncodeWebp, LessQualityIsSmaller) {
  EXPECT_LT(EncodeWebp(Sample(320, 180), {40, 4})->size(), EncodeWebp(Sample(320, 180), {95, 4})->size());
}

TEST(EncodeWebp, WhatCannotBeIsSaid) {
  EXPECT_THAT(EncodeWebp(Sample(16384, 1)).error().message,
              HasSubstr("expected at most 16383 pixels a side, found 16384 x 1"));
  EXPECT_THAT(EncodeWebp(Sample(4, 4), {101, 4}).error().message, HasSubstr("the quality must be 0 to 100"));
  EXPECT_FALSE(EncodeWebp(Image{}));
}

}  // namespace
}  // namespace aerascope
