#include "engine/store/database.h"

#include <cerrno>
#include <cstring>

namespace aerascope {

int Database::Open(const std::string& path, int flags) {
  sqlite3* handle = nullptr;
  // SQLite takes "file:..." for a URI; a path that begins so is meant as a path.
  const std::string name = path.starts_with("file:") ? "./" + path : path;
  const int code =
      sqlite3_open_v2(name.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, nullptr);
  handle_.reset(handle);
  return code;
}

int Database::Execute(const std::string& sql) {
  return sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
}

Statement Database::Prepare(std::string_view sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v3(handle_.get(), sql.data(), static_cast<int>(sql.size()), SQLITE_PREPARE_PERSISTENT,
                     &statement, nullptr);
  return Statement(statement);
}

std::string Database::QueryText(std::string_view sql) {
  const Statement statement = Prepare(sql);
  if (!statement.get() || sqlite3_step(statement.get()) != SQLITE_ROW) return {};
  return std::string(ColumnBytes(statement.get(), 0));
}

std::int64_t Database::QueryInteger(std::string_view sql) {
  const Statement statement = Prepare(sql);
  if (!statement.get() || sqlite3_step(statement.get()) != SQLITE_ROW) return 0;
  return sqlite3_column_int64(statement.get(), 0);
}

int Database::CopyFrom(std::span<const std::byte> image) {
  Database source;
  const int opened = source.Open(":memory:", SQLITE_OPEN_READWRITE);
  if (opened != SQLITE_OK) return opened;
  // Read only: SQLite does not write to the image.
  auto* bytes = reinterpret_cast<unsigned char*>(const_cast<std::byte*>(image.data()));
  const auto size = static_cast<sqlite3_int64>(image.size());
  const int read = sqlite3_deserialize(source.get(), "main", bytes, size, size, SQLITE_DESERIALIZE_READONLY);
  if (read != SQLITE_OK) return read;
  sqlite3_backup* copy = sqlite3_backup_init(get(), "main", source.get(), "main");
  if (!copy) return ProblemCode();
  sqlite3_backup_step(copy, -1);
  return sqlite3_backup_finish(copy);
}

int Database::Close() {
  const int code = sqlite3_close(handle_.get());
  if (code == SQLITE_OK) (void)handle_.release();
  return code;
}

int Database::ProblemCode() const {
  return handle_ ? sqlite3_extended_errcode(handle_.get()) : SQLITE_NOMEM;
}

std::string Database::Problem() const {
  const int code = ProblemCode();
  // SQLite does not always keep the system's error; then errno still has it, as nothing else was called
  // since.
  const int last_error = errno;
  const int kept_error = handle_ ? sqlite3_system_errno(handle_.get()) : 0;
  const int system_error = kept_error != 0 ? kept_error : last_error;
  if ((code & 0xff) == SQLITE_FULL) return "the disk is full";
  if ((code & 0xff) == SQLITE_CORRUPT) return "it is damaged";
  if ((code & 0xff) == SQLITE_NOTADB) return "it is not an SQLite file";
  const bool system_is_the_reason = (code & 0xff) == SQLITE_IOERR || (code & 0xff) == SQLITE_CANTOPEN;
  if (system_is_the_reason && system_error != 0) return std::strerror(system_error);
  return handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory";
}

}  // namespace aerascope
