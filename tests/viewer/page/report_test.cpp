#include "viewer/page/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/viewer/page/page_fixture.h"
#include "viewer/page/report_data.h"

namespace aerascope {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

json Data(const PageFixture& fixture = {}) {
  const Run run = PaperRun(fixture);
  return json::parse(ReportData(run, {}, {}, {"paper.episode"}));
}

std::string SummaryText(const json& data) {
  std::string text;
  for (const json& item : data["summary"]) text += item["text"].get<std::string>() + "; ";
  return text;
}

// The subject whose title holds all the words.
json SubjectOf(const json& data, const std::string& kind, const std::vector<std::string>& words) {
  for (const json& subject : data["subjects"]) {
    const std::string title = subject["title"];
    const bool all = std::all_of(words.begin(), words.end(), [&](const std::string& word) {
      return title.find(word) != std::string::npos;
    });
    if (subject["kind"] == kind && all) return subject;
  }
  return {};
}

std::size_t CountOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Report, HeaderCountsWhatTheRunDid) {
  EXPECT_EQ(
      SummaryText(Data()),
      "5 of 5 goals reached; 9 pieces of knowledge learned; 4 by analogy; 9 of 9 predictions came true; ");
}

TEST(Report, ProvenanceSaysThatTheDigestWasVerified) {
  const std::string text = Data()["provenance"];
  EXPECT_THAT(text, HasSubstr("paper.episode, 15 s in 15 frames"));
  EXPECT_THAT(text, HasSubstr(", verified"));
  EXPECT_EQ(Data()["warning"], "");
}

TEST(Report, RunCutShortSaysSo) {
  PageFixture fixture;
  fixture.episode.last_frame = 9;
  const json data = Data(fixture);
  EXPECT_THAT(data["warning"].get<std::string>(), HasSubstr("incomplete: it stops after event"));
  EXPECT_THAT(data["provenance"].get<std::string>(), HasSubstr(", incomplete"));
}

TEST(Report, FailedGraspShowsAsFailedGoalAndPrediction) {
  PageFixture fixture;
  fixture.episode.cylinder_slips = true;
  const json data = Data(fixture);
  EXPECT_THAT(SummaryText(data), HasSubstr("4 of 5 goals reached"));
  EXPECT_EQ(data["lanes"]["goals"].back()["outcome"], "failed");
  EXPECT_EQ(data["lanes"]["predictions"].back()["outcome"], "failed");
  const json row = data["story"].back();
  EXPECT_EQ(row["failed"], true);
}

TEST(Report, AnalogyIsExplainedConditionByCondition) {
  const json piece = SubjectOf(Data(), "requirement", {"rab_type_2", "large"});
  const json derived = [&] {
    const json data = Data();
    for (const json& entry : data["lanes"]["analogy"])
      if (entry["at"] == 6000000) return data["subjects"][entry["subject"].get<std::string>()];
    return json();
  }();
  ASSERT_FALSE(derived.is_null());
  EXPECT_EQ(derived["made_by_comparison"], true);
  const json comparison = derived["compared"][0];
  EXPECT_EQ(comparison["psi"], "0.75");
  EXPECT_EQ(comparison["jaccard"], "0.6");
  EXPECT_EQ(comparison["object"], "s1");
  std::multiset<std::string> statuses;
  for (const json& row : comparison["rows"]) statuses.insert(row["status"].get<std::string>());
  EXPECT_EQ(statuses, (std::multiset<std::string>{"matched", "matched", "matched", "missed"}));
  // The rejected comparison for the same goal is told, too.
  EXPECT_GE(derived["compared"].size(), 2u);
  EXPECT_DOUBLE_EQ(derived["confidence"][0]["sure"], 0.75);
  EXPECT_DOUBLE_EQ(derived["confidence"][1]["sure"], 0.875);
}

TEST(Report, WhyLeadsBackToWhatWasSeen) {
  const json data = Data();
  const json subject = data["subjects"][data["lanes"]["analogy"][0]["subject"].get<std::string>()];
  const json& nodes = subject["why"]["nodes"];
  ASSERT_FALSE(nodes.empty());
  EXPECT_EQ(nodes[0][1], 0);
  EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [&](const json& node) {
    return data["events"][std::to_string(node[0].get<int>())]["mark"] == "seen";
  }));
  for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_LE(nodes[i][1], nodes[i - 1][1].get<int>() + 1);
}

TEST(Report, EverySubjectNamedSomewhereExists) {
  const json data = Data();
  const auto check = [&](const json& entry) {
    if (!entry.contains("subject") || entry["subject"] == "") return;
    EXPECT_TRUE(data["subjects"].contains(entry["subject"].get<std::string>())) << entry;
  };
  for (const json& row : data["story"]) check(row);
  for (const json& lane : data["lanes"])
    for (const json& bar : lane) check(bar);
  for (const json& band : data["graph"]["bands"])
    for (const json& card : band["cards"]) check(card);
  for (const json& event : data["events"]) check(event);
  for (const json& subject : data["subjects"])
    for (const char* list : {"why", "led"})
      for (const json& node : subject[list]["nodes"])
        EXPECT_TRUE(data["events"].contains(std::to_string(node[0].get<int>())));
}

TEST(Report, SameRunGivesTheSameBytes) {
  EXPECT_EQ(PaperReport().html, PaperReport().html);
}

TEST(Report, EachImageIsStoredOnce) {
  const auto run = PaperRun();
  ReportFrames frames = MadeUpFrames(run);
  for (Still& still : frames.stills) still.bytes = frames.stills[0].bytes;
  const auto report = BuildReport(run, frames);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(CountOf(report->html, "id=\"image-"), 1u);
}

TEST(Report, PartsAddUpToTheWhole) {
  const Report report = PaperReport();
  std::size_t sum = 0;
  for (const ReportPart& part : report.parts) sum += part.bytes;
  EXPECT_EQ(sum, report.html.size());
  EXPECT_TRUE(report.warnings.empty());
}

TEST(Report, LargeReportIsMadeWithAWarning) {
  const auto run = PaperRun();
  const ReportFrames frames{10, 10, "image/png", {{Time{0}, std::string(16'000'000, 'x'), {}}}, ""};
  const auto report = BuildReport(run, frames);
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->warnings.size(), 1u);
  EXPECT_THAT(report->warnings[0], HasSubstr("more than 20 MB"));
}

TEST(Report, HostileNamesAreNotMarkup) {
  PageFixture fixture;
  fixture.episode.scenario = "</title></script><script>alert(1)</script>";
  fixture.episode.cylinder = "<img src=x onerror=alert(1)>";
  const std::string html = PaperReport(fixture).html;
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
}

TEST(Report, PolicyAllowsOwnScriptAndStyleOnly) {
  const std::string html = PaperReport().html;
  EXPECT_THAT(html, HasSubstr("default-src 'none'; script-src 'sha256-"));
  EXPECT_THAT(html, Not(HasSubstr("unsafe-inline")));
  EXPECT_THAT(html, Not(HasSubstr("http-equiv=\"refresh\"")));
}

TEST(Report, EmptyAndOddRunsGiveAReport) {
  EXPECT_TRUE(BuildReport(Run::FromEvents({}), {}).ok());
  for (const int last : {1, 2, 7}) {
    PageFixture fixture;
    fixture.episode.last_frame = last;
    EXPECT_TRUE(BuildReport(PaperRun(fixture), {}).ok()) << last;
  }
}

}  // namespace
}  // namespace aerascope
