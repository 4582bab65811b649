#include "engine/store/episode_reader.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "engine/kb/term_codec.h"
#include "engine/store/column_codec.h"
#include "engine/store/database.h"
#include "engine/store/episode_schema.h"

namespace aerascope {
namespace {

namespace fs = std::filesystem;

// ------------------------------------------------------------------------------------------------- opening
// the file

// The first 100 bytes of every SQLite file, as far as they matter here.
struct FileHeader {
  std::int32_t version = 0;  // kSchemaVersion of the writer
  std::uint64_t page_size = 0;
  std::uint64_t pages = 0;  // what the file should hold
};

std::uint32_t BigEndian(std::string_view bytes, std::size_t offset, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

Error Unreadable(const std::string& path, const std::string& reason) {
  return {"cannot read episode " + path + ": " + reason};
}

bool HasContent(const std::string& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return !error && size > 0;
}

Result<FileHeader> ReadFileHeader(const std::string& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) return Unreadable(path, "there is no such file");
  if (!fs::is_regular_file(status)) return Unreadable(path, "it is not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) return Unreadable(path, "no permission to read it");
  std::string bytes(100, '\0');
  file.read(bytes.data(), 100);
  const std::string kind = "expected an episode written by `aerascope run`, found ";
  if (file.gcount() == 0) return Unreadable(path, kind + "an empty file");
  if (!bytes.starts_with(std::string_view("SQLite format 3\0", 16)))
    return Unreadable(path, kind + "another kind of file");
  if (file.gcount() < 100) return Unreadable(path, "it is cut off in its first 100 bytes");
  if (BigEndian(bytes, 68, 4) != static_cast<std::uint32_t>(kEpisodeApplicationId)) {
    return Unreadable(path, kind + "another SQLite database");
  }
  FileHeader header;
  header.version = static_cast<std::int32_t>(BigEndian(bytes, 60, 4));
  if (header.version > kSchemaVersion) {
    return Unreadable(path, "it was written by a newer aerascope (episode version " +
                                std::to_string(header.version) + ", this program knows up to " +
                                std::to_string(kSchemaVersion) + "); use that program or a newer one");
  }
  header.page_size = BigEndian(bytes, 16, 2);
  if (header.page_size == 1) header.page_size = 65536;
  header.pages = BigEndian(bytes, 28, 4);
  const std::uint64_t size = fs::file_size(path, error);
  if (!HasContent(path + "-wal") && !HasContent(path + "-journal") &&
      size < header.page_size * header.pages) {
    return Unreadable(path, "it is cut off: it should have " +
                                std::to_string(header.page_size * header.pages) + " bytes and has " +
                                std::to_string(size));
  }
  return header;
}

// A private copy of a file and what lies beside it, for recovery where nothing may be written there.
class TemporaryCopy {
 public:
  TemporaryCopy() = default;
  TemporaryCopy(const TemporaryCopy&) = delete;
  ~TemporaryCopy() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }

  // The path of the copy; empty if it could not be made.
  std::string Make(const std::string& path) {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "aerascope-XXXXXX").string();
    if (error || mkdtemp(pattern.data()) == nullptr) return {};
    folder_ = pattern;
    const std::string copy = (folder_ / "episode").string();
    if (!fs::copy_file(path, copy, error)) return {};
    for (const char* suffix : {"-wal", "-journal"}) {
      if (HasContent(path + suffix) && !fs::copy_file(path + suffix, copy + suffix, error)) return {};
    }
    return copy;
  }

 private:
  fs::path folder_;
};

// Lets our SELECTs read plain tables and nothing else: no views, functions or recursion that a crafted file
// may hold.
int AllowPlainReading(void*, int action, const char*, const char*, const char*, const char* inside_view) {
  const bool plain = (action == SQLITE_SELECT || action == SQLITE_READ) && inside_view == nullptr;
  return plain ? SQLITE_OK : SQLITE_DENY;
}

// An open episode, with what protects against a file made to do harm.
class OpenFile {
 public:
  Status Open(const std::string& path) {
    path_ = path;
    Result<FileHeader> header = ReadFileHeader(path);
    if (!header) return header.error();
    header_ = *header;
    if (TryOpen(path, SQLITE_OPEN_READONLY)) return Ok();
    // A file from a killed run in a folder where nothing may be written: recover a copy.
    const int code = database_.ProblemCode() & 0xff;
    if (code == SQLITE_CANTOPEN || code == SQLITE_READONLY || code == SQLITE_PERM) {
      const std::string copy = copy_.Make(path);
      if (!copy.empty() && TryOpen(copy, SQLITE_OPEN_READWRITE)) return Ok();
    }
    return Trouble();
  }

  Database& database() { return database_; }
  Error Trouble() const { return Unreadable(path_, database_.Problem()); }
  Error Damaged(const std::string& what) const { return Unreadable(path_, "it is damaged: " + what); }
  bool older() const { return header_.version < kSchemaVersion; }

  // For each column of `table`, its place in SelectSql's rows, or -1 if the file, being older, lacks it. A
  // table that is missing gives an empty list.
  Result<std::vector<int>> PlacesOf(const StoredTable& table) {
    std::vector<int> places;
    if (!tables_.contains(table.name)) {
      if (older()) return places;
      return Damaged("the table " + table.name + " is missing");
    }
    int next = 0;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const bool there = !NameIn(table, i).empty();
      if (!there && (!older() || next == 0)) {
        return Damaged("the column " + table.columns[i].name + " of the table " + table.name + " is missing");
      }
      places.push_back(there ? next++ : -1);
    }
    return places;
  }

  // All rows in the order of the key, which is the order they lie in.
  Statement Select(const StoredTable& table, const std::vector<int>& places) {
    std::string columns;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (places[i] >= 0) columns += (columns.empty() ? "" : ",") + Quoted(NameIn(table, i));
    }
    return database_.Prepare("SELECT " + columns + " FROM " + Quoted(table.name) + " ORDER BY " +
                             OrderSql(table));
  }

 private:
  // What the file calls the i-th column of the table; empty if it has none. Where a list of plain values has
  // become one of structs since the file was written, its values are the first field.
  std::string NameIn(const StoredTable& table, std::size_t i) const {
    const std::set<std::string>& columns = tables_.at(table.name);
    if (columns.contains(table.columns[i].name)) return table.columns[i].name;
    const bool first_field =
        table.key == StoredTable::Key::kPosition && i == static_cast<std::size_t>(kListColumns);
    return older() && first_field && columns.contains("value") ? "value" : "";
  }

  bool TryOpen(const std::string& path, int flags) {
    tables_.clear();
    if (database_.Open(path, flags) != SQLITE_OK) return false;
    sqlite3* db = database_.get();
    sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(db, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_limit(db, SQLITE_LIMIT_LENGTH, static_cast<int>(LargestValue(path)));
    sqlite3_busy_timeout(db, 2000);
    // One transaction, so that a run that is still going on is read as of one moment.
    if (database_.Execute("PRAGMA cell_size_check=ON; PRAGMA mmap_size=0; BEGIN") != SQLITE_OK) return false;
    if (!ListTables()) return false;
    sqlite3_set_authorizer(db, AllowPlainReading, nullptr);
    return true;
  }

  // No value can be longer than the file and its log together.
  static std::uint64_t LargestValue(const std::string& path) {
    std::error_code error;
    std::uint64_t size = 1u << 20;
    for (const char* suffix : {"", "-wal"}) {
      const auto bytes = fs::file_size(path + suffix, error);
      if (!error) size += bytes;
    }
    return std::min<std::uint64_t>(size, 1'000'000'000);
  }

  bool ListTables() {
    const Statement tables =
        database_.Prepare("SELECT name FROM sqlite_schema WHERE type='table' AND rootpage>0");
    if (!tables.get()) return false;
    std::vector<std::string> names;
    int code = 0;
    while ((code = sqlite3_step(tables.get())) == SQLITE_ROW) {
      names.emplace_back(ColumnBytes(tables.get(), 0));
    }
    if (code != SQLITE_DONE) return false;
    const Statement columns = database_.Prepare("SELECT name FROM pragma_table_xinfo(?) WHERE hidden=0");
    if (!columns.get()) return false;
    for (const std::string& name : names) {
      std::set<std::string>& known = tables_[name];
      BindText(columns.get(), 1, name);
      while ((code = sqlite3_step(columns.get())) == SQLITE_ROW) known.emplace(ColumnBytes(columns.get(), 0));
      if (code != SQLITE_DONE) return false;
      sqlite3_reset(columns.get());
    }
    return true;
  }

  std::string path_;
  FileHeader header_;
  TemporaryCopy copy_;  // outlives the connection
  Database database_;
  std::map<std::string, std::set<std::string>> tables_;  // with their columns, generated ones left out
};

// -------------------------------------------------------------------------------------------------------------
// rows

// Walks the rows of one table in the order of its key.
class Rows {
 public:
  Status Open(OpenFile* file, const StoredTable& table) {
    file_ = file;
    table_ = &table;
    Result<std::vector<int>> places = file->PlacesOf(table);
    if (!places) return places.error();
    places_ = std::move(*places);
    if (places_.empty()) return Ok();
    statement_ = file->Select(table, places_);
    if (!statement_.get()) return file->Trouble();
    return Advance();
  }

  // To the first or next row; at_end() after the last.
  Status Advance() {
    key_ = 0;
    at_end_ = true;
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_DONE) return Ok();
    if (code != SQLITE_ROW) return file_->Trouble();
    at_end_ = false;
    key_ = sqlite3_column_type(statement_.get(), 0) == SQLITE_INTEGER
               ? sqlite3_column_int64(statement_.get(), 0)
               : 0;
    return Ok();
  }

  bool at_end() const { return at_end_; }
  std::int64_t key() const { return key_; }  // the first column: an event or an id

  RowReader Reader(const std::vector<Term>& contents) const {
    return RowReader(statement_.get(), places_, *table_, contents);
  }
  Error Damaged(const std::string& what) const {
    return file_->Damaged("in the table " + table_->name + ", row " + std::to_string(key_) + ", " + what);
  }

 private:
  OpenFile* file_ = nullptr;
  const StoredTable* table_ = nullptr;
  std::vector<int> places_;
  Statement statement_;
  bool at_end_ = true;
  std::int64_t key_ = 0;
};

constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();

// The rows of a list table that belong to `event`; `read` reads one element after the two key columns.
template <class Read>
Status ReadListOf(std::int64_t event, std::int64_t first_position, const std::vector<Term>& contents,
                  Rows* rows, Read&& read) {
  for (std::int64_t position = first_position; !rows->at_end(); ++position) {
    if (rows->key() > event) return Ok();
    RowReader row = rows->Reader(contents);
    std::int64_t owner = 0;
    std::int64_t found = 0;
    row.Integer(&owner, event, event);
    row.Integer(&found, position, position);
    read(&row);
    if (row.failed()) return rows->Damaged(row.problem());
    if (Status next = rows->Advance(); !next) return next;
  }
  return Ok();
}

// Reads the events of one kind, in order of their numbers.
class KindReader {
 public:
  virtual ~KindReader() = default;
  virtual Status Read(const std::vector<Term>& contents, Event* event) = 0;

  Rows rows;
  std::vector<Rows> lists;
};

template <class Body>
class KindReaderOf : public KindReader {
 public:
  Status Read(const std::vector<Term>& contents, Event* event) override {
    Body& body = event->body.emplace<Body>();
    RowReader row = rows.Reader(contents);
    std::int64_t cause = 0;
    row.Integer(&event->id.value, 1, kLargest);
    row.TimeUs(&event->time);
    row.Integer(&event->frame, 0, kLargest);
    row.IntegerOrNull(&event->simulation.value, kLargest);
    row.IntegerOrNull(&cause, event->id.value - 1);
    if (cause != 0) event->causes.push_back({cause});
    ForEachField<Body>([&](const auto& field) {
      using Value = std::decay_t<decltype(body.*(field.member))>;
      if constexpr (!kIsList<Value>) ColumnCodec<Value>::Read(&row, &(body.*(field.member)));
    });
    if (row.failed()) return rows.Damaged(row.problem());
    Status status = rows.Advance();
    std::size_t list = 0;
    ForEachField<Body>([&](const auto& field) {
      using Value = std::decay_t<decltype(body.*(field.member))>;
      if constexpr (kIsList<Value>) {
        if (!status) return;
        status = ReadListOf(event->id.value, 0, contents, &lists[list++], [&](RowReader* element) {
          ReadElement(element, &(body.*(field.member)).emplace_back());
        });
      }
    });
    return status;
  }
};

// --------------------------------------------------------------------------------------------------- the
// whole file

// Table descriptions that outlive the rows which point to them.
struct Tables {
  std::vector<StoredTable> common = CommonTables();
  std::vector<StoredTable> events = EventTables();

  const StoredTable& Common(std::string_view name) const {
    return *std::find_if(common.begin(), common.end(),
                         [&](const StoredTable& table) { return table.name == name; });
  }
};

// Calls read(RowReader*) for each row of a table beside the events.
template <class Read>
Status ReadCommon(OpenFile* file, const Tables& tables, std::string_view name, Read&& read) {
  static const std::vector<Term> kNoContents;
  Rows rows;
  Status status = rows.Open(file, tables.Common(name));
  while (status && !rows.at_end()) {
    RowReader row = rows.Reader(kNoContents);
    read(&row);
    if (row.failed()) return rows.Damaged(row.problem());
    status = rows.Advance();
  }
  return status;
}

struct StoredHeader {
  EpisodeHeader header;
  std::optional<std::int64_t> events;  // how many, if finished
  std::optional<Hash128> digest;
};

std::optional<Hash128> ParseHash(std::string_view text) {
  if (text.size() != 32) return std::nullopt;
  Hash128 hash;
  for (std::size_t i = 0; i < 32; ++i) {
    const char c = text[i];
    std::uint64_t digit = 0;
    if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint64_t>(c - '0');
    } else if (c >= 'a' && c <= 'f') {
      digit = static_cast<std::uint64_t>(c - 'a' + 10);
    } else {
      return std::nullopt;
    }
    std::uint64_t& half = i < 16 ? hash.high : hash.low;
    half = half << 4 | digit;
  }
  return hash;
}

Result<StoredHeader> ReadHeader(OpenFile* file, const Tables& tables) {
  StoredHeader stored;
  bool found = false;
  Status status = ReadCommon(file, tables, "episode", [&](RowReader* row) {
    std::int64_t id = 0;
    std::int64_t events = 0;
    std::string digest;
    found = true;
    row->Integer(&id, 1, 1);
    row->Text(&stored.header.program_version);
    if (row->NextIsNull()) return;
    row->Integer(&events, 0, kLargest);
    row->Text(&digest);
    stored.events = events;
    stored.digest = ParseHash(digest);
    if (!row->failed() && !stored.digest) row->Refuse("is not a hash of 32 hexadecimal digits");
  });
  if (!status) return status.error();
  if (!found) return file->Damaged("the table episode is empty");
  status = ReadCommon(file, tables, "setting", [&](RowReader* row) {
    std::string name;
    std::string value;
    row->Text(&name);
    row->Text(&value);
    stored.header.settings.emplace(std::move(name), std::move(value));
  });
  if (!status) return status.error();
  status = ReadCommon(file, tables, "file", [&](RowReader* row) {
    std::int64_t position = 0;
    NamedFile named;
    row->Integer(&position, 1, kLargest);
    row->Text(&named.name);
    row->Blob(&named.bytes);
    stored.header.files.push_back(std::move(named));
  });
  if (!status) return status.error();
  return stored;
}

Result<std::vector<Term>> ReadContents(OpenFile* file, const Tables& tables) {
  std::vector<Term> contents;
  Status status = ReadCommon(file, tables, "content", [&](RowReader* row) {
    std::int64_t id = 0;
    std::string text;
    const auto expected = static_cast<std::int64_t>(contents.size()) + 1;
    row->Integer(&id, expected, expected);
    row->Text(&text);
    if (row->failed()) return;
    Result<Term> term = DecodeTerm(text);
    if (!term) return row->Refuse("cannot be read: " + term.error().message);
    contents.push_back(std::move(*term));
  });
  if (!status) return status.error();
  return contents;
}

class EventsReader {
 public:
  Status Open(OpenFile* file, const Tables& tables) {
    if (Status status = causes_.Open(file, tables.Common("event_cause")); !status) return status;
    auto table = tables.events.begin();
    Status status;
    ForEachKind([&]<class Body>() {
      if (!status) return;
      auto reader = std::make_unique<KindReaderOf<Body>>();
      status = reader->rows.Open(file, *table++);
      ForEachField<Body>([&](const auto& field) {
        using Value = std::decay_t<decltype(std::declval<Body>().*(field.member))>;
        if constexpr (kIsList<Value>) {
          if (!status) return;
          status = reader->lists.emplace_back().Open(file, *table++);
        }
      });
      kinds_.push_back(std::move(reader));
    });
    return status;
  }

  // The events of all kinds, merged by number.
  Result<std::vector<Event>> Read(OpenFile* file, const std::vector<Term>& contents) {
    std::vector<Event> events;
    while (KindReader* kind = Next()) {
      const auto expected = static_cast<std::int64_t>(events.size()) + 1;
      if (kind->rows.key() != expected) {
        return file->Damaged("after event " + std::to_string(expected - 1) + " comes event " +
                             std::to_string(kind->rows.key()));
      }
      Event& event = events.emplace_back();
      if (Status status = kind->Read(contents, &event); !status) return status.error();
      if (event.causes.empty()) continue;
      const Status status = ReadListOf(expected, 1, contents, &causes_, [&](RowReader* row) {
        std::int64_t cause = 0;
        row->Integer(&cause, 1, expected - 1);
        event.causes.push_back({cause});
      });
      if (!status) return status.error();
    }
    if (!causes_.at_end()) return causes_.Damaged("there is no such event with causes");
    for (const auto& kind : kinds_) {
      for (const Rows& list : kind->lists) {
        if (!list.at_end()) return list.Damaged("there is no such event");
      }
    }
    return events;
  }

 private:
  KindReader* Next() {
    KindReader* next = nullptr;
    for (const auto& kind : kinds_) {
      if (kind->rows.at_end()) continue;
      if (next == nullptr || kind->rows.key() < next->rows.key()) next = kind.get();
    }
    return next;
  }

  std::vector<std::unique_ptr<KindReader>> kinds_;
  Rows causes_;
};

}  // namespace

Result<EpisodeHeader> ReadEpisodeHeader(const std::string& path) {
  OpenFile file;
  if (Status status = file.Open(path); !status) return status.error();
  Result<StoredHeader> stored = ReadHeader(&file, Tables());
  if (!stored) return stored.error();
  return std::move(stored->header);
}

Result<EpisodeFile> ReadEpisode(const std::string& path) {
  const Tables tables;
  OpenFile file;
  if (Status status = file.Open(path); !status) return status.error();
  Result<StoredHeader> stored = ReadHeader(&file, tables);
  if (!stored) return stored.error();
  Result<std::vector<Term>> contents = ReadContents(&file, tables);
  if (!contents) return contents.error();
  EventsReader reader;
  if (Status status = reader.Open(&file, tables); !status) return status.error();
  Result<std::vector<Event>> events = reader.Read(&file, *contents);
  if (!events) return events.error();

  EpisodeFile episode{std::move(stored->header), std::move(*events), false, stored->digest};
  if (stored->events && *stored->events != static_cast<std::int64_t>(episode.events.size())) {
    return file.Damaged("it should have " + std::to_string(*stored->events) + " events and has " +
                        std::to_string(episode.events.size()));
  }
  episode.complete = stored->digest && !episode.events.empty() &&
                     std::holds_alternative<EpisodeEnded>(episode.events.back().body);
  episode.older = file.older();
  if (episode.older) episode.stored_digest.reset();
  return episode;
}

}  // namespace aerascope
