#include "viewer/draw/marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

std::string At(double x, double y) {
  return SvgNumber(x) + " " + SvgNumber(y);
}

// A point on a circle, `turn` in whole turns clockwise from the top.
std::string OnCircle(Point centre, double radius, double turn) {
  const double angle_rad = turn * 2 * std::numbers::pi;
  return At(centre.x + radius * std::sin(angle_rad), centre.y - radius * std::cos(angle_rad));
}

}  // namespace

void DrawStar(Svg& svg, Point centre, int radius, std::string_view classes) {
  std::string path;
  for (int corner = 0; corner < 10; ++corner) {
    path += corner == 0 ? "M" : "L";
    path += OnCircle(centre, corner % 2 == 0 ? radius : radius * 0.42, corner / 10.0);
  }
  svg.Path(path + "z", classes);
}

void DrawDot(Svg& svg, Point centre, int radius, std::string_view classes) {
  svg.Leaf("circle", {{"cx", centre.x}, {"cy", centre.y}, {"r", radius}, {"class", std::string(classes)}});
}

void DrawCheck(Svg& svg, Point c, int radius) {
  svg.Path("M" + At(c.x - radius, c.y) + "L" + At(c.x - radius * 0.25, c.y + radius * 0.75) + "L" +
               At(c.x + radius, c.y - radius * 0.75),
           "d-check");
}

void DrawCross(Svg& svg, Point c, int radius) {
  svg.Path("M" + At(c.x - radius, c.y - radius) + "L" + At(c.x + radius, c.y + radius) + "M" +
               At(c.x + radius, c.y - radius) + "L" + At(c.x - radius, c.y + radius),
           "d-cross");
}

void DrawArrowHead(Svg& svg, Point tip) {
  svg.Path("M" + At(tip.x, tip.y) + "l-8 -4v8z", "d-arrow");
}

void DrawRing(Svg& svg, const Rect& square, double share, bool veto) {
  const Point centre = square.centre();
  const int radius = square.width / 2 - 2;
  DrawDot(svg, centre, radius, "d-ring");
  const double part = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  const std::string arc = veto ? "d-arc d-veto" : "d-arc";
  if (part > 0.995) {
    DrawDot(svg, centre, radius, arc);
  } else if (part > 0.005) {
    const std::string size = SvgNumber(radius);
    svg.Path("M" + OnCircle(centre, radius, 0) + "A" + size + " " + size + " 0 " + (part > 0.5 ? "1" : "0") +
                 " 1 " + OnCircle(centre, radius, part),
             arc);
  }
  const double size = radius >= 15 ? 12 : 10;
  svg.Text(centre.x, centre.y + size * 0.36, RingText(share),
           {veto ? "d-b d-fail" : "d-b", size, TextAnchor::kMiddle});
  if (!veto) return;
  for (const double turn : {0.125, 0.625})
    svg.Path("M" + OnCircle(centre, radius - 1, turn) + "L" + OnCircle(centre, radius + 7, turn), "d-bars");
}

void DrawStop(Svg& svg, Point tip) {
  svg.Path("M" + At(tip.x - 2, tip.y - 6) + "v12", "d-bars");
}

void DrawTag(Svg& svg, const Rect& r, TagShape shape, std::string_view classes) {
  if (shape == TagShape::kBar) return svg.Box(r, classes);
  const double tip = std::min(6.0, r.width / 2.0);
  const double x = r.x + 0.5;
  const double y = r.y + 0.5;
  const double w = r.width;
  const double h = r.height;
  if (shape == TagShape::kPointsLeft) {
    svg.Path("M" + At(x, y + h / 2) + "L" + At(x + tip, y) + "H" + SvgNumber(x + w) + "V" + SvgNumber(y + h) +
                 "H" + SvgNumber(x + tip) + "z",
             classes);
  } else {
    svg.Path("M" + At(x, y) + "H" + SvgNumber(x + w - tip) + "L" + At(x + w, y + h / 2) + "L" +
                 At(x + w - tip, y + h) + "H" + SvgNumber(x) + "z",
             classes);
  }
}

void DrawRoundedBand(Svg& svg, const Rect& r, int upper, int lower, std::string_view classes) {
  const double x = r.x + 0.5;
  const double y = r.y + 0.5;
  const auto corner = [](int radius, int dx, int dy) {
    return radius == 0 ? std::string() : "a" + At(radius, radius) + " 0 0 1 " + At(dx * radius, dy * radius);
  };
  svg.Path("M" + At(x, y + upper) + corner(upper, 1, -1) + "H" + SvgNumber(x + r.width - upper) +
               corner(upper, 1, 1) + "V" + SvgNumber(y + r.height - lower) + corner(lower, -1, 1) + "H" +
               SvgNumber(x + lower) + corner(lower, -1, -1) + "z",
           classes);
}

}  // namespace aerascope
