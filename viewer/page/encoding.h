// Bytes as they stand inside an HTML page: compressed, or in base64.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

std::string Base64(std::string_view bytes);

// A gzip stream without name and time, so that equal bytes give equal streams.
Result<std::string> Gzip(std::string_view bytes);

// The bytes that hexadecimal digits stand for; only digits in pairs.
std::string BytesOfHex(std::string_view digits);

}  // namespace aerascope
