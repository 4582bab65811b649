// Writing files so that nothing is ever half written: beside the target first, then renamed over it.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

// Whether a file could be made or replaced at path, for commands that work long before they write. "-" always
// can.
Status CheckWritable(const std::string& path);

// Writes bytes to path; on any trouble the old file, if there was one, is left as it was. "-" is standard
// output.
Status WriteFile(const std::string& path, std::string_view bytes);

Result<std::string> ReadFile(const std::string& path);

// Makes the folder and those above it.
Status MakeFolder(const std::string& path);

// Without folder: "out/run.episode" -> "run.episode".
std::string FileName(const std::string& path);

}  // namespace aerascope
