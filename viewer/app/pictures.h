// The pictures of an episode as reports want them: drawn again from the recorded world states, with the
// outline of each object. Where nothing can be drawn there are no pictures and a sentence that says why.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/run.h"
#include "viewer/draw/sheet.h"
#include "viewer/render/renderer.h"
#include "viewer/scene/camera.h"
#include "viewer/scene/scene.h"
#include "viewer/scene/state_timeline.h"

namespace aerascope {

using OnPicture = std::function<void(std::size_t done, std::size_t of)>;

// Smooth edges matter more in stills than speed does.
inline constexpr RenderQuality kStillQuality{.samples = 4, .shadow_map_size = 2048};

// Draws the moments of one run. Make one a run; it keeps the process's one renderer while it lives.
class EpisodePictures {
 public:
  // A run without a scene (a scripted world), or a machine without EGL, gives an object that draws nothing;
  // `trouble()` then says why. An error only where the file's scene itself is damaged.
  static Result<EpisodePictures> Open(const Run& run);

  const std::string& trouble() const { return trouble_; }
  bool can_draw() const { return scene_.has_value(); }
  // The scene's model; only when can_draw().
  const SceneModel& model() const { return *scene_->model(); }
  std::string driver() const { return renderer_ ? renderer_->info().driver : std::string(); }

  // An object of the scene in a picture.
  struct Traced {
    std::string name;
    std::vector<std::pair<double, double>> outline;  // of the largest visible piece
    std::pair<double, double> label;
  };

  // One picture. An error if nothing can be drawn.
  Result<Image> Draw(Time at, const Camera& camera, PictureSize size, const RenderQuality& quality);
  Result<std::string> DrawPng(Time at, const Camera& camera, PictureSize size);
  Result<std::vector<Traced>> Trace(Time at, const Camera& camera, PictureSize size);

  // The recorded states of the world.
  const StateTimeline& timeline() const { return timeline_; }

  // One picture with the outlines of what is in it.
  Result<SheetFrame> DrawFrame(Time at, const Camera& camera, PictureSize size);
  // Stills of the sheet's key moments.
  Result<SheetFrames> ForSheet(const OnPicture& on_picture = {});

 private:
  explicit EpisodePictures(const Run& run) : run_(&run), timeline_(run.events()) {}
  const Run* run_;
  StateTimeline timeline_;
  std::string trouble_;
  std::optional<Scene> scene_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace aerascope
