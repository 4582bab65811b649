// SVG to PNG by librsvg and cairo. The same SVG gives the same bytes on the same machine; the PNG holds no
// times, names or other words. Nothing outside the SVG is read: pictures must be inside it as data.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

inline constexpr long long kMaxPngPixels = 200'000'000;

// PNG bytes, `scale` pixels for each unit of the SVG. White where the SVG draws nothing.
Result<std::string> SvgToPng(std::string_view svg, double scale = 1);

}  // namespace aerascope
