#include "engine/store/episode_schema.h"

#include "engine/base/text.h"
#include "engine/store/column_codec.h"

namespace aerascope {
namespace {

StoredColumn Integer(std::string name, std::string meaning) {
  return {std::move(name), "INTEGER", false, std::move(meaning)};
}
StoredColumn IntegerOrNull(std::string name, std::string meaning) {
  return {std::move(name), "INTEGER", true, std::move(meaning)};
}
StoredColumn Text(std::string name, std::string meaning) {
  return {std::move(name), "TEXT", false, std::move(meaning)};
}

Columns CommonColumns() {
  return {
      Integer("seq", "number of the event, from 1, without gaps"),
      Integer("time_us", "engine time at which it happened, microseconds"),
      Integer("frame", "sampling periods since the start"),
      IntegerOrNull("in_simulation", "the simulation it happened in; NULL: it happened in fact"),
      IntegerOrNull("cause", "the event that most directly caused it; more are in event_cause; NULL: none")};
}

template <class Body>
void AddTablesOfKind(std::vector<StoredTable>* tables) {
  StoredTable table{std::string(Body::kName), std::string(Body::kMeaning), CommonColumns(),
                    StoredTable::Key::kNumber};
  std::vector<StoredTable> lists;
  ForEachField<Body>([&](const auto& field) {
    using Value = std::decay_t<decltype(std::declval<Body>().*(field.member))>;
    const std::string name(field.name);
    const std::string meaning(field.meaning);
    if constexpr (kIsList<Value>) {
      StoredTable list{
          table.name + "_" + name,
          "The " + name + " of " + table.name + ": " + meaning + ".",
          {Integer("event", "the event it belongs to"), Integer("position", "position in the list, from 0")},
          StoredTable::Key::kPosition};
      DescribeElement<typename Value::value_type>(meaning, &list.columns);
      lists.push_back(std::move(list));
    } else {
      ColumnCodec<Value>::Describe(name, meaning, &table.columns);
    }
  });
  tables->push_back(std::move(table));
  for (StoredTable& list : lists) tables->push_back(std::move(list));
}

std::string UnionOverKinds(const std::string& select_before_kind, const std::string& condition) {
  std::vector<std::string> parts;
  ForEachKind([&]<class Body>() {
    std::string select = select_before_kind;
    const std::size_t at = select.find("KIND");
    if (at != std::string::npos) select.replace(at, 4, "'" + std::string(Body::kName) + "'");
    parts.push_back("SELECT " + select + " FROM " + Quoted(std::string(Body::kName)) + condition);
  });
  return Join(parts, "\nUNION ALL\n");
}

}  // namespace

std::string Quoted(const std::string& name) {
  return "\"" + name + "\"";
}

std::vector<StoredTable> CommonTables() {
  return {
      {"episode",
       "One row: the episode as a whole.",
       {Integer("id", "always 1"),
        Text("program_version", "version of the program that wrote the file"),
        IntegerOrNull("events", "number of events; NULL while the episode is not finished"),
        {"digest", "TEXT", true, "hash of the event stream, 32 hexadecimal digits; NULL while not finished"}},
       StoredTable::Key::kNumber},
      {"setting",
       "The settings of the run.",
       {Text("name", "name of the setting"), Text("value", "its value as text")},
       StoredTable::Key::kText},
      {"file",
       "The files of the scenario: all that is needed to look at the episode elsewhere.",
       {Integer("position", "order, from 1"),
        Text("name", "relative name, with slashes"),
        {"bytes", "BLOB", false, "what the file holds"}},
       StoredTable::Key::kNumber},
      {"content",
       "Terms, each written once and referred to by id: payloads, patterns, definitions.",
       {Integer("id", "number of the term, from 1, without gaps"),
        Text("text", "the term in the exact notation of engine/kb/term_codec.h")},
       StoredTable::Key::kNumber},
      {"event_cause",
       "The causes of an event after the first one.",
       {Integer("event", "the event"), Integer("position", "1 for its second cause, and so on"),
        Integer("cause", "an earlier event")},
       StoredTable::Key::kPosition},
      {"event_count",
       "How many events of each kind there are; filled when the episode is finished.",
       {Text("kind", "name of the kind and of its table"), Integer("events", "number of events")},
       StoredTable::Key::kText},
      {"schema_column",
       "What every table and column means.",
       {Text("table_name", "the table or view"),
        Text("column_name", "the column; empty for the table itself"),
        Text("meaning", "what it says, with the unit")},
       StoredTable::Key::kTwoTexts},
  };
}

std::vector<StoredTable> EventTables() {
  std::vector<StoredTable> tables;
  ForEachKind([&]<class Body>() { AddTablesOfKind<Body>(&tables); });
  return tables;
}

std::vector<StoredView> Views() {
  return {
      {"event",
       "Every event, without what is special to its kind: seq, time_us, frame, in_simulation, cause, kind.",
       UnionOverKinds("seq, time_us, frame, in_simulation, cause, KIND AS kind", "")},
      {"confidence_steps",
       "The confidence of each model over time: its first evidence, then one row an outcome. success is NULL "
       "at first.",
       "SELECT seq, time_us, frame, model, NULL AS success, evidence_positive AS positive, evidence_total AS "
       "total,\n"
       "       evidence_positive / evidence_total AS confidence, strong, cause FROM \"ModelCreated\"\n"
       "UNION ALL\n"
       "SELECT seq, time_us, frame, model, success, after_positive, after_total,\n"
       "       after_positive / after_total, strong_after, cause FROM \"EvidenceUpdated\""},
      {"model_timeline",
       "What happened to each model, in words: created (by what), right, wrong, active, phased_out, deleted.",
       "SELECT seq, time_us, frame, model, 'created by ' || origin AS what,\n"
       "       evidence_positive / evidence_total AS confidence FROM \"ModelCreated\"\n"
       "UNION ALL\n"
       "SELECT seq, time_us, frame, model, CASE success WHEN 1 THEN 'right' ELSE 'wrong' END,\n"
       "       after_positive / after_total FROM \"EvidenceUpdated\"\n"
       "UNION ALL\n"
       "SELECT seq, time_us, frame, model, after, NULL FROM \"ModelStateChanged\""},
      {"chain_edges", "Which event caused which: cause, effect. Walk it with a recursive query.",
       UnionOverKinds("cause, seq AS effect", " WHERE cause IS NOT NULL") +
           "\nUNION ALL\nSELECT cause, event FROM \"event_cause\""},
  };
}

std::string CreateSql(const StoredTable& table) {
  using Key = StoredTable::Key;
  std::string sql = "CREATE TABLE " + Quoted(table.name) + " (  -- " + table.meaning + "\n";
  std::string key;
  if (table.key == Key::kText) key = Quoted(table.columns[0].name);
  if (table.key == Key::kTwoTexts) key = Quoted(table.columns[0].name) + ", " + Quoted(table.columns[1].name);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const StoredColumn& column = table.columns[i];
    sql += "  " + Quoted(column.name) + " " + column.type;
    if (i == 0 && table.key == Key::kNumber) {
      sql += " PRIMARY KEY";
    } else if (!column.may_be_null) {
      sql += " NOT NULL";
    }
    const bool last = i + 1 == table.columns.size() && key.empty();
    sql += (last ? "  -- " : ",  -- ") + column.meaning + "\n";
  }
  if (!key.empty()) return sql + "  PRIMARY KEY (" + key + ")\n) STRICT, WITHOUT ROWID";
  return sql + ") STRICT";
}

std::string OrderSql(const StoredTable& table) {
  switch (table.key) {
    case StoredTable::Key::kNumber:
    case StoredTable::Key::kText:
      return Quoted(table.columns[0].name);
    case StoredTable::Key::kTwoTexts:
      return Quoted(table.columns[0].name) + ", " + Quoted(table.columns[1].name);
    case StoredTable::Key::kPosition:
      return "rowid";
  }
  return {};
}

std::string CreateSql(const StoredView& view) {
  return "CREATE VIEW " + Quoted(view.name) + " AS  -- " + view.meaning + "\n" + view.sql;
}

std::vector<StoredIndex> Indexes(const std::vector<StoredTable>& tables) {
  std::vector<StoredIndex> indexes{
      {"event_cause", "CREATE INDEX event_cause_by_cause ON event_cause(cause)"}};
  for (const StoredTable& table : tables) {
    if (table.key == StoredTable::Key::kPosition) {
      // Keys of lists are made here and not by the tables: adding to a table that is ordered by row number is
      // faster.
      indexes.push_back({table.name, "CREATE UNIQUE INDEX " + Quoted(table.name + "_by_event") + " ON " +
                                         Quoted(table.name) + "(event, position)"});
    } else if (table.columns.size() > 4 && table.columns[4].name == "cause") {
      indexes.push_back({table.name, "CREATE INDEX " + Quoted(table.name + "_by_cause") + " ON " +
                                         Quoted(table.name) + "(cause) WHERE cause IS NOT NULL"});
    }
  }
  return indexes;
}

std::string InsertSql(const StoredTable& table) {
  std::string parameters = "?";
  for (std::size_t i = 1; i < table.columns.size(); ++i) parameters += ",?";
  return "INSERT INTO " + Quoted(table.name) + " VALUES(" + parameters + ")";
}

}  // namespace aerascope
