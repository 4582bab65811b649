#include "viewer/scene/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>

#include "tests/viewer/scene/small_world.h"
#include "viewer/scene/scene.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;

std::string Read(const SceneModel& model, std::string_view text) {
  const Result<Camera> camera = ParseCamera(model, text);
  return camera ? ToText(*camera) : camera.error().message;
}

TEST(Camera, ReadsNamesAndFreeViews) {
  const auto model = SceneModel::Load(SmallWorld());
  EXPECT_EQ(Read(**model, ""), "top");
  EXPECT_EQ(Read(**model, "side"), "side");
  EXPECT_EQ(Read(**model, "free:120,-30,1.5,0.1,0.2,0.3"), "free:120,-30,1.5,0.1,0.2,0.3");
  EXPECT_THAT(Read(**model, "free:120,-30,1.5"), HasSubstr("free:120,-30,1.5,"));
  EXPECT_EQ(Read(**model, Read(**model, "free")), Read(**model, "free"));
}

TEST(Camera, WhatIsNoCameraIsExplained) {
  const auto model = SceneModel::Load(SmallWorld());
  EXPECT_EQ(Read(**model, "fro\nnt"),
            "the scene has no camera named fro\\x0ant; it has top, side, above, side, at:ENTITY and free");
  for (const char* text : {"free:", "free:1,2", "free:1,2,3,4", "free:1,2,0", "free:1,2,nan",
                           "free:1,2,3,4,5,6,7", "free:1,2,1e9"}) {
    EXPECT_THAT(Read(**model, text), HasSubstr("is not understood: expected free:AZIMUTH,ELEVATION,DISTANCE"))
        << text;
  }
}

TEST(Camera, AModelWithoutNamedCamerasHasItsFreeOne) {
  SceneSource source;
  source.model_text = "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>";
  const auto model = SceneModel::Load(source);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT(ToText(DefaultCamera(**model)), HasSubstr("free:"));
  EXPECT_EQ(Read(**model, "top"),
            "the scene has no camera named top; it has above, side, at:ENTITY and free");
}

// Where a point of the world is in the picture of a free camera: across and upwards, each from -1 to 1 inside
// a picture that is 1.6 times as wide as high.
std::array<double, 2> InPicture(const Camera& camera, double fovy_deg, const std::array<double, 3>& point_m) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double azimuth = camera.azimuth_deg * kDegree, elevation = camera.elevation_deg * kDegree;
  const std::array<double, 3> forward{std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  const std::array<double, 3> right{std::sin(azimuth), -std::cos(azimuth), 0};
  const std::array<double, 3> up{-std::sin(elevation) * std::cos(azimuth),
                                 -std::sin(elevation) * std::sin(azimuth), std::cos(elevation)};
  double along = camera.distance_m, across = 0, upwards = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double away = point_m[i] - camera.look_at_m[i];
    along += away * forward[i];
    across += away * right[i];
    upwards += away * up[i];
  }
  const double half = along * std::tan(fovy_deg * kDegree / 2);
  return {across / half / 1.6, upwards / half};
}

TEST(Camera, ViewsOfAnySceneShowItsEntities) {
  const auto model = SceneModel::Load(SmallWorld());
  const double fovy_deg = (*model)->mujoco().vis.global.fovy;
  for (const char* text : {"above", "at:c"}) {
    SCOPED_TRACE(text);
    const Result<Camera> camera = ParseCamera(**model, text);
    ASSERT_TRUE(camera) << camera.error().message;
    // The cube's middle, as the small world has it.
    const auto [across, upwards] = InPicture(*camera, fovy_deg, {0.2, 0, 0.05});
    EXPECT_LT(std::abs(across), 1);
    EXPECT_LT(std::abs(upwards), 1);
  }
  // What the model itself calls so comes first.
  EXPECT_EQ(ParseCamera(**model, "side")->name, "side");
  EXPECT_LT(ParseCamera(**model, "above")->elevation_deg, -80);
}

TEST(Camera, OneThatFollowsLooksAtTheEntityWhereverItIs) {
  const auto model = SceneModel::Load(SmallWorld());
  const Result<Camera> camera = ParseCamera(**model, "at:c");
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ(ToText(*camera), "at:c");
  EXPECT_EQ(TitleOf(**model, *camera), "at c");
  Scene scene = std::move(*Scene::Create(*model));
  const auto camera_line = [&](double x) {
    EXPECT_TRUE(scene.Show(SmallWorldState(x), *camera));
    return ToText(scene).substr(0, ToText(scene).find('\n'));
  };
  EXPECT_NE(camera_line(0), camera_line(0.3));
  EXPECT_EQ(Read(**model, "at:nobody"),
            "the scene has no entity named nobody that a camera could follow; it has c, h");
}

TEST(Camera, SeveralAreReadWithCommasBetween) {
  const auto model = SceneModel::Load(SmallWorld());
  const auto read = [&](std::string_view text) {
    const auto cameras = ParseCameras(**model, text);
    if (!cameras) return cameras.error().message;
    std::string all;
    for (const Camera& camera : *cameras) all += TitleOf(**model, camera) + "; ";
    return all;
  };
  EXPECT_EQ(read("top"), "top; ");
  EXPECT_EQ(read("top,above,at:h"), "top; above; at h; ");
  EXPECT_EQ(read("free:120,-30,1.5,0.1,0.2,0.3,side"), "free:120,-30,1.5,0.1,0.2,0.3; side; ");
  EXPECT_THAT(read("top,"), HasSubstr("expected names with a comma between"));
  EXPECT_THAT(read(",top"), HasSubstr("expected names with a comma between"));
  EXPECT_EQ(read("top,top"), "the camera top is named twice");
  EXPECT_THAT(read("top,frnt"), HasSubstr("no camera named frnt"));
}

}  // namespace
}  // namespace aerascope
