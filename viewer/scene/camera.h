// A Camera says from where a scene is looked at: one that the model names, or a free one that looks at a
// point.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "viewer/scene/scene_model.h"

namespace aerascope {

struct Camera {
  // A camera of the model; when empty, the free camera below is meant.
  std::string name;

  // Where the free camera looks, from how far, and in which direction: azimuth counter-clockwise from the
  // world's x axis, elevation above the horizon (negative: looking down).
  std::array<double, 3> look_at_m{0, 0, 0};
  double distance_m = 1;
  double azimuth_deg = 90;
  double elevation_deg = -45;
  // An entity that the free camera goes along with: its middle is looked at instead of look_at_m.
  std::string follow;

  bool operator==(const Camera&) const = default;
};

// The first named camera, or the model's own free camera if none has a name.
Camera DefaultCamera(const SceneModel& model);

// Reads a camera as users write it: "" (the default), the name of a camera, "free" (the model's own free
// camera), "free:AZIMUTH,ELEVATION,DISTANCE" or "free:AZIMUTH,ELEVATION,DISTANCE,X,Y,Z", in degrees and
// metres; and views that any scene has: "above" and "side" show all entities as they stand at first, turned
// as the default camera is, "at:ENTITY" goes along with one. A camera that the model names comes first.
Result<Camera> ParseCamera(const SceneModel& model, std::string_view text);

// Several of them, separated by commas: "film,above,free:90,-20,1.5". At least one, none twice.
Result<std::vector<Camera>> ParseCameras(const SceneModel& model, std::string_view text);

// What ParseCamera reads.
std::string ToText(const Camera& camera);

// What a button says: "film", "above", "at h"; a free camera without a name of its own: its numbers.
std::string TitleOf(const SceneModel& model, const Camera& camera);

}  // namespace aerascope
