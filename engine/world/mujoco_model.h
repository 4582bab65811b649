// Loading MuJoCo models from memory, and packing a model file with everything it names into such a form.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/world/world.h"

namespace aerascope {

struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPointer = std::unique_ptr<mjModel, MujocoDeleter>;
using DataPointer = std::unique_ptr<mjData, MujocoDeleter>;

// An MJCF text and the files it names, ready for mj_loadXML with a virtual file system: meshes are in
// MuJoCo's own format. Lines are as in the original text, so that MuJoCo's error messages stay true.
struct PackedModel {
  std::string name;  // of the file, for messages
  std::string text;
  std::vector<WorldAsset> assets;  // sorted by name
};

// Reads the file and everything it names (meshes through assimp, textures, height fields, included files).
Result<PackedModel> PackModelFile(const std::string& path);
// The same, the files being given by name.
Result<PackedModel> PackModelText(const std::string& text, std::span<const WorldAsset> files);

// Compiles the model. Errors name the file and MuJoCo's line.
Result<ModelPointer> LoadModel(const PackedModel& packed);

}  // namespace aerascope
