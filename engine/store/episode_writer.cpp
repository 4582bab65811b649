#include "engine/store/episode_writer.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <unordered_map>
#include <vector>

#include "engine/event/event_packing.h"
#include "engine/kb/term_codec.h"
#include "engine/store/column_codec.h"
#include "engine/store/database.h"
#include "engine/store/empty_episode.h"
#include "engine/store/episode_schema.h"

namespace aerascope {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostQueuedEvents = 8192;
constexpr std::size_t kMostQueuedBytes = 32u << 20;
// The writer is woken early at this fill; else it looks every kLookEvery, which spares the reasoner the
// waking.
constexpr std::size_t kWakeAt = 4096;
constexpr std::chrono::milliseconds kLookEvery{10};
// What a reasoner says until the writer looks again is packed in memory that is there already.
constexpr std::size_t kPreparedBytes = 512u << 10;
constexpr int kEventsPerTransaction = 4096;
constexpr std::chrono::milliseconds kLongestTransaction{50};
// Terms remembered for interning, in two generations, so that memory stays bounded in a run of any length.
constexpr std::size_t kTermsPerGeneration = 16384;

// The most rows of event_cause written by one INSERT.
constexpr std::size_t kCausesPerInsert = 6;

// Where the SQLite file format keeps these numbers.
constexpr std::size_t kHeaderSize = 100;
constexpr std::size_t kApplicationIdOffset = 68;
constexpr std::streamoff kChangeCounterOffset = 24;
constexpr std::streamoff kVersionValidForOffset = 92;

struct HashTerm {
  std::size_t operator()(const Term& term) const { return static_cast<std::size_t>(term.hash()); }
};

// An episode or an empty file may be replaced; nothing else is.
Status MayReplace(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return Ok();
  const Error refusal{"cannot write " + path + ": expected no file or an earlier episode there, found "};
  if (!std::filesystem::is_regular_file(status))
    return Error{refusal.message + "something that is not a file"};
  std::ifstream file(path, std::ios::binary);
  std::array<char, kHeaderSize> header{};
  file.read(header.data(), header.size());
  if (file.gcount() == 0 && file.eof()) return Ok();
  const std::string_view magic("SQLite format 3\0", 16);
  std::int32_t id = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    id = id << 8 | static_cast<unsigned char>(header[kApplicationIdOffset + i]);
  }
  if (std::string_view(header.data(), 16) != magic || id != kEpisodeApplicationId) {
    return Error{refusal.message + "another kind of file; name another one, or remove it first"};
  }
  return Ok();
}

void RemoveEpisode(const std::string& path) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(path + suffix, ignored);
}

// While a new episode is written, the earlier one of that name stands beside it.
constexpr const char* kEarlier = ".earlier";

void MoveEpisode(const std::string& from, const std::string& to) {
  RemoveEpisode(to);
  std::error_code ignored;
  for (const char* suffix : {"", "-wal"}) std::filesystem::rename(from + suffix, to + suffix, ignored);
}

// SQLite's own message names the wrong reason where a folder is missing or may not be written.
Status MayWriteFolderOf(const std::string& path) {
  std::string folder = std::filesystem::path(path).parent_path().string();
  if (folder.empty()) folder = ".";
  if (access(folder.c_str(), F_OK) != 0)
    return Error{"cannot write " + path + ": there is no folder " + folder};
  if (access(folder.c_str(), W_OK) != 0) {
    return Error{"cannot write " + path + ": " + std::generic_category().message(errno)};
  }
  return Ok();
}

// SQLite counts commits in the file header. How many there were depends on the clock, so the finished file
// says 1.
bool FixChangeCounter(const std::string& path) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const char one[4] = {0, 0, 0, 1};
  for (const std::streamoff offset : {kChangeCounterOffset, kVersionValidForOffset}) {
    file.seekp(offset);
    file.write(one, sizeof one);
  }
  file.close();
  return !file.fail();
}

// The prepared INSERTs of one kind and of its lists.
struct KindStatements {
  std::size_t table = 0;  // position among all tables; those of its lists follow
  Statement event;
  std::vector<Statement> lists;
};

// Everything that touches the database; used by the writer's thread, and by Create and Finish while there is
// no thread.
class Store : public ContentIds {
 public:
  // Creates the file with its header; on failure nothing is left behind.
  Status Create(const std::string& path, const EpisodeHeader& header) {
    path_ = path;
    if (Status allowed = MayWriteFolderOf(path); !allowed) return allowed;
    std::error_code error;
    replaces_ = std::filesystem::exists(path, error);
    if (replaces_) MoveEpisode(path, path + kEarlier);
    RemoveEpisode(path);
    if (std::filesystem::exists(path, error)) {
      return Error{"cannot write " + path + ": the earlier episode there cannot be moved out of the way"};
    }
    const int opened = database_.Open(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    if (opened != SQLITE_OK || !CreateTables() || !InsertHeader(header) || !StartLogging()) {
      const Error trouble{"cannot write " + path + ": " + database_.Problem()};
      Discard();
      return trouble;
    }
    return Ok();
  }

  void Begin() {
    if (trouble_.empty()) Check(database_.Execute("BEGIN"));
  }

  void Commit() {
    if (!trouble_.empty()) return;
    if (Check(database_.Execute("COMMIT"))) committed_ = stored_;
  }

  void Insert(const Event& event) {
    if (!trouble_.empty()) return;
    if (event.id.value != stored_ + 1) {
      trouble_ = "event " + std::to_string(event.id.value) + " came after event " + std::to_string(stored_);
      return;
    }
    stored_ = event.id.value;
    const std::size_t kind = event.body.index();
    ++counts_[kind];
    digest_.Add(event);
    std::visit([&](const auto& body) { InsertBody(event, body, &statements_[kind]); }, event.body);
    InsertFurtherCauses(event);
  }

  // Number of the term in `content`; written there when it is not remembered.
  std::int64_t IdOf(const Term& term) override {
    if (const auto it = terms_.find(term); it != terms_.end()) return it->second;
    std::int64_t id = 0;
    if (const auto it = older_terms_.find(term); it != older_terms_.end()) {
      id = it->second;
    } else {
      id = ++last_content_;
      const std::string text = Encode(term);
      sqlite3_bind_int64(content_.get(), 1, id);
      BindText(content_.get(), 2, text);
      Check(sqlite3_step(content_.get()));
      sqlite3_reset(content_.get());
    }
    if (terms_.size() >= kTermsPerGeneration) {
      older_terms_ = std::move(terms_);
      terms_.clear();
    }
    terms_.emplace(term, id);
    return id;
  }

  // After the last commit: digest, counts, indexes, one plain file.
  Result<Hash128> Finish() {
    if (trouble_.empty()) Complete();
    if (!trouble_.empty()) {
      const Error error{"cannot write " + path_ + ": " + trouble_ + "; " + std::to_string(committed_) +
                        " events were stored and the unfinished file was removed"};
      Discard();
      return error;
    }
    if (replaces_) RemoveEpisode(path_ + kEarlier);
    replaces_ = false;
    return digest_.Value();
  }

  void Close() {
    Forget();
    database_.Close();
  }

  bool failed() const { return !trouble_.empty(); }
  std::int64_t committed() const { return committed_; }

 private:
  // The tables are there already in the image of an empty episode, made when the program was built.
  bool CreateTables() {
    tables_ = CommonTables();
    for (StoredTable& table : EventTables()) tables_.push_back(std::move(table));
    return database_.Execute("PRAGMA synchronous=OFF; PRAGMA secure_delete=OFF") == SQLITE_OK &&
           database_.CopyFrom(EmptyEpisodeImage()) == SQLITE_OK && database_.Execute("BEGIN") == SQLITE_OK;
  }

  bool InsertHeader(const EpisodeHeader& header) {
    if (!InsertTexts("INSERT INTO episode VALUES(1,?,NULL,NULL)", {header.program_version})) return false;
    for (const auto& [name, value] : header.settings) {
      if (!InsertTexts("INSERT INTO setting VALUES(?,?)", {name, value})) return false;
    }
    const Statement insert = database_.Prepare("INSERT INTO file VALUES(NULL,?,?)");
    for (const NamedFile& file : header.files) {
      BindText(insert.get(), 1, file.name);
      BindBlob(insert.get(), 2, file.bytes);
      if (sqlite3_step(insert.get()) != SQLITE_DONE) return false;
      sqlite3_reset(insert.get());
    }
    return database_.Execute("COMMIT") == SQLITE_OK;
  }

  bool InsertTexts(const std::string& sql, const std::vector<std::string>& values) {
    return StepWithTexts(database_.Prepare(sql), values);
  }

  static bool StepWithTexts(const Statement& insert, const std::vector<std::string>& values) {
    if (!insert.get()) return false;
    for (std::size_t i = 0; i < values.size(); ++i)
      BindText(insert.get(), static_cast<int>(i + 1), values[i]);
    const bool done = sqlite3_step(insert.get()) == SQLITE_DONE;
    sqlite3_reset(insert.get());
    return done;
  }

  bool StartLogging() {
    // Events are added at the end of each table only, so a small cache does. The log is moved into the file
    // every 32 MiB.
    if (database_.QueryText("PRAGMA journal_mode=WAL") != "wal") return false;
    if (database_.Execute(
            "PRAGMA synchronous=NORMAL; PRAGMA cache_size=-8000; PRAGMA wal_autocheckpoint=4096") !=
        SQLITE_OK) {
      return false;
    }
    content_ = database_.Prepare("INSERT INTO content VALUES(?,?)");
    if (!content_.get()) return false;
    std::string insert_causes = "INSERT INTO event_cause VALUES(?,?,?)";
    for (Statement& insert : causes_) {
      insert = database_.Prepare(insert_causes);
      if (!insert.get()) return false;
      insert_causes += ",(?,?,?)";
    }
    // Each kind's INSERTs are prepared when its first event comes; here it is only noted where its tables
    // are.
    std::map<std::string, std::size_t> kinds;
    std::size_t next_kind = 0;
    ForEachKind([&]<class Body>() { kinds.emplace(std::string(Body::kName), next_kind++); });
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      if (const auto kind = kinds.find(tables_[i].name); kind != kinds.end())
        statements_[kind->second].table = i;
    }
    return true;
  }

  // The INSERTs of a kind: its own table, and those of its lists, which follow it.
  bool Prepare(KindStatements* statements) {
    if (statements->event.get()) return true;
    std::size_t table = statements->table;
    filled_.insert(tables_[table].name);
    statements->event = database_.Prepare(InsertSql(tables_[table]));
    if (!statements->event.get()) return Check(database_.ProblemCode());
    for (++table; table < tables_.size() && tables_[table].key == StoredTable::Key::kPosition; ++table) {
      filled_.insert(tables_[table].name);
      statements->lists.push_back(database_.Prepare(InsertSql(tables_[table])));
      if (!statements->lists.back().get()) return Check(database_.ProblemCode());
    }
    return true;
  }

  template <class Body>
  void InsertBody(const Event& event, const Body& body, KindStatements* statements) {
    if (!Prepare(statements)) return;
    Binder row(statements->event.get(), this);
    row.Integer(event.id.value);
    row.Integer(event.time.us);
    row.Integer(event.frame);
    row.IntegerOrNull(event.simulation.value);
    row.IntegerOrNull(event.causes.empty() ? 0 : event.causes[0].value);
    ForEachField<Body>([&](const auto& field) {
      using Value = std::decay_t<decltype(body.*(field.member))>;
      if constexpr (!kIsList<Value>) ColumnCodec<Value>::Bind(body.*(field.member), &row);
    });
    Step(statements->event, row);
    std::size_t list = 0;
    ForEachField<Body>([&](const auto& field) {
      using Value = std::decay_t<decltype(body.*(field.member))>;
      if constexpr (kIsList<Value>) InsertList(event.id, body.*(field.member), statements->lists[list++]);
    });
  }

  // Several rows with one INSERT: a composite state has a handful of causes, and a statement costs more than
  // a row.
  void InsertFurtherCauses(const Event& event) {
    for (std::size_t i = 1; i < event.causes.size() && trouble_.empty();) {
      const std::size_t rows = std::min(event.causes.size() - i, kCausesPerInsert);
      const Statement& insert = causes_[rows - 1];
      Binder row(insert.get(), this);
      for (const std::size_t end = i + rows; i < end; ++i) {
        row.Integer(event.id.value);
        row.Integer(static_cast<std::int64_t>(i));
        row.Integer(event.causes[i].value);
      }
      Step(insert, row);
    }
  }

  template <class Element>
  void InsertList(EventId event, const std::vector<Element>& list, const Statement& statement) {
    for (std::size_t i = 0; i < list.size() && trouble_.empty(); ++i) {
      Binder row(statement.get(), this);
      row.Integer(event.value);
      row.Integer(static_cast<std::int64_t>(i));
      BindElement(list[i], &row);
      Step(statement, row);
    }
  }

  void Step(const Statement& statement, const Binder& row) {
    if (row.failed()) {
      Check(database_.ProblemCode());
    } else {
      Check(sqlite3_step(statement.get()));
    }
    sqlite3_reset(statement.get());
  }

  bool Check(int code) {
    if (code == SQLITE_OK || code == SQLITE_DONE || code == SQLITE_ROW) return true;
    if (trouble_.empty()) trouble_ = database_.Problem();
    return false;
  }

  void Complete() {
    if (!Check(database_.Execute("BEGIN"))) return;
    InsertCounts();
    for (const StoredIndex& index : Indexes(tables_)) {
      if (filled_.contains(index.table)) Check(database_.Execute(index.sql));
    }
    Check(database_.Execute("UPDATE episode SET events=" + std::to_string(stored_) + ", digest='" +
                            ToText(digest_.Value()) + "'"));
    if (trouble_.empty()) Check(database_.Execute("COMMIT"));
    if (trouble_.empty()) LeaveOnePlainFile();
  }

  void InsertCounts() {
    const Statement insert = database_.Prepare("INSERT INTO event_count VALUES(?,?)");
    std::size_t kind = 0;
    ForEachKind([&]<class Body>() {
      BindText(insert.get(), 1, Body::kName);
      sqlite3_bind_int64(insert.get(), 2, counts_[kind++]);
      Check(sqlite3_step(insert.get()));
      sqlite3_reset(insert.get());
    });
  }

  void LeaveOnePlainFile() {
    Forget();
    if (!Check(database_.Execute("PRAGMA wal_checkpoint(TRUNCATE)"))) return;
    if (database_.QueryText("PRAGMA journal_mode=DELETE") != "delete") {
      Check(database_.ProblemCode());
      if (trouble_.empty()) trouble_ = "another program is reading it; close that program and run again";
      return;
    }
    if (!Check(database_.Close())) return;
    if (!FixChangeCounter(path_)) trouble_ = "its header could not be written";
  }

  // Statements must be gone before the connection is closed.
  void Forget() {
    content_ = {};
    for (Statement& statement : causes_) statement = {};
    for (KindStatements& statements : statements_) {
      statements.event = {};
      statements.lists.clear();
    }
  }

  void Discard() {
    Close();
    database_ = {};
    RemoveEpisode(path_);
    if (replaces_) MoveEpisode(path_ + kEarlier, path_);
    replaces_ = false;
  }

  std::string path_;
  bool replaces_ = false;  // an earlier episode was moved aside and comes back if this one fails
  Database database_;
  std::vector<StoredTable> tables_;
  std::set<std::string> filled_{"event_cause"};  // tables that have rows, or could have some
  Statement content_;
  std::array<Statement, kCausesPerInsert> causes_;  // for 1, 2, 3 ... rows
  std::array<KindStatements, kEventKinds> statements_;
  std::array<std::int64_t, kEventKinds> counts_{};
  std::unordered_map<Term, std::int64_t, HashTerm> terms_;
  std::unordered_map<Term, std::int64_t, HashTerm> older_terms_;
  std::int64_t last_content_ = 0;
  std::int64_t stored_ = 0;
  std::int64_t committed_ = 0;
  EventDigest digest_;
  std::string trouble_;
};

}  // namespace

// The queue between the appending thread and the writer's: events packed, so that the threads share no memory
// but the bytes that are handed over.
struct EpisodeWriter::State {
  TermSpace space;  // of all terms in the writer's thread
  Store store;

  std::mutex mutex;
  std::condition_variable work;  // the writer waits for events, a flush, or the end
  std::condition_variable room;  // Append waits for the queue to empty, Flush for the commit
  EventPacker packer;
  PackedBytes queue;
  PackedBytes batch;  // what the writer is at; the two change places
  std::size_t queued_events = 0;
  std::int64_t appended = 0;  // events given to Append
  std::int64_t handled = 0;   // of those: committed, or dropped after trouble
  bool writer_idle = false;   // waiting without limit: wake it for the first event
  bool flush = false;
  bool stop = false;
  std::atomic<std::int64_t> committed{0};

  std::thread thread;
  std::optional<Result<Hash128>> result;

  void Write();
  void StopThread();
};

void EpisodeWriter::State::Write() {
  const TermSpace::Scope in_space(space);
  EventUnpacker unpacker;
  std::int64_t taken = 0;
  int in_transaction = 0;
  Clock::time_point deadline;
  for (bool last_round = false; !last_round;) {
    bool commit_now = false;
    {
      std::unique_lock lock(mutex);
      const auto urgent = [&] { return stop || flush || queued_events >= kWakeAt; };
      if (queued_events == 0 && in_transaction == 0) {
        writer_idle = true;
        work.wait(lock, [&] { return urgent() || queued_events > 0; });
        writer_idle = false;
      }
      work.wait_for(lock, kLookEvery, urgent);
      commit_now = flush || stop;
      last_round = stop;
      flush = false;
      batch.swap(queue);
      queued_events = 0;
    }
    room.notify_all();
    for (PackedReader reader(batch); !reader.at_end();) {
      const Event event = unpacker.Unpack(&reader);
      if (in_transaction == 0) {
        store.Begin();
        deadline = Clock::now() + kLongestTransaction;
      }
      store.Insert(event);
      ++taken;
      if (++in_transaction >= kEventsPerTransaction) {
        store.Commit();
        committed = store.committed();
        in_transaction = 0;
      }
    }
    batch.clear();
    if (in_transaction > 0 && (commit_now || Clock::now() >= deadline)) {
      store.Commit();
      committed = store.committed();
      in_transaction = 0;
    }
    if (in_transaction == 0) {
      const std::lock_guard lock(mutex);
      handled = taken;
      room.notify_all();
    }
  }
}

void EpisodeWriter::State::StopThread() {
  if (!thread.joinable()) return;
  {
    const std::lock_guard lock(mutex);
    stop = true;
  }
  work.notify_one();
  thread.join();
}

EpisodeWriter::EpisodeWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

EpisodeWriter::~EpisodeWriter() {
  state_->StopThread();
  if (!state_->result) state_->store.Close();
}

Result<std::unique_ptr<EpisodeWriter>> EpisodeWriter::Create(const std::string& path, EpisodeHeader header) {
  std::set<std::string> names;
  for (const NamedFile& file : header.files) {
    if (!names.insert(file.name).second)
      return Error{"cannot write " + path + ": two files are called " + file.name};
  }
  if (Status allowed = MayReplace(path); !allowed) return allowed.error();
  auto state = std::make_unique<State>();
  if (Status created = state->store.Create(path, header); !created) return created.error();
  for (PackedBytes* bytes : {&state->queue, &state->batch}) bytes->Prepare(kPreparedBytes);
  State* shared = state.get();
  state->thread = std::thread([shared] { shared->Write(); });
  return std::unique_ptr<EpisodeWriter>(new EpisodeWriter(std::move(state)));
}

void EpisodeWriter::Append(Event event) {
  State& state = *state_;
  bool wake = false;
  {
    std::unique_lock lock(state.mutex);
    state.room.wait(lock, [&] {
      return state.queued_events < kMostQueuedEvents && state.queue.size() < kMostQueuedBytes;
    });
    state.packer.Pack(event, &state.queue);
    ++state.queued_events;
    ++state.appended;
    wake = state.queued_events == kWakeAt || state.writer_idle || state.queue.size() >= kMostQueuedBytes;
  }
  if (wake) state.work.notify_one();
}

void EpisodeWriter::Flush() {
  State& state = *state_;
  std::unique_lock lock(state.mutex);
  if (state.stop) return;
  const std::int64_t wanted = state.appended;
  state.flush = true;
  state.work.notify_one();
  state.room.wait(lock, [&] { return state.handled >= wanted; });
}

EventId EpisodeWriter::Committed() const {
  return {state_->committed.load()};
}

Result<Hash128> EpisodeWriter::Finish() {
  state_->StopThread();
  if (!state_->result) state_->result = state_->store.Finish();
  return *state_->result;
}

}  // namespace aerascope
