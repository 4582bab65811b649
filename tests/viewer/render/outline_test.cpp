#include "viewer/render/outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/viewer/render/render_test_support.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;

// A model whose geom 0 is the entity "a", geom 1 the entity "b", and geom 2 scenery.
std::shared_ptr<const SceneModel> TwoEntities() {
  SceneSource source;
  source.model_text =
      "<mujoco><worldbody><body name='a'><geom size='1'/></body><body name='b'><geom size='1'/></body>"
      "<body><geom size='1'/></body></worldbody></mujoco>";
  source.body_of_entity = {{"a", "a"}, {"b", "b"}};
  return *SceneModel::Load(source);
}

// '#' is geom 0, 'o' is geom 1, '+' is geom 2, everything else background.
SegmentImage Picture(const std::vector<std::string>& rows) {
  SegmentImage segments{{static_cast<int>(rows[0].size()), static_cast<int>(rows.size())}, {}};
  for (const std::string& row : rows) {
    for (const char c : row) segments.geom.push_back(c == '#' ? 0 : c == 'o' ? 1 : c == '+' ? 2 : -1);
  }
  return segments;
}

// Every corner of the border, nothing left out.
constexpr OutlineOptions kExact{0, 0};

double Area(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PixelPoint& a = ring[i];
    const PixelPoint& b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

TEST(Outline, ARectangleHasFourSidesAndALabelAboveItsMiddle) {
  const auto outlines = TraceOutlines(
      Picture({"..........", "..######..", "..######..", "..######..", "..######..", ".........."}),
      *TwoEntities());
  ASSERT_EQ(outlines.size(), 1u);
  const Outline& a = outlines[0];
  EXPECT_EQ(a.entity, "a");
  EXPECT_EQ(a.visible_pixels, 24);
  EXPECT_EQ(a.top_left, (PixelPoint{2, 1}));
  EXPECT_EQ(a.bottom_right, (PixelPoint{8, 5}));
  EXPECT_EQ(a.label_anchor, (PixelPoint{5, 1}));
  ASSERT_EQ(a.rings.size(), 1u);
  for (const PixelPoint& point : a.rings[0]) {
    EXPECT_TRUE(point.x == 2 || point.x == 8 || point.y == 1 || point.y == 5) << point.x << ' ' << point.y;
  }
  EXPECT_NEAR(Area(a.rings[0]), 24, 5);
}

TEST(Outline, AnOccludedThingHasItsPiecesTheLargestFirst) {
  const auto outlines =
      TraceOutlines(Picture({"##++####", "##++####", "##++####", "oooo...."}), *TwoEntities(), kExact);
  ASSERT_EQ(outlines.size(), 2u);
  ASSERT_EQ(outlines[0].rings.size(), 2u);
  EXPECT_GT(Area(outlines[0].rings[0]), Area(outlines[0].rings[1]));
  EXPECT_EQ(outlines[1].entity, "b");
}

TEST(Outline, AHoleGoesTheOtherWayRound) {
  const auto outlines =
      TraceOutlines(Picture({"#####", "#...#", "#...#", "#...#", "#####"}), *TwoEntities(), kExact);
  ASSERT_EQ(outlines.size(), 1u);
  ASSERT_EQ(outlines[0].rings.size(), 2u);
  EXPECT_GT(Area(outlines[0].rings[0]), 0);
  EXPECT_LT(Area(outlines[0].rings[1]), 0);
}

TEST(Outline, PiecesThatTouchAtACornerAreTwo) {
  const auto outlines = TraceOutlines(Picture({"##..", "##..", "..##", "..##"}), *TwoEntities(), kExact);
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(outlines[0].rings.size(), 2u);
}

TEST(Outline, SpecksAreLeftOut) {
  EXPECT_TRUE(TraceOutlines(Picture({"##", "##"}), *TwoEntities()).empty());
  EXPECT_TRUE(TraceOutlines(Picture({"++", "++"}), *TwoEntities(), kExact).empty());
  EXPECT_TRUE(TraceOutlines(SegmentImage{}, *TwoEntities(), kExact).empty());
}

TEST(Outline, ADiscIsRoundWithFewCorners) {
  SegmentImage segments{{100, 100}, {}};
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x)
      segments.geom.push_back(std::hypot(x + 0.5 - 50, y + 0.5 - 50) < 40 ? 0 : -1);
  }
  const auto outlines = TraceOutlines(segments, *TwoEntities());
  ASSERT_EQ(outlines.size(), 1u);
  ASSERT_EQ(outlines[0].rings.size(), 1u);
  const Ring& ring = outlines[0].rings[0];
  EXPECT_LT(ring.size(), 40u);
  EXPECT_GT(ring.size(), 8u);
  for (const PixelPoint& point : ring) EXPECT_NEAR(std::hypot(point.x - 50, point.y - 50), 40, 1);
  EXPECT_NEAR(Area(ring), std::numbers::pi * 1600, 150);
}

TEST(Outline, IsWrittenAsSvg) {
  EXPECT_EQ(SvgPath({{{1, 2}, {3.25, 4}, {5, 6.5}}, {{0, 0}, {1, 0}, {0, 1}}}),
            "M1 2L3.3 4L5 6.5ZM0 0L1 0L0 1Z");
  EXPECT_EQ(SvgPath({}), "");
}

// Follows any pattern of pixels: the rings together enclose every pixel but the half ones at corners.
RC_GTEST_PROP(OutlineLaw, RingsEncloseThePixels, ()) {
  const int width = *rc::gen::inRange(1, 12);
  const int height = *rc::gen::inRange(1, 12);
  const auto pixels = *rc::gen::container<std::vector<bool>>(static_cast<std::size_t>(width * height),
                                                             rc::gen::arbitrary<bool>());
  SegmentImage segments{{width, height}, {}};
  int count = 0;
  for (const bool inside : pixels) {
    segments.geom.push_back(inside ? 0 : -1);
    count += inside;
  }
  static const auto model = TwoEntities();
  const auto outlines = TraceOutlines(segments, *model, {0, 1e-9});
  RC_ASSERT(outlines.size() == (count > 0 ? 1u : 0u));
  if (count == 0) return;
  // The middles of the pixel edges cut off an eighth of a pixel at an outer corner and add one at an inner
  // corner.
  double area = 0;
  std::size_t corners = 0;
  for (const Ring& ring : outlines[0].rings) {
    area += Area(ring);
    corners += ring.size();
  }
  RC_ASSERT(std::abs(area - count) <= 0.125 * static_cast<double>(2 * corners) + 1e-9);
}

TEST_F(RenderTest, OutlinesLieAroundWhatIsDrawn) {
  ASSERT_TRUE(scene->Show(SmallWorldState(), camera));
  const Result<SegmentImage> segments = renderer->DrawSegments(*scene, {400, 200});
  ASSERT_TRUE(segments) << segments.error().message;
  const auto outlines = TraceOutlines(*segments, *scene->model());
  ASSERT_EQ(outlines.size(), 2u);
  const Outline& cube = outlines[0];
  ASSERT_EQ(cube.entity, "c");
  // 0.1 m wide, its top 1.9 m from the camera: 21 pixels around (242, 100).
  EXPECT_NEAR(cube.bottom_right.x - cube.top_left.x, 21, 2);
  EXPECT_NEAR((cube.bottom_right.x + cube.top_left.x) / 2, 242, 2);
  EXPECT_NEAR((cube.bottom_right.y + cube.top_left.y) / 2, 100, 2);
  EXPECT_LE(cube.rings[0].size(), 8u);
  EXPECT_EQ(outlines[1].entity, "h");
}

TEST_F(RenderTest, AThingOutOfThePictureHasNoOutline) {
  ASSERT_TRUE(scene->Show(SmallWorldState(50), camera));
  const Result<SegmentImage> segments = renderer->DrawSegments(*scene, {400, 200});
  ASSERT_TRUE(segments) << segments.error().message;
  const auto outlines = TraceOutlines(*segments, *scene->model());
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(outlines[0].entity, "h");
}

}  // namespace
}  // namespace aerascope
