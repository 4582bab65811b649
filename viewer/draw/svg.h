// Svg writes one SVG document or a piece of one, element by element.
//
// Always true: (1) what it writes is well-formed XML, whatever text it is given: markup is escaped, and
// characters that XML forbids, control characters and bidirectional overrides are written out visibly
// (Printable); (2) numbers have at most two decimals and no locale.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/layout/geometry.h"

namespace aerascope {

// At most two decimals, "." as point, never "-0".
std::string SvgNumber(double value);

struct SvgAttribute {
  std::string_view name;
  std::string value;
  SvgAttribute(std::string_view n, std::string v) : name(n), value(std::move(v)) {}
  SvgAttribute(std::string_view n, const char* v) : name(n), value(v) {}
  SvgAttribute(std::string_view n, double v) : name(n), value(SvgNumber(v)) {}
  SvgAttribute(std::string_view n, int v) : name(n), value(std::to_string(v)) {}
};
using SvgAttributes = std::vector<SvgAttribute>;

// A piece of a line of text in its own style.
struct TextRun {
  std::string text;
  std::string classes;
};

enum class TextAnchor { kStart, kMiddle, kEnd };

struct TextStyle {
  std::string classes;
  double size = 12;
  TextAnchor anchor = TextAnchor::kStart;
};

class Svg {
 public:
  void Open(std::string_view element, const SvgAttributes& attributes = {});
  void Close();  // the element opened last
  void Leaf(std::string_view element, const SvgAttributes& attributes);
  // An element with text and nothing else inside: title, desc, style.
  void Words(std::string_view element, std::string_view text, const SvgAttributes& attributes = {});

  void Text(double x, double y, std::string_view text, const TextStyle& style = {});
  void Text(double x, double y, const std::vector<TextRun>& runs, const TextStyle& style = {});
  void Line(Point from, Point to, std::string_view classes);
  void Box(const Rect& rect, std::string_view classes, int radius = 0);
  void Path(std::string_view data, std::string_view classes);

  // What another one has written; all its elements are closed.
  void Append(const Svg& other);

  // What is written so far; complete when all elements are closed.
  const std::string& content() const { return content_; }

 private:
  void Begin(std::string_view element, const SvgAttributes& attributes);

  std::string content_;
  std::vector<std::string> open_;
};

// A document of this size around content made with Svg; `style` is CSS, `title` what a screen reader says.
std::string SvgDocument(Size size, std::string_view title, std::string_view style, std::string_view content);

}  // namespace aerascope
