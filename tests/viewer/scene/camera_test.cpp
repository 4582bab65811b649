#include "viewer/scene/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/viewer/scene/small_world.h"

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
  EXPECT_EQ(Read(**model, "fro\nnt"), "the scene has no camera named fro\\x0ant; it has top, side and free");
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
  EXPECT_EQ(Read(**model, "top"), "the scene has no camera named top; it has free");
}

}  // namespace
}  // namespace aerascope
