#include "viewer/scene/camera.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/base/text.h"
#include "viewer/scene/bounds.h"

namespace aerascope {
namespace {

constexpr std::string_view kFree = "free";
constexpr std::string_view kAbove = "above";
constexpr std::string_view kSide = "side";
constexpr std::string_view kAt = "at:";
constexpr double kFarthest_m = 1e6;
constexpr double kDegree_rad = std::numbers::pi / 180;

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

// Into which direction the default camera looks, as the azimuth of a free one.
double DefaultAzimuth_deg(const SceneModel& model) {
  const mjModel& mujoco = model.mujoco();
  if (!model.cameras().empty()) {
    const int camera = mj_name2id(&mujoco, mjOBJ_CAMERA, model.cameras().front().c_str());
    // A camera looks along its negative z axis; this is its frame at the initial state.
    const mjtNum* frame = mujoco.cam_mat0 + 9 * camera;
    if (std::hypot(frame[2], frame[5]) > 1e-3) return std::atan2(-frame[5], -frame[2]) / kDegree_rad;
  }
  return FreeCamera(model).azimuth_deg;
}

// How far away the camera must be for the box to fill a picture that is a little wider than high.
double FittingDistance_m(const SceneModel& model, const Camera& camera, const Bounds& bounds) {
  constexpr double kAspect = 1.6;
  constexpr double kMargin = 1.06;
  const double azimuth_rad = camera.azimuth_deg * kDegree_rad;
  const double elevation_rad = camera.elevation_deg * kDegree_rad;
  const std::array<double, 3> forward{std::cos(elevation_rad) * std::cos(azimuth_rad),
                                      std::cos(elevation_rad) * std::sin(azimuth_rad),
                                      std::sin(elevation_rad)};
  const std::array<double, 3> right{std::sin(azimuth_rad), -std::cos(azimuth_rad), 0};
  const std::array<double, 3> up{-std::sin(elevation_rad) * std::cos(azimuth_rad),
                                 -std::sin(elevation_rad) * std::sin(azimuth_rad), std::cos(elevation_rad)};
  const double slope = std::tan(model.mujoco().vis.global.fovy * kDegree_rad / 2);
  double distance_m = 0.01;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double along_m = 0, across_m = 0, upwards_m = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double half_m =
          (bounds.high_m[axis] - bounds.low_m[axis]) / 2 * ((corner >> axis & 1u) != 0 ? 1 : -1);
      along_m += half_m * forward[axis];
      across_m += half_m * right[axis];
      upwards_m += half_m * up[axis];
    }
    const double height_m = std::max(std::abs(upwards_m), std::abs(across_m) / kAspect);
    distance_m = std::max(distance_m, kMargin * height_m / slope - along_m);
  }
  return distance_m;
}

Camera Above(const SceneModel& model) {
  Camera camera = FreeCamera(model);
  camera.azimuth_deg = DefaultAzimuth_deg(model);
  camera.elevation_deg = -89;
  if (const auto bounds = BoundsAtFirst(model)) {
    camera.look_at_m = bounds->Middle();
    camera.distance_m = FittingDistance_m(model, camera, *bounds);
  }
  return camera;
}

// From the right of who looks through the default camera.
Camera Side(const SceneModel& model) {
  Camera camera = FreeCamera(model);
  camera.azimuth_deg = DefaultAzimuth_deg(model) + 90;
  camera.elevation_deg = -12;
  if (const auto bounds = BoundsAtFirst(model)) {
    camera.look_at_m = bounds->Middle();
    camera.distance_m = FittingDistance_m(model, camera, *bounds);
  }
  return camera;
}

Camera At(const SceneModel& model, int entity) {
  Camera camera = FreeCamera(model);
  camera.follow = model.entities()[static_cast<std::size_t>(entity)].entity;
  camera.azimuth_deg = DefaultAzimuth_deg(model) + 30;
  camera.elevation_deg = -15;
  // Room around it for what it meets.
  constexpr double kRoom = 1.3;
  if (const auto bounds = BoundsAtFirst(model, entity)) {
    camera.look_at_m = bounds->Middle();
    camera.distance_m = kRoom * FittingDistance_m(model, camera, *bounds);
  }
  return camera;
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
  if (text == kAbove) return Above(model);
  if (text == kSide) return Side(model);
  if (text.starts_with(kAt)) {
    const std::string_view name = text.substr(kAt.size());
    const int entity = model.FindEntity(name);
    if (entity >= 0) return At(model, entity);
    std::vector<std::string> names;
    for (const SceneEntity& one : model.entities()) names.push_back(one.entity);
    return Error{"the scene has no entity named " + Printable(name) + " that a camera could follow; it has " +
                 (names.empty() ? "none" : Join(names, ", "))};
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
               (known.empty() ? "" : Join(known, ", ") + ", ") + "above, side, at:ENTITY and free"};
}

Result<std::vector<Camera>> ParseCameras(const SceneModel& model, std::string_view text) {
  // Numbers belong to the free camera in front of them.
  std::vector<std::string> words;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(','));
    const bool number = !words.empty() && words.back().starts_with("free:") && Numbers(word);
    number ? words.back().append(",").append(word) : words.emplace_back(word);
    if (word.size() + 1 == rest.size()) words.emplace_back();
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
  }
  if (words.empty()) words.emplace_back();
  std::vector<Camera> cameras;
  for (const std::string& word : words) {
    if (word.empty())
      return Error{"the cameras " + Printable(text) +
                   " are not understood: expected names with a comma between"};
    Result<Camera> camera = ParseCamera(model, word);
    if (!camera) return camera.error();
    if (std::find(cameras.begin(), cameras.end(), *camera) != cameras.end())
      return Error{"the camera " + Printable(word) + " is named twice"};
    cameras.push_back(*std::move(camera));
  }
  return cameras;
}

std::string TitleOf(const SceneModel& model, const Camera& camera) {
  if (!camera.name.empty()) return camera.name;
  if (!camera.follow.empty()) return "at " + camera.follow;
  for (const std::string_view word : {kAbove, kSide, kFree}) {
    const Result<Camera> known = ParseCamera(model, word);
    if (known && *known == camera) return std::string(word);
  }
  return ToText(camera);
}

std::string ToText(const Camera& camera) {
  if (!camera.name.empty()) return camera.name;
  if (!camera.follow.empty()) return std::string(kAt) + camera.follow;
  std::vector<std::string> numbers;
  for (const double number : {camera.azimuth_deg, camera.elevation_deg, camera.distance_m,
                              camera.look_at_m[0], camera.look_at_m[1], camera.look_at_m[2]}) {
    numbers.push_back(FormatNumber(number));
  }
  return "free:" + Join(numbers, ",");
}

}  // namespace aerascope
