// What is written to an episode file is read back: every kind, every field, exactly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "engine/store/episode_reader.h"
#include "engine/store/episode_writer.h"
#include "tests/engine/store/temporary_folder.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

using testing::HasSubstr;

EpisodeHeader SampleHeader() {
  return {"0.1.0",
          {{"scenario", "pick and place"}, {"seed", "7"}, {"odd", std::string("a\0b\xff'\"", 6)}},
          {{"scenario.toml", "title = \"x\"\n"},
           {"world/scene.xml", "<mujoco/>"},
           {"world/arm.msh", std::string("\0\1\2\xff", 4)},
           {"empty", ""}}};
}

Hash128 Write(const std::string& path, const EpisodeHeader& header, const std::vector<Event>& events) {
  auto writer = EpisodeWriter::Create(path, header);
  EXPECT_TRUE(writer.ok()) << (writer.ok() ? "" : writer.error().message);
  for (const Event& event : events) (*writer)->Append(event);
  const Result<Hash128> digest = (*writer)->Finish();
  EXPECT_TRUE(digest.ok()) << (digest.ok() ? "" : digest.error().message);
  return digest.ok() ? *digest : Hash128{};
}

std::vector<Event> EventsOfEveryKind(std::uint64_t seed, int rounds) {
  AnyEvents any(seed);
  std::vector<Event> events;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t kind = 0; kind < kEventKinds; ++kind) {
      events.push_back(any.AnyEvent(static_cast<std::int64_t>(events.size()) + 1, kind));
    }
  }
  return events;
}

Hash128 DigestOf(const std::vector<Event>& events) {
  EventDigest digest;
  for (const Event& event : events) digest.Add(event);
  return digest.Value();
}

void ExpectSame(const std::vector<Event>& expected, const std::vector<Event>& found) {
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE(SameContent(expected[i], found[i])) << ToText(expected[i]) << "\n" << ToText(found[i]);
  }
}

TEST(EpisodeRoundTrip, EveryKindWithVariedValuesInEveryField) {
  const TemporaryFolder folder;
  std::vector<Event> events = EventsOfEveryKind(1, 40);
  Event last = events.back();
  last.id = EventId{last.id.value + 1};
  last.body = EpisodeEnded{};
  events.push_back(last);
  const Hash128 digest = Write(folder / "a.episode", SampleHeader(), events);

  const Result<EpisodeFile> file = ReadEpisode(folder / "a.episode");

  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->header, SampleHeader());
  ExpectSame(events, file->events);
  EXPECT_EQ(file->stored_digest, digest);
  EXPECT_EQ(digest, DigestOf(events));
  EXPECT_EQ(digest, DigestOf(file->events));
  EXPECT_TRUE(file->complete);
}

TEST(EpisodeRoundTrip, AnyEventsComeBackAsTheyWere) {
  const TemporaryFolder folder;
  EXPECT_TRUE(rc::check([&](std::uint64_t seed) {
    AnyEvents any(seed);
    std::vector<Event> events;
    for (std::int64_t n = any.Below(60); n > 0; --n) {
      events.push_back(any.AnyEvent(static_cast<std::int64_t>(events.size()) + 1));
    }
    Write(folder / "b.episode", {}, events);
    const Result<EpisodeFile> file = ReadEpisode(folder / "b.episode");
    RC_ASSERT(file.ok());
    RC_ASSERT(SameContent(file->events, events));
  }));
}

TEST(EpisodeRoundTrip, EmptyEpisodeIsReadAndIncomplete) {
  const TemporaryFolder folder;
  Write(folder / "c.episode", SampleHeader(), {});
  const Result<EpisodeFile> file = ReadEpisode(folder / "c.episode");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_TRUE(file->events.empty());
  EXPECT_FALSE(file->complete);
  EXPECT_TRUE(file->stored_digest.has_value());
}

TEST(EpisodeRoundTrip, HeaderAloneIsRead) {
  const TemporaryFolder folder;
  Write(folder / "d.episode", SampleHeader(), EventsOfEveryKind(2, 1));
  const Result<EpisodeHeader> header = ReadEpisodeHeader(folder / "d.episode");
  ASSERT_TRUE(header.ok()) << header.error().message;
  EXPECT_EQ(*header, SampleHeader());
}

TEST(EpisodeRoundTrip, SpecialNumbersSurvive) {
  const TemporaryFolder folder;
  const double infinity = std::numeric_limits<double>::infinity();
  Event world{{1}, {0}, 0, {}, {}, WorldStateRecorded{{5}, {-0.0, infinity, -infinity, 5e-324}, {}, {0.1}}};
  Event simulation{{2}, {0}, 0, {}, {EventId{1}}, SimulationStarted{{1}, {2}, {}, std::nan("")}};
  Write(folder / "e.episode", {}, {world, simulation});
  const Result<EpisodeFile> file = ReadEpisode(folder / "e.episode");
  ASSERT_TRUE(file.ok()) << file.error().message;
  const auto& state = std::get<WorldStateRecorded>(file->events[0].body);
  EXPECT_TRUE(std::signbit(state.qpos[0]));
  EXPECT_TRUE(SameContent(state, std::get<WorldStateRecorded>(world.body)));
  EXPECT_TRUE(std::isnan(std::get<SimulationStarted>(file->events[1].body).score));
}

TEST(EpisodeWriting, SameEventsGiveTheSameBytes) {
  const TemporaryFolder folder;
  const std::vector<Event> events = EventsOfEveryKind(3, 300);
  Write(folder / "a.episode", SampleHeader(), events);
  // Another grouping into transactions must not show.
  auto writer = EpisodeWriter::Create(folder / "b.episode", SampleHeader());
  ASSERT_TRUE(writer.ok());
  for (const Event& event : events) {
    (*writer)->Append(event);
    if (event.id.value % 100 == 0) (*writer)->Flush();
  }
  ASSERT_TRUE((*writer)->Finish().ok());
  EXPECT_TRUE(FileBytes(folder / "a.episode") == FileBytes(folder / "b.episode"));
  EXPECT_EQ(FilesIn(folder.path()), 2u) << "nothing lies beside a finished episode";
}

TEST(EpisodeWriting, EarlierEpisodeIsReplaced) {
  const TemporaryFolder folder;
  Write(folder / "a.episode", {}, EventsOfEveryKind(4, 2));
  Write(folder / "a.episode", SampleHeader(), EventsOfEveryKind(5, 1));
  const Result<EpisodeFile> file = ReadEpisode(folder / "a.episode");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(file->events.size(), kEventKinds);
}

TEST(EpisodeWriting, OtherFilesAreNotReplaced) {
  const TemporaryFolder folder;
  WriteFile(folder / "notes.txt", "my notes");
  const auto writer = EpisodeWriter::Create(folder / "notes.txt", {});
  ASSERT_FALSE(writer.ok());
  EXPECT_THAT(writer.error().message, HasSubstr("another kind of file"));
  EXPECT_EQ(FileBytes(folder / "notes.txt"), "my notes");
}

TEST(EpisodeWriting, EmptyFileIsReplaced) {
  const TemporaryFolder folder;
  WriteFile(folder / "a.episode", "");
  Write(folder / "a.episode", {}, EventsOfEveryKind(6, 1));
  EXPECT_TRUE(ReadEpisode(folder / "a.episode").ok());
}

TEST(EpisodeWriting, PathThatCannotBeWrittenIsRefused) {
  const TemporaryFolder folder;
  for (const std::string& path : {folder / "no/such/folder/a.episode", folder.path(), std::string("")}) {
    const auto writer = EpisodeWriter::Create(path, {});
    ASSERT_FALSE(writer.ok()) << path;
    EXPECT_THAT(writer.error().message, HasSubstr("cannot write"));
  }
  EXPECT_EQ(FilesIn(folder.path()), 0u);
}

TEST(EpisodeWriting, PathThatLooksLikeAUriIsAPath) {
  const TemporaryFolder folder;
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  Write("file:odd?mode=memory#x.episode", {}, EventsOfEveryKind(6, 1));
  EXPECT_TRUE(ReadEpisode("file:odd?mode=memory#x.episode").ok());
  EXPECT_EQ(FilesIn(folder.path()), 1u);
  std::filesystem::current_path(here);
}

TEST(EpisodeWriting, TwoFilesOfOneNameAreRefused) {
  const TemporaryFolder folder;
  EXPECT_FALSE(EpisodeWriter::Create(folder / "a.episode", {"", {}, {{"x", "1"}, {"x", "2"}}}).ok());
  EXPECT_EQ(FilesIn(folder.path()), 0u);
}

TEST(EpisodeWriting, GapInNumbersIsToldAtTheEnd) {
  const TemporaryFolder folder;
  AnyEvents any(1);
  auto writer = EpisodeWriter::Create(folder / "a.episode", {});
  ASSERT_TRUE(writer.ok());
  (*writer)->Append(any.AnyEvent(1));
  (*writer)->Append(any.AnyEvent(3));
  const Result<Hash128> digest = (*writer)->Finish();
  ASSERT_FALSE(digest.ok());
  EXPECT_THAT(digest.error().message, HasSubstr("event 3 came after event 1"));
  EXPECT_EQ(FilesIn(folder.path()), 0u);
}

TEST(EpisodeWriting, FlushCommitsAndARunningEpisodeCanBeRead) {
  const TemporaryFolder folder;
  const std::vector<Event> events = EventsOfEveryKind(7, 3);
  auto writer = EpisodeWriter::Create(folder / "a.episode", SampleHeader());
  ASSERT_TRUE(writer.ok());
  for (const Event& event : events) (*writer)->Append(event);
  (*writer)->Flush();
  EXPECT_EQ((*writer)->Committed().value, static_cast<std::int64_t>(events.size()));
  const Result<EpisodeFile> file = ReadEpisode(folder / "a.episode");
  ASSERT_TRUE(file.ok()) << file.error().message;
  ExpectSame(events, file->events);
  EXPECT_FALSE(file->complete);
  EXPECT_FALSE(file->stored_digest.has_value());
}

TEST(EpisodeWriting, UnfinishedEpisodeIsKeptIncomplete) {
  const TemporaryFolder folder;
  const std::vector<Event> events = EventsOfEveryKind(8, 3);
  {
    auto writer = EpisodeWriter::Create(folder / "a.episode", SampleHeader());
    ASSERT_TRUE(writer.ok());
    for (const Event& event : events) (*writer)->Append(event);
  }
  const Result<EpisodeFile> file = ReadEpisode(folder / "a.episode");
  ASSERT_TRUE(file.ok()) << file.error().message;
  ExpectSame(events, file->events);
  EXPECT_FALSE(file->complete);
}

TEST(EpisodeWriting, CommitComesByItselfWithinATenthOfASecond) {
  const TemporaryFolder folder;
  AnyEvents any(1);
  auto writer = EpisodeWriter::Create(folder / "a.episode", {});
  ASSERT_TRUE(writer.ok());
  (*writer)->Append(any.AnyEvent(1));
  // Generous for a busy machine; what is tested is that no further event is needed.
  for (int i = 0; i < 500 && (*writer)->Committed().value < 1; ++i) usleep(10'000);
  EXPECT_EQ((*writer)->Committed().value, 1);
}

}  // namespace
}  // namespace aerascope
