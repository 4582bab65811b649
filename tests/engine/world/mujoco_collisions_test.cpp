// MuJoCo 2.2 loses the contacts of upright cylinders and invents contacts between boxes; both are put right.
#include "engine/world/mujoco_collisions.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/world/mujoco_model.h"

namespace aerascope {
namespace {

// As MuJoCo has them, read before anything could replace them.
const mjfCollision kOriginalBoxBox = mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX];
const mjfCollision kOriginalPlaneCylinder = mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_CYLINDER];

struct Scene {
  explicit Scene(const std::string& geoms)
      : model(std::move(
            *LoadModel(*PackModelText("<mujoco><worldbody>" + geoms + "</worldbody></mujoco>", {})))),
        data(mj_makeData(model.get())) {
    InstallMujocoCollisionFixes();
    mj_forward(model.get(), data.get());
  }
  // Contacts between geom 0 and geom 1 by the given function.
  std::vector<mjContact> Contacts(mjfCollision collide) {
    std::vector<mjContact> contacts(50);
    contacts.resize(collide(model.get(), data.get(), contacts.data(), 0, 1, 0));
    return contacts;
  }
  // Sets the orientation of geom 1 to a turn around z followed by a small tilt.
  void Turn(double yaw, double tilt_x, double tilt_y) {
    const mjtNum z[3] = {0, 0, 1};
    const double tilt = std::hypot(tilt_x, tilt_y);
    const mjtNum axis[3] = {tilt > 0 ? tilt_x / tilt : 1, tilt > 0 ? tilt_y / tilt : 0, 0};
    mjtNum about_z[4], about_axis[4], both[4];
    mju_axisAngle2Quat(about_z, z, yaw);
    mju_axisAngle2Quat(about_axis, axis, tilt);
    mju_mulQuat(both, about_axis, about_z);
    mju_quat2Mat(data->geom_xmat + 9, both);
  }
  ModelPointer model;
  DataPointer data;
};

TEST(PlaneCylinder, AnUprightCylinderHasThreeContactsInEveryOrientation) {
  // MuJoCo 2.2 returns none where the direction to the lowest point of the rim is rounding noise along the
  // normal.
  Scene scene(
      "<geom type='plane' size='1 1 1'/><geom type='cylinder' size='0.033 0.03' pos='0.1 0.2 0.0299'/>");
  std::mt19937_64 generator(1);
  const auto centred = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1; };
  int lost_before = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double tilt = std::pow(10, -20 + 15 * std::abs(centred()));
    scene.Turn(3 * centred(), tilt * centred(), tilt * centred());
    lost_before += scene.Contacts(kOriginalPlaneCylinder).empty();
    const std::vector<mjContact> contacts = scene.Contacts(mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_CYLINDER]);
    ASSERT_GE(contacts.size(), 3u) << tilt;
    for (const mjContact& contact : contacts) {
      ASSERT_NEAR(contact.dist, -0.0001, 1e-5);
      ASSERT_NEAR(contact.frame[2], 1, 1e-12);
    }
  }
  EXPECT_GT(lost_before, 0) << "if MuJoCo has put this right, the fix can go";
}

TEST(PlaneCylinder, ACylinderAboveThePlaneHasNone) {
  Scene scene("<geom type='plane' size='1 1 1'/><geom type='cylinder' size='0.033 0.03' pos='0 0 0.031'/>");
  EXPECT_TRUE(scene.Contacts(mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_CYLINDER]).empty());
}

TEST(PlaneCylinder, ATiltedOneIsLeftToMujoco) {
  Scene scene("<geom type='plane' size='1 1 1'/><geom type='cylinder' size='0.033 0.03' pos='0 0 0.0299'/>");
  scene.Turn(0.3, 0.2, 0.1);
  EXPECT_EQ(scene.Contacts(mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_CYLINDER]).size(),
            scene.Contacts(kOriginalPlaneCylinder).size());
}

TEST(BoxBox, NoContactIsDeeperThanTheBoxes) {
  // A cube resting on a box table: MuJoCo 2.2 returns, in rare poses, contacts as deep as the table is wide.
  Scene scene(
      "<geom type='box' size='0.35 0.3 0.02' pos='0 0 -0.02'/><geom type='box' size='0.033 0.033 0.033'/>");
  std::mt19937_64 generator(2);
  const auto centred = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1; };
  const int dropped_at_first = DroppedBoxContacts();
  for (int i = 0; i < 20'000; ++i) {
    const double tilt = std::pow(10, -16 + 12 * std::abs(centred()));
    scene.data->geom_xpos[3] = 0.2 * centred();
    scene.data->geom_xpos[4] = 0.2 * centred();
    scene.data->geom_xpos[5] = 0.033 - 1e-5 * std::abs(centred());
    scene.Turn(i % 2 == 0 ? 0.8 * centred() : 1e-9 * centred(), tilt * centred(), tilt * centred());
    const int dropped = DroppedBoxContacts();
    const std::size_t found = scene.Contacts(kOriginalBoxBox).size();
    const std::vector<mjContact> contacts = scene.Contacts(mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX]);
    ASSERT_EQ(contacts.size() + (DroppedBoxContacts() - dropped), found);
    for (const mjContact& contact : contacts) ASSERT_GT(contact.dist, -0.04);
  }
  EXPECT_GT(DroppedBoxContacts(), dropped_at_first) << "if MuJoCo has put this right, the fix can go";
}

}  // namespace
}  // namespace aerascope
