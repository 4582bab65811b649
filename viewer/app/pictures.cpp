#include "viewer/app/pictures.h"

#include "viewer/draw/key_moments.h"
#include "viewer/render/encode.h"
#include "viewer/render/outline.h"
#include "viewer/scene/episode_scene.h"

namespace aerascope {

Result<EpisodePictures> EpisodePictures::Open(const Run& run) {
  EpisodePictures pictures(run);
  auto source = SceneSourceOf(run.header());
  if (!source) return source.error();
  if (!*source) {
    pictures.trouble_ = "This world has no scene to film.";
    return pictures;
  }
  if (pictures.timeline_.empty()) {
    pictures.trouble_ = "No state of the world was recorded, so there is nothing to draw.";
    return pictures;
  }
  auto model = SceneModel::Load(**source);
  if (!model) return model.error();
  auto scene = Scene::Create(*model);
  if (!scene) return scene.error();
  auto renderer = Renderer::Create();
  if (!renderer) {
    pictures.trouble_ = renderer.error().message;
    return pictures;
  }
  pictures.renderer_ = std::move(*renderer);
  pictures.scene_ = std::move(*scene);
  return pictures;
}

Result<Image> EpisodePictures::Draw(Time at, const Camera& camera, PictureSize size,
                                    const RenderQuality& quality) {
  if (!can_draw()) return Error{trouble_};
  if (Status shown = scene_->Show(*timeline_.At(at), camera); !shown) return shown.error();
  return renderer_->Draw(*scene_, size, quality);
}

Result<std::vector<EpisodePictures::Traced>> EpisodePictures::Trace(Time at, const Camera& camera,
                                                                    PictureSize size) {
  if (Status shown = scene_->Show(*timeline_.At(at), camera); !shown) return shown.error();
  auto segments = renderer_->DrawSegments(*scene_, size);
  if (!segments) return segments.error();
  std::vector<Traced> traced;
  for (const Outline& outline : TraceOutlines(*segments, *scene_->model())) {
    Traced object;
    object.name = outline.entity;
    if (!outline.rings.empty()) {
      for (const PixelPoint& point : outline.rings.front()) object.outline.emplace_back(point.x, point.y);
    }
    object.label = {outline.label_anchor.x, outline.label_anchor.y};
    traced.push_back(std::move(object));
  }
  return traced;
}

Result<std::string> EpisodePictures::DrawPng(Time at, const Camera& camera, PictureSize size) {
  auto image = Draw(at, camera, size, kStillQuality);
  if (!image) return image.error();
  return EncodePng(*image);
}

Result<SheetFrame> EpisodePictures::DrawFrame(Time at, const Camera& camera, PictureSize size) {
  auto png = DrawPng(at, camera, size);
  if (!png) return png.error();
  auto objects = Trace(at, camera, size);
  if (!objects) return objects.error();
  SheetFrame frame;
  frame.at = at;
  frame.png = std::move(*png);
  for (const Traced& object : *objects) {
    SheetObject entry;
    entry.name = object.name;
    for (const auto& [x, y] : object.outline) entry.outline.push_back({x, y});
    entry.label = {object.label.first, object.label.second};
    frame.objects.push_back(std::move(entry));
  }
  return frame;
}

Result<SheetFrames> EpisodePictures::ForSheet(const OnPicture& on_picture) {
  SheetFrames sheet;
  if (!can_draw()) {
    sheet.note = trouble_;
    return sheet;
  }
  const PictureSize size{2 * kSheetFrameWidth, 2 * kSheetFrameHeight};
  const Camera camera = DefaultCamera(model());
  const std::vector<Time> moments = KeyMoments(*run_, kSheetFrames);
  for (const Time at : moments) {
    auto frame = DrawFrame(at, camera, size);
    if (!frame) return frame.error();
    sheet.frames.push_back(std::move(*frame));
    if (on_picture) on_picture(sheet.frames.size(), moments.size());
  }
  return sheet;
}

}  // namespace aerascope
