// A Scene is one moment of an episode as things to draw: shapes with place and colour, lights and a camera,
// computed from a recorded world state without any graphics library. It can be printed as text, and
// viewer/render makes it pixels.
//
// One thread at a time uses a scene. No physics is run: places follow from the recorded positions alone.
#pragma once

#include <memory>
#include <string>

#include "engine/base/result.h"
#include "engine/event/event_body.h"
#include "viewer/scene/camera.h"
#include "viewer/scene/scene_model.h"

struct mjvScene_;  // MuJoCo's abstract scene

namespace aerascope {

class Scene {
 public:
  // Shows the model's initial state through its default camera.
  static Result<Scene> Create(std::shared_ptr<const SceneModel> model);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  // Shows this state through this camera. Fails, and shows what it showed before, if the state does not fit
  // the model or the model has no such camera.
  Status Show(const WorldStateRecorded& state, const Camera& camera);

  const std::shared_ptr<const SceneModel>& model() const;
  const Camera& camera() const;
  const mjvScene_& mujoco() const;

 private:
  struct Content;
  explicit Scene(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

// The whole scene for people and tests: a line for the camera, each light and each shape, in the model's
// order; metres and turns (unit quaternion w x y z) rounded to 0.0001, so that it is the same on every
// machine.
std::string ToText(const Scene& scene);

}  // namespace aerascope
