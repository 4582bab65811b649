#include "viewer/scene/scene.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/base/text.h"
#include "viewer/scene/bounds.h"
#include "viewer/scene/mujoco_guard.h"

namespace aerascope {

struct Scene::Content {
  explicit Content(std::shared_ptr<const SceneModel> of) : model(std::move(of)) { mjv_defaultScene(&scene); }
  ~Content() {
    mjv_freeScene(&scene);
    mj_deleteData(data);
  }
  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;

  std::shared_ptr<const SceneModel> model;
  mjData* data = nullptr;
  mjvScene scene;
  Camera camera;
};

namespace {

// Room for every geom and site, and for the segments of tendons around them.
int MostShapes(const mjModel& model) {
  return 2 * (model.ngeom + model.nsite + 2 * model.nwrap) + 1000;
}

Status CheckCount(const char* what, std::size_t expected, std::span<const double> found) {
  if (expected != found.size()) {
    return Error{"the recorded state does not fit the scene's model: expected " + std::to_string(expected) +
                 " " + what + ", found " + std::to_string(found.size())};
  }
  constexpr double kLargest = 1e9;  // beyond, single precision has lost every place that could be seen
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::abs(found[i]) <= kLargest) continue;
    return Error{"the recorded state cannot be drawn: number " + std::to_string(i + 1) + " of its " + what +
                 " is " + FormatNumber(found[i])};
  }
  return Ok();
}

Status CheckState(const mjModel& model, const WorldStateRecorded& state) {
  if (Status s = CheckCount("positions (qpos)", static_cast<std::size_t>(model.nq), state.qpos); !s) return s;
  if (Status s = CheckCount("velocities (qvel)", static_cast<std::size_t>(model.nv), state.qvel); !s)
    return s;
  return CheckCount("controls (ctrl)", static_cast<std::size_t>(model.nu), state.ctrl);
}

Status CheckCamera(const SceneModel& model, const Camera& camera) {
  if (!camera.name.empty()) {
    const std::vector<std::string>& known = model.cameras();
    if (std::find(known.begin(), known.end(), camera.name) != known.end()) return Ok();
    return ParseCamera(model, camera.name).error();
  }
  if (camera.follow.empty() || model.FindEntity(camera.follow) >= 0) return Ok();
  return Error{"the scene has no entity named " + Printable(camera.follow) + " that a camera could follow"};
}

// With the places of the moment: a camera may follow what moves.
mjvCamera MujocoCamera(const SceneModel& model, const mjData& data, const Camera& camera) {
  mjvCamera result;
  mjv_defaultCamera(&result);
  if (!camera.name.empty()) {
    result.type = mjCAMERA_FIXED;
    result.fixedcamid = mj_name2id(&model.mujoco(), mjOBJ_CAMERA, camera.name.c_str());
    return result;
  }
  std::array<double, 3> look_at_m = camera.look_at_m;
  if (!camera.follow.empty()) {
    if (const auto bounds = BoundsOfEntity(model, data, model.FindEntity(camera.follow)))
      look_at_m = bounds->Middle();
  }
  std::copy(look_at_m.begin(), look_at_m.end(), result.lookat);
  result.distance = camera.distance_m;
  result.azimuth = camera.azimuth_deg;
  result.elevation = camera.elevation_deg;
  return result;
}

// The parts of MuJoCo's forward pass that places depend on.
void ComputePlaces(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
  mj_tendon(&model, &data);
}

}  // namespace

Scene::Scene(std::unique_ptr<Content> content) : content_(std::move(content)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const std::shared_ptr<const SceneModel>& Scene::model() const {
  return content_->model;
}
const Camera& Scene::camera() const {
  return content_->camera;
}
const mjvScene_& Scene::mujoco() const {
  return content_->scene;
}

Result<Scene> Scene::Create(std::shared_ptr<const SceneModel> model) {
  return GuardMujoco("the scene cannot be made", [&]() -> Result<Scene> {
    auto content = std::make_unique<Content>(model);
    const mjModel& mujoco = model->mujoco();
    content->data = mj_makeData(&mujoco);
    if (content->data == nullptr) return Error{"the scene cannot be made: there is not enough memory"};
    mjv_makeScene(&mujoco, &content->scene, MostShapes(mujoco));
    WorldStateRecorded initial;
    initial.qpos.assign(mujoco.qpos0, mujoco.qpos0 + mujoco.nq);
    initial.qvel.assign(static_cast<std::size_t>(mujoco.nv), 0);
    initial.ctrl.assign(static_cast<std::size_t>(mujoco.nu), 0);
    Scene scene(std::move(content));
    if (Status status = scene.Show(initial, DefaultCamera(*model)); !status) return status.error();
    return scene;
  });
}

Status Scene::Show(const WorldStateRecorded& state, const Camera& camera) {
  return GuardMujoco("the recorded state cannot be drawn", [&]() -> Status {
    const mjModel& model = content_->model->mujoco();
    mjData& data = *content_->data;
    if (Status status = CheckState(model, state); !status) return status;
    if (Status known = CheckCamera(*content_->model, camera); !known) return known;
    std::copy(state.qpos.begin(), state.qpos.end(), data.qpos);
    std::copy(state.qvel.begin(), state.qvel.end(), data.qvel);
    std::copy(state.ctrl.begin(), state.ctrl.end(), data.ctrl);
    ComputePlaces(model, data);
    mjvCamera mujoco_camera = MujocoCamera(*content_->model, data, camera);
    mjvOption options;
    mjv_defaultOption(&options);
    mjv_updateScene(&model, &data, &options, nullptr, &mujoco_camera, mjCAT_ALL, &content_->scene);
    content_->camera = camera;
    return Ok();
  });
}

// ------------------------------------------------------------------------------------------------------ as
// text

namespace {

std::string Rounded(double value) {
  return FormatNumber(std::round(value * 1e4) / 1e4, 9);
}

template <class Number>
std::string RoundedList(const Number* values, int count) {
  std::vector<std::string> words;
  for (int i = 0; i < count; ++i) words.push_back(Rounded(values[i]));
  return Join(words, " ");
}

// Of the two quaternions of a turn, the one whose first number that is not zero (after rounding) is positive.
std::string TurnText(const float matrix[9]) {
  mjtNum wide[9];
  std::copy(matrix, matrix + 9, wide);
  mjtNum turn[4];
  mju_mat2Quat(turn, wide);
  const mjtNum* first = std::find_if(turn, turn + 4, [](mjtNum number) { return std::abs(number) >= 5e-5; });
  if (first != turn + 4 && *first < 0) mju_scl(turn, turn, -1, 4);
  return RoundedList(turn, 4);
}

std::string TypeText(int type) {
  static constexpr const char* kNames[] = {"plane",     "hfield",   "sphere", "capsule",
                                           "ellipsoid", "cylinder", "box",    "mesh"};
  if (type >= 0 && type < static_cast<int>(std::size(kNames))) return kNames[type];
  return "decoration";
}

std::string ShapeName(const SceneModel& model, const mjvGeom& shape) {
  if (shape.objtype == mjOBJ_GEOM) return model.GeomName(shape.objid);
  const char* name =
      shape.objtype == mjOBJ_UNKNOWN ? nullptr : mj_id2name(&model.mujoco(), shape.objtype, shape.objid);
  return std::string(name == nullptr ? "" : name) + " (" + mju_type2Str(shape.objtype) + ")";
}

std::string ShapeText(const SceneModel& model, const mjvGeom& shape) {
  return "shape " + ShapeName(model, shape) + ": " + TypeText(shape.type) + " size " +
         RoundedList(shape.size, 3) + " at " + RoundedList(shape.pos, 3) + " turn " + TurnText(shape.mat) +
         " colour " + RoundedList(shape.rgba, 4) + "\n";
}

std::string LightText(const mjvLight& light) {
  const std::string place = " from " + RoundedList(light.pos, 3) + " along " + RoundedList(light.dir, 3);
  return (light.headlight     ? "light on the camera:"
          : light.directional ? "directional light" + place + ":"
                              : "spot light" + place + ":") +
         std::string(" ambient ") + RoundedList(light.ambient, 3) + " diffuse " +
         RoundedList(light.diffuse, 3) + (light.castshadow ? " with shadows" : "") + "\n";
}

std::string CameraText(const Scene& scene) {
  const mjvGLCamera average = mjv_averageCamera(&scene.mujoco().camera[0], &scene.mujoco().camera[1]);
  return "camera " + ToText(scene.camera()) + ": at " + RoundedList(average.pos, 3) + " along " +
         RoundedList(average.forward, 3) + " up " + RoundedList(average.up, 3) + "\n";
}

}  // namespace

std::string ToText(const Scene& scene) {
  const mjvScene& mujoco = scene.mujoco();
  std::string text = CameraText(scene);
  for (int i = 0; i < mujoco.nlight; ++i) text += LightText(mujoco.lights[i]);
  for (int i = 0; i < mujoco.ngeom; ++i) text += ShapeText(*scene.model(), mujoco.geoms[i]);
  return text;
}

}  // namespace aerascope
