// Events as lines of words and as JSON lines.
#include "exporters/events/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/any_event.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;

Run PaperRun() {
  return Run::FromEvents({{}, PaperEpisode(), true, std::nullopt});
}

std::size_t LinesIn(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(EventsTextTest, OneLineAnEvent) {
  const auto run = PaperRun();
  std::ostringstream out;
  ASSERT_TRUE(WriteEventsText(run, {}, out));
  EXPECT_EQ(LinesIn(out.str()), run.events().size());
  EXPECT_THAT(out.str(), HasSubstr("6 s      #141    DriveInjected          Drive: hold s1.\n"));
}

TEST(EventsTextTest, FiltersByKindAndTime) {
  const auto run = PaperRun();
  std::ostringstream out;
  EventFilter filter;
  filter.kind = KindOfName("CommandIssued");
  filter.from = Time{6'000'000};
  filter.to = Time{8'000'000};
  ASSERT_TRUE(WriteEventsText(run, filter, out));
  EXPECT_EQ(LinesIn(out.str()), 3u);
}

TEST(EventsNdjsonTest, EveryLineHoldsAllFieldsOfItsKind) {
  const auto run = PaperRun();
  std::ostringstream out;
  ASSERT_TRUE(WriteEventsNdjson(run, {}, out));
  std::istringstream lines(out.str());
  std::string line;
  for (const Event& event : run.events()) {
    ASSERT_TRUE(std::getline(lines, line));
    const nlohmann::json json = nlohmann::json::parse(line);
    EXPECT_EQ(json["id"], event.id.value);
    EXPECT_EQ(json["kind"], KindName(event.body));
    std::visit(
        [&]<class Body>(const Body&) {
          ForEachField<Body>(
              [&](const auto& field) { EXPECT_TRUE(json["body"].contains(field.name)) << field.name; });
        },
        event.body);
  }
}

TEST(EventsNdjsonTest, AnyEventIsValidJson) {
  AnyEvents any(11);
  EpisodeFile file;
  for (std::int64_t i = 1; i <= 500; ++i) file.events.push_back(any.AnyEvent(i));
  const auto run = aerascope::Run::FromEvents(std::move(file));
  std::ostringstream out;
  EventFilter all;
  all.to = Time{std::numeric_limits<std::int64_t>::max()};
  ASSERT_TRUE(WriteEventsNdjson(run, all, out));
  std::istringstream lines(out.str());
  std::string line;
  std::size_t count = 0;
  for (; std::getline(lines, line); ++count) EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  EXPECT_EQ(count, run.events().size());
}

}  // namespace
}  // namespace aerascope
