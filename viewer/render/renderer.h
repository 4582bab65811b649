// The Renderer makes pixels of scenes, without a window: OpenGL through EGL, in software where there is no
// graphics card.
//
// At most one exists in a process at a time; keep it for all pictures, for starting takes a good part of a
// second. Only the thread that made it uses and destroys it. Create sets environment variables: call it
// before other threads start that may read the environment. The same scene gives the same pixels on the same
// machine; another machine may differ in single pixels by a little.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "viewer/render/image.h"
#include "viewer/scene/scene.h"

namespace aerascope {

struct RendererInfo {
  std::string driver;    // OpenGL's name of what draws, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string version;   // of OpenGL, with the driver's version
  std::string platform;  // how EGL was reached: "surfaceless" or "device"
  bool software = false;
};

// How carefully to draw. Changing the numbers from one picture to the next costs time, changing the rest does
// not.
struct RenderQuality {
  std::optional<int> samples;          // for smooth edges: 0, 2, 4, 8...; none: as the model says
  std::optional<int> shadow_map_size;  // pixels a side; none: as the model says
  bool shadows = true;
  bool reflections = true;

  bool operator==(const RenderQuality&) const = default;
};

class Renderer {
 public:
  // Fails where there is no usable EGL, with a sentence that says what to install.
  static Result<std::unique_ptr<Renderer>> Create();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  const RendererInfo& info() const;

  // Each side at least 1 and at most 16384, and no more than 2^25 pixels in all.
  Result<Image> Draw(const Scene& scene, PictureSize size, const RenderQuality& quality = {});
  // Which geom is seen at each pixel.
  Result<SegmentImage> DrawSegments(const Scene& scene, PictureSize size);

 private:
  class Content;
  explicit Renderer(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

// "960x540" as a size; the error names what was expected.
Result<PictureSize> ParsePictureSize(std::string_view text);

}  // namespace aerascope
