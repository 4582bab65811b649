#include "viewer/app/pictures.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "viewer/app/file_output.h"
#include "viewer/app/terminal.h"
#include "viewer/draw/key_moments.h"
#include "viewer/draw/png.h"
#include "viewer/render/encode.h"
#include "viewer/render/outline.h"
#include "viewer/scene/episode_scene.h"

namespace aerascope {
namespace {

// Smooth edges matter more in stills than speed does.
constexpr RenderQuality kStillQuality{.samples = 4, .shadow_map_size = 2048};

std::string Kilobytes(std::size_t bytes) {
  return std::to_string((bytes + 999) / 1000) + " kB";
}

}  // namespace

Result<EpisodePictures> EpisodePictures::Open(const Run& run) {
  EpisodePictures pictures(run);
  auto source = SceneSourceOf(run.header());
  if (!source) return source.error();
  if (!*source) {
    pictures.trouble_ = "This world has no scene to draw.";
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

Result<Image> EpisodePictures::Draw(Time at, const Camera& camera, PictureSize size) {
  if (!can_draw()) return Error{trouble_};
  if (Status shown = scene_->Show(*timeline_.At(at), camera); !shown) return shown.error();
  return renderer_->Draw(*scene_, size, kStillQuality);
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
  auto image = Draw(at, camera, size);
  if (!image) return image.error();
  return EncodePng(*image);
}

Result<ReportFrames> EpisodePictures::Film(PictureSize size, int per_second, const OnPicture& on_picture) {
  ReportFrames film;
  if (!can_draw()) {
    film.note = trouble_;
    return film;
  }
  film.width = size.width;
  film.height = size.height;
  film.mime = "image/webp";
  // Recorded instants only: the start of each frame, and between them the first state of each 1/per_second.
  std::set<Time> moments;
  for (const RunFrame& frame : run_->frames()) moments.insert(timeline_.At(frame.interval.after)->at);
  const std::int64_t step = 1'000'000 / std::max(per_second, 1);
  std::int64_t last_slot = -1;
  for (const WorldStateRecorded* state : timeline_.states()) {
    const std::int64_t slot = state->at.us / step;
    if (slot != last_slot) moments.insert(state->at);
    last_slot = slot;
  }
  const Camera camera = DefaultCamera(model());
  std::size_t done = 0;
  for (const Time at : moments) {
    auto image = Draw(at, camera, size);
    if (!image) return image.error();
    auto bytes = EncodeWebp(*image);
    if (!bytes) return bytes.error();
    auto objects = Trace(at, camera, size);
    if (!objects) return objects.error();
    Still still;
    still.at = at;
    still.bytes = std::move(*bytes);
    for (const Traced& object : *objects) {
      StillObject entry;
      entry.name = object.name;
      for (const auto& [x, y] : object.outline) entry.outline.push_back({x, y});
      entry.label = {object.label.first, object.label.second};
      still.objects.push_back(std::move(entry));
    }
    film.stills.push_back(std::move(still));
    if (on_picture) on_picture(++done, moments.size());
  }
  return film;
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
    sheet.frames.push_back(std::move(frame));
    if (on_picture) on_picture(sheet.frames.size(), moments.size());
  }
  return sheet;
}

Status WriteReports(const Run& run, const std::string& episode_path, const ReportFiles& files) {
  for (const std::string& path : {files.html, files.sheet}) {
    if (path.empty()) continue;
    if (Status fine = CheckWritable(path); !fine) return fine;
  }
  if (!files.html.empty() && files.html == files.sheet) {
    return Error{"the report and the sheet cannot both be " + files.html + "; name two files"};
  }
  ProgressLine progress;
  ReportFrames film;
  SheetFrames sheet_frames;
  if (files.frames) {
    auto pictures = EpisodePictures::Open(run);
    if (!pictures) return pictures.error();
    const auto drawing = [&](const std::string& what) {
      return [&progress, what](std::size_t done, std::size_t of) {
        progress.Show("drawing " + what + ": " + std::to_string(done) + " of " + std::to_string(of));
      };
    };
    if (!files.html.empty()) {
      auto drawn = pictures->Film(files.still_size, files.stills_per_second, drawing("the film"));
      if (!drawn) return drawn.error();
      film = std::move(*drawn);
    }
    if (!files.sheet.empty()) {
      auto drawn = pictures->ForSheet(drawing("the sheet"));
      if (!drawn) return drawn.error();
      sheet_frames = std::move(*drawn);
    }
    if (!pictures->can_draw()) progress.Keep("no frames: " + pictures->trouble());
  } else {
    film.note = sheet_frames.note = "Frames were left out as asked (--no-frames).";
  }
  // Both are made before the first is written, so that trouble with one leaves no other behind.
  std::string html;
  std::string sheet;
  std::vector<std::string> remarks;
  if (!files.html.empty()) {
    auto report = BuildReport(run, film, {.file_name = FileName(episode_path)});
    if (!report) return report.error();
    html = std::move(report->html);
    std::string sizes;
    for (const ReportPart& part : report->parts) {
      sizes += (sizes.empty() ? "" : ", ") + part.name + " " + Kilobytes(part.bytes);
    }
    remarks.push_back("report " + Kilobytes(html.size()) + ": " + sizes);
    for (const std::string& warning : report->warnings) remarks.push_back("warning: " + warning);
  }
  if (!files.sheet.empty()) {
    auto svg = BuildSheetSvg(run, sheet_frames, {.file_name = FileName(episode_path)});
    if (!svg) return svg.error();
    auto png = SvgToPng(*svg, files.sheet_scale);
    if (!png) return png.error();
    sheet = std::move(*png);
  }
  if (!files.html.empty()) {
    if (Status written = WriteFile(files.html, html); !written) return written;
  }
  if (!files.sheet.empty()) {
    if (Status written = WriteFile(files.sheet, sheet); !written) return written;
  }
  for (const std::string& remark : remarks) progress.Keep(remark);
  return Ok();
}

}  // namespace aerascope
