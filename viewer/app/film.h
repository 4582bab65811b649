// The film of a report: video and stills of the first camera, stills of others, and the outlines of things.
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/query/run.h"
#include "viewer/app/pictures.h"
#include "viewer/page/film_plan.h"
#include "viewer/page/report.h"
#include "viewer/render/image.h"

namespace aerascope {

struct FilmOptions {
  PictureSize still_size{960, 540};
  FilmWishes wishes;
  // As ParseCameras reads them, the first being the film's; empty for the default camera with views from the
  // side, from above, and at what the agent moves.
  std::string cameras;
};

// A film without pictures, and the reason, where `pictures` cannot draw.
Result<ReportFrames> MakeFilm(const Run& run, EpisodePictures& pictures, const FilmOptions& options,
                              const OnPicture& on_picture = {});

}  // namespace aerascope
