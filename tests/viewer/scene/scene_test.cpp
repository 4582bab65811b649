#include "viewer/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/viewer/scene/small_world.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Scene SmallScene() {
  auto model = SceneModel::Load(SmallWorld());
  auto scene = Scene::Create(*model);
  return std::move(*scene);
}

Camera Named(const std::string& name) {
  Camera camera;
  camera.name = name;
  return camera;
}

TEST(Scene, IsPrintedShapeByShape) {
  Scene scene = SmallScene();
  WorldStateRecorded state = SmallWorldState();
  state.qpos[14] = 0.1;                               // the hand lifted by 10 cm
  state.qpos[3] = 0.5, state.qpos[6] = 0.8660254038;  // the cube turned by 120 degrees
  ASSERT_TRUE(scene.Show(state, Named("top")));
  EXPECT_EQ(
      ToText(scene),
      "camera top: at 0 0 2 along 0 0 -1 up 0 1 0\n"
      "light on the camera: ambient 0.5 0.5 0.5 diffuse 0.5 0.5 0.5\n"
      "shape floor: plane size 2 2 0.1 at 0 0 0 turn 1 0 0 0 colour 0.8 0.8 0.8 1\n"
      "shape cube: box size 0.05 0.05 0.05 at 0.2 0 0.05 turn 0.5 0 0 0.866 colour 1 0 0 1\n"
      "shape geom 0 of brick_body: mesh size 0.02 0.04 0.06 at -0.2 0.2 0.05 turn 1 0 0 0 colour 0 0 1 1\n"
      "shape palm: box size 0.1 0.04 0.02 at -0.2 -0.2 0.2 turn 1 0 0 0 colour 0 0.6 0 1\n"
      "shape geom 0 of finger: sphere size 0.03 0.03 0.03 at -0.14 -0.14 0.2 turn 1 0 0 0 colour 0 0.6 0 "
      "1\n");
}

TEST(Scene, ShowsTheLastStateGivenWhateverWasShownBefore) {
  Scene one = SmallScene();
  Scene two = SmallScene();
  ASSERT_TRUE(one.Show(SmallWorldState(0.3), Named("side")));
  ASSERT_TRUE(one.Show(SmallWorldState(), Named("top")));
  ASSERT_TRUE(two.Show(SmallWorldState(), Named("top")));
  EXPECT_EQ(ToText(one), ToText(two));
}

TEST(Scene, AStateOfAnotherModelIsRefusedAndTheSceneStays) {
  Scene scene = SmallScene();
  const std::string before = ToText(scene);
  WorldStateRecorded state = SmallWorldState(0.1);
  state.qpos.pop_back();
  Status status = scene.Show(state, Named("top"));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            "the recorded state does not fit the scene's model: expected 16 positions (qpos), found 15");
  state = SmallWorldState(0.1);
  state.ctrl.clear();
  status = scene.Show(state, Named("top"));
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("expected 1 controls (ctrl), found 0"));
  EXPECT_EQ(ToText(scene), before);
}

TEST(Scene, NumbersThatAreNoPlacesAreRefused) {
  Scene scene = SmallScene();
  for (const double number :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    WorldStateRecorded state = SmallWorldState();
    state.qpos[2] = number;
    const Status status = scene.Show(state, Named("top"));
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, HasSubstr("number 3 of its positions (qpos) is"));
  }
}

TEST(Scene, AQuaternionOfZerosIsNoTurn) {
  Scene scene = SmallScene();
  WorldStateRecorded state = SmallWorldState();
  state.qpos[3] = 0;
  ASSERT_TRUE(scene.Show(state, Named("top")));
  EXPECT_THAT(ToText(scene), HasSubstr("shape cube: box size 0.05 0.05 0.05 at 0.2 0 0.05 turn 1 0 0 0"));
}

TEST(Scene, AnUnknownCameraIsRefused) {
  Scene scene = SmallScene();
  const Status status = scene.Show(SmallWorldState(), Named("front"));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message,
            "the scene has no camera named front; it has top, side, above, side, at:ENTITY and free");
}

TEST(Scene, AFreeCameraLooksAtItsPoint) {
  Scene scene = SmallScene();
  Camera camera;
  camera.look_at_m = {0.2, 0, 0};
  camera.distance_m = 3;
  camera.azimuth_deg = 0;
  camera.elevation_deg = 0;
  ASSERT_TRUE(scene.Show(SmallWorldState(), camera));
  EXPECT_THAT(ToText(scene), HasSubstr("camera free:0,0,3,0.2,0,0: at -2.8 0 0 along 1 0 0 up 0 0 1\n"));
}

}  // namespace
}  // namespace aerascope
