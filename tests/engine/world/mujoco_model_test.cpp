// Packing and loading models: everything a model names comes along, and trouble is one sentence.
#include "engine/world/mujoco_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace aerascope {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string LoadError(const std::string& text, std::vector<WorldAsset> files = {}) {
  const Result<PackedModel> packed = PackModelText(text, files);
  if (!packed) return packed.error().message;
  const Result<ModelPointer> model = LoadModel(*packed);
  return model ? "" : model.error().message;
}

TEST(PackModel, TheTabletopIsSelfContained) {
  const Result<PackedModel> packed = PackModelFile(AERASCOPE_SOURCE_DIR "/assets/worlds/tabletop/scene.xml");
  ASSERT_TRUE(packed.ok()) << packed.error().message;

  const Result<ModelPointer> model = LoadModel({"copy", packed->text, packed->assets});

  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ((*model)->nmesh, static_cast<int>(packed->assets.size()));
  for (const WorldAsset& asset : packed->assets) EXPECT_THAT(asset.name, testing::EndsWith(".msh"));
  EXPECT_THAT(packed->text, Not(HasSubstr(".obj")));
}

TEST(PackModel, PackingAPackedModelChangesNothing) {
  const Result<PackedModel> once = PackModelFile(AERASCOPE_SOURCE_DIR "/assets/worlds/tabletop/scene.xml");
  ASSERT_TRUE(once.ok());
  const Result<PackedModel> twice = PackModelText(once->text, once->assets);
  ASSERT_TRUE(twice.ok()) << twice.error().message;
  EXPECT_EQ(once->text, twice->text);
  EXPECT_EQ(once->assets, twice->assets);
}

TEST(PackModel, AMeshKeepsTheNameItHadByItsFile) {
  const std::string text =
      "<mujoco><!-- <mesh file='not_me.obj'/> --><asset><mesh file='a/part.obj'/><mesh name=\"other\" "
      "file='b/part.obj'/></asset>"
      "<worldbody><geom type='mesh' mesh='part'/><geom type='mesh' mesh='other'/></worldbody></mujoco>";
  const std::vector<WorldAsset> files{{"part.obj", kTetrahedron}};

  const Result<PackedModel> packed = PackModelText(text, files);

  ASSERT_TRUE(packed.ok()) << packed.error().message;
  ASSERT_EQ(packed->assets.size(), 2u) << "equal names in different folders are different files";
  EXPECT_EQ(packed->assets[0].name, "part.msh");
  EXPECT_EQ(packed->assets[1].name, "part_2.msh");
  const Result<ModelPointer> model = LoadModel(*packed);
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ((*model)->nmesh, 2);
}

TEST(PackModel, IncludedFilesComeAlong) {
  const std::vector<WorldAsset> files{{"things.xml",
                                       "<mujoco><asset><mesh file='part.obj'/></asset><worldbody><geom "
                                       "type='mesh' mesh='part'/></worldbody></mujoco>"},
                                      {"part.obj", kTetrahedron}};

  const Result<PackedModel> packed = PackModelText("<mujoco><include file='things.xml'/></mujoco>", files);

  ASSERT_TRUE(packed.ok()) << packed.error().message;
  const Result<ModelPointer> model = LoadModel(*packed);
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_EQ((*model)->nmesh, 1);
}

TEST(PackModel, AFileThatIncludesItselfEndsInAnError) {
  const std::vector<WorldAsset> files{{"loop.xml", "<mujoco><include file='loop.xml'/></mujoco>"}};
  EXPECT_NE(LoadError("<mujoco><include file='loop.xml'/></mujoco>", files), "");
}

TEST(PackModel, AMissingMeshIsNamed) {
  const Result<PackedModel> packed =
      PackModelText("<mujoco><asset><mesh file='gone.obj'/></asset></mujoco>", {});
  ASSERT_FALSE(packed.ok());
  EXPECT_THAT(packed.error().message, HasSubstr("gone.obj"));
}

TEST(PackModel, AMissingFileOrAFolderIsAnError) {
  EXPECT_THAT(PackModelFile("/nonexistent/scene.xml").error().message, HasSubstr("/nonexistent/scene.xml"));
  EXPECT_THAT(PackModelFile(AERASCOPE_SOURCE_DIR).error().message, HasSubstr("folder"));
}

TEST(LoadModel, AnUnknownAttributeIsReportedWithItsLine) {
  const std::string message =
      LoadError("<mujoco>\n<worldbody>\n<geom type=\"box\" sise=\"1 1 1\"/>\n</worldbody>\n</mujoco>");
  EXPECT_THAT(message, AllOf(HasSubstr("sise"), HasSubstr("line 3"), Not(HasSubstr("\n"))));
}

TEST(LoadModel, LinesAreThoseOfTheOriginalAlsoAfterMeshesWereRenamed) {
  const std::string text =
      "<mujoco>\n<asset>\n<mesh\n file='part.obj'/>\n</asset>\n<worldbody>\n<geom type='mesh' "
      "mash='part'/>\n</worldbody>\n</mujoco>";
  EXPECT_THAT(LoadError(text, {{"part.obj", kTetrahedron}}), AllOf(HasSubstr("mash"), HasSubstr("line 7")));
}

TEST(LoadModel, BrokenTextIsASentenceNotACrash) {
  const std::vector<std::string> broken{"",
                                        " ",
                                        "<",
                                        "<mujoco",
                                        "<mujoco>",
                                        "no xml",
                                        "<mujoco><geom",
                                        "<mujoco a='",
                                        "<a/>",
                                        "<mujoco><worldbody><geom size='x'/></worldbody></mujoco>",
                                        "<mujoco><asset><mesh file=''/></asset></mujoco>",
                                        std::string("\0\0", 2)};
  for (const std::string& text : broken) {
    const std::string message = LoadError(text);
    EXPECT_NE(message, "") << text;
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << text;
  }
}

}  // namespace
}  // namespace aerascope
