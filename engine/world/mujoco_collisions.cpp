#include "engine/world/mujoco_collisions.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace aerascope {
namespace {

constexpr double kUprightSine = 1e-5;  // a cylinder tilted less than this many radians is upright

// MuJoCo calls the functions without any context of ours.
thread_local int dropped_box_contacts = 0;
mjfCollision original_box_box = nullptr;
mjfCollision original_plane_cylinder = nullptr;

double SmallestHalfSize(const mjModel* model, int geom) {
  const mjtNum* size = model->geom_size + 3 * geom;
  return std::min({size[0], size[1], size[2]});
}

int BoxBox(const mjModel* model, const mjData* data, mjContact* contacts, int geom_1, int geom_2,
           mjtNum margin) {
  const int count = original_box_box(model, data, contacts, geom_1, geom_2, margin);
  const double deepest = -2 * std::min(SmallestHalfSize(model, geom_1), SmallestHalfSize(model, geom_2));
  mjContact* end = std::remove_if(contacts, contacts + count,
                                  [deepest](const mjContact& contact) { return contact.dist < deepest; });
  const int kept = static_cast<int>(end - contacts);
  dropped_box_contacts += count - kept;
  return kept;
}

int PlaneCylinder(const mjModel* model, const mjData* data, mjContact* contacts, int plane, int cylinder,
                  mjtNum margin) {
  const mjtNum* plane_axes = data->geom_xmat + 9 * plane;
  const mjtNum* axes = data->geom_xmat + 9 * cylinder;
  const mjtNum normal[3] = {plane_axes[2], plane_axes[5], plane_axes[8]};
  const mjtNum axis[3] = {axes[2], axes[5], axes[8]};
  mjtNum sine[3];
  mju_cross(sine, normal, axis);
  if (mju_norm3(sine) > kUprightSine)
    return original_plane_cylinder(model, data, contacts, plane, cylinder, margin);

  const double radius = model->geom_size[3 * cylinder];
  const double half_height = model->geom_size[3 * cylinder + 1];
  const double down = mju_dot3(normal, axis) > 0 ? -half_height : half_height;
  int count = 0;
  for (int corner = 0; corner < 3; ++corner) {
    const double angle = 2 * mjPI * corner / 3;
    const mjtNum local[3] = {radius * std::cos(angle), radius * std::sin(angle), down};
    mjtNum point[3];
    mjtNum from_plane[3];
    mju_rotVecMat(point, local, axes);
    mju_addTo3(point, data->geom_xpos + 3 * cylinder);
    mju_sub3(from_plane, point, data->geom_xpos + 3 * plane);
    const double distance = mju_dot3(from_plane, normal);
    if (distance > margin) continue;
    mjContact& contact = contacts[count++];
    contact.dist = distance;
    mju_addScl3(contact.pos, point, normal, -distance / 2);
    mju_copy3(contact.frame, normal);
    mju_zero3(contact.frame + 3);
  }
  return count;
}

}  // namespace

void InstallMujocoCollisionFixes() {
  static std::once_flag once;
  std::call_once(once, [] {
    original_box_box = mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX];
    original_plane_cylinder = mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_CYLINDER];
    mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] = BoxBox;
    mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_CYLINDER] = PlaneCylinder;
  });
}

int DroppedBoxContacts() {
  return dropped_box_contacts;
}

}  // namespace aerascope
