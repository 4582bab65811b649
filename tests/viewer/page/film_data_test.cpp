#include "viewer/page/film_data.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace aerascope {
namespace {

using nlohmann::json;

StillObject Box(const std::string& name, double x) {
  return {name, {{x, 10}, {x + 8, 10}, {x + 8, 18}, {x, 18}}, {x + 4, 9}};
}

ReportFrames TwoCameras() {
  ReportFrames frames;
  frames.width = 160;
  frames.height = 90;
  frames.mime = "image/webp";
  frames.camera_id = "film";
  frames.camera_title = "film";
  frames.stills = {{.at = {0}, .bytes = "a", .objects = {}, .until = {500'000}},
                   {.at = {1'000'000}, .bytes = "b", .objects = {}, .until = {}}};
  frames.outlines = {{{0}, {Box("cube", 10), Box("hand", 30)}},
                     {{250'000}, {Box("cube", 10), Box("hand", 34)}},
                     {{1'000'000}, {Box("cube", 10)}}};
  FilmView above{"above", "above", {{.at = {0}, .bytes = "c", .objects = {Box("hand", 50)}, .until = {}}}};
  frames.views.push_back(above);
  frames.video = FilmVideo{.bytes = "v",
                           .mime = "video/webm",
                           .from = {0},
                           .picture = {50'000},
                           .pictures = 40,
                           .width = 80,
                           .height = 44};
  return frames;
}

TEST(FilmData, BlocksAreNamedInTheOrderOfStillsViewsVideo) {
  const json film = FilmData(TwoCameras(), {"A", "B", "C", "V"});
  EXPECT_EQ(film["stills"][0], (json{{"at", 0}, {"until", 500'000}, {"image", "A"}}));
  EXPECT_EQ(film["stills"][1], (json{{"at", 1'000'000}, {"until", 1'000'000}, {"image", "B"}}));
  EXPECT_EQ(film["camera"]["id"], "film");
  EXPECT_EQ(film["views"][0]["id"], "above");
  EXPECT_EQ(film["views"][0]["stills"][0]["image"], "C");
  EXPECT_EQ(film["video"]["block"], "V");
  EXPECT_EQ(film["video"]["picture"], 50'000);
  EXPECT_EQ(film["video"]["pictures"], 40);
}

TEST(FilmData, OutlinesAreToldOnceWhileAThingStandsStill) {
  const json outlines = FilmData(TwoCameras(), {"A", "B", "C", "V"})["outlines"];
  EXPECT_EQ(outlines["names"], (json{"cube", "hand"}));
  // The cube's shape, and two of the hand.
  ASSERT_EQ(outlines["shapes"].size(), 3u);
  EXPECT_EQ(outlines["shapes"][0], (json{14, 9, 10, 10, 8, 0, 0, 8, -8, 0}));
  EXPECT_EQ(outlines["at"], (json{{0, 0, 0, 1, 1}, {250'000, 0, 0, 1, 2}, {1'000'000, 0, 0}}));
}

TEST(FilmData, OutlinesOfStillsServeWhereThereAreNoOthers) {
  ReportFrames frames = TwoCameras();
  frames.outlines.clear();
  frames.stills[1].objects = {Box("cube", 20)};
  const json outlines = FilmData(frames, {"A", "B", "C", "V"})["outlines"];
  EXPECT_EQ(outlines["at"], (json{json::array({0}), {1'000'000, 0, 0}}));
}

TEST(FilmData, NamesAreMadePrintableAndNumbersWhole) {
  ReportFrames frames;
  frames.stills = {{.at = {0},
                    .bytes = "a",
                    .objects = {{"a\nb\u202e", {{0.6, 1e300}, {NAN, -INFINITY}}, {0.4, 0}}},
                    .until = {}}};
  const json film = FilmData(frames, {"A"});
  EXPECT_EQ(film["outlines"]["names"][0].get<std::string>().find('\n'), std::string::npos);
  for (const json& number : film["outlines"]["shapes"][0]) EXPECT_TRUE(number.is_number_integer());
}

TEST(FilmData, NoPicturesAreExplained) {
  EXPECT_EQ(FilmData({}, {})["note"], "This report has no frames.");
  EXPECT_FALSE(FilmData({}, {}).contains("video"));
}

}  // namespace
}  // namespace aerascope
