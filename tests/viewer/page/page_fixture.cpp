#include "tests/viewer/page/page_fixture.h"

#include <png.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

namespace aerascope {
namespace {

constexpr int kWidth = 400;
constexpr int kHeight = 250;
using Colour = std::array<std::uint8_t, 3>;

class Picture {
 public:
  Picture() : pixels_(static_cast<std::size_t>(kWidth) * kHeight * 3, 214) {}

  void Disc(StillPoint centre, double radius, Colour colour) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        if (std::hypot(x - centre.x, y - centre.y) <= radius)
          for (std::size_t c = 0; c < 3; ++c)
            pixels_[(static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)) * 3 + c] = colour[c];
  }

  std::string Png() const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = kWidth;
    image.height = kHeight;
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, pixels_.data(), 0, nullptr);
    std::string bytes(size, '\0');
    png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels_.data(), 0, nullptr);
    bytes.resize(size);
    return bytes;
  }

 private:
  std::vector<std::uint8_t> pixels_;
};

StillPoint OnTable(double x, double y) {
  return {200 + x * 600, 120 - y * 500};
}

Still MadeUpStill(Time at, const std::map<std::string, StillPoint>& places) {
  constexpr std::array<Colour, 6> kColours = {
      {{196, 60, 50}, {60, 110, 190}, {140, 80, 160}, {90, 90, 96}, {220, 180, 40}, {70, 150, 90}}};
  Picture picture;
  Still still;
  still.at = at;
  std::size_t i = 0;
  for (const auto& [name, place] : places) {
    const double radius = name == "h" ? 8 : 14;
    picture.Disc(place, radius, kColours[i++ % kColours.size()]);
    StillObject object{name, {}, {place.x, place.y + radius + 12}};
    for (int k = 0; k < 24; ++k) {
      const double angle = 2 * std::numbers::pi * k / 24;
      object.outline.push_back({place.x + radius * std::cos(angle), place.y + radius * std::sin(angle)});
    }
    still.objects.push_back(std::move(object));
  }
  still.bytes = picture.Png();
  return still;
}

}  // namespace

Run PaperRun(const PageFixture& fixture) {
  EpisodeFile file;
  file.header.program_version = "0.1.0";
  file.events = PaperEpisode(fixture.episode);
  file.complete = fixture.finished && fixture.episode.last_frame >= 15;
  EventDigest digest;
  for (const Event& event : file.events) digest.Add(event);
  if (file.complete) file.stored_digest = digest.Value();
  return Run::FromEvents(std::move(file));
}

ReportFrames MadeUpFrames(const Run& run) {
  ReportFrames frames{kWidth, kHeight, "image/png", {}, ""};
  for (const RunFrame& frame : run.frames()) {
    std::map<std::string, StillPoint> places;
    const KnowledgeBase now = run.KnowledgeBaseAt(frame.interval.after);
    for (const auto& [id, record] : now.facts()) {
      const Term& payload = record.fact.payload;
      if (!IsValue(payload) || !payload[2].IsStruct("vec2")) continue;
      places[payload[0].name()] = OnTable(payload[2][0].number(), payload[2][1].number());
    }
    frames.stills.push_back(MadeUpStill(frame.interval.after, places));
  }
  return frames;
}

Report PaperReport(const PageFixture& fixture) {
  const Run run = PaperRun(fixture);
  ReportFrames frames;
  if (fixture.frames)
    frames = MadeUpFrames(run);
  else
    frames.note = "This report has no frames: EGL could not be started on the machine that made it.";
  auto report = BuildReport(run, frames, {"paper.episode"});
  return report ? std::move(report).value() : Report{};
}

}  // namespace aerascope
