// Thin owners of an SQLite connection and its statements; only engine/store uses them.
#pragma once

#include <sqlite3.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

class Statement {
 public:
  Statement() = default;
  explicit Statement(sqlite3_stmt* handle) : handle_(handle) {}
  sqlite3_stmt* get() const { return handle_.get(); }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

// One connection; used by one thread at a time.
class Database {
 public:
  Database() = default;

  // The SQLite result code; the connection is kept also when it failed, for Problem().
  int Open(const std::string& path, int flags);
  int Execute(const std::string& sql);
  // An empty statement if it cannot be prepared.
  Statement Prepare(std::string_view sql);
  // The first column of the first row as text or number; "" or 0 where there is none.
  std::string QueryText(std::string_view sql);
  std::int64_t QueryInteger(std::string_view sql);
  int Close();
  // Makes the (empty) database a copy of one that lies in memory, as sqlite3_serialize gives it.
  int CopyFrom(std::span<const std::byte> image);

  sqlite3* get() const { return handle_.get(); }
  // What went wrong last, in words for people: "the disk is full", "it is damaged" ... To be asked at once.
  std::string Problem() const;
  int ProblemCode() const;

 private:
  struct CloseHandle {
    void operator()(sqlite3* handle) const { sqlite3_close(handle); }
  };
  std::unique_ptr<sqlite3, CloseHandle> handle_;
};

// Binds text or bytes that outlive the next step; 64-bit lengths.
inline int BindText(sqlite3_stmt* statement, int index, std::string_view text) {
  return sqlite3_bind_text64(statement, index, text.empty() ? "" : text.data(), text.size(), SQLITE_STATIC,
                             SQLITE_UTF8);
}
inline int BindBlob(sqlite3_stmt* statement, int index, std::string_view bytes) {
  return sqlite3_bind_blob64(statement, index, bytes.empty() ? "" : bytes.data(), bytes.size(),
                             SQLITE_STATIC);
}
inline std::string_view ColumnBytes(sqlite3_stmt* statement, int column) {
  // The pointer must be asked for before the length.
  const auto* data = static_cast<const char*>(sqlite3_column_blob(statement, column));
  const int size = sqlite3_column_bytes(statement, column);
  return data == nullptr ? std::string_view() : std::string_view(data, static_cast<std::size_t>(size));
}

}  // namespace aerascope
