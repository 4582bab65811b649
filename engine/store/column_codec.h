// How each type of event field is kept in columns: for each type one ColumnCodec that describes its columns,
// binds a value to them and reads it back (checking everything). Inside engine/store only.
#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/event/event_body.h"
#include "engine/store/database.h"
#include "engine/store/episode_schema.h"

namespace aerascope {

// The columns every event table begins with.
inline constexpr int kCommonColumns = 5;  // seq, time_us, frame, in_simulation, cause
// The columns every list table begins with.
inline constexpr int kListColumns = 2;  // event, position

// Kept in a table of its own; a list of plain numbers is one BLOB instead.
template <class T>
inline constexpr bool kIsList = kIsVector<T> && !std::is_same_v<T, std::vector<double>>;

template <class T>
concept HasFields = requires {
  T::Fields();
};

// Gives each different term a number in the `content` table.
class ContentIds {
 public:
  virtual ~ContentIds() = default;
  virtual std::int64_t IdOf(const Term& term) = 0;
};

// Binds one value after another to the parameters of an INSERT.
class Binder {
 public:
  Binder(sqlite3_stmt* statement, ContentIds* contents) : statement_(statement), contents_(contents) {}

  void Integer(std::int64_t value) { sqlite3_bind_int64(statement_, ++index_, value); }
  void IntegerOrNull(std::int64_t value) {
    if (value == 0) {
      sqlite3_bind_null(statement_, ++index_);
    } else {
      Integer(value);
    }
  }
  void Real(double value) { sqlite3_bind_double(statement_, ++index_, value); }  // NaN becomes NULL
  void Text(std::string_view value) { Keep(BindText(statement_, ++index_, value)); }
  void Blob(std::string bytes) {
    Keep(sqlite3_bind_blob64(statement_, ++index_, bytes.empty() ? "" : bytes.data(), bytes.size(),
                             SQLITE_TRANSIENT));
  }
  void Content(const Term& term) { Integer(contents_->IdOf(term)); }

  bool failed() const { return failed_; }

 private:
  void Keep(int code) { failed_ = failed_ || code != SQLITE_OK; }

  sqlite3_stmt* statement_;
  ContentIds* contents_;
  int index_ = 0;
  bool failed_ = false;
};

// Reads one value after another from a row. A column that an older file does not have leaves the value as it
// is. The first thing that does not fit is remembered as a phrase: "frame is -3".
class RowReader {
 public:
  // `columns`: for each column of the table as it is now, its place in the row, or -1 where the file has
  // none.
  RowReader(sqlite3_stmt* statement, const std::vector<int>& columns, const StoredTable& table,
            const std::vector<Term>& contents)
      : statement_(statement), columns_(columns), table_(table), contents_(contents) {}

  void Integer(std::int64_t* value, std::int64_t smallest, std::int64_t largest) {
    const int column = Next();
    if (column < 0) return;
    if (sqlite3_column_type(statement_, column) != SQLITE_INTEGER) return Refuse("is not a whole number");
    const std::int64_t found = sqlite3_column_int64(statement_, column);
    if (found < smallest || found > largest) return Refuse("is " + std::to_string(found));
    *value = found;
  }
  // Null is 0.
  void IntegerOrNull(std::int64_t* value, std::int64_t largest) {
    if (Peek() >= 0 && NextIsNull()) {
      Next();
      *value = 0;
      return;
    }
    Integer(value, 1, largest);
  }
  void Real(double* value) {
    const int column = Next();
    if (column < 0) return;
    const int type = sqlite3_column_type(statement_, column);
    if (type == SQLITE_NULL) {
      *value = std::numeric_limits<double>::quiet_NaN();
    } else if (type == SQLITE_FLOAT) {
      *value = sqlite3_column_double(statement_, column);
    } else {
      Refuse("is not a number");
    }
  }
  void Text(std::string* value) {
    const int column = Next();
    if (column < 0) return;
    if (sqlite3_column_type(statement_, column) != SQLITE_TEXT) return Refuse("is not text");
    *value = std::string(ColumnBytes(statement_, column));
  }
  void Blob(std::string* value) {
    const int column = Next();
    if (column < 0) return;
    if (sqlite3_column_type(statement_, column) != SQLITE_BLOB) return Refuse("is not a BLOB");
    *value = std::string(ColumnBytes(statement_, column));
  }
  void Content(Term* value) {
    std::int64_t id = 0;
    if (Peek() < 0) return Skip();
    Integer(&id, 1, static_cast<std::int64_t>(contents_.size()));
    if (!failed()) *value = contents_[static_cast<std::size_t>(id - 1)];
  }
  void TimeUs(Time* value) { Integer(&value->us, -kLargestStoredTimeUs, kLargestStoredTimeUs); }

  void Refuse(const std::string& what) {
    if (failed()) return;
    problem_ = table_.columns[index_ == 0 ? 0 : index_ - 1].name + " " + what;
  }
  bool NextIsNull() const {
    const int column = Peek();
    return column < 0 || sqlite3_column_type(statement_, column) == SQLITE_NULL;
  }
  bool failed() const { return !problem_.empty(); }
  const std::string& problem() const { return problem_; }

 private:
  // Sums and differences of two such times do not overflow.
  static constexpr std::int64_t kLargestStoredTimeUs = std::numeric_limits<std::int64_t>::max() / 2;

  int Peek() const { return columns_[index_]; }
  int Next() { return columns_[index_++]; }
  void Skip() { ++index_; }

  sqlite3_stmt* statement_;
  const std::vector<int>& columns_;
  const StoredTable& table_;
  const std::vector<Term>& contents_;
  std::size_t index_ = 0;
  std::string problem_;
};

using Columns = std::vector<StoredColumn>;

template <class T>
struct ColumnCodec;

template <class Tag>
struct ColumnCodec<Id<Tag>> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "INTEGER", true, meaning + "; NULL: none"});
  }
  static void Bind(Id<Tag> value, Binder* to) { to->IntegerOrNull(value.value); }
  static void Read(RowReader* from, Id<Tag>* value) {
    from->IntegerOrNull(&value->value, std::numeric_limits<std::int64_t>::max());
  }
};

template <>
struct ColumnCodec<bool> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "INTEGER", false, meaning + "; 0 or 1"});
  }
  static void Bind(bool value, Binder* to) { to->Integer(value ? 1 : 0); }
  static void Read(RowReader* from, bool* value) {
    std::int64_t number = *value ? 1 : 0;
    from->Integer(&number, 0, 1);
    *value = number != 0;
  }
};

template <>
struct ColumnCodec<std::int64_t> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "INTEGER", false, meaning});
  }
  static void Bind(std::int64_t value, Binder* to) { to->Integer(value); }
  static void Read(RowReader* from, std::int64_t* value) {
    from->Integer(value, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  }
};

template <>
struct ColumnCodec<double> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "REAL", true, meaning});
  }
  static void Bind(double value, Binder* to) { to->Real(value); }
  static void Read(RowReader* from, double* value) { from->Real(value); }
};

template <class Enum>
requires std::is_enum_v<Enum>
struct ColumnCodec<Enum> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    std::string names;
    for (const std::string_view value : kEnumNames<Enum>)
      names += (names.empty() ? "" : ", ") + std::string(value);
    columns->push_back({name, "TEXT", false, meaning + "; one of " + names});
  }
  static void Bind(Enum value, Binder* to) { to->Text(EnumName(value)); }
  static void Read(RowReader* from, Enum* value) {
    std::string name(EnumName(*value));
    from->Text(&name);
    const auto found = std::find(kEnumNames<Enum>.begin(), kEnumNames<Enum>.end(), name);
    if (found == kEnumNames<Enum>.end()) return from->Refuse("is none of the known words");
    *value = static_cast<Enum>(found - kEnumNames<Enum>.begin());
  }
};

template <>
struct ColumnCodec<std::string> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "TEXT", false, meaning});
  }
  static void Bind(const std::string& value, Binder* to) { to->Text(value); }
  static void Read(RowReader* from, std::string* value) { from->Text(value); }
};

template <>
struct ColumnCodec<Term> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "INTEGER", false, meaning + "; content id"});
  }
  static void Bind(const Term& value, Binder* to) { to->Content(value); }
  static void Read(RowReader* from, Term* value) { from->Content(value); }
};

template <>
struct ColumnCodec<Time> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name + "_us", "INTEGER", false, meaning});
  }
  static void Bind(Time value, Binder* to) { to->Integer(value.us); }
  static void Read(RowReader* from, Time* value) { from->TimeUs(value); }
};

template <>
struct ColumnCodec<TimeInterval> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name + "_after_us", "INTEGER", false, meaning + ": its beginning, microseconds"});
    columns->push_back(
        {name + "_before_us", "INTEGER", false, meaning + ": its end (not included), microseconds"});
  }
  static void Bind(const TimeInterval& value, Binder* to) {
    to->Integer(value.after.us);
    to->Integer(value.before.us);
  }
  static void Read(RowReader* from, TimeInterval* value) {
    from->TimeUs(&value->after);
    from->TimeUs(&value->before);
  }
};

template <>
struct ColumnCodec<Fact> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back(
        {name + "_positive", "INTEGER", false, meaning + ": 1 it held, 0 it did not (anti-fact)"});
    columns->push_back({name + "_payload", "INTEGER", false, meaning + ": what, a content id"});
    ColumnCodec<TimeInterval>::Describe(name, meaning, columns);
    columns->push_back({name + "_confidence", "REAL", true, meaning + ": confidence from 0 to 1"});
  }
  static void Bind(const Fact& value, Binder* to) {
    to->Integer(value.positive ? 1 : 0);
    to->Content(value.payload);
    ColumnCodec<TimeInterval>::Bind(value.interval, to);
    to->Real(value.confidence);
  }
  static void Read(RowReader* from, Fact* value) {
    ColumnCodec<bool>::Read(from, &value->positive);
    from->Content(&value->payload);
    // As a term (fact/fact-not ...) the payload is one level deeper.
    if (value->payload.depth() >= kMaxTermDepth) from->Refuse("is nested too deeply");
    ColumnCodec<TimeInterval>::Read(from, &value->interval);
    from->Real(&value->confidence);
  }
};

template <>
struct ColumnCodec<Evidence> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name + "_positive", "REAL", true, meaning + ": times it was right"});
    columns->push_back({name + "_total", "REAL", true, meaning + ": times it was tried"});
  }
  static void Bind(const Evidence& value, Binder* to) {
    to->Real(value.positive);
    to->Real(value.total);
  }
  static void Read(RowReader* from, Evidence* value) {
    from->Real(&value->positive);
    from->Real(&value->total);
  }
};

inline std::optional<CompositeState> FromDefinition(CompositeStateId id, const Term& definition) {
  return CompositeStateFromTerm(id, definition);
}
inline std::optional<Model> FromDefinition(ModelId id, const Term& definition) {
  return ModelFromTerm(id, definition);
}

template <class Definition>
requires std::is_same_v<Definition, CompositeState> || std::is_same_v<Definition, Model>
struct ColumnCodec<Definition> {
  static void Describe(const std::string& name, const std::string&, Columns* columns) {
    columns->push_back({name, "INTEGER", false, "its number"});
    columns->push_back({name + "_definition", "INTEGER", false, "what it says; content id"});
  }
  static void Bind(const Definition& value, Binder* to) {
    to->Integer(value.id.value);
    to->Content(DefinitionToTerm(value));
  }
  static void Read(RowReader* from, Definition* value) {
    std::int64_t id = 0;
    from->Integer(&id, 1, std::numeric_limits<std::int64_t>::max());
    Term definition;
    from->Content(&definition);
    if (from->failed()) return;
    auto read = FromDefinition(decltype(value->id){id}, definition);
    if (!read) return from->Refuse("is not a definition");
    *value = std::move(*read);
  }
};

// Little-endian doubles, 8 bytes each.
template <>
struct ColumnCodec<std::vector<double>> {
  static void Describe(const std::string& name, const std::string& meaning, Columns* columns) {
    columns->push_back({name, "BLOB", false, meaning + "; 64-bit floats, least significant byte first"});
  }
  static void Bind(const std::vector<double>& value, Binder* to) {
    std::string bytes(value.size() * 8, '\0');
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto bits = std::bit_cast<std::uint64_t>(value[i]);
      for (std::size_t b = 0; b < 8; ++b) bytes[i * 8 + b] = static_cast<char>(bits >> (8 * b) & 0xff);
    }
    to->Blob(std::move(bytes));
  }
  static void Read(RowReader* from, std::vector<double>* value) {
    std::string bytes;
    from->Blob(&bytes);
    if (bytes.size() % 8 != 0) return from->Refuse("does not hold whole numbers of 8 bytes");
    value->resize(bytes.size() / 8);
    for (std::size_t i = 0; i < value->size(); ++i) {
      std::uint64_t bits = 0;
      for (std::size_t b = 0; b < 8; ++b) {
        bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i * 8 + b])) << (8 * b);
      }
      (*value)[i] = std::bit_cast<double>(bits);
    }
  }
};

// An element of a list: a struct by its fields, anything else in a column named "value".
template <class Element>
void DescribeElement(const std::string& meaning, Columns* columns) {
  if constexpr (HasFields<Element>) {
    ForEachField<Element>([&](const auto& field) {
      using Value = std::decay_t<decltype(std::declval<Element>().*(field.member))>;
      ColumnCodec<Value>::Describe(std::string(field.name), std::string(field.meaning), columns);
    });
  } else {
    ColumnCodec<Element>::Describe("value", meaning, columns);
  }
}

template <class Element>
void BindElement(const Element& element, Binder* to) {
  if constexpr (HasFields<Element>) {
    ForEachField<Element>([&](const auto& field) {
      using Value = std::decay_t<decltype(element.*(field.member))>;
      ColumnCodec<Value>::Bind(element.*(field.member), to);
    });
  } else {
    ColumnCodec<Element>::Bind(element, to);
  }
}

template <class Element>
void ReadElement(RowReader* from, Element* element) {
  if constexpr (HasFields<Element>) {
    ForEachField<Element>([&](const auto& field) {
      using Value = std::decay_t<decltype(element->*(field.member))>;
      ColumnCodec<Value>::Read(from, &(element->*(field.member)));
    });
  } else {
    ColumnCodec<Element>::Read(from, element);
  }
}

}  // namespace aerascope
