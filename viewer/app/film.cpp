#include "viewer/app/film.h"

#include <algorithm>
#include <future>
#include <map>
#include <utility>

#include "engine/query/goal_tree.h"
#include "viewer/app/pictures.h"
#include "viewer/render/encode.h"
#include "viewer/render/video_writer.h"

namespace aerascope {
namespace {

// Videos are looked at in passing: drawn fast, and small.
constexpr RenderQuality kVideoQuality{.samples = 0, .shadow_map_size = 1024, .reflections = false};
constexpr int kVideoWidth = 640;
// From here on stills and pictures of the video are packed smaller.
constexpr std::size_t kManyStills = 60;
constexpr std::int64_t kManyPictures = 1200;

class FilmMaker {
 public:
  FilmMaker(const Run& run, EpisodePictures& pictures, const FilmOptions& options,
            const OnPicture& on_picture)
      : run_(run),
        pictures_(pictures),
        options_(options),
        on_picture_(on_picture),
        plan_(PlanFilm(run, options.wishes)) {}

  Result<ReportFrames> Make() {
    auto cameras = Cameras();
    if (!cameras) return cameras.error();
    film_.width = options_.still_size.width;
    film_.height = options_.still_size.height;
    film_.mime = "image/webp";
    film_.note = plan_.note;
    total_ = plan_.stills.size() + plan_.views.size() * (cameras->size() - 1) +
             static_cast<std::size_t>(plan_.video_pictures);
    for (std::size_t i = 0; i < cameras->size(); ++i) {
      const Camera& camera = (*cameras)[i];
      const std::vector<Time>& times = i == 0 ? plan_.stills : plan_.views;
      auto stills = Stills(camera, times, i > 0);
      if (!stills) return stills.error();
      const std::string title = TitleOf(pictures_.model(), camera);
      const std::string id = camera.follow.empty() ? title : ToText(camera);
      if (i == 0) {
        film_.stills = std::move(*stills);
        film_.camera_id = id;
        film_.camera_title = title;
      } else {
        film_.views.push_back({id, title, std::move(*stills)});
      }
    }
    if (Status done = Outlines(cameras->front()); !done) return done.error();
    if (plan_.video_pictures > 0) {
      if (Status done = Video(cameras->front()); !done) return done.error();
    }
    return std::move(film_);
  }

 private:
  Result<std::vector<Camera>> Cameras() const {
    const SceneModel& model = pictures_.model();
    if (!options_.cameras.empty()) return ParseCameras(model, options_.cameras);
    std::vector<Camera> cameras = {DefaultCamera(model)};
    std::vector<std::string> further = {"side", "above"};
    if (const std::string mover = Mover(); !mover.empty()) further.push_back("at:" + mover);
    for (const std::string& text : further) {
      auto camera = ParseCamera(model, text);
      if (camera && std::find(cameras.begin(), cameras.end(), *camera) == cameras.end())
        cameras.push_back(*std::move(camera));
    }
    return cameras;
  }

  // The entity that most commands are given to, if the scene has it.
  std::string Mover() const {
    std::map<std::string, std::size_t> commands;
    for (const IssuedCommand& command : CommandsOf(run_)) Count(command.command, commands);
    std::string most;
    for (const auto& [entity, count] : commands) {
      if (most.empty() || count > commands[most]) most = entity;
    }
    return most;
  }
  // The entities of the scene inside a term.
  void Count(const Term& term, std::map<std::string, std::size_t>& commands) const {
    if (term.is(TermKind::kEntity)) {
      if (pictures_.model().FindEntity(term.name()) >= 0) ++commands[term.name()];
    } else if (term.is(TermKind::kStruct) || term.is(TermKind::kSet)) {
      for (const Term& item : term.items()) Count(item, commands);
    }
  }

  const WorldStateRecorded& StateAt(Time at) const { return *pictures_.timeline().At(at); }

  // Until when nothing moves after this time.
  Time StillUntil(Time at) const {
    const auto states = pictures_.timeline().states();
    const WorldStateRecorded& shown = StateAt(at);
    auto next = std::upper_bound(states.begin(), states.end(), at,
                                 [](Time t, const WorldStateRecorded* state) { return t < state->at; });
    while (next != states.end() && (*next)->qpos == shown.qpos) ++next;
    return next == states.end() ? std::max(run_.end(), at) : (*next)->at;
  }

  PictureSize VideoSize() const {
    const PictureSize& still = options_.still_size;
    const auto even = [](int pixels) { return std::max(2, pixels / 2 * 2); };
    if (still.width <= kVideoWidth) return {even(still.width), even(still.height)};
    return {kVideoWidth, even(static_cast<int>(std::int64_t{kVideoWidth} * still.height / still.width))};
  }

  // Drawn and packed at once: while one is drawn, the one before is packed. Further views are smaller.
  Result<std::vector<Still>> Stills(const Camera& camera, const std::vector<Time>& times, bool further) {
    const PictureSize size = further ? VideoSize() : options_.still_size;
    const WebpOptions packing{.quality = times.size() > kManyStills ? 70.0F : 80.0F};
    std::vector<Still> stills;
    std::future<Result<std::string>> packed;
    std::size_t packing_for = 0;
    const auto collect = [&]() -> Status {
      if (!packed.valid()) return Ok();
      auto bytes = packed.get();
      if (!bytes) return bytes.error();
      for (std::size_t i = packing_for; i < stills.size(); ++i) stills[i].bytes = *bytes;
      return Ok();
    };
    for (const Time at : times) {
      Tick();
      // Nothing moved since the last still: the same picture, which the page holds once.
      if (!stills.empty() && at < stills.back().until) {
        stills.push_back(stills.back());
        stills.back().at = at;
        continue;
      }
      auto image = pictures_.Draw(at, camera, size, kStillQuality);
      if (!image) return image.error();
      if (Status done = collect(); !done) return done.error();
      Still still;
      still.at = at;
      still.until = StillUntil(at);
      if (further) {
        auto objects = ObjectsAt(at, camera);
        if (!objects) return objects.error();
        still.objects = std::move(*objects);
      }
      packing_for = stills.size();
      stills.push_back(std::move(still));
      packed = std::async(std::launch::async,
                          [picture = std::move(*image), packing] { return EncodeWebp(picture, packing); });
    }
    if (Status done = collect(); !done) return done.error();
    return stills;
  }

  Result<std::vector<StillObject>> ObjectsAt(Time at, const Camera& camera) {
    auto traced = pictures_.Trace(at, camera, options_.still_size);
    if (!traced) return traced.error();
    std::vector<StillObject> objects;
    for (const EpisodePictures::Traced& object : *traced) {
      StillObject entry;
      entry.name = object.name;
      for (const auto& [x, y] : object.outline) entry.outline.push_back({x, y});
      entry.label = {object.label.first, object.label.second};
      objects.push_back(std::move(entry));
    }
    return objects;
  }

  Status Outlines(const Camera& camera) {
    const std::vector<double>* shown = nullptr;
    for (const Time at : plan_.outlines) {
      const std::vector<double>& positions = StateAt(at).qpos;
      if (shown != nullptr && *shown == positions) {
        film_.outlines.push_back({at, film_.outlines.back().objects});
        continue;
      }
      shown = &positions;
      auto objects = ObjectsAt(at, camera);
      if (!objects) return objects.error();
      film_.outlines.push_back({at, std::move(*objects)});
    }
    return Ok();
  }

  Status Video(const Camera& camera) {
    const PictureSize size = VideoSize();
    VideoOptions settings{.size = size, .picture_ms = plan_.video_picture.us / 1000};
    if (plan_.video_pictures > kManyPictures) settings.quantizer = 36;
    auto writer = VideoWriter::Create(settings);
    if (!writer) return writer.error();
    const std::vector<double>* shown = nullptr;
    for (std::int64_t i = 0; i < plan_.video_pictures; ++i) {
      const Time at{plan_.video_from.us + i * plan_.video_picture.us};
      const std::vector<double>& positions = StateAt(at).qpos;
      if (shown != nullptr && *shown == positions) {
        if (Status added = writer->Repeat(); !added) return added;
      } else {
        auto image = pictures_.Draw(at, camera, size, kVideoQuality);
        if (!image) return image.error();
        if (Status added = writer->Add(std::move(*image)); !added) return added;
      }
      shown = &positions;
      Tick();
    }
    auto bytes = writer->Finish();
    if (!bytes) return bytes.error();
    film_.video = FilmVideo{.bytes = std::move(*bytes),
                            .mime = std::string(kVideoMime),
                            .from = plan_.video_from,
                            .picture = plan_.video_picture,
                            .pictures = plan_.video_pictures,
                            .width = size.width,
                            .height = size.height};
    return Ok();
  }

  void Tick() {
    if (on_picture_) on_picture_(++done_, total_);
  }

  const Run& run_;
  EpisodePictures& pictures_;
  const FilmOptions& options_;
  const OnPicture& on_picture_;
  const FilmPlan plan_;
  ReportFrames film_;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
};

}  // namespace

Result<ReportFrames> MakeFilm(const Run& run, EpisodePictures& pictures, const FilmOptions& options,
                              const OnPicture& on_picture) {
  if (!pictures.can_draw()) {
    ReportFrames film;
    film.note = pictures.trouble();
    return film;
  }
  return FilmMaker(run, pictures, options, on_picture).Make();
}

}  // namespace aerascope
