#include "viewer/scene/camera.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/text.h"

namespace aerascope {
namespace {

constexpr std::string_view kFree = "free";
constexpr double kFarthest_m = 1e6;

Camera FreeCamera(const SceneModel& model) {
  mjvCamera free;
  mjv_defaultFreeCamera(&model.mujoco(), &free);
  Camera camera;
  camera.look_at_m = {free.lookat[0], free.lookat[1], free.lookat[2]};
  camera.distance_m = free.distance;
  camera.azimuth_deg = free.azimuth;
  camera.elevation_deg = free.elevation;
  return camera;
}

std::optional<std::vector<double>> Numbers(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view word = text.substr(0, text.find(','));
    double number = 0;
    const auto [end, trouble] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (trouble != std::errc() || end != word.data() + word.size() || !(std::abs(number) <= kFarthest_m))
      return std::nullopt;
    numbers.push_back(number);
    if (word.size() == text.size()) return numbers;
    text.remove_prefix(word.size() + 1);
  }
}

}  // namespace

Camera DefaultCamera(const SceneModel& model) {
  if (model.cameras().empty()) return FreeCamera(model);
  Camera camera;
  camera.name = model.cameras().front();
  return camera;
}

Result<Camera> ParseCamera(const SceneModel& model, std::string_view text) {
  if (text.empty()) return DefaultCamera(model);
  const std::vector<std::string>& known = model.cameras();
  if (std::find(known.begin(), known.end(), text) != known.end()) {
    Camera camera;
    camera.name = text;
    return camera;
  }
  Camera camera = FreeCamera(model);
  if (text == kFree) return camera;
  if (text.starts_with("free:")) {
    const std::optional<std::vector<double>> numbers = Numbers(text.substr(kFree.size() + 1));
    if (!numbers || (numbers->size() != 3 && numbers->size() != 6) || (*numbers)[2] <= 0) {
      return Error{"the camera " + Printable(text) +
                   " is not understood: expected free:AZIMUTH,ELEVATION,DISTANCE or "
                   "free:AZIMUTH,ELEVATION,DISTANCE,X,Y,Z in degrees and metres, the distance above 0"};
    }
    camera.azimuth_deg = (*numbers)[0];
    camera.elevation_deg = (*numbers)[1];
    camera.distance_m = (*numbers)[2];
    if (numbers->size() == 6) std::copy(numbers->begin() + 3, numbers->end(), camera.look_at_m.begin());
    return camera;
  }
  return Error{"the scene has no camera named " + Printable(text) + "; it has " +
               (known.empty() ? "" : Join(known, ", ") + " and ") + "free"};
}

std::string ToText(const Camera& camera) {
  if (!camera.name.empty()) return camera.name;
  std::vector<std::string> numbers;
  for (const double number : {camera.azimuth_deg, camera.elevation_deg, camera.distance_m,
                              camera.look_at_m[0], camera.look_at_m[1], camera.look_at_m[2]}) {
    numbers.push_back(FormatNumber(number));
  }
  return "free:" + Join(numbers, ",");
}

}  // namespace aerascope
