#include "engine/world/mesh_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdint>
#include <cstring>
#include <vector>

namespace aerascope {
namespace {

constexpr std::size_t kMujocoMaxFaces = 200'000;
constexpr float kSmoothingAngleDegrees = 40;  // edges sharper than this stay visible

struct Triangles {
  std::vector<float> points;
  std::vector<float> normals;
  std::vector<std::int32_t> faces;
};

void Append(const aiVector3D& vector, std::vector<float>& out) {
  out.insert(out.end(), {vector.x, vector.y, vector.z});
}

Triangles Merged(const aiScene& scene) {
  Triangles merged;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    const auto first = static_cast<std::int32_t>(merged.points.size() / 3);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      Append(mesh.mVertices[i], merged.points);
      Append(mesh.HasNormals() ? mesh.mNormals[i] : aiVector3D(0, 0, 1), merged.normals);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines have no surface
      for (unsigned k = 0; k < 3; ++k)
        merged.faces.push_back(first + static_cast<std::int32_t>(face.mIndices[k]));
    }
  }
  return merged;
}

template <class T>
void AppendBytes(const std::vector<T>& values, std::string& out) {
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// MSH: the numbers of points, normals, texture coordinates and faces, then these.
std::string WriteMsh(const Triangles& mesh) {
  std::string out;
  AppendBytes(std::vector<std::int32_t>{static_cast<std::int32_t>(mesh.points.size() / 3),
                                        static_cast<std::int32_t>(mesh.normals.size() / 3), 0,
                                        static_cast<std::int32_t>(mesh.faces.size() / 3)},
              out);
  AppendBytes(mesh.points, out);
  AppendBytes(mesh.normals, out);
  AppendBytes(mesh.faces, out);
  return out;
}

std::string Ending(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(dot + 1);
}

}  // namespace

Result<std::string> ConvertMesh(const std::string& bytes, const std::string& name) {
  Assimp::Importer importer;
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothingAngleDegrees);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                  aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                      aiProcess_GenSmoothNormals | aiProcess_PreTransformVertices,
                                  Ending(name).c_str());
  if (!scene) {
    return Error{name +
                 ": expected a mesh in a format assimp can read, but it says: " + importer.GetErrorString()};
  }
  const Triangles mesh = Merged(*scene);
  const std::size_t faces = mesh.faces.size() / 3;
  if (faces == 0 || faces > kMujocoMaxFaces) {
    return Error{name + ": expected a mesh with 1 to " + std::to_string(kMujocoMaxFaces) +
                 " triangles, found " + std::to_string(faces)};
  }
  return WriteMsh(mesh);
}

}  // namespace aerascope
