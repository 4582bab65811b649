// A configuration file as plain data with positions, and readers that turn it into structs and refuse what
// they do not know. The file format is TOML 1.0.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace aerascope {

struct ConfigValue {
  enum class Kind { kTable, kList, kString, kInteger, kNumber, kBool, kOther };

  Kind kind = Kind::kOther;
  std::string text;                                // of a string
  std::int64_t integer = 0;                        // of an integer or bool
  double number = 0;                               // of a number or integer
  std::vector<ConfigValue> items;                  // of a list, or the values of a table
  std::vector<std::string> keys;                   // of a table, in order of the alphabet
  std::vector<std::pair<int, int>> key_positions;  // line and column of each key
  int line = 1;
  int column = 1;
};

// The whole file as a table.
Result<ConfigValue> ParseConfig(std::string_view text, const std::string& file);

// Collects what is wrong. The first in the file is reported; that something is missing only if nothing else
// is wrong, as a misspelt key is both.
class ConfigErrors {
 public:
  explicit ConfigErrors(std::string file) : file_(std::move(file)) {}
  void Add(int line, int column, std::string message);
  void Add(const ConfigValue& value, std::string message) {
    Add(value.line, value.column, std::move(message));
  }
  void AddMissing(const ConfigValue& table, std::string message);
  // An error that already says where it is.
  void Add(int line, int column, const Error& error);
  Status First() const;
  const std::string& file() const { return file_; }

 private:
  struct Entry {
    bool missing;
    int line;
    int column;
    Error error;
  };
  std::string file_;
  std::vector<Entry> entries_;
};

// Reads the keys of one table. A wrong value is reported and the fallback returned, so that reading goes on;
// Finish reports the keys nobody asked for. The errors and the value must outlive the reader.
class ConfigTable {
 public:
  // `name` is how messages call the table: "[world.hand]".
  ConfigTable(const ConfigValue& table, std::string name, ConfigErrors* errors);

  const ConfigValue& value() const { return *table_; }
  bool Has(std::string_view key) const { return Find(key) != nullptr; }
  // The value of a key; null if it is not there. Asking makes the key known.
  const ConfigValue* Get(std::string_view key);
  const ConfigValue* Require(std::string_view key);

  std::string String(std::string_view key, std::string fallback);
  std::string RequiredString(std::string_view key);  // not empty
  double Number(std::string_view key, double fallback, double smallest, double largest);
  std::int64_t Integer(std::string_view key, std::int64_t fallback, std::int64_t smallest,
                       std::int64_t largest);
  std::vector<std::string> Strings(std::string_view key);
  std::vector<double> Numbers(std::string_view key, double smallest, double largest);
  std::array<double, 2> Pair(std::string_view key, std::array<double, 2> fallback, double smallest,
                             double largest);
  // Index of the word among the choices, the fallback if the key is not there, nothing if it is none of them.
  std::optional<std::size_t> Choice(std::string_view key, const std::vector<std::string>& choices,
                                    std::size_t fallback);
  // A table that may be missing, and the tables of a list ([[name]]).
  std::optional<ConfigTable> Table(std::string_view key);
  std::vector<ConfigTable> Tables(std::string_view key);
  // Makes keys known that are asked for later.
  void Know(const std::vector<std::string>& keys) { known_.insert(keys.begin(), keys.end()); }
  void Finish();

  void Fail(const ConfigValue& value, std::string message) { errors_->Add(value, std::move(message)); }

 private:
  const ConfigValue* Find(std::string_view key) const;
  std::optional<double> NumberOf(const ConfigValue& value, std::string_view key, double smallest,
                                 double largest);

  const ConfigValue* table_;
  std::string name_;
  ConfigErrors* errors_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace aerascope
