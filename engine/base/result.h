// Result<T>: a value, or one sentence that says what went wrong. The only way outside trouble (files, input,
// GPU) travels between modules; exceptions do not cross a module border.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace aerascope {

// One sentence: what was expected, what was found, where ("file:line:column: ..." at the front), what to do.
struct Error {
  std::string message;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT: a value is a result
  Result(Error error) : content_(std::move(error)) {}  // NOLINT: so is an error

  bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }

  // The value; only when ok().
  const T& value() const& { return std::get<T>(content_); }
  T& value() & { return std::get<T>(content_); }
  T&& value() && { return std::get<T>(std::move(content_)); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  // The error; only when not ok().
  const Error& error() const { return std::get<Error>(content_); }

 private:
  std::variant<T, Error> content_;
};

// A result without a value. `return Ok();` when all went well.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}  // NOLINT: an error is a status

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

inline Status Ok() {
  return {};
}

// Where in a text file something is; line and column count from 1, the column in bytes.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

inline Error ErrorAt(const SourceLocation& at, const std::string& message) {
  return {at.file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": " + message};
}

}  // namespace aerascope
