// Writes the image of an empty episode to the file named by its argument; part of the build, not of the
// program.
#include <sqlite3.h>

#include <cstdio>
#include <fstream>

#include "engine/store/database.h"
#include "engine/store/episode_header.h"
#include "engine/store/episode_schema.h"

namespace aerascope {
namespace {

bool InsertMeanings(Database* database, const std::vector<StoredTable>& tables) {
  const Statement prepared = database->Prepare("INSERT INTO schema_column VALUES(?,?,?)");
  if (!prepared.get()) return false;
  const auto insert = [&](const std::string& table, const std::string& column, const std::string& meaning) {
    BindText(prepared.get(), 1, table);
    BindText(prepared.get(), 2, column);
    BindText(prepared.get(), 3, meaning);
    const bool done = sqlite3_step(prepared.get()) == SQLITE_DONE;
    sqlite3_reset(prepared.get());
    return done;
  };
  for (const StoredTable& table : tables) {
    if (!insert(table.name, "", table.meaning)) return false;
    for (const StoredColumn& column : table.columns) {
      if (!insert(table.name, column.name, column.meaning)) return false;
    }
  }
  for (const StoredView& view : Views()) {
    if (!insert(view.name, "", view.meaning)) return false;
  }
  return true;
}

bool Fill(Database* database) {
  if (database->Execute(
          "PRAGMA page_size=4096; PRAGMA application_id=" + std::to_string(kEpisodeApplicationId) +
          "; PRAGMA user_version=" + std::to_string(kSchemaVersion) + "; BEGIN") != SQLITE_OK) {
    return false;
  }
  std::vector<StoredTable> tables = CommonTables();
  for (StoredTable& table : EventTables()) tables.push_back(std::move(table));
  for (const StoredTable& table : tables) {
    if (database->Execute(CreateSql(table)) != SQLITE_OK) return false;
  }
  for (const StoredView& view : Views()) {
    if (database->Execute(CreateSql(view)) != SQLITE_OK) return false;
  }
  return InsertMeanings(database, tables) && database->Execute("COMMIT") == SQLITE_OK;
}

int Write(const char* path) {
  Database database;
  if (database.Open(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE) != SQLITE_OK ||
      !Fill(&database)) {
    std::fprintf(stderr, "cannot make an empty episode: %s\n", database.Problem().c_str());
    return 1;
  }
  sqlite3_int64 size = 0;
  unsigned char* image = sqlite3_serialize(database.get(), "main", &size, 0);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(image), size);
  file.close();
  sqlite3_free(image);
  if (file.fail()) std::fprintf(stderr, "cannot write %s\n", path);
  return file.fail() ? 1 : 0;
}

}  // namespace
}  // namespace aerascope

int main(int count, char** arguments) {
  return count == 2 ? aerascope::Write(arguments[1]) : 1;
}
