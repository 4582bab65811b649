// Two of MuJoCo 2.2's collision functions are sometimes wrong, and MuJoCo lets a program put its own in their
// place.
//
// Box and box: now and then it returns contacts deeper than the boxes themselves, which would shoot a resting
// box away. Such contacts are dropped. Plane and cylinder: for an upright cylinder the direction to its
// lowest point is rounding noise, and in some steps there is no contact at all; upright cylinders get three
// contacts around their rim instead.
#pragma once

namespace aerascope {

// For the whole process. MakeMujocoWorld calls it.
void InstallMujocoCollisionFixes();

// How many impossible contacts between two boxes were dropped in this thread so far.
int DroppedBoxContacts();

}  // namespace aerascope
