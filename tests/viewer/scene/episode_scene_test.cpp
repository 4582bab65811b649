#include "viewer/scene/episode_scene.h"

#include <gtest/gtest.h>

#include "tests/viewer/scene/small_world.h"

namespace aerascope {
namespace {

EpisodeHeader SmallHeader() {
  EpisodeHeader header;
  header.settings = {
      {"world.kind", "mujoco"}, {"world.body.c", "cube_body"}, {"world.body.h", "hand"}, {"other", "x"}};
  header.files = {{"scenario.toml", "..."},
                  {"world/brick.msh", BrickMesh()},
                  {"world/scene.xml", SmallWorld().model_text}};
  return header;
}

TEST(EpisodeScene, FindsModelMeshesAndBodiesInTheHeader) {
  const auto source = SceneSourceOf(SmallHeader());
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE(source->has_value());
  EXPECT_EQ((*source)->body_of_entity, SmallWorld().body_of_entity);
  ASSERT_EQ((*source)->files.size(), 1u);
  EXPECT_EQ((*source)->files[0].name, "brick.msh");
  const auto model = SceneModel::Load(**source);
  EXPECT_TRUE(model) << model.error().message;
}

TEST(EpisodeScene, AScriptedWorldHasNoScene) {
  EpisodeHeader header = SmallHeader();
  header.settings["world.kind"] = "scripted";
  const auto source = SceneSourceOf(header);
  ASSERT_TRUE(source);
  EXPECT_FALSE(source->has_value());
}

TEST(EpisodeScene, APromisedModelThatIsMissingIsAnError) {
  EpisodeHeader header = SmallHeader();
  header.files.pop_back();
  const auto source = SceneSourceOf(header);
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().message,
            "the episode's world is one of MuJoCo, but the episode file has no world/scene.xml");
}

}  // namespace
}  // namespace aerascope
