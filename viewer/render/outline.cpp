#include "viewer/render/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/base/text.h"

namespace aerascope {
namespace {

// ---------------------------------------------------------------------------------------------- following a
// border

// Which pixels are the object, within the box around it.
class Mask {
 public:
  Mask(int left, int top, int width, int height)
      : left_(left),
        top_(top),
        width_(width),
        height_(height),
        inside_(static_cast<std::size_t>(width * height), 0) {}

  int left() const { return left_; }
  int top() const { return top_; }
  int width() const { return width_; }
  int height() const { return height_; }

  void Set(int x, int y) { inside_[Index(x, y)] = 1; }
  bool Inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && inside_[Index(x, y)] != 0;
  }

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int left_, top_, width_, height_;
  std::vector<std::uint8_t> inside_;
};

struct Step {
  int dx, dy;
};
// Clockwise as seen, y pointing down.
constexpr std::array<Step, 4> kSteps{Step{1, 0}, Step{0, 1}, Step{-1, 0}, Step{0, -1}};

// The pixels ahead of corner (x, y), to the right and to the left of someone who walks in this direction.
bool AheadRight(const Mask& mask, int x, int y, int direction) {
  static constexpr std::array<Step, 4> kPixel{Step{0, 0}, Step{-1, 0}, Step{-1, -1}, Step{0, -1}};
  return mask.Inside(x + kPixel[static_cast<std::size_t>(direction)].dx,
                     y + kPixel[static_cast<std::size_t>(direction)].dy);
}
bool AheadLeft(const Mask& mask, int x, int y, int direction) {
  return AheadRight(mask, x, y, (direction + 3) % 4);
}

// Walks along the border with the object on the right, from the corner (x, y) to the right, and notes the
// middle of each pixel edge passed: slanted borders come out straight that way. `seen` marks the edges passed
// from left to right.
Ring Follow(const Mask& mask, int x, int y, std::vector<std::uint8_t>& seen) {
  Ring ring;
  const int start_x = x, start_y = y;
  int direction = 0;
  do {
    if (direction == 0) seen[static_cast<std::size_t>(y * mask.width() + x)] = 1;
    const Step step = kSteps[static_cast<std::size_t>(direction)];
    ring.push_back({mask.left() + x + 0.5 * step.dx, mask.top() + y + 0.5 * step.dy});
    x += step.dx;
    y += step.dy;
    if (!AheadRight(mask, x, y, direction)) {
      direction = (direction + 1) % 4;
    } else if (AheadLeft(mask, x, y, direction)) {
      direction = (direction + 3) % 4;
    }
  } while (x != start_x || y != start_y || direction != 0);
  return ring;
}

std::vector<Ring> Borders(const Mask& mask) {
  std::vector<Ring> rings;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(mask.width() * mask.height()), 0);
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const bool upper_border = mask.Inside(x, y) && !mask.Inside(x, y - 1);
      if (upper_border && !seen[static_cast<std::size_t>(y * mask.width() + x)])
        rings.push_back(Follow(mask, x, y, seen));
    }
  }
  return rings;
}

// -------------------------------------------------------------------------------------------------------
// polygons

// Positive for outer borders.
double SignedArea(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PixelPoint& a = ring[i];
    const PixelPoint& b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

double Distance(PixelPoint a, PixelPoint b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

double DistanceToSegment(PixelPoint point, PixelPoint a, PixelPoint b) {
  const double length = Distance(a, b);
  if (length == 0) return Distance(point, a);
  const double along = ((point.x - a.x) * (b.x - a.x) + (point.y - a.y) * (b.y - a.y)) / (length * length);
  const double t = std::clamp(along, 0.0, 1.0);
  return Distance(point, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
}

// Douglas and Peucker's method on points[first..last]: keeps the point farthest from the straight line while
// it is farther than the tolerance, and looks again at both parts.
void KeepCorners(const Ring& points, std::size_t first, std::size_t last, double tolerance,
                 std::vector<bool>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    std::size_t farthest = begin;
    double distance = tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double d = DistanceToSegment(points[i], points[begin], points[end]);
      if (d > distance) {
        distance = d;
        farthest = i;
      }
    }
    if (farthest == begin) continue;
    keep[farthest] = true;
    open.push_back({begin, farthest});
    open.push_back({farthest, end});
  }
}

Ring Simplified(const Ring& ring, double tolerance) {
  Ring closed = ring;
  closed.push_back(ring.front());
  // A closed line has no ends: it is cut at its first point and at the one farthest from that.
  std::size_t opposite = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (Distance(ring[0], ring[i]) > Distance(ring[0], ring[opposite])) opposite = i;
  }
  std::vector<bool> keep(closed.size(), false);
  keep[0] = keep[opposite] = true;
  KeepCorners(closed, 0, opposite, tolerance, keep);
  KeepCorners(closed, opposite, closed.size() - 1, tolerance, keep);
  Ring simple;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (keep[i]) simple.push_back(ring[i]);
  }
  return simple;
}

std::vector<Ring> LargeSimpleRings(std::vector<Ring> rings, const OutlineOptions& options) {
  std::erase_if(rings,
                [&](const Ring& ring) { return std::abs(SignedArea(ring)) < options.smallest_area_px; });
  std::stable_sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) {
    return std::abs(SignedArea(a)) > std::abs(SignedArea(b));
  });
  for (Ring& ring : rings) ring = Simplified(ring, options.tolerance_px);
  std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
  return rings;
}

// ------------------------------------------------------------------------------------------------- pixels of
// entities

// The box around the pixels of one entity.
struct Extent {
  int left = 0, top = 0, right = 0, bottom = 0;  // right and bottom: behind the last
  int pixels = 0;
  std::int64_t sum_x = 0;

  void Add(int x, int y) {
    if (pixels == 0) *this = {x, y, x + 1, y + 1, 0, 0};
    left = std::min(left, x);
    right = std::max(right, x + 1);
    bottom = y + 1;
    ++pixels;
    sum_x += x;
  }
};

template <class Visit>
void ForEachEntityPixel(const SegmentImage& segments, const SceneModel& model, Visit&& visit) {
  std::size_t at = 0;
  for (int y = 0; y < segments.size.height; ++y) {
    for (int x = 0; x < segments.size.width; ++x, ++at) {
      const int entity = segments.geom[at] < 0 ? -1 : model.EntityOfGeom(segments.geom[at]);
      if (entity >= 0) visit(static_cast<std::size_t>(entity), x, y);
    }
  }
}

}  // namespace

std::vector<Outline> TraceOutlines(const SegmentImage& segments, const SceneModel& model,
                                   const OutlineOptions& options) {
  std::vector<Extent> extents(model.entities().size());
  ForEachEntityPixel(segments, model, [&](std::size_t entity, int x, int y) { extents[entity].Add(x, y); });
  std::vector<Mask> masks;
  for (const Extent& e : extents) masks.emplace_back(e.left, e.top, e.right - e.left, e.bottom - e.top);
  ForEachEntityPixel(segments, model, [&](std::size_t entity, int x, int y) {
    masks[entity].Set(x - extents[entity].left, y - extents[entity].top);
  });

  std::vector<Outline> outlines;
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const Extent& e = extents[i];
    std::vector<Ring> rings = LargeSimpleRings(Borders(masks[i]), options);
    if (rings.empty()) continue;
    Outline outline;
    outline.entity = model.entities()[i].entity;
    outline.rings = std::move(rings);
    outline.visible_pixels = e.pixels;
    outline.top_left = {static_cast<double>(e.left), static_cast<double>(e.top)};
    outline.bottom_right = {static_cast<double>(e.right), static_cast<double>(e.bottom)};
    outline.label_anchor = {static_cast<double>(e.sum_x) / e.pixels + 0.5, static_cast<double>(e.top)};
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

std::string SvgPath(const std::vector<Ring>& rings) {
  const auto text = [](double pixels) { return FormatNumber(std::round(pixels * 10) / 10); };
  std::string path;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      path += (i == 0 ? "M" : "L") + text(ring[i].x) + " " + text(ring[i].y);
    path += "Z";
  }
  return path;
}

}  // namespace aerascope
