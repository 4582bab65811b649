#include "viewer/draw/still_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/query/describe.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

std::string Base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[(group >> (18 - 6 * k)) & 63u] : '=';
  }
  return text;
}

// Width and height as the header of a PNG says.
std::optional<Size> SizeOfPng(std::string_view png) {
  static constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (png.size() < 33 || png.substr(0, 8) != kSignature || png.substr(12, 4) != "IHDR") return std::nullopt;
  const auto number = [&png](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = (value << 8) | static_cast<unsigned char>(png[at + i]);
    return value;
  };
  constexpr unsigned kMost = 32767;
  if (number(16) < 1 || number(20) < 1 || number(16) > kMost || number(20) > kMost) return std::nullopt;
  return Size{static_cast<int>(number(16)), static_cast<int>(number(20))};
}

bool ContainsWord(std::string_view text, std::string_view word) {
  const auto part_of_word = [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  if (word.empty()) return false;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !part_of_word(text[at - 1])) && (end == text.size() || !part_of_word(text[end])))
      return true;
  }
  return false;
}

void DrawOutline(Svg& svg, const SheetObject& object, double unit, const Theme& theme) {
  if (object.outline.size() <= 2) return;
  std::string path;
  for (const SheetPoint& point : object.outline) {
    path += (path.empty() ? "M" : "L") + SvgNumber(point.x) + " " + SvgNumber(point.y);
  }
  for (const bool halo : {true, false}) {
    svg.Leaf("path", {{"d", path + "z"},
                      {"fill", "none"},
                      {"stroke", halo ? theme.surface : theme.ask},
                      {"stroke-linejoin", "round"},
                      {"stroke-width", (halo ? 5 : 2.5) * unit}});
  }
}

void DrawName(Svg& svg, const std::string& name, SheetPoint at, double unit, const Theme& theme) {
  const std::string size = "font-size:" + SvgNumber(14 * unit) + "px";
  svg.Words("text", name,
            {{"x", at.x},
             {"y", at.y},
             {"class", "d-b"},
             {"text-anchor", "middle"},
             {"style", size + ";fill:none;stroke:" + theme.surface +
                           ";stroke-linejoin:round;stroke-width:" + SvgNumber(4 * unit) + "px"}});
  svg.Words("text", name,
            {{"x", at.x}, {"y", at.y}, {"class", "d-b d-ask"}, {"text-anchor", "middle"}, {"style", size}});
}

// Names lie over all outlines, and not on each other: the lower one moves down.
void DrawNames(Svg& svg, std::vector<const SheetObject*> objects, double unit, const Theme& theme) {
  struct Placed {
    SheetPoint at;
    double half;
  };
  std::stable_sort(objects.begin(), objects.end(),
                   [](const SheetObject* a, const SheetObject* b) { return a->label.y < b->label.y; });
  std::vector<Placed> placed;
  const double line = 16 * unit;
  for (const SheetObject* object : objects) {
    const std::string name = FitText(object->name, 160, 14, TextWeight::kBold);
    Placed here{object->label, TextWidth(name, 14, TextWeight::kBold) * unit / 2};
    for (const Placed& other : placed) {
      const bool beside = std::abs(other.at.x - here.at.x) >= other.half + here.half;
      if (!beside && std::abs(other.at.y - here.at.y) < line) here.at.y = other.at.y + line;
    }
    DrawName(svg, name, here.at, unit, theme);
    placed.push_back(here);
  }
}

}  // namespace

Status DrawStill(Svg& svg, const SheetFrame& frame, const Rect& place, std::string_view words,
                 const Theme& theme) {
  const std::optional<Size> size = SizeOfPng(frame.png);
  if (!size) {
    return Error{"the picture for " + SecondsText(frame.at) +
                 " of the sheet is not a PNG; expected its signature and header at the front"};
  }
  svg.Open("svg", {{"x", place.x},
                   {"y", place.y},
                   {"width", place.width},
                   {"height", place.height},
                   {"viewBox", "0 0 " + std::to_string(size->width) + " " + std::to_string(size->height)},
                   {"preserveAspectRatio", "xMidYMid slice"}});
  svg.Leaf("image", {{"width", size->width},
                     {"height", size->height},
                     {"href", "data:image/png;base64," + Base64(frame.png)}});
  // Lines and letters keep their size on paper whatever the size of the still.
  const double unit = std::min(size->width / static_cast<double>(place.width),
                               size->height / static_cast<double>(place.height));
  std::vector<const SheetObject*> named;
  for (const SheetObject& object : frame.objects) {
    if (ContainsWord(words, object.name)) named.push_back(&object);
  }
  for (const SheetObject* object : named) DrawOutline(svg, *object, unit, theme);
  DrawNames(svg, named, unit, theme);
  svg.Close();
  return Ok();
}

}  // namespace aerascope
