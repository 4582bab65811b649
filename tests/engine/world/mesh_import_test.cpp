// Meshes of common formats become MuJoCo's own format, whole.
#include "engine/world/mesh_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

namespace aerascope {
namespace {

using testing::HasSubstr;

constexpr const char* kTwoTetrahedra = R"(o first
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
o second
v 2 0 0
v 3 0 0
v 2 1 0
v 2 0 1
f 5 7 6
f 5 6 8
f 5 8 7
f 6 7 8
)";

struct MshHeader {
  std::int32_t points = 0, normals = 0, texture_coordinates = 0, faces = 0;
};

MshHeader HeaderOf(const std::string& msh) {
  MshHeader header;
  EXPECT_GE(msh.size(), sizeof(header));
  std::memcpy(&header, msh.data(), sizeof(header));
  EXPECT_EQ(msh.size(), sizeof(header) + 12u * (header.points + header.normals + header.faces));
  return header;
}

TEST(ConvertMesh, AllObjectsOfAFileAreMerged) {
  const Result<std::string> mesh = ConvertMesh(kTwoTetrahedra, "pair.obj");

  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  const MshHeader header = HeaderOf(*mesh);
  EXPECT_EQ(header.faces, 8);
  EXPECT_EQ(header.points, header.normals);
  EXPECT_EQ(header.points, 24) << "edges sharper than the smoothing angle keep a normal for each face";
}

TEST(ConvertMesh, AsciiStlWhichMujocoCannotReadIsFine) {
  const std::string stl =
      "solid t\n"
      "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
      "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
      "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
      "endsolid t\n";

  const Result<std::string> mesh = ConvertMesh(stl, "t.stl");

  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(HeaderOf(*mesh).faces, 4);
}

TEST(ConvertMesh, GarbageIsAnErrorThatNamesTheFile) {
  for (const char* name : {"noise.obj", "noise.glb", "noise.dae", "noise.stl", "noise", "noise.xyz"}) {
    const Result<std::string> mesh = ConvertMesh("this is no mesh \x01\x02", name);
    ASSERT_FALSE(mesh.ok()) << name;
    EXPECT_THAT(mesh.error().message, HasSubstr(name));
  }
  EXPECT_FALSE(ConvertMesh("", "empty.obj").ok());
}

TEST(ConvertMesh, TheSameBytesGiveTheSameBytes) {
  EXPECT_EQ(*ConvertMesh(kTwoTetrahedra, "pair.obj"), *ConvertMesh(kTwoTetrahedra, "other.obj"));
}

}  // namespace
}  // namespace aerascope
