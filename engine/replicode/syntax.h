// The form of Replicode text, without its meaning: statements, lists, names, numbers, times, variables.
//
// `label:(head field field ...) [views]`, comments from ; to the end of the line. A list is written `[a b
// c]`, or as
// `[]` at the end of a line followed by one element a line, indented deeper; `|[]` is always the empty list.
// `X:` is a variable, `:` and `::` are wildcards for one field and for the rest, `P1:(+ P0 D)` is an
// expression with a label. Times are 100ms, 5s, 80us (durations) and 0s:100ms:0us (instants). `!def NAME
// value` names a value.
//
// Always true: reading takes memory and time in proportion to the text, whatever its bytes; nesting ends at
// kMaxNesting.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace aerascope {

inline constexpr int kMaxNesting = 32;
inline constexpr std::size_t kMaxReplicodeBytes = 16 << 20;

struct SyntaxNode {
  enum class Kind {
    kName,
    kNumber,
    kInstant,
    kDuration,
    kString,
    kVariable,
    kWildcard,
    kRest,
    kList,
    kGroup
  };

  Kind kind = Kind::kName;
  std::string text;  // a name, a variable's name, a string, the head of a group
  double number = 0;
  std::int64_t us = 0;            // of an instant or a duration, microseconds
  std::string label;              // of a labelled expression, else empty
  std::vector<SyntaxNode> items;  // of a list; of a group its fields, the head excluded
  int line = 0;
  int column = 0;

  bool IsGroup(std::string_view head) const { return kind == Kind::kGroup && text == head; }
};

// How a node is called in messages: "the number 5", "a list", "(cmd ...)".
std::string Described(const SyntaxNode& node);

// One object at top level.
struct SyntaxStatement {
  SyntaxNode object;  // a group, or of a directive other than !def its name
  SyntaxNode views;   // a list, empty if there are none: where OpenAERA would put it
  bool directive = false;
};

struct SyntaxOptions {
  // Accepts what OpenAERA's dumps of objects have beside Replicode: numbers before the label, lines starting
  // with >.
  bool dump = false;
};

// Reads statement after statement.
class SyntaxReader {
 public:
  // `text` must outlive the reader; `start` is where it begins, for messages.
  SyntaxReader(std::string_view text, SourceLocation start, SyntaxOptions options = {});

  // The next statement; nothing at the end of the text.
  Result<std::optional<SyntaxStatement>> NextStatement();
  // The text as one expression and nothing else.
  Result<SyntaxNode> OnlyExpression();

  const std::string& file() const { return file_; }

 private:
  struct Token {
    enum class Kind {
      kEnd,
      kOpen,
      kClose,
      kListOpen,
      kListClose,
      kEmptyList,
      kName,
      kLabel,
      kVariable,
      kNumber,
      kInstant,
      kDuration,
      kString,
      kWildcard,
      kRest,
      kDirective
    };
    Kind kind = Kind::kEnd;
    std::string_view source;  // the characters of the token
    std::string text;         // of a string: its content
    double number = 0;
    std::int64_t us = 0;
    int line = 0;
    int column = 0;
    int indent = 0;  // column of the first token of its line
    bool first_on_line = false;
  };

  char Peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void Skip(std::size_t count);
  void SkipLine();
  void SkipSpace();
  Status Advance();  // reads the next token into next_
  Status ScanString();
  Status ScanNumber();
  Status ScanName();
  Result<SyntaxNode> ReadExpression(int depth);
  Result<SyntaxNode> ReadAtom();
  Result<SyntaxNode> ReadGroup(int depth);
  Result<SyntaxNode> ReadList(int depth);
  Status ReadDefinition();
  Status SkipDumpNumbers();
  SyntaxNode NodeHere(SyntaxNode::Kind kind) const;
  Error ErrorHere(const std::string& message) const;
  std::string FoundHere() const;

  std::string_view text_;
  std::string file_;
  SyntaxOptions options_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  int line_indent_ = 0;
  bool line_started_ = false;
  Token next_;
  bool started_ = false;
  std::map<std::string, SyntaxNode, std::less<>> definitions_;
};

}  // namespace aerascope
