// Episodes that were cut short, damaged, or made by someone else: read as far as they are true, or refused in
// a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <random>

#include "engine/store/episode_reader.h"
#include "engine/store/episode_writer.h"
#include "tests/engine/store/temporary_folder.h"
#include "tests/support/any_event.h"
#include "tests/support/slowness.h"

namespace aerascope {
namespace {

using testing::HasSubstr;

std::vector<Event> SomeEvents(std::uint64_t seed, int count) {
  AnyEvents any(seed);
  std::vector<Event> events;
  for (int i = 1; i <= count; ++i)
    events.push_back(any.AnyEvent(i, static_cast<std::size_t>(i) % kEventKinds));
  return events;
}

void WriteEpisode(const std::string& path, const std::vector<Event>& events) {
  auto writer =
      EpisodeWriter::Create(path, {"0.1.0", {{"a", "b"}}, {{"seed.replicode", std::string(5000, 'x')}}});
  ASSERT_TRUE(writer.ok()) << writer.error().message;
  for (const Event& event : events) (*writer)->Append(event);
  ASSERT_TRUE((*writer)->Finish().ok());
}

// Runs SQL on the file as anyone with the sqlite3 program could.
void Tamper(const std::string& path, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  char* problem = nullptr;
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &problem), SQLITE_OK) << problem;
  sqlite3_free(problem);
  sqlite3_close(db);
}

std::string ErrorOf(const std::string& path) {
  const Result<EpisodeFile> file = ReadEpisode(path);
  return file.ok() ? "(read without an error)" : file.error().message;
}

// -------------------------------------------------------------------------------------------------------------
// kill

// Appends for ever and tells through the pipe what is committed; ends by being killed.
[[noreturn]] void AppendUntilKilled(const std::string& path, std::uint64_t seed, int report) {
  auto writer = EpisodeWriter::Create(path, {"0.1.0", {}, {{"seed.replicode", "x"}}});
  if (!writer) _exit(1);
  AnyEvents any(seed);
  std::int64_t told = -1;
  for (std::int64_t i = 1;; ++i) {
    (*writer)->Append(any.AnyEvent(i));
    const std::int64_t committed = (*writer)->Committed().value;
    if (committed != told && write(report, &committed, sizeof committed) == sizeof committed)
      told = committed;
    if (i % 64 == 0) usleep(300);
  }
}

TEST(KilledRun, EveryCommittedEventIsReadAtWhateverMomentItIsKilled) {
  const TemporaryFolder folder;
  std::mt19937_64 random(20240501);
  int with_events = 0;
  for (int round = 0; round < 50; ++round) {
    const std::string path = folder / ("run" + std::to_string(round) + ".episode");
    const std::uint64_t seed = random();
    int pipe_ends[2];
    ASSERT_EQ(pipe(pipe_ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) AppendUntilKilled(path, seed, pipe_ends[1]);
    close(pipe_ends[1]);
    std::int64_t committed = 0;
    // Half of the kills come after the first commit, however slow the machine is.
    do {
      ASSERT_EQ(read(pipe_ends[0], &committed, sizeof committed), static_cast<ssize_t>(sizeof committed));
    } while (round % 2 == 0 && committed == 0);
    usleep(static_cast<useconds_t>(random() % 200'000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    for (std::int64_t later = 0; read(pipe_ends[0], &later, sizeof later) == sizeof later;) committed = later;
    close(pipe_ends[0]);

    const Result<EpisodeFile> file = ReadEpisode(path);

    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_FALSE(file->complete);
    EXPECT_GE(static_cast<std::int64_t>(file->events.size()), committed);
    AnyEvents any(seed);
    for (std::size_t i = 0; i < file->events.size(); ++i) {
      ASSERT_TRUE(SameContent(file->events[i], any.AnyEvent(static_cast<std::int64_t>(i) + 1)));
    }
    with_events += committed > 0 ? 1 : 0;
  }
  EXPECT_GT(with_events, 20) << "kills came too early to show anything";
}

TEST(KilledRun, IsReadWhereNothingMayBeWritten) {
  if (getuid() != 0) GTEST_SKIP() << "needs root to give the reading up to another user";
  const TemporaryFolder folder;
  std::int64_t committed = 0;
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) AppendUntilKilled(folder / "a.episode", 7, pipe_ends[1]);
  while (committed == 0 && read(pipe_ends[0], &committed, sizeof committed) == sizeof committed) {
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ASSERT_GT(std::filesystem::file_size(folder / "a.episode-wal"), 0u);
  for (const bool with_shared_memory : {true, false}) {
    if (!with_shared_memory) std::filesystem::remove(folder / "a.episode-shm");
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
    for (const char* suffix : {"", "-wal"}) {
      std::filesystem::permissions(folder / (std::string("a.episode") + suffix),
                                   std::filesystem::perms(0444));
    }
    const pid_t reader = fork();
    if (reader == 0) {
      if (setuid(65534) != 0) _exit(3);
      const Result<EpisodeFile> file = ReadEpisode(folder / "a.episode");
      if (!file) fprintf(stderr, "%s\n", file.error().message.c_str());
      _exit(file.ok() && static_cast<std::int64_t>(file->events.size()) >= committed ? 0 : 1);
    }
    int status = 0;
    waitpid(reader, &status, 0);
    EXPECT_EQ(status, 0);
    std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  }
}

// -----------------------------------------------------------------------------------------------------------
// damage

TEST(DamagedEpisode, CutOffAnywhereIsRefused) {
  const TemporaryFolder folder;
  WriteEpisode(folder / "whole", SomeEvents(1, 400));
  const std::string bytes = FileBytes(folder / "whole");
  std::mt19937_64 random(1);
  std::vector<std::size_t> sizes{0, 1, 15, 16, 50, 99, 100, 101, 512, 8191, 8192, 8193, bytes.size() - 1};
  for (int i = 0; i < CasesToTry(100); ++i) sizes.push_back(random() % bytes.size());
  for (const std::size_t size : sizes) {
    WriteFile(folder / "cut", bytes.substr(0, size));
    EXPECT_THAT(ErrorOf(folder / "cut"), HasSubstr("cannot read episode")) << size;
  }
}

TEST(DamagedEpisode, ChangedBytesNeverCrashTheReader) {
  const TemporaryFolder folder;
  WriteEpisode(folder / "whole", SomeEvents(2, 300));
  const std::string bytes = FileBytes(folder / "whole");
  std::mt19937_64 random(2);
  int refused = 0;
  for (int round = 0; round < CasesToTry(600); ++round) {
    std::string damaged = bytes;
    const int changes = round % 3 == 0 ? 1 : 40;
    for (int i = 0; i < changes; ++i) {
      // Half of the rounds aim at the beginnings of pages, where the structure is.
      const std::size_t page = 8192 * (random() % (bytes.size() / 8192));
      damaged[round % 2 == 0 ? page + random() % 64 : random() % bytes.size()] = static_cast<char>(random());
    }
    WriteFile(folder / "damaged", damaged);
    const Result<EpisodeFile> file = ReadEpisode(folder / "damaged");
    if (!file) {
      EXPECT_THAT(file.error().message, HasSubstr("cannot read episode"));
      ++refused;
    }
    (void)ReadEpisodeHeader(folder / "damaged");
  }
  EXPECT_GT(refused, CasesToTry(200));
}

TEST(DamagedEpisode, DamagedLogOfAKilledRunIsReadToWhereItIsWhole) {
  const TemporaryFolder folder;
  const std::vector<Event> events = SomeEvents(3, 500);
  auto writer = EpisodeWriter::Create(folder / "a", {});
  ASSERT_TRUE(writer.ok());
  for (const Event& event : events) {
    (*writer)->Append(event);
    if (event.id.value % 50 == 0) (*writer)->Flush();
  }
  (*writer)->Flush();
  const std::string main_bytes = FileBytes(folder / "a");
  const std::string log = FileBytes(folder / "a-wal");
  ASSERT_GT(log.size(), 10'000u);
  std::mt19937_64 random(3);
  for (int round = 0; round < 100; ++round) {
    std::string damaged = log;
    if (round % 2 == 0) {
      damaged.resize(random() % log.size());
    } else {
      damaged[random() % log.size()] ^= 0x55;
    }
    WriteFile(folder / "b", main_bytes);
    WriteFile(folder / "b-wal", damaged);
    std::filesystem::remove(folder / "b-shm");
    const Result<EpisodeFile> file = ReadEpisode(folder / "b");
    ASSERT_TRUE(file.ok()) << file.error().message;
    ASSERT_LE(file->events.size(), events.size());
    for (std::size_t i = 0; i < file->events.size(); ++i)
      ASSERT_TRUE(SameContent(file->events[i], events[i]));
  }
}

// ---------------------------------------------------------------------------------------------------- not an
// episode

TEST(NotAnEpisode, EachKindIsRefusedInItsOwnWords) {
  const TemporaryFolder folder;
  EXPECT_THAT(ErrorOf(folder / "missing"), HasSubstr("there is no such file"));
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("it is not a file"));
  WriteFile(folder / "empty", "");
  EXPECT_THAT(ErrorOf(folder / "empty"), HasSubstr("found an empty file"));
  WriteFile(folder / "text", std::string(5000, 'x'));
  EXPECT_THAT(ErrorOf(folder / "text"), HasSubstr("found another kind of file"));
  Tamper(folder / "other.db", "CREATE TABLE t(a); INSERT INTO t VALUES(1)");
  EXPECT_THAT(ErrorOf(folder / "other.db"), HasSubstr("found another SQLite database"));
  WriteFile(folder / "only-header", FileBytes(folder / "other.db").substr(0, 60));
  EXPECT_THAT(ErrorOf(folder / "only-header"), HasSubstr("cut off"));
  EXPECT_FALSE(ReadEpisodeHeader(folder / "text").ok());
}

TEST(OtherVersions, NewerIsRefusedAndSaysWhatToDo) {
  const TemporaryFolder folder;
  WriteEpisode(folder / "a", SomeEvents(4, 30));
  Tamper(folder / "a", "PRAGMA user_version=" + std::to_string(kSchemaVersion + 1));
  EXPECT_THAT(ErrorOf(folder / "a"), HasSubstr("written by a newer aerascope"));
}

TEST(OtherVersions, OlderIsReadWithoutWhatItDoesNotHaveYet) {
  const TemporaryFolder folder;
  std::vector<Event> events = SomeEvents(5, 28);
  std::erase_if(events, [](const Event& e) { return std::holds_alternative<CommandRefused>(e.body); });
  for (std::size_t i = 0; i < events.size(); ++i)
    events[i].id = {static_cast<std::int64_t>(i) + 1}, events[i].causes.clear();
  WriteEpisode(folder / "a", events);
  const std::string drop =
      "DROP VIEW event; DROP VIEW chain_edges; DROP INDEX IF EXISTS CommandRefused_by_cause; DROP TABLE "
      "CommandRefused;"
      "ALTER TABLE CommandIssued DROP COLUMN goal; ALTER TABLE EpisodeStarted DROP COLUMN seed;";
  Tamper(folder / "a", drop);
  EXPECT_THAT(ErrorOf(folder / "a"), HasSubstr("is missing"));
  Tamper(folder / "a", "PRAGMA user_version=" + std::to_string(kSchemaVersion - 1));
  const Result<EpisodeFile> file = ReadEpisode(folder / "a");
  ASSERT_TRUE(file.ok()) << file.error().message;
  ASSERT_EQ(file->events.size(), events.size());
  EXPECT_TRUE(file->older);
  EXPECT_FALSE(file->stored_digest) << "a digest over fields that the file does not have cannot be compared";
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (auto* started = std::get_if<EpisodeStarted>(&events[i].body)) started->seed = 0;
    if (auto* command = std::get_if<CommandIssued>(&events[i].body)) command->goal = {};
    EXPECT_TRUE(SameContent(file->events[i], events[i])) << ToText(events[i]);
  }
}

TEST(OtherVersions, CandidatesOfAChoiceWereNumbersOfSimulationsUpToVersion4) {
  // Given an episode as version 4 wrote it, where a choice between plans named the simulations and no more
  const TemporaryFolder folder;
  PlanCommitted committed{{1}, {9}, {}, 0.5};
  committed.candidates.push_back({{9}, 0.5, 0.5, Time{300'000}, Time{400'000}});
  committed.candidates.push_back({{8}, 0.4, 0.4, Time{200'000}, Time{400'000}});
  WriteEpisode(folder / "a",
               {{{1}, {0}, 0, {}, {}, EpisodeStarted{}}, {{2}, {100}, 0, {}, {{1}}, committed}});
  Tamper(folder / "a",
         "DROP TABLE PlanCommitted_candidates; CREATE TABLE PlanCommitted_candidates(event INTEGER NOT NULL, "
         "position INTEGER NOT NULL, value INTEGER) STRICT;"
         "INSERT INTO PlanCommitted_candidates VALUES(2, 0, 9), (2, 1, 8)");
  EXPECT_THAT(ErrorOf(folder / "a"),
              HasSubstr("column simulation of the table PlanCommitted_candidates is missing"));
  Tamper(folder / "a", "PRAGMA user_version=4");
  // When it is read
  const Result<EpisodeFile> file = ReadEpisode(folder / "a");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_TRUE(file->older);
  // Then the simulations are known, and what they were worth is not.
  ASSERT_EQ(file->events.size(), 2u);
  const auto& read = std::get<PlanCommitted>(file->events[1].body);
  EXPECT_EQ(read.chosen, SimulationId{9});
  EXPECT_EQ(read.score, 0.5);
  ASSERT_EQ(read.candidates.size(), 2u);
  EXPECT_EQ(read.candidates[0].simulation, SimulationId{9});
  EXPECT_EQ(read.candidates[1].simulation, SimulationId{8});
  EXPECT_TRUE(std::isnan(read.candidates[1].score));
  EXPECT_TRUE(std::isnan(read.candidates[1].confidence));
  EXPECT_EQ(read.candidates[1].reaches, Time{});
}

struct WrongContent {
  const char* sql;
  const char* expected;
};

class HostileEpisode : public testing::TestWithParam<WrongContent> {};

TEST_P(HostileEpisode, IsRefused) {
  const TemporaryFolder folder;
  WriteEpisode(folder / "a", SomeEvents(6, 120));
  Tamper(folder / "a", GetParam().sql);
  EXPECT_THAT(ErrorOf(folder / "a"), HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, HostileEpisode,
    testing::Values(
        WrongContent{"UPDATE FactObserved SET source='rumour'", "source is none of the known words"},
        WrongContent{"UPDATE FactObserved SET fact_payload=99999999", "fact_payload is 99999999"},
        WrongContent{"UPDATE FactObserved SET fact_payload=0", "fact_payload is 0"},
        WrongContent{"UPDATE FactObserved SET fact_positive=2", "fact_positive is 2"},
        WrongContent{"UPDATE FactObserved SET fact_id=-5", "fact_id is -5"},
        WrongContent{"UPDATE FactObserved SET fact_after_us=9223372036854775807", "fact_after_us is"},
        WrongContent{"UPDATE FactObserved SET frame=-1", "frame is -1"},
        WrongContent{"UPDATE FactObserved SET cause=seq", "cause is"},
        WrongContent{"UPDATE FactObserved SET cause=9999", "cause is 9999"},
        WrongContent{"UPDATE event_cause SET cause=event", "cause is"},
        WrongContent{"UPDATE event_cause SET position=position+100", "position is 10"},
        WrongContent{"INSERT INTO event_cause VALUES(9999,1,1)", "no such event"},
        WrongContent{"INSERT INTO EpisodeStarted_parameters VALUES(9999,0,'a','b')", "no such event"},
        WrongContent{"UPDATE WorldStateRecorded SET qpos=x'010203'", "whole numbers of 8 bytes"},
        WrongContent{"UPDATE content SET text='(mk.val @h'", "cannot be read"},
        WrongContent{"UPDATE content SET text='t9223372036854775807'", "cannot be read"},
        WrongContent{"UPDATE content SET text=replace(hex(zeroblob(5000)),'0','[')", "less nesting"},
        WrongContent{"UPDATE ModelCreated SET model_definition=(SELECT fact_payload FROM FactObserved)",
                     "is not a definition"},
        WrongContent{"DELETE FROM FactObserved WHERE seq>4", "comes event"},
        WrongContent{"DELETE FROM event_cause WHERE position=1", "position is 2"},
        WrongContent{"DELETE FROM content WHERE id=3", "id is 4"},
        WrongContent{"DELETE FROM episode", "is empty"},
        WrongContent{"UPDATE episode SET digest='zz'", "is not a hash"},
        WrongContent{"UPDATE episode SET events=7", "it should have 7 events and has 120"},
        WrongContent{"DROP VIEW chain_edges; DROP TABLE event_cause", "event_cause is missing"},
        // A view in place of a table could run for ever.
        WrongContent{
            "DROP TABLE GoalFailed; CREATE VIEW GoalFailed AS WITH RECURSIVE x(seq) AS (SELECT 1 UNION ALL "
            "SELECT seq+1 FROM x) SELECT seq, 0 AS time_us, 0 AS frame, NULL AS in_simulation, NULL AS "
            "cause, "
            "1 AS goal FROM x",
            "GoalFailed is missing"},
        WrongContent{"DROP TABLE GoalFailed; CREATE VIRTUAL TABLE GoalFailed USING fts5(seq,time_us,frame)",
                     "GoalFailed is missing"},
        WrongContent{
            "DROP TABLE GoalFailed; CREATE TABLE GoalFailed(seq INTEGER PRIMARY KEY, time_us AS (0), frame, "
            "in_simulation, cause, goal)",
            "time_us of the table GoalFailed is missing"}));

// --------------------------------------------------------------------------------------------------------
// full disk

TEST(FullDisk, IsToldOnceAndLeavesNoFile) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    auto writer = EpisodeWriter::Create(folder / "a.episode", {});
    const rlimit limit{2 << 20, 2 << 20};
    setrlimit(RLIMIT_FSIZE, &limit);
    AnyEvents any(1);
    for (std::int64_t i = 1; i < 100'000; ++i) (*writer)->Append(any.AnyEvent(i));
    (*writer)->Flush();
    const Result<Hash128> digest = (*writer)->Finish();
    if (digest) _exit(1);
    if (digest.error().message.find("File too large") == std::string::npos) _exit(2);
    if ((*writer)->Finish().ok()) _exit(3);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0);
  EXPECT_EQ(FilesIn(folder.path()), 0u);
}

TEST(FullDisk, NoRoomForTheHeaderIsRefusedAtOnce) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 16, 1 << 16};
    setrlimit(RLIMIT_FSIZE, &limit);
    auto writer =
        EpisodeWriter::Create(folder / "a.episode", {"", {}, {{"mesh", std::string(1 << 20, 'm')}}});
    _exit(writer.ok() ? 1 : 0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0);
  EXPECT_EQ(FilesIn(folder.path()), 0u);
}

}  // namespace
}  // namespace aerascope
