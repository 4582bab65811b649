#include "viewer/page/film_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"

namespace aerascope {
namespace {

using nlohmann::json;

std::int64_t Whole(double pixels) {
  constexpr double kFarthest = 1e6;
  return std::isfinite(pixels) ? std::llround(std::clamp(pixels, -kFarthest, kFarthest)) : 0;
}

// The outlines of one camera: each name and each shape once.
class OutlineTable {
 public:
  // Instants in any order; of two at one time the first counts.
  void Add(Time at, const std::vector<StillObject>& objects) {
    const auto [entry, is_new] = at_.try_emplace(at.us, json::array({at.us}));
    if (!is_new) return;
    for (const StillObject& object : objects) {
      entry->second.push_back(NumberOf(names_, Printable(object.name)));
      entry->second.push_back(NumberOf(shapes_, ShapeOf(object)));
    }
  }

  json Data() const {
    json at = json::array();
    for (const auto& [time, entry] : at_) at.push_back(entry);
    return {{"names", InOrder(names_)}, {"shapes", InOrder(shapes_)}, {"at", at}};
  }

 private:
  using Shape = std::vector<std::int64_t>;

  static Shape ShapeOf(const StillObject& object) {
    Shape shape = {Whole(object.label.x), Whole(object.label.y)};
    std::int64_t x = 0, y = 0;
    for (const StillPoint& point : object.outline) {
      shape.push_back(Whole(point.x) - x);
      shape.push_back(Whole(point.y) - y);
      x = Whole(point.x);
      y = Whole(point.y);
    }
    return shape;
  }

  template <class Item>
  static std::size_t NumberOf(std::map<Item, std::size_t>& numbers, Item item) {
    return numbers.try_emplace(std::move(item), numbers.size()).first->second;
  }
  template <class Item>
  static json InOrder(const std::map<Item, std::size_t>& numbers) {
    json list = json::array();
    for (std::size_t i = 0; i < numbers.size(); ++i) list.push_back(nullptr);
    for (const auto& [item, number] : numbers) list[number] = item;
    return list;
  }

  std::map<std::string, std::size_t> names_;
  std::map<Shape, std::size_t> shapes_;
  std::map<std::int64_t, json> at_;
};

json StillData(const Still& still, const std::string& block) {
  return {{"at", still.at.us}, {"until", std::max(still.until, still.at).us}, {"image", block}};
}

json VideoData(const FilmVideo& video, const std::string& block) {
  return {{"block", block},
          {"type", video.mime},
          {"from", video.from.us},
          {"picture", video.picture.us},
          {"pictures", video.pictures},
          {"width", video.width},
          {"height", video.height}};
}

}  // namespace

json FilmData(const ReportFrames& frames, const std::vector<std::string>& blocks) {
  auto block = blocks.begin();
  json stills = json::array();
  OutlineTable outlines;
  for (const Still& still : frames.stills) {
    stills.push_back(StillData(still, *block++));
    if (frames.outlines.empty()) outlines.Add(still.at, still.objects);
  }
  for (const OutlinesAt& entry : frames.outlines) outlines.Add(entry.at, entry.objects);
  json views = json::array();
  for (const FilmView& view : frames.views) {
    json of_view = json::array();
    OutlineTable over_view;
    for (const Still& still : view.stills) {
      of_view.push_back(StillData(still, *block++));
      over_view.Add(still.at, still.objects);
    }
    views.push_back({{"id", Printable(view.id)},
                     {"title", Printable(view.title)},
                     {"stills", std::move(of_view)},
                     {"outlines", over_view.Data()}});
  }
  std::string note = Printable(frames.note);
  if (frames.stills.empty() && note.empty()) note = "This report has no frames.";
  json film = {{"width", frames.width},
               {"height", frames.height},
               {"stills", std::move(stills)},
               {"outlines", outlines.Data()},
               {"camera", {{"id", Printable(frames.camera_id)}, {"title", Printable(frames.camera_title)}}},
               {"views", std::move(views)},
               {"note", note}};
  if (frames.video) film["video"] = VideoData(*frames.video, *block);
  return film;
}

}  // namespace aerascope
