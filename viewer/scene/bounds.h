// The box around things of a scene, along the world's axes. Private to viewer/scene.
#pragma once

#include <array>
#include <optional>

#include "viewer/scene/scene_model.h"

struct mjData_;  // MuJoCo's state

namespace aerascope {

struct Bounds {
  std::array<double, 3> low_m{};
  std::array<double, 3> high_m{};

  std::array<double, 3> Middle() const;
};

// Of an entity's shapes at the places in `data`, each taken as the ball around it; nothing where it has none.
std::optional<Bounds> BoundsOfEntity(const SceneModel& model, const mjData_& data, int entity);

// Of all entities, or where there are none of all shapes that have an end, as they stand at first.
std::optional<Bounds> BoundsAtFirst(const SceneModel& model);
// Of one entity, as it stands at first.
std::optional<Bounds> BoundsAtFirst(const SceneModel& model, int entity);

}  // namespace aerascope
