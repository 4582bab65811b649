// Bytes as they stand inside an HTML page: compressed, in base64, or escaped.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

std::string Base64(std::string_view bytes);

// A gzip stream without name and time, so that equal bytes give equal streams.
Result<std::string> Gzip(std::string_view bytes);

// Text as HTML text or attribute value.
std::string EscapeHtml(std::string_view text);

// The bytes that hexadecimal digits stand for; only digits in pairs.
std::string BytesOfHex(std::string_view digits);

}  // namespace aerascope
