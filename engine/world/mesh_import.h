// Reads a triangle mesh in any format assimp knows and gives it in MuJoCo's own binary format (MSH), all
// objects of the file merged into one. MuJoCo itself reads only the first object of an OBJ file, and no
// Collada or glTF at all.
#pragma once

#include <string>

#include "engine/base/result.h"

namespace aerascope {

// `bytes` is the file's content; `name` is used for its ending and in errors. Coordinates stay as in the
// file.
Result<std::string> ConvertMesh(const std::string& bytes, const std::string& name);

}  // namespace aerascope
