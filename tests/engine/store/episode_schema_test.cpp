// The tables and views of an episode file, and the page that documents them.
#include "engine/store/episode_schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cstdlib>
#include <set>

#include "engine/event/event.h"
#include "engine/store/episode_header.h"
#include "engine/store/episode_writer.h"
#include "tests/engine/store/temporary_folder.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

std::vector<StoredTable> AllTables() {
  std::vector<StoredTable> tables = CommonTables();
  for (StoredTable& table : EventTables()) tables.push_back(std::move(table));
  return tables;
}

// The answer of a query, a row a line, values separated by "|".
std::string Ask(const std::string& path, const std::string& sql) {
  sqlite3* db = nullptr;
  EXPECT_EQ(sqlite3_open_v2(path.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(db, sql.c_str(), -1, &statement, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
  std::string answer;
  while (sqlite3_step(statement) == SQLITE_ROW) {
    for (int i = 0; i < sqlite3_column_count(statement); ++i) {
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, i));
      answer += (i > 0 ? "|" : "") + std::string(text ? text : "NULL");
    }
    answer += "\n";
  }
  sqlite3_finalize(statement);
  sqlite3_close(db);
  return answer;
}

// ------------------------------------------------------------------------------------------------------ the
// page

std::string TableRows(const StoredTable& table) {
  std::string rows;
  for (const StoredColumn& column : table.columns) {
    rows += "| `" + column.name + "` | " + column.type + (column.may_be_null ? " or NULL" : "") + " | " +
            column.meaning + " |\n";
  }
  return rows;
}

std::string SchemaPage() {
  std::string page = R"(# The episode file

<!-- Made from the program's own description of its events: do not edit. After a change there, run
     `AERASCOPE_UPDATE_GOLDEN=1 ./aerascope test engine/store`. -->

An episode is one SQLite file (`application_id` )" +
                     std::to_string(kEpisodeApplicationId) + " = \"AERA\", `user_version` " +
                     std::to_string(kSchemaVersion) +
                     R"( = version of this schema).
Any SQLite program reads it; the meaning of each column below is also in the file, in the table `schema_column`.
Times are whole microseconds of engine time. A *content id* refers to `content`. Numbers of objects (facts, goals, models ...)
are unique within the episode. A finished episode has its digest in the table `episode`; a run that was cut short has none.

## The run

)";
  for (const StoredTable& table : CommonTables()) {
    page += "### " + table.name + "\n\n" + table.meaning +
            "\n\n| column | type | meaning |\n|---|---|---|\n" + TableRows(table) + "\n";
  }
  page += R"(## Views

| view | what it answers |
|---|---|
)";
  for (const StoredView& view : Views()) page += "| `" + view.name + "` | " + view.meaning + " |\n";
  const std::vector<StoredTable> events = EventTables();
  page +=
      "\n## Events\n\nA table a kind. Each begins with these columns:\n\n| column | type | meaning "
      "|\n|---|---|---|\n";
  StoredTable common = events[0];
  common.columns.resize(5);
  page += TableRows(common) + "\nand goes on with its own:\n\n";
  for (StoredTable table : events) {
    const bool list = table.key == StoredTable::Key::kPosition;
    if (!list) table.columns.erase(table.columns.begin(), table.columns.begin() + 5);
    page += (list ? "#### " : "### ") + table.name + "\n\n" + table.meaning + "\n\n";
    if (!table.columns.empty())
      page += "| column | type | meaning |\n|---|---|---|\n" + TableRows(table) + "\n";
  }
  page.pop_back();
  return page;
}

TEST(SchemaPage, IsWhatTheProgramWrites) {
  const std::string path = std::string(AERASCOPE_SOURCE_DIR) + "/docs/event-schema.md";
  if (std::getenv("AERASCOPE_UPDATE_GOLDEN") != nullptr) WriteFile(path, SchemaPage());
  EXPECT_EQ(FileBytes(path), SchemaPage())
      << "set AERASCOPE_UPDATE_GOLDEN=1 and run again to write the page anew";
}

// ----------------------------------------------------------------------------------------------------- the
// tables

TEST(Schema, NamesDoNotCollide) {
  std::set<std::string> names;
  for (const StoredTable& table : AllTables()) {
    EXPECT_TRUE(names.insert(table.name).second) << table.name;
    std::set<std::string> columns;
    for (const StoredColumn& column : table.columns) {
      EXPECT_TRUE(columns.insert(column.name).second) << table.name << "." << column.name;
    }
  }
  for (const StoredView& view : Views()) EXPECT_TRUE(names.insert(view.name).second) << view.name;
}

TEST(Schema, EveryColumnHasAMeaning) {
  for (const StoredTable& table : AllTables()) {
    EXPECT_TRUE(table.meaning.ends_with(".")) << table.name;
    for (const StoredColumn& column : table.columns) {
      EXPECT_FALSE(column.meaning.empty()) << table.name << "." << column.name;
      // It becomes a comment in SQL and a cell in Markdown.
      EXPECT_EQ(column.meaning.find_first_of("\n|"), std::string::npos) << table.name << "." << column.name;
    }
  }
}

class StoredEpisode : public testing::Test {
 protected:
  void SetUp() override {
    auto writer = EpisodeWriter::Create(folder_ / "a.episode", {"0.1.0", {}, {}});
    ASSERT_TRUE(writer.ok());
    Model model;
    model.id = {5};
    const std::vector<Event> events{
        {{1}, {0}, 0, {}, {}, EpisodeStarted{"grab", "scripted", 7, 100'000, {{"psi", "0.5"}, {"min", "2"}}}},
        {{2}, {0}, 0, {}, {{1}}, ModelCreated{model, {0.75, 1}, false, Origin::kAnalogy, {}}},
        {{3}, {100'000}, 1, {}, {{2}, {1}}, EvidenceUpdated{{5}, true, {0.75, 1}, {1.75, 2}, false, false}},
        {{4}, {200'000}, 2, {9}, {{3}}, SimulationStarted{{9}, {1}, {{Term::Entity("h"), {5}, {}}}, 0.5}},
        {{5}, {300'000}, 3, {}, {{3}}, ModelStateChanged{{5}, ModelState::kActive, ModelState::kDeleted}}};
    for (const Event& event : events) (*writer)->Append(event);
    ASSERT_TRUE((*writer)->Finish().ok());
  }
  std::string Answer(const std::string& sql) const { return Ask(folder_ / "a.episode", sql); }

  TemporaryFolder folder_;
};

TEST_F(StoredEpisode, IsSoundAndStrict) {
  EXPECT_EQ(Answer("PRAGMA integrity_check"), "ok\n");
  EXPECT_EQ(Answer("PRAGMA application_id"), "1095062081\n");
  EXPECT_EQ(Answer("PRAGMA user_version"), std::to_string(kSchemaVersion) + "\n");
  EXPECT_EQ(Answer("PRAGMA journal_mode"), "delete\n");
  EXPECT_EQ(Answer("SELECT name FROM pragma_table_list WHERE schema='main' AND type='table' AND NOT strict "
                   "AND name NOT "
                   "LIKE 'sqlite%'"),
            "");
}

TEST_F(StoredEpisode, EventViewHasAllKindsInOneList) {
  EXPECT_EQ(Answer("SELECT * FROM event ORDER BY seq"),
            "1|0|0|NULL|NULL|EpisodeStarted\n2|0|0|NULL|1|ModelCreated\n3|100000|1|NULL|2|EvidenceUpdated\n"
            "4|200000|2|9|3|SimulationStarted\n5|300000|3|NULL|3|ModelStateChanged\n");
}

TEST_F(StoredEpisode, ConfidenceStepsAndTimelineOfAModel) {
  EXPECT_EQ(
      Answer("SELECT seq, model, success, positive, total, confidence FROM confidence_steps ORDER BY seq"),
      "2|5|NULL|0.75|1.0|0.75\n3|5|1|1.75|2.0|0.875\n");
  EXPECT_EQ(Answer("SELECT seq, what, confidence FROM model_timeline WHERE model=5 ORDER BY seq"),
            "2|created by analogy|0.75\n3|right|0.875\n5|deleted|NULL\n");
}

TEST_F(StoredEpisode, ChainsAreWalkedInSql) {
  EXPECT_EQ(Answer("SELECT cause, effect FROM chain_edges ORDER BY effect, cause"),
            "1|2\n1|3\n2|3\n3|4\n3|5\n");
  EXPECT_EQ(
      Answer(
          "WITH RECURSIVE why(seq) AS (VALUES(5) UNION SELECT cause FROM chain_edges JOIN why ON effect=seq) "
          "SELECT group_concat(seq) FROM (SELECT seq FROM why ORDER BY seq)"),
      "1,2,3,5\n");
}

TEST_F(StoredEpisode, ListsContentsAndCountsAreTables) {
  EXPECT_EQ(Answer("SELECT * FROM EpisodeStarted_parameters"), "1|0|psi|0.5\n1|1|min|2\n");
  EXPECT_EQ(
      Answer(
          "SELECT text, causal_model, requirement FROM SimulationStarted_steps JOIN content ON id=command"),
      "@h|5|NULL\n");
  EXPECT_EQ(
      Answer("SELECT kind, events FROM event_count WHERE events>0 ORDER BY kind"),
      "EpisodeStarted|1\nEvidenceUpdated|1\nModelCreated|1\nModelStateChanged|1\nSimulationStarted|1\n");
  EXPECT_EQ(Answer("SELECT id, program_version, events, length(digest) FROM episode"), "1|0.1.0|5|32\n");
}

TEST_F(StoredEpisode, SaysItselfWhatItsColumnsMean) {
  EXPECT_EQ(
      Answer("SELECT meaning FROM schema_column WHERE table_name='GoalSet' AND column_name='super_goal'"),
      "the goal it serves; NULL: none\n");
  EXPECT_THAT(Answer("SELECT sql FROM sqlite_schema WHERE name='GoalSet'"),
              testing::HasSubstr("-- the goal it serves"));
}

}  // namespace
}  // namespace aerascope
