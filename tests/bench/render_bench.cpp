// Frames a second against a bare MuJoCo render loop in the same process, the two taking turns, picture by
// picture in rounds: places, scene, OpenGL and reading back there; the same and PNG files here. Target:
// within 10 %.
#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "engine/world/mujoco_model.h"
#include "viewer/render/render_frames.h"

namespace aerascope {
namespace {

constexpr int kFramesARound = 20;

// The demo's scene, its arm swinging: no two states alike.
class Film {
 public:
  static Result<Film> Load() {
    Result<PackedModel> packed = PackModelFile(AERASCOPE_SOURCE_DIR "/assets/worlds/tabletop/scene.xml");
    if (!packed) return packed.error();
    SceneSource source{packed->text, {}, {}};
    for (const WorldAsset& asset : packed->assets) source.files.push_back({asset.name, asset.bytes});
    auto model = SceneModel::Load(source);
    if (!model) return model.error();
    return Film(std::move(*model));
  }

  const std::shared_ptr<const SceneModel>& model() const { return model_; }

  const WorldStateRecorded& Next() {
    const mjModel& model = model_->mujoco();
    const mjtNum* start = model.nkey > 0 ? model.key_qpos : model.qpos0;
    state_.qpos.assign(start, start + model.nq);
    state_.qvel.assign(static_cast<std::size_t>(model.nv), 0);
    state_.ctrl.assign(static_cast<std::size_t>(model.nu), 0);
    state_.qpos[0] += 0.5 * std::sin(0.05 * static_cast<double>(++shown_));
    return state_;
  }

 private:
  explicit Film(std::shared_ptr<const SceneModel> model) : model_(std::move(model)) {}

  std::shared_ptr<const SceneModel> model_;
  WorldStateRecorded state_;
  std::int64_t shown_ = 0;
};

// What anyone would write with MuJoCo alone, in the OpenGL context that is current.
class BareLoop {
 public:
  BareLoop(const mjModel& model, PictureSize size) : model_(model), size_(size), data_(mj_makeData(&model)) {
    mjv_defaultScene(&scene_);
    mjv_makeScene(&model, &scene_, 2000);
    mjv_defaultOption(&options_);
    mjv_defaultCamera(&camera_);
    camera_.type = mjCAMERA_FIXED;
    camera_.fixedcamid = 0;
    mjr_defaultContext(&context_);
    mjModel sized = model;
    sized.vis.global.offwidth = size.width;
    sized.vis.global.offheight = size.height;
    mjr_makeContext(&sized, &context_, mjFONTSCALE_50);
    pixels_.resize(3 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  }
  ~BareLoop() {
    mjr_freeContext(&context_);
    mjv_freeScene(&scene_);
    mj_deleteData(data_);
  }
  BareLoop(const BareLoop&) = delete;
  BareLoop& operator=(const BareLoop&) = delete;

  void Draw(const WorldStateRecorded& state) {
    std::copy(state.qpos.begin(), state.qpos.end(), data_->qpos);
    mj_kinematics(&model_, data_);
    mj_comPos(&model_, data_);
    mj_camlight(&model_, data_);
    mjv_updateScene(&model_, data_, &options_, nullptr, &camera_, mjCAT_ALL, &scene_);
    mjr_setBuffer(mjFB_OFFSCREEN, &context_);
    const mjrRect viewport{0, 0, size_.width, size_.height};
    mjr_render(viewport, &scene_, &context_);
    mjr_readPixels(pixels_.data(), nullptr, viewport, &context_);
  }

 private:
  const mjModel& model_;
  PictureSize size_;
  mjData* data_;
  mjvScene scene_;
  mjvOption options_;
  mjvCamera camera_;
  mjrContext context_;
  std::vector<unsigned char> pixels_;
};

double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Of all threads of this process: says how much work there is where other programs disturb the clock.
double CpuSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Status Compare(benchmark::State& state, PictureSize size) {
  Result<Film> film = Film::Load();
  if (!film) return film.error();
  Result<std::unique_ptr<Renderer>> renderer = Renderer::Create();
  if (!renderer) return renderer.error();
  Result<Scene> scene = Scene::Create(film->model());
  if (!scene) return scene.error();
  BareLoop bare(film->model()->mujoco(), size);
  FrameOptions options;
  options.camera = DefaultCamera(*film->model());
  options.size = size;
  if (Result<Image> warm = (*renderer)->Draw(*scene, size); !warm) return warm.error();
  bare.Draw(film->Next());

  double bare_s = 0, ours_s = 0, bare_cpu_s = 0, ours_cpu_s = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const double start = Seconds(), start_cpu = CpuSeconds();
    for (int i = 0; i < kFramesARound; ++i) bare.Draw(film->Next());
    const double middle = Seconds(), middle_cpu = CpuSeconds();
    std::vector<WorldStateRecorded> states;
    for (int i = 0; i < kFramesARound; ++i) states.push_back(film->Next());
    std::vector<const WorldStateRecorded*> looks;
    for (const WorldStateRecorded& s : states) looks.push_back(&s);
    const Result<RenderedFrames> frames = RenderFrames(**renderer, *scene, looks, options);
    if (!frames) return frames.error();
    const double end = Seconds();
    bare_s += middle - start;
    ours_s += end - middle;
    bare_cpu_s += middle_cpu - start_cpu;
    ours_cpu_s += CpuSeconds() - middle_cpu;
    for (const std::string& picture : frames->pictures) bytes += picture.size();
  }
  const double count = static_cast<double>(state.iterations()) * kFramesARound;
  state.counters["bare_fps"] = count / bare_s;
  state.counters["png_fps"] = count / ours_s;
  state.counters["png_of_bare"] = bare_s / ours_s;
  state.counters["bare_cpu_ms"] = 1000 * bare_cpu_s / count;
  state.counters["png_cpu_ms"] = 1000 * ours_cpu_s / count;
  state.counters["png_kB"] = static_cast<double>(bytes) / count / 1000;
  return Ok();
}

void FramesPerSecond(benchmark::State& state) {
  const PictureSize size{static_cast<int>(state.range(0)), static_cast<int>(state.range(1))};
  if (Status status = Compare(state, size); !status) state.SkipWithError(status.error().message.c_str());
}

BENCHMARK(FramesPerSecond)
    ->Args({320, 180})
    ->Args({640, 360})
    ->Args({960, 540})
    ->Args({1280, 720})
    ->Iterations(3)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerascope
