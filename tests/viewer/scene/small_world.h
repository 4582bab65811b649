// A small world for tests of the viewer: a floor, a red cube, a blue brick that is a mesh, a hand with one
// finger.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/event/event_body.h"
#include "viewer/scene/scene_model.h"

namespace aerascope {

// A brick of 0.04 x 0.08 x 0.12 m around its middle, in MuJoCo's mesh format: counts, points, faces.
inline std::string BrickMesh() {
  const std::array<std::int32_t, 4> counts{8, 0, 0, 12};
  std::array<float, 24> points{};
  for (std::size_t i = 0; i < 8; ++i) {
    points[3 * i] = (i & 1) != 0 ? 0.02f : -0.02f;
    points[3 * i + 1] = (i & 2) != 0 ? 0.04f : -0.04f;
    points[3 * i + 2] = (i & 4) != 0 ? 0.06f : -0.06f;
  }
  const std::array<std::int32_t, 36> faces{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                           2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  std::string bytes;
  const auto add = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  add(counts.data(), sizeof(counts));
  add(points.data(), sizeof(points));
  add(faces.data(), sizeof(faces));
  return bytes;
}

// Seen from `top`, x goes right and y goes up; the picture is 1 m high.
inline SceneSource SmallWorld() {
  SceneSource source;
  source.model_text = R"(<mujoco model="small">
  <visual>
    <headlight ambient="0.5 0.5 0.5" diffuse="0.5 0.5 0.5" specular="0 0 0"/>
    <quality offsamples="0" shadowsize="512"/>
  </visual>
  <asset><mesh name="brick" file="meshes/brick.msh"/></asset>
  <worldbody>
    <camera name="top" pos="0 0 2" fovy="28.0725"/>
    <camera name="side" pos="0 -2 0.1" xyaxes="1 0 0 0 0 1" fovy="28"/>
    <geom name="floor" type="plane" size="2 2 0.1" rgba="0.8 0.8 0.8 1"/>
    <body name="cube_body" pos="0.2 0 0.05">
      <freejoint/>
      <geom name="cube" type="box" size="0.05 0.05 0.05" rgba="1 0 0 1"/>
    </body>
    <body name="brick_body" pos="-0.2 0.2 0.05">
      <freejoint/>
      <geom type="mesh" mesh="brick" rgba="0 0 1 1"/>
    </body>
    <body name="hand" pos="-0.2 -0.2 0.1">
      <joint name="lift" type="slide" axis="0 0 1"/>
      <geom name="palm" type="box" size="0.1 0.04 0.02" rgba="0 0.6 0 1"/>
      <body name="finger" pos="0.06 0.06 0">
        <joint name="finger" type="slide" axis="1 0 0"/>
        <geom type="sphere" size="0.03" rgba="0 0.6 0 1"/>
      </body>
      <geom name="hidden" type="box" size="0.5 0.5 0.5" group="3"/>
    </body>
  </worldbody>
  <actuator><position name="lift" joint="lift"/></actuator>
</mujoco>
)";
  source.files = {{"brick.msh", BrickMesh()}};
  source.body_of_entity = {{"c", "cube_body"}, {"h", "hand"}};
  return source;
}

// The small world as it begins; its cube moved to the right by `cube_shift_m`.
inline WorldStateRecorded SmallWorldState(double cube_shift_m = 0) {
  WorldStateRecorded state;
  state.qpos = {0.2 + cube_shift_m, 0, 0.05, 1, 0, 0, 0, -0.2, 0.2, 0.05, 1, 0, 0, 0, 0, 0};
  state.qvel.assign(14, 0);
  state.ctrl.assign(1, 0);
  return state;
}

}  // namespace aerascope
