#include "viewer/scene/scene_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/viewer/scene/small_world.h"

namespace aerascope {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string LoadTrouble(const SceneSource& source) {
  const auto model = SceneModel::Load(source);
  return model ? "loaded" : model.error().message;
}

int GeomNamed(const SceneModel& model, const std::string& name) {
  for (int geom = 0; geom < 10; ++geom) {
    if (model.GeomName(geom) == name) return geom;
  }
  return -1;
}

TEST(SceneModel, ListsItsNamedCamerasInOrder) {
  const auto model = SceneModel::Load(SmallWorld());
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_THAT((*model)->cameras(), ElementsAre("top", "side"));
}

TEST(SceneModel, AnEntityHasTheGeomsOfItsBodyAndOfAllAttachedToIt) {
  const auto model = SceneModel::Load(SmallWorld());
  ASSERT_TRUE(model) << model.error().message;
  ASSERT_EQ((*model)->entities().size(), 2u);
  EXPECT_EQ((*model)->entities()[1].entity, "h");
  EXPECT_EQ((*model)->EntityOfGeom(GeomNamed(**model, "cube")), 0);
  EXPECT_EQ((*model)->EntityOfGeom(GeomNamed(**model, "palm")), 1);
  EXPECT_EQ((*model)->EntityOfGeom(GeomNamed(**model, "geom 0 of finger")), 1);
  EXPECT_EQ((*model)->EntityOfGeom(GeomNamed(**model, "floor")), -1);
  EXPECT_EQ((*model)->EntityOfGeom(1000), -1);
}

TEST(SceneModel, ABodyThatIsAnEntityItselfIsNotPartOfAnother) {
  SceneSource source = SmallWorld();
  source.body_of_entity["f"] = "finger";
  const auto model = SceneModel::Load(source);
  ASSERT_TRUE(model) << model.error().message;
  const int owner = (*model)->EntityOfGeom(GeomNamed(**model, "geom 0 of finger"));
  EXPECT_EQ((*model)->entities()[static_cast<std::size_t>(owner)].entity, "f");
}

TEST(SceneModel, AnUnknownBodyIsNamedWithTheLikeliestOne) {
  SceneSource source = SmallWorld();
  source.body_of_entity["c"] = "cube_boddy";
  EXPECT_EQ(LoadTrouble(source),
            "the entity c is said to be the body cube_boddy, which the scene's model does not have; did you "
            "mean cube_body?");
}

TEST(SceneModel, AMistakeInTheModelIsToldWithItsLine) {
  SceneSource source = SmallWorld();
  source.model_text.replace(source.model_text.find("type=\"plane\""), 12, "typo=\"plane\"");
  EXPECT_THAT(LoadTrouble(source),
              AllOf(HasSubstr("cannot load the scene's model"), HasSubstr("typo"), HasSubstr("line 10")));
  EXPECT_EQ(LoadTrouble(source).find('\n'), std::string::npos);
}

TEST(SceneModel, NothingIsReadFromTheDisk) {
  SceneSource source = SmallWorld();
  source.files.clear();
  EXPECT_EQ(LoadTrouble(source),
            "the scene's model names the file meshes/brick.msh, which is not among the files given with it");
}

TEST(SceneModel, AFileNamedByAnIncludedFileMustBeGivenToo) {
  SceneSource source = SmallWorld();
  const std::size_t asset = source.model_text.find("<asset>");
  source.model_text.insert(asset, "<!-- file=\"not a file\" --> <include file=\"more.xml\"/>");
  source.files.push_back(
      {"more.xml", "<mujoco><asset><texture type='2d' file='wood.png'/></asset></mujoco>"});
  EXPECT_THAT(LoadTrouble(source), HasSubstr("names the file wood.png"));
}

TEST(SceneModel, UnusableFilesAreNamed) {
  SceneSource source = SmallWorld();
  source.files[0].bytes.clear();
  EXPECT_THAT(LoadTrouble(source), HasSubstr("brick.msh cannot be used: it is empty"));
  source = SmallWorld();
  source.files.push_back(source.files[0]);
  EXPECT_THAT(LoadTrouble(source), HasSubstr("brick.msh cannot be used: its name is used twice"));
  source = SmallWorld();
  source.files[0].bytes.resize(20);
  EXPECT_THAT(LoadTrouble(source), HasSubstr("cannot load the scene's model"));
}

TEST(SceneModel, TextThatIsNoModelIsRefused) {
  for (const std::string text :
       {"", "<", "<mujoco", "<mujoco/><", "\xff\xfe", "<mujoco><worldbody><geom size=\"1 1 1\""}) {
    SceneSource source;
    source.model_text = text;
    EXPECT_NE(LoadTrouble(source), "loaded") << text;
  }
}

}  // namespace
}  // namespace aerascope
