// The tables and views of an episode file as data, made from the events' own description
// (engine/event/event_body.h): one table a kind of event, and one a list inside an event. The writer creates
// them, docs/event-schema.md prints them.
#pragma once

#include <string>
#include <vector>

namespace aerascope {

struct StoredColumn {
  std::string name;
  std::string type;  // INTEGER, REAL, TEXT or BLOB
  bool may_be_null = false;
  std::string meaning;  // a sentence or phrase, with the unit
};

struct StoredTable {
  std::string name;
  std::string meaning;
  std::vector<StoredColumn> columns;
  enum class Key {
    kNumber,    // the first column, a whole number
    kText,      // the first column, text
    kTwoTexts,  // the first two columns, text
    kPosition,  // the first two columns, event and position; rows are added, and lie, in that order
  };
  Key key = Key::kNumber;
};

struct StoredView {
  std::string name;
  std::string meaning;
  std::string sql;  // the SELECT
};

// The tables beside events: episode, setting, file, content, event_cause, event_count, schema_column.
std::vector<StoredTable> CommonTables();
// A table for each kind, in order of kinds, each followed by the tables of its lists.
std::vector<StoredTable> EventTables();
std::vector<StoredView> Views();

std::string CreateSql(const StoredTable& table);
std::string CreateSql(const StoredView& view);
// The order in which rows lie: an ORDER BY that costs nothing.
std::string OrderSql(const StoredTable& table);
// An index, created when all events are stored if its table has rows then: most episodes know but some kinds
// of events, and an index costs as much as a hundred rows.
struct StoredIndex {
  std::string table;
  std::string sql;
};
std::vector<StoredIndex> Indexes(const std::vector<StoredTable>& tables);
// INSERT with a parameter for each column.
std::string InsertSql(const StoredTable& table);
// "name" in quotes, so that SQL words (before, index, by) may be columns.
std::string Quoted(const std::string& name);

}  // namespace aerascope
