#include "viewer/draw/svg.h"

#include <cassert>
#include <cmath>

#include "engine/base/markup.h"

namespace aerascope {

std::string SvgNumber(double value) {
  if (!std::isfinite(value)) return "0";
  constexpr double kLargest = 1e9;
  const auto hundredths = std::llround(std::fmin(std::fmax(value, -kLargest), kLargest) * 100);
  const long long size = hundredths < 0 ? -hundredths : hundredths;
  std::string text = (hundredths < 0 ? "-" : "") + std::to_string(size / 100);
  const long long fraction = size % 100;
  if (fraction == 0) return text;
  text += fraction < 10 ? ".0" : ".";
  text += std::to_string(fraction % 10 == 0 ? fraction / 10 : fraction);
  return text;
}

void Svg::Begin(std::string_view element, const SvgAttributes& attributes) {
  content_ += '<';
  content_ += element;
  for (const SvgAttribute& attribute : attributes) {
    content_ += ' ';
    content_ += attribute.name;
    content_ += "=\"";
    content_ += EscapeMarkup(attribute.value);
    content_ += '"';
  }
}

void Svg::Open(std::string_view element, const SvgAttributes& attributes) {
  Begin(element, attributes);
  content_ += ">\n";
  open_.emplace_back(element);
}

void Svg::Close() {
  assert(!open_.empty());
  content_ += "</" + open_.back() + ">\n";
  open_.pop_back();
}

void Svg::Leaf(std::string_view element, const SvgAttributes& attributes) {
  Begin(element, attributes);
  content_ += "/>\n";
}

void Svg::Words(std::string_view element, std::string_view text, const SvgAttributes& attributes) {
  Begin(element, attributes);
  content_ += '>';
  content_ += EscapeMarkup(text);
  content_ += "</";
  content_ += element;
  content_ += ">\n";
}

void Svg::Append(const Svg& other) {
  assert(other.open_.empty());
  content_ += other.content_;
}

void Svg::Text(double x, double y, std::string_view text, const TextStyle& style) {
  Text(x, y, std::vector<TextRun>{{std::string(text), ""}}, style);
}

void Svg::Text(double x, double y, const std::vector<TextRun>& runs, const TextStyle& style) {
  SvgAttributes attributes = {{"x", x}, {"y", y}};
  if (!style.classes.empty()) attributes.emplace_back("class", style.classes);
  // A style sheet has more weight than an attribute, so the size is given as style.
  if (style.size != 12) attributes.emplace_back("style", "font-size:" + SvgNumber(style.size) + "px");
  if (style.anchor == TextAnchor::kMiddle) attributes.emplace_back("text-anchor", "middle");
  if (style.anchor == TextAnchor::kEnd) attributes.emplace_back("text-anchor", "end");
  Begin("text", attributes);
  content_ += '>';
  for (const TextRun& run : runs) {
    if (run.classes.empty()) {
      content_ += EscapeMarkup(run.text);
    } else {
      content_ += "<tspan class=\"" + EscapeMarkup(run.classes) + "\">" + EscapeMarkup(run.text) + "</tspan>";
    }
  }
  content_ += "</text>\n";
}

void Svg::Line(Point from, Point to, std::string_view classes) {
  Leaf("line", {{"x1", from.x}, {"y1", from.y}, {"x2", to.x}, {"y2", to.y}, {"class", std::string(classes)}});
}

void Svg::Box(const Rect& rect, std::string_view classes, int radius) {
  // Half a pixel in, so that outlines of one pixel are crisp.
  SvgAttributes attributes = {
      {"x", rect.x + 0.5}, {"y", rect.y + 0.5}, {"width", rect.width}, {"height", rect.height}};
  if (radius > 0) attributes.emplace_back("rx", radius);
  attributes.emplace_back("class", std::string(classes));
  Leaf("rect", attributes);
}

void Svg::Path(std::string_view data, std::string_view classes) {
  Leaf("path", {{"d", std::string(data)}, {"class", std::string(classes)}});
}

std::string SvgDocument(Size size, std::string_view title, std::string_view style, std::string_view content) {
  Svg head;
  head.Words("title", title);
  std::string document = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(size.width) +
                         "\" height=\"" + std::to_string(size.height) + "\" viewBox=\"0 0 " +
                         std::to_string(size.width) + " " + std::to_string(size.height) +
                         "\" role=\"img\" xml:space=\"preserve\">\n";
  document += head.content();
  document += "<style>";
  document += style;
  document += "</style>\n";
  document += content;
  document += "</svg>\n";
  return document;
}

}  // namespace aerascope
