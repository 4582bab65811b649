#include "viewer/render/renderer.h"

#include <gmock/gmock.h>

#include "tests/viewer/render/render_test_support.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;

constexpr PictureSize kSize{200, 100};  // 1 m high: 100 pixels a metre, the world's origin in the middle

TEST_F(RenderTest, ThingsAreWhereTheyShouldBeInTheirColours) {
  ASSERT_TRUE(scene->Show(SmallWorldState(), camera));
  const Result<Image> image = renderer->Draw(*scene, kSize);
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->rgb.size(), 60000u);
  EXPECT_PRED2([](Colour a, Colour b) { return Near(a, b); }, PixelOf(*image, 120, 50),
               (Colour{255, 0, 0}));  // cube
  EXPECT_PRED2([](Colour a, Colour b) { return Near(a, b); }, PixelOf(*image, 78, 71),
               (Colour{0, 153, 0}));  // palm
  const Colour floor = PixelOf(*image, 150, 80);
  EXPECT_EQ(floor.red, floor.green);
  EXPECT_GT(floor.red, 150);
  const Colour brick = PixelOf(*image, 80, 30);
  EXPECT_GT(brick.blue, 100);
  EXPECT_EQ(brick.red, 0);
}

TEST_F(RenderTest, WhatMovesInTheStateMovesInThePicture) {
  ASSERT_TRUE(scene->Show(SmallWorldState(0.3), camera));
  const Result<Image> image = renderer->Draw(*scene, kSize);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_TRUE(Near(PixelOf(*image, 151, 50), {255, 0, 0})) << PixelOf(*image, 151, 50);
  EXPECT_GT(PixelOf(*image, 120, 50).green, 150);
}

TEST_F(RenderTest, TheSameSceneGivesTheSameBytesWhateverWasDrawnBetween) {
  ASSERT_TRUE(scene->Show(SmallWorldState(), camera));
  const Result<Image> first = renderer->Draw(*scene, kSize);
  ASSERT_TRUE(renderer->DrawSegments(*scene, kSize));
  ASSERT_TRUE(renderer->Draw(*scene, {333, 77}));
  RenderQuality smooth;
  smooth.samples = 4;
  ASSERT_TRUE(renderer->Draw(*scene, kSize, smooth));
  const Result<Image> second = renderer->Draw(*scene, kSize);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

TEST_F(RenderTest, ARendererMadeAfterAnotherDrawsTheSame) {
  const Result<Image> first = renderer->Draw(*scene, kSize);
  ASSERT_TRUE(first);
  renderer.reset();
  auto again = Renderer::Create();
  ASSERT_TRUE(again) << again.error().message;
  const Result<Image> second = (*again)->Draw(*scene, kSize);
  ASSERT_TRUE(second);
  EXPECT_EQ(*first, *second);
}

TEST_F(RenderTest, OnlyOneRendererExistsAtATime) {
  const auto second = Renderer::Create();
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("has a renderer already"));
}

TEST_F(RenderTest, TwoModelsAreDrawnInTurn) {
  SceneSource other;
  other.model_text =
      "<mujoco><visual><quality offsamples='0'/></visual><worldbody><camera name='top' pos='0 0 2'/>"
      "<geom type='box' size='1 1 0.1' rgba='1 0 1 1'/></worldbody></mujoco>";
  auto model = SceneModel::Load(other);
  ASSERT_TRUE(model) << model.error().message;
  auto second = Scene::Create(*model);
  ASSERT_TRUE(second);
  const Result<Image> small = renderer->Draw(*scene, kSize);
  const Result<Image> box = renderer->Draw(*second, kSize);
  const Result<Image> small_again = renderer->Draw(*scene, kSize);
  ASSERT_TRUE(small && box && small_again);
  const Colour middle = PixelOf(*box, 100, 50);
  EXPECT_EQ(middle.red, middle.blue);
  EXPECT_GT(middle.red, middle.green + 100);
  EXPECT_EQ(*small, *small_again);
}

TEST_F(RenderTest, AnyReasonableSizeWorksAndOthersAreRefused) {
  for (const PictureSize size : {PictureSize{1, 1}, {3, 2}, {7, 301}, {2600, 1700}}) {
    const Result<Image> image = renderer->Draw(*scene, size);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->rgb.size(),
              3u * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    if (size.width < 100) continue;
    EXPECT_TRUE(Near(PixelOf(*image, size.width / 2 + size.height / 5, size.height / 2), {255, 0, 0}));
    EXPECT_NE(PixelOf(*image, size.width - 1, 0), (Colour{0, 0, 0}));
  }
  for (const PictureSize size : {PictureSize{0, 10}, {10, -1}, {16385, 10}, {16000, 16000}}) {
    const Result<Image> image = renderer->Draw(*scene, size);
    ASSERT_FALSE(image);
    EXPECT_THAT(image.error().message,
                HasSubstr("pixels cannot be drawn: expected sides of 1 to 16384 pixels"));
  }
}

TEST_F(RenderTest, UnknownQualityIsRefused) {
  RenderQuality quality;
  quality.samples = 1000;
  const Result<Image> image = renderer->Draw(*scene, kSize, quality);
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message, HasSubstr("expected 0 to 16 samples"));
  EXPECT_TRUE(renderer->Draw(*scene, kSize));
}

TEST_F(RenderTest, SegmentsNameTheGeomSeenAtEachPixel) {
  ASSERT_TRUE(scene->Show(SmallWorldState(), camera));
  const Result<SegmentImage> segments = renderer->DrawSegments(*scene, kSize);
  ASSERT_TRUE(segments) << segments.error().message;
  const auto name_at = [&](std::size_t x, std::size_t y) {
    return scene->model()->GeomName(segments->geom[y * 200 + x]);
  };
  EXPECT_EQ(name_at(120, 50), "cube");
  EXPECT_EQ(name_at(78, 71), "palm");
  EXPECT_EQ(name_at(86, 64), "geom 0 of finger");
  EXPECT_EQ(name_at(150, 80), "floor");
}

TEST_F(RenderTest, TellsWhatDraws) {
  EXPECT_FALSE(renderer->info().driver.empty());
  EXPECT_FALSE(renderer->info().version.empty());
  EXPECT_THAT(renderer->info().platform, ::testing::AnyOf("surfaceless", "device"));
}

TEST(PictureSize, IsReadFromText) {
  const Result<PictureSize> size = ParsePictureSize("960x540");
  ASSERT_TRUE(size);
  EXPECT_EQ(*size, (PictureSize{960, 540}));
  for (const char* text :
       {"", "960", "x", "960x", "x540", "960x540x", "960 x 540", "-5x5", "0x5", "99999999999x5"}) {
    EXPECT_FALSE(ParsePictureSize(text)) << text;
  }
}

}  // namespace
}  // namespace aerascope
