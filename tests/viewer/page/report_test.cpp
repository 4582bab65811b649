#include "viewer/page/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "tests/viewer/page/page_fixture.h"
#include "tests/viewer/page/page_reader.h"
#include "viewer/page/event_fields.h"
#include "viewer/page/event_log_data.h"
#include "viewer/page/subject_data.h"

namespace aerascope {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string Html(const PageFixture& fixture = {}) {
  const Run run = PaperRun(fixture);
  return BuildReport(run, {}, {"paper.episode"})->html;
}
json Data(const std::string& html) {
  return json::parse(BlockOf(html, "report-data"));
}
json Data(const PageFixture& fixture = {}) {
  return Data(Html(fixture));
}

// The details of a subject, from the block that holds them.
json DetailOf(const std::string& html, std::size_t number) {
  const json block = json::parse(BlockOf(html, "subjects-" + std::to_string(number / kSubjectsABlock)));
  return block[number % kSubjectsABlock];
}

// The columns of texts of the first chunk: for each event its sentence, its fields and, of comparisons, the
// table.
struct EventTexts {
  std::string sentence;
  std::vector<std::optional<std::string>> fields, links;
  std::optional<std::string> comparison;
};

std::map<std::int64_t, EventTexts> TextsOfFirstChunk(const std::string& html, const Run& run) {
  const json kinds = Data(html)["log"]["kinds"];
  TextColumnReader sentences(BlockOf(html, "text-0")), fields(BlockOf(html, "fields-0"));
  std::map<std::int64_t, EventTexts> texts;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    std::vector<std::int64_t> rows;
    for (const Event& event : run.events())
      if (event.body.index() == kind && static_cast<std::size_t>(event.id.value) <= kEventsAChunk)
        rows.push_back(event.id.value);
    if (rows.empty()) continue;
    const auto take = [&](TextColumnReader& reader, const auto& put) {
      const auto column = reader.Next(rows);
      for (std::size_t i = 0; i < rows.size(); ++i) put(texts[rows[i]], column[i]);
    };
    take(sentences, [](EventTexts& event, const auto& text) { event.sentence = text.value_or("none"); });
    for (std::size_t i = 0; i < kinds[kind]["fields"].size(); ++i) {
      take(fields, [](EventTexts& event, const auto& text) { event.fields.push_back(text); });
      take(fields, [](EventTexts& event, const auto& text) { event.links.push_back(text); });
    }
    if (kinds[kind]["name"] == "AnalogyCompared")
      take(fields, [](EventTexts& event, const auto& text) { event.comparison = text; });
  }
  EXPECT_TRUE(sentences.AtEnd());
  EXPECT_TRUE(fields.AtEnd());
  return texts;
}

// A list of numbers for each event, by its number.
std::map<std::int64_t, std::vector<std::int64_t>> ReadLists(ColumnReader* columns, const Run& run) {
  std::vector<std::vector<std::int64_t>> by_kind(std::variant_size_v<EventBody>);
  for (const Event& event : run.events()) by_kind[event.body.index()].push_back(event.id.value);
  std::map<std::int64_t, std::size_t> lengths;
  for (const auto& events : by_kind)
    for (const std::int64_t event : events) lengths[event] = columns->Unsigned();
  std::map<std::int64_t, std::vector<std::int64_t>> lists;
  for (const auto& events : by_kind) {
    for (std::size_t place = 0;; ++place) {
      std::int64_t value = 0;
      bool any = false;
      for (const std::int64_t event : events) {
        if (place >= lengths[event]) continue;
        any = true;
        lists[event].push_back(value += columns->Signed());
      }
      if (!any) break;
    }
  }
  return lists;
}

std::string SummaryText(const json& data) {
  std::string text;
  for (const json& item : data["summary"]) text += item["text"].get<std::string>() + "; ";
  return text;
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
  EXPECT_EQ(data["lanes"]["goals"]["sign"].back(), static_cast<int>(Outcome::kFailed));
  EXPECT_EQ(data["lanes"]["predictions"]["sign"].back(), static_cast<int>(Outcome::kFailed));
  EXPECT_EQ(data["drives"].back()["outcome"], static_cast<int>(Outcome::kFailed));
}

TEST(Report, AnalogyIsExplainedConditionByCondition) {
  const std::string html = Html();
  const json data = Data(html);
  const json& lane = data["lanes"]["analogy"];
  const auto at = std::find(lane["from"].begin(), lane["from"].end(), 6000000);
  ASSERT_NE(at, lane["from"].end());
  const std::size_t number = lane["subject"][static_cast<std::size_t>(at - lane["from"].begin())];
  const json derived = DetailOf(html, number);
  EXPECT_EQ(derived["made_by_comparison"], true);
  // The rejected comparison for the same goal is told, too.
  ASSERT_GE(derived["compared"].size(), 2u);

  const std::int64_t event = derived["compared"][0];
  const json comparison = json::parse(TextsOfFirstChunk(html, PaperRun({}))[event].comparison.value());
  EXPECT_EQ(comparison["psi"], "0.75");
  EXPECT_EQ(comparison["jaccard"], "0.6");
  EXPECT_EQ(comparison["object"], "s1");
  std::multiset<std::string> statuses;
  for (const json& row : comparison["rows"]) statuses.insert(row["status"].get<std::string>());
  EXPECT_EQ(statuses, (std::multiset<std::string>{"matched", "matched", "matched", "missed"}));
  EXPECT_EQ(derived["steps"][0], (json{"by analogy", 0.75, 1.0}));
  EXPECT_EQ(derived["steps"][1][2], 2.0);
}

TEST(Report, EveryEventIsThereWithItsSentenceItsFieldsAndItsCauses) {
  const auto run = PaperRun({});
  const std::string html = Html();
  const json log = Data(html)["log"];
  const std::size_t n = run.events().size();
  EXPECT_EQ(log["count"], n);
  ASSERT_LE(n, kEventsAChunk);
  ColumnReader columns(BlockOf(html, "log"));
  for (const Event& event : run.events()) EXPECT_EQ(columns.Byte(), event.body.index());
  ColumnReader causes(BlockOf(html, "log-causes"));
  auto back = ReadLists(&causes, run);
  EXPECT_TRUE(causes.AtEnd());
  auto texts = TextsOfFirstChunk(html, run);
  EXPECT_EQ(texts.size(), n);
  for (const Event& event : run.events()) {
    std::vector<EventId> named;
    for (const std::int64_t by : back[event.id.value]) named.push_back(EventId{event.id.value - by});
    EXPECT_EQ(named, event.causes);
    const EventTexts& said = texts[event.id.value];
    EXPECT_EQ(said.sentence, SentenceOf(run, event));
    const auto fields = FieldsOf(run, event);
    ASSERT_EQ(said.fields.size(), fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      EXPECT_EQ(said.fields[i], fields[i] ? std::optional(fields[i]->text) : std::nullopt);
      EXPECT_EQ(said.links[i].value_or(""), fields[i] ? fields[i]->link : "");
      // What leads to itself leads nowhere.
      EXPECT_NE(said.links[i].value_or(""), "#" + std::to_string(event.id.value));
    }
  }
}

TEST(Report, EverySubjectNamedSomewhereExists) {
  const std::string html = Html();
  const json data = Data(html);
  const json& ids = data["subjects"]["id"];
  const std::set<std::string> known(ids.begin(), ids.end());
  for (const auto& [name, column] : data["subjects"].items()) {
    if (column.is_array()) {
      EXPECT_EQ(column.size(), ids.size()) << name;
    }
  }
  for (const char* lane : {"goals", "commands", "predictions", "learned", "analogy"})
    for (const json& number : data["lanes"][lane]["subject"])
      EXPECT_LT(number.get<std::size_t>(), ids.size());
  for (const json& band : data["graph"]["bands"])
    for (const json& card : band["cards"])
      EXPECT_TRUE(card["subject"] == "" || known.contains(card["subject"])) << card;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const json detail = DetailOf(html, i);
    EXPECT_TRUE(detail.contains("note")) << ids[i];
    for (const char* list : {"requirements", "sub_goals", "commands"})
      for (const json& id : detail.value(list, json::array()))
        EXPECT_TRUE(known.contains(id.get<std::string>())) << ids[i] << " " << list << " " << id;
  }
}

TEST(Report, TextThatIsTooLongIsCutAndSaysHowLongItIs) {
  PageFixture fixture;
  fixture.episode.cylinder = std::string(100'000, 'x');
  const std::string html = Html(fixture);
  EXPECT_LT(html.size(), 1'500'000u);
  const json titles = Data(html)["subjects"]["title"];
  EXPECT_TRUE(std::any_of(titles.begin(), titles.end(), [](const json& title) {
    return title.get<std::string>().find("(100000 characters)") != std::string::npos;
  }));
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

TEST(Report, PicturesMayLieBesideThePage) {
  const auto run = PaperRun();
  const auto inside = BuildReport(run, MadeUpFrames(run));
  const auto beside = BuildReport(run, MadeUpFrames(run), {.file_name = "a", .picture_folder = "r_files"});
  ASSERT_TRUE(inside.ok() && beside.ok());
  EXPECT_TRUE(inside->files.empty());
  ASSERT_FALSE(beside->files.empty());
  EXPECT_LT(beside->html.size(), inside->html.size());
  for (const ReportFile& file : beside->files) {
    EXPECT_EQ(CountOf(beside->html, "data-file=\"" + file.path + "\""), 1u);
    EXPECT_THAT(file.path, testing::MatchesRegex("r_files/image-[0-9a-f]+\\.png"));
  }
  EXPECT_THAT(beside->html, HasSubstr("img-src blob: data: 'self'; media-src blob: 'self';"));
  EXPECT_THAT(inside->html, HasSubstr("img-src blob: data:; media-src blob:;"));
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
