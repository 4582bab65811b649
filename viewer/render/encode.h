// Pictures as files in memory. Equal pictures and settings give equal bytes; no time and no program name is
// inside.
#pragma once

#include <functional>
#include <string>

#include "engine/base/result.h"
#include "viewer/render/image.h"

namespace aerascope {

// An image as the bytes of a file. Called from one thread at a time, not always the same one.
using Encoder = std::function<Result<std::string>(const Image&)>;

// Exact pixels. Rendered pictures, being smooth in colour and flat in places, pack best and fastest without
// PNG's filters.
Result<std::string> EncodePng(const Image& image);

struct WebpOptions {
  float quality = 80;  // 0 (smallest) to 100 (best)
  int effort = 4;      // 0 (fastest) to 6 (smallest)
};

// Pixels about as seen, a quarter of the size of PNG. Each side at most 16383.
Result<std::string> EncodeWebp(const Image& image, const WebpOptions& options = {});

}  // namespace aerascope
