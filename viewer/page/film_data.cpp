#include "viewer/page/film_data.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"

namespace aerascope {
namespace {

using nlohmann::json;

double Tenths(double pixels) {
  return std::round(pixels * 10) / 10;
}

json ObjectData(const StillObject& object) {
  json outline = json::array();
  for (const StillPoint& point : object.outline) {
    outline.push_back(Tenths(point.x));
    outline.push_back(Tenths(point.y));
  }
  return {{"outline", outline}, {"label", {Tenths(object.label.x), Tenths(object.label.y)}}};
}

}  // namespace

json FilmData(const ReportFrames& frames, const std::vector<std::string>& images) {
  json stills = json::array();
  for (std::size_t i = 0; i < frames.stills.size(); ++i) {
    const Still& still = frames.stills[i];
    json objects = json::object();
    for (const StillObject& object : still.objects) objects[Printable(object.name)] = ObjectData(object);
    stills.push_back({{"at", still.at.us}, {"image", images[i]}, {"objects", objects}});
  }
  std::string note = Printable(frames.note);
  if (frames.stills.empty() && note.empty()) note = "This report has no frames.";
  return {{"width", frames.width}, {"height", frames.height}, {"stills", stills}, {"note", note}};
}

}  // namespace aerascope
