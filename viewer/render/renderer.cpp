#include "viewer/render/renderer.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <charconv>
#include <cstring>
#include <thread>

#include "engine/base/text.h"
#include "viewer/render/gl_context.h"
#include "viewer/scene/mujoco_guard.h"

namespace aerascope {
namespace {

constexpr int kLongestSide = 16384;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 25;

// MuJoCo finds OpenGL's functions through global tables, so that two contexts would disturb each other.
std::atomic<bool> renderer_exists{false};

std::string SizeText(PictureSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

Status CheckSize(PictureSize size) {
  const bool possible = size.width >= 1 && size.height >= 1 && size.width <= kLongestSide &&
                        size.height <= kLongestSide && std::int64_t{size.width} * size.height <= kMostPixels;
  if (possible) return Ok();
  return Error{"a picture of " + SizeText(size) + " pixels cannot be drawn: expected sides of 1 to " +
               std::to_string(kLongestSide) + " pixels and at most " + std::to_string(kMostPixels) +
               " pixels in all"};
}

bool DrawsInSoftware(const std::string& driver) {
  return driver.find("llvmpipe") != std::string::npos || driver.find("softpipe") != std::string::npos ||
         driver.find("SwiftShader") != std::string::npos;
}

// MuJoCo's pictures begin with the bottom row.
void TurnOver(Image& image) {
  const std::size_t row = 3 * static_cast<std::size_t>(image.size.width);
  auto top = image.rgb.begin();
  auto bottom = image.rgb.end();
  for (int y = 0; y < image.size.height / 2; ++y) {
    bottom -= static_cast<std::ptrdiff_t>(row);
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
    top += static_cast<std::ptrdiff_t>(row);
  }
}

}  // namespace

// ------------------------------------------------------------------------------------ what is on the
// graphics side

class Renderer::Content {
 public:
  explicit Content(std::unique_ptr<GlContext> gl) : gl_(std::move(gl)) {
    mjr_defaultContext(&context_);
    const std::string driver = gl_->DriverName();
    info_ = {driver, gl_->DriverVersion(), gl_->Platform(), DrawsInSoftware(driver)};
  }

  ~Content() {
    FreeBuffers();
    gl_.reset();
    renderer_exists = false;
  }

  Content(const Content&) = delete;
  Content& operator=(const Content&) = delete;

  const RendererInfo& info() const { return info_; }

  // What is drawn, and how; `flags` are changed from those of the scene.
  struct Task {
    const Scene& scene;
    PictureSize size;
    RenderQuality quality;
    bool segments = false;
  };

  Result<Image> Draw(const Task& task) {
    assert(std::this_thread::get_id() == thread_ && "a renderer belongs to the thread that made it");
    if (Status status = CheckSize(task.size); !status) return status.error();
    return GuardMujoco("the frame cannot be drawn", [&]() -> Result<Image> {
      if (Status status = Prepare(task); !status) return status.error();
      const mjrRect viewport{0, 0, task.size.width, task.size.height};
      // A shallow copy: its flags change, the lists it points to are the scene's.
      mjvScene scene = task.scene.mujoco();
      scene.flags[mjRND_SHADOW] = task.quality.shadows;
      scene.flags[mjRND_REFLECTION] = task.quality.reflections;
      scene.flags[mjRND_SEGMENT] = task.segments;
      scene.flags[mjRND_IDCOLOR] = task.segments;
      mjr_setBuffer(mjFB_OFFSCREEN, &context_);
      mjr_render(viewport, &scene, &context_);
      const auto pixels =
          static_cast<std::size_t>(task.size.width) * static_cast<std::size_t>(task.size.height);
      Image image{task.size, std::vector<std::uint8_t>(3 * pixels)};
      mjr_readPixels(image.rgb.data(), nullptr, viewport, &context_);
      if (const int trouble = mjr_getError(); trouble != 0) {
        return Error{"the frame cannot be drawn: OpenGL reports error " + std::to_string(trouble) + " on " +
                     info_.driver};
      }
      TurnOver(image);
      return image;
    });
  }

 private:
  // Uploads the model's meshes and makes buffers, unless what is there will do.
  Status Prepare(const Task& task) {
    const mjModel& model = task.scene.model()->mujoco();
    const int samples = task.quality.samples.value_or(model.vis.quality.offsamples);
    const int shadow_size = task.quality.shadow_map_size.value_or(model.vis.quality.shadowsize);
    const bool fits = model_ == task.scene.model() && samples == samples_ && shadow_size == shadow_size_ &&
                      task.size.width <= context_.offWidth && task.size.height <= context_.offHeight;
    if (fits) return Ok();
    if (samples < 0 || samples > 16 || shadow_size < 0 || shadow_size > kLongestSide) {
      return Error{"the frame cannot be drawn: expected 0 to 16 samples and a shadow map of 0 to " +
                   std::to_string(kLongestSide) + " pixels a side, found " + std::to_string(samples) +
                   " and " + std::to_string(shadow_size)};
    }
    FreeBuffers();
    mjModel adjusted =
        model;  // shallow: MuJoCo reads the settings from the model, and the model is not ours to change
    adjusted.vis.quality.offsamples = samples;
    adjusted.vis.quality.shadowsize = shadow_size;
    adjusted.vis.global.offwidth = task.size.width;
    adjusted.vis.global.offheight = task.size.height;
    mjr_makeContext(&adjusted, &context_, mjFONTSCALE_50);
    mjr_setBuffer(mjFB_OFFSCREEN, &context_);
    if (context_.currentBuffer != mjFB_OFFSCREEN)
      return Error{"the frame cannot be drawn: no offscreen buffer on " + info_.driver};
    const mjrRect available = mjr_maxViewport(&context_);
    if (available.width < task.size.width || available.height < task.size.height) {
      return Error{"a picture of " + SizeText(task.size) + " pixels cannot be drawn: " + info_.driver +
                   " gives at most " + SizeText({available.width, available.height})};
    }
    model_ = task.scene.model();
    samples_ = samples;
    shadow_size_ = shadow_size;
    return Ok();
  }

  void FreeBuffers() {
    model_.reset();
    if (context_.glInitialized) mjr_freeContext(&context_);
    mjr_defaultContext(&context_);
  }

  std::unique_ptr<GlContext> gl_;
  RendererInfo info_;
  mjrContext context_;
  // Shared with the scenes: whether another scene is of the same model is only known while the model lives.
  std::shared_ptr<const SceneModel> model_;
  int samples_ = 0;
  int shadow_size_ = 0;
  std::thread::id thread_ = std::this_thread::get_id();
};

Renderer::Renderer(std::unique_ptr<Content> content) : content_(std::move(content)) {}
Renderer::~Renderer() = default;

const RendererInfo& Renderer::info() const {
  return content_->info();
}

Result<std::unique_ptr<Renderer>> Renderer::Create() {
  if (renderer_exists.exchange(true)) {
    return Error{"frames cannot be drawn: the process has a renderer already, and only one can be at a time"};
  }
  Result<std::unique_ptr<GlContext>> gl = GlContext::Create();
  if (!gl) {
    renderer_exists = false;
    return gl.error();
  }
  EnsureMujocoThrows();
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<Content>(std::move(*gl))));
}

Result<Image> Renderer::Draw(const Scene& scene, PictureSize size, const RenderQuality& quality) {
  return content_->Draw({scene, size, quality});
}

Result<SegmentImage> Renderer::DrawSegments(const Scene& scene, PictureSize size) {
  RenderQuality quality;
  quality.shadows = false;
  quality.reflections = false;
  Result<Image> image = content_->Draw({scene, size, quality, true});
  if (!image) return image.error();
  const mjvScene& mujoco = scene.mujoco();
  std::vector<std::int32_t> geom_of_segment(static_cast<std::size_t>(mujoco.ngeom), -1);
  for (int i = 0; i < mujoco.ngeom; ++i) {
    const mjvGeom& shape = mujoco.geoms[i];
    if (shape.objtype != mjOBJ_GEOM || shape.segid < 0 || shape.segid >= mujoco.ngeom) continue;
    geom_of_segment[static_cast<std::size_t>(shape.segid)] = shape.objid;
  }
  SegmentImage segments{size, {}};
  segments.geom.reserve(image->rgb.size() / 3);
  for (std::size_t i = 0; i + 2 < image->rgb.size(); i += 3) {
    // MuJoCo paints the segment's number plus 1, red being the lowest byte.
    const std::size_t segment = image->rgb[i] + 256u * image->rgb[i + 1] + 65536u * image->rgb[i + 2];
    const bool known = segment >= 1 && segment <= geom_of_segment.size();
    segments.geom.push_back(known ? geom_of_segment[segment - 1] : -1);
  }
  return segments;
}

Result<PictureSize> ParsePictureSize(std::string_view text) {
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  bool understood = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  if (understood) {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    understood = height.ec == std::errc() && height.ptr == end;
  }
  if (!understood)
    return Error{"the size " + Printable(text) + " is not understood: expected WIDTHxHEIGHT, as in 960x540"};
  if (Status status = CheckSize(size); !status) return status.error();
  return size;
}

}  // namespace aerascope
