#include "viewer/scene/bounds.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>

namespace aerascope {
namespace {

struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using OwnedData = std::unique_ptr<mjData, DataDeleter>;

// Places of the initial state; null without memory.
OwnedData DataAtFirst(const SceneModel& model) {
  OwnedData data(mj_makeData(&model.mujoco()));
  if (data) mj_kinematics(&model.mujoco(), data.get());
  return data;
}

// Of the geoms that `belongs` chooses. Planes have no end and count for nothing.
template <class Belongs>
std::optional<Bounds> BoundsOfGeoms(const mjModel& model, const mjData& data, Belongs&& belongs) {
  std::optional<Bounds> bounds;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const double radius_m = model.geom_rbound[geom];
    if (!belongs(geom) || !(radius_m > 0)) continue;
    Bounds ball;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double middle_m = data.geom_xpos[3 * static_cast<std::size_t>(geom) + axis];
      ball.low_m[axis] = middle_m - radius_m;
      ball.high_m[axis] = middle_m + radius_m;
    }
    if (!bounds) bounds = ball;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds->low_m[axis] = std::min(bounds->low_m[axis], ball.low_m[axis]);
      bounds->high_m[axis] = std::max(bounds->high_m[axis], ball.high_m[axis]);
    }
  }
  return bounds;
}

}  // namespace

std::array<double, 3> Bounds::Middle() const {
  std::array<double, 3> middle_m{};
  for (std::size_t axis = 0; axis < 3; ++axis) middle_m[axis] = (low_m[axis] + high_m[axis]) / 2;
  return middle_m;
}

std::optional<Bounds> BoundsOfEntity(const SceneModel& model, const mjData_& data, int entity) {
  return BoundsOfGeoms(model.mujoco(), data,
                       [&](int geom) { return entity >= 0 && model.EntityOfGeom(geom) == entity; });
}

std::optional<Bounds> BoundsAtFirst(const SceneModel& model) {
  const OwnedData data = DataAtFirst(model);
  if (!data) return std::nullopt;
  const auto entities =
      BoundsOfGeoms(model.mujoco(), *data, [&](int geom) { return model.EntityOfGeom(geom) >= 0; });
  return entities ? entities : BoundsOfGeoms(model.mujoco(), *data, [](int) { return true; });
}

std::optional<Bounds> BoundsAtFirst(const SceneModel& model, int entity) {
  const OwnedData data = DataAtFirst(model);
  return data ? BoundsOfEntity(model, *data, entity) : std::nullopt;
}

}  // namespace aerascope
