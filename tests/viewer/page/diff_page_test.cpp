// The page of a difference: what it is told, that it holds together whatever the runs hold, and that equal
// input gives equal bytes.
#include "viewer/page/diff_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/hostile_texts.h"
#include "tests/viewer/page/page_fixture.h"
#include "tests/viewer/page/page_reader.h"

namespace aerascope {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string PageOf(const DiffPageSide& left, const DiffPageSide& right) {
  auto page = BuildDiffPage(
      left, right, DiffKnowledge(left.run.KnowledgeBaseAt(left.at), right.run.KnowledgeBaseAt(right.at)),
      DiffRuns({left.run, left.at}, {right.run, right.at}));
  EXPECT_TRUE(page) << page.error().message;
  return *page;
}
std::string PageOf(const PageFixture& left, const PageFixture& right) {
  const auto a = PaperRun(left);
  const auto b = PaperRun(right);
  return PageOf({a, a.end(), "a.episode"}, {b, b.end(), "b.episode"});
}
json DataOf(const std::string& page) {
  return json::parse(BlockOf(page, "diff-data"));
}
PageFixture Slipped() {
  PageFixture fixture;
  fixture.episode.cylinder_slips = true;
  return fixture;
}
PageFixture UpToFrame(int frame) {
  PageFixture fixture;
  fixture.episode.last_frame = frame;
  return fixture;
}

// What the page's elements point to.
std::vector<std::string> AddressesIn(const std::string& page) {
  std::vector<std::string> addresses;
  for (const std::string_view attribute : {"src=\"", "href=\""}) {
    for (std::size_t at = page.find(attribute); at != std::string::npos; at = page.find(attribute, at + 1)) {
      const std::size_t begin = at + attribute.size();
      addresses.push_back(page.substr(begin, page.find('"', begin) - begin));
    }
  }
  return addresses;
}

TEST(DiffPage, OfARunWithItselfHasNoDifference) {
  const json data = DataOf(PageOf(PageFixture{}, PageFixture{}));
  EXPECT_EQ(data["items"], json::array());
  EXPECT_EQ(data["same"].size(), 15u);
  EXPECT_EQ(data["runs"]["settings"], json::array());
  EXPECT_EQ(data["runs"]["parting"], nullptr);
  for (const json& item : data["same"]) EXPECT_EQ(item["left"]["id"], item["right"]["id"]);
}

TEST(DiffPage, TellsAnotherConfidenceWithItsCurvesAndHowEachEnded) {
  const json data = DataOf(PageOf(PageFixture{}, Slipped()));
  const auto item = std::find_if(data["items"].begin(), data["items"].end(), [](const json& one) {
    return one["title"] == "grab_type_2 something large";
  });
  ASSERT_NE(item, data["items"].end());
  EXPECT_EQ((*item)["change"], "changed");
  EXPECT_GT((*item)["left"]["sure"].get<double>(), (*item)["right"]["sure"].get<double>());
  // The last step of a curve is what the side ends with.
  for (const char* side : {"left", "right"})
    EXPECT_EQ((*item)[side]["curve"].back()[1], (*item)[side]["sure"]);
  const json& drives = data["runs"]["drives"];
  EXPECT_EQ(drives.back()[1][0], 1);
  EXPECT_EQ(drives.back()[2][0], 2);
  EXPECT_NE(data["runs"]["parting"], nullptr);
}

TEST(DiffPage, TellsWhatAPieceDoesNotAskForBesideItsNearestRelative) {
  const auto run = PaperRun();
  const json data = DataOf(PageOf({run, Time{5'900'000}, "run@5.9s"}, {run, run.end(), "run"}));
  const auto item = std::find_if(data["items"].begin(), data["items"].end(), [](const json& one) {
    return one["title"] == "grab_type_2 something large";
  });
  ASSERT_NE(item, data["items"].end());
  EXPECT_EQ((*item)["change"], "added");
  EXPECT_EQ((*item)["near"]["right_is"], "generalised");
  EXPECT_THAT((*item)["rows"],
              testing::Contains(json::array({"condition", "left", "C shape cube", "", {"C"}})));
  EXPECT_EQ(data["left"]["whole"], false);
  EXPECT_EQ(data["left"]["at"], "5.9 s");
  EXPECT_EQ(data["right"]["whole"], true);
}

TEST(DiffPage, EqualInputGivesEqualBytes) {
  EXPECT_EQ(PageOf(PageFixture{}, Slipped()), PageOf(PageFixture{}, Slipped()));
}

TEST(DiffPage, MayLoadNothingAndRunsOnlyItsOwnScript) {
  const std::string page = PageOf(PageFixture{}, Slipped());
  EXPECT_THAT(page, HasSubstr("default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(page, Not(HasSubstr("unsafe")));
  EXPECT_THAT(page, Not(HasSubstr("@data@")));
  for (const std::string& address : AddressesIn(page)) {
    EXPECT_TRUE(address.starts_with("#") || address.starts_with("data:,")) << address;
  }
}

TEST(DiffPage, AnIncompleteRunIsSaidToBeOne) {
  const json data = DataOf(PageOf(UpToFrame(9), PageFixture{}));
  EXPECT_THAT(data["left"]["warning"].get<std::string>(), HasSubstr("incomplete"));
  EXPECT_EQ(data["right"]["warning"], "");
}

TEST(DiffPage, OfRunsWithoutEventsIsAPage) {
  const auto nothing = Run::FromEvents({});
  const auto run = PaperRun();
  EXPECT_EQ(DataOf(PageOf({nothing, nothing.end(), ""}, {nothing, nothing.end(), ""}))["items"],
            json::array());
  const json data = DataOf(PageOf({nothing, nothing.end(), ""}, {run, run.end(), "b"}));
  for (const json& item : data["items"]) EXPECT_EQ(item["change"], "added");
  EXPECT_FALSE(data["items"].empty());
}

TEST(DiffPage, TextsOfTheEpisodesAreDataOnly) {
  for (int turn = 0; turn < kHostileTurns; ++turn) {
    HostileEpisode hostile = MakeHostileEpisode(turn);
    EpisodeFile file;
    file.header = std::move(hostile.header);
    file.events = std::move(hostile.events);
    const auto a = Run::FromEvents(std::move(file));
    const auto b = PaperRun();
    const std::string page = PageOf({a, a.end(), "<script>window.pwned=1</script>"}, {b, b.end(), "b"});
    EXPECT_THAT(page, HasSubstr("<title>&lt;script&gt;window.pwned=1&lt;/script&gt; and b"));
    EXPECT_EQ(page.find("pwned"), page.rfind("pwned"));
    EXPECT_FALSE(DataOf(page)["items"].empty());
  }
}

TEST(DiffPage, AMegabyteOfTextIsShortened) {
  HostileEpisode endless = MakeEndlessEpisode();
  EpisodeFile file;
  file.header = std::move(endless.header);
  file.events = std::move(endless.events);
  const auto a = Run::FromEvents(std::move(file));
  const auto b = PaperRun();
  const std::string page = PageOf({a, a.end(), "a"}, {b, b.end(), "b"});
  EXPECT_LT(page.size(), 1'000'000u);
  EXPECT_LT(BlockOf(page, "diff-data").size(), 2'000'000u);
}

TEST(DiffPage, NumbersThatAreNoneAreNoNumbersInThePage) {
  HostileEpisode none = MakeEpisodeWithoutNumbers();
  EpisodeFile file;
  file.events = std::move(none.events);
  const auto a = Run::FromEvents(std::move(file));
  const json same = DataOf(PageOf({a, a.end(), "a"}, {a, a.end(), "a"}));
  EXPECT_EQ(same["items"], json::array());
  const auto b = PaperRun();
  EXPECT_FALSE(DataOf(PageOf({a, a.end(), "a"}, {b, b.end(), "b"}))["items"].empty());
}

}  // namespace
}  // namespace aerascope
