// The small signs of all drawings; each has one meaning everywhere.
//
// Star: made by analogy. Filled circle: learned. Ring with arc and number: confidence. Check and cross: came
// true or reached, and not. Tag pointing left: goal; tag pointing right: prediction. Bar: command, dashed the
// teacher's. Barred ring and barred end of a link: a veto.
#pragma once

#include "viewer/draw/svg.h"
#include "viewer/layout/geometry.h"

namespace aerascope {

void DrawStar(Svg& svg, Point centre, int radius, std::string_view classes);
void DrawDot(Svg& svg, Point centre, int radius, std::string_view classes);
void DrawCheck(Svg& svg, Point centre, int radius);
void DrawCross(Svg& svg, Point centre, int radius);
// An arrow head whose tip is here, pointing right.
void DrawArrowHead(Svg& svg, Point tip);
// A confidence as a ring in this square, with its number inside; that of a veto is barred and in the colour
// of failure.
void DrawRing(Svg& svg, const Rect& square, double share, bool veto = false);
// The end of a link that forbids what it leads to: a bar across the line, which ends here from the left.
void DrawStop(Svg& svg, Point tip);

enum class TagShape { kBar, kPointsLeft, kPointsRight };
void DrawTag(Svg& svg, const Rect& rect, TagShape shape, std::string_view classes);

// A rectangle whose upper or lower corners are round.
void DrawRoundedBand(Svg& svg, const Rect& rect, int upper_radius, int lower_radius,
                     std::string_view classes);

}  // namespace aerascope
