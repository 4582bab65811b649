#include "engine/replicode/syntax.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/text.h"
#include "engine/base/time.h"

namespace aerascope {
namespace {

// Values named by !def are copied at each use; this bounds how much a use can multiply the text.
constexpr std::size_t kMaxDefinitionNodes = 64;

bool IsLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}
bool IsNameCharacter(char c) {
  return IsLetter(c) || IsDigit(c) || c == '.';
}
bool IsOperatorCharacter(char c) {
  return c == '+' || c == '-' || c == '*' || c == '/' || c == '<' || c == '>' || c == '=';
}
bool IsSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::size_t NodeCount(const SyntaxNode& node) {
  std::size_t count = 1;
  for (const SyntaxNode& item : node.items) count += NodeCount(item);
  return count;
}

int Depth(const SyntaxNode& node) {
  int depth = 0;
  for (const SyntaxNode& item : node.items) depth = std::max(depth, Depth(item));
  return depth + 1;
}

std::optional<double> ParseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> ParseInteger(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "100ms", "-5s", "0.5s", "80us"; a whole number of microseconds within kForever.
std::optional<std::int64_t> ParseSpan(std::string_view text) {
  std::int64_t scale = 0;
  if (text.ends_with("us"))
    scale = 1;
  else if (text.ends_with("ms"))
    scale = 1000;
  else if (text.ends_with("s"))
    scale = 1'000'000;
  if (scale == 0) return std::nullopt;
  text.remove_suffix(scale == 1'000'000 ? 1 : 2);
  if (const auto whole = ParseInteger(text)) {
    // OpenAERA writes "never ends" as the largest number there is.
    if (scale == 1 && *whole == std::numeric_limits<std::int64_t>::max()) return kForever.us;
    const std::int64_t limit = kForever.us / scale;
    if (*whole > limit || *whole < -limit) return std::nullopt;
    return *whole * scale;
  }
  const auto value = ParseNumber(text);
  if (!value || std::abs(*value) * static_cast<double>(scale) > 1e15) return std::nullopt;
  return std::llround(*value * static_cast<double>(scale));
}

// "0s:100ms:0us", with an optional minus in front of it all.
std::optional<std::int64_t> ParseInstant(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::size_t first = text.find(':');
  const std::size_t second = first == std::string_view::npos ? first : text.find(':', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  const std::string_view parts[] = {text.substr(0, first), text.substr(first + 1, second - first - 1),
                                    text.substr(second + 1)};
  if (parts[0].ends_with("ms") || parts[0].ends_with("us") || !parts[1].ends_with("ms") ||
      !parts[2].ends_with("us")) {
    return std::nullopt;
  }
  std::int64_t sum = 0;
  for (const std::string_view part : parts) {
    const auto us = ParseSpan(part);
    if (!us || *us < 0 || *us > kForever.us - sum) return std::nullopt;
    sum += *us;
  }
  return negative ? -sum : sum;
}

struct Escape {
  char character;
  std::size_t length;
};

// The escape at the front of `text`, backslash included.
std::optional<Escape> ParseEscape(std::string_view text) {
  if (text.size() < 2) return std::nullopt;
  switch (text[1]) {
    case '"':
      return Escape{'"', 2};
    case '\\':
      return Escape{'\\', 2};
    case 'n':
      return Escape{'\n', 2};
    case 't':
      return Escape{'\t', 2};
    case 'x':
      break;
    default:
      return std::nullopt;
  }
  unsigned value = 0;
  const std::string_view digits = text.substr(2, 2);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 2 || error != std::errc() || end != digits.data() + 2) return std::nullopt;
  return Escape{static_cast<char>(value), 4};
}

}  // namespace

std::string Described(const SyntaxNode& node) {
  switch (node.kind) {
    case SyntaxNode::Kind::kName:
      return "'" + Printable(node.text) + "'";
    case SyntaxNode::Kind::kNumber:
      return "the number " + FormatNumber(node.number);
    case SyntaxNode::Kind::kInstant:
      return "the time " + ToText(Time{node.us});
    case SyntaxNode::Kind::kDuration:
      return "the duration " + ToText(Duration{node.us});
    case SyntaxNode::Kind::kString:
      return "a text in quotes";
    case SyntaxNode::Kind::kVariable:
      return "the variable '" + Printable(node.text) + ":'";
    case SyntaxNode::Kind::kWildcard:
      return "':'";
    case SyntaxNode::Kind::kRest:
      return "'::'";
    case SyntaxNode::Kind::kList:
      return "a list";
    case SyntaxNode::Kind::kGroup:
      return "(" + Printable(node.text) + " ...)";
  }
  return {};
}

SyntaxReader::SyntaxReader(std::string_view text, SourceLocation start, SyntaxOptions options)
    : text_(text), file_(std::move(start.file)), options_(options), line_(start.line), column_(start.column) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
}

void SyntaxReader::Skip(std::size_t count) {
  for (std::size_t i = 0; i < count && at_ < text_.size(); ++i) {
    if (text_[at_++] == '\n') {
      ++line_;
      column_ = 1;
      line_started_ = false;
    } else {
      ++column_;
    }
  }
}

void SyntaxReader::SkipLine() {
  while (at_ < text_.size() && Peek() != '\n') Skip(1);
}

void SyntaxReader::SkipSpace() {
  while (at_ < text_.size()) {
    if (IsSpace(Peek()))
      Skip(1);
    else if (Peek() == ';' || (options_.dump && Peek() == '>' && !line_started_))
      SkipLine();
    else
      return;
  }
}

Error SyntaxReader::ErrorHere(const std::string& message) const {
  return ErrorAt({file_, next_.line, next_.column}, message);
}

std::string SyntaxReader::FoundHere() const {
  if (next_.source.empty()) return "found the end of the text";
  std::string_view source = next_.source;
  if (source.size() > 40) source = source.substr(0, 40);
  return "found '" + Printable(source) + "'";
}

Status SyntaxReader::Advance() {
  SkipSpace();
  next_ = Token{};
  next_.line = line_;
  next_.column = column_;
  next_.first_on_line = !line_started_;
  if (!line_started_) line_indent_ = column_;
  line_started_ = true;
  next_.indent = line_indent_;
  const std::size_t start = at_;
  if (at_ >= text_.size()) return Ok();

  const auto simple = [&](Token::Kind kind, std::size_t length) {
    next_.kind = kind;
    next_.source = text_.substr(start, length);
    Skip(length);
    return Ok();
  };
  const char c = Peek();
  switch (c) {
    case '(':
      return simple(Token::Kind::kOpen, 1);
    case ')':
      return simple(Token::Kind::kClose, 1);
    case '[':
      return simple(Token::Kind::kListOpen, 1);
    case ']':
      return simple(Token::Kind::kListClose, 1);
    case ':':
      return Peek(1) == ':' ? simple(Token::Kind::kRest, 2) : simple(Token::Kind::kWildcard, 1);
    case '"':
      return ScanString();
    default:
      break;
  }
  if (c == '|' && Peek(1) == '[') {
    if (Peek(2) == ']') return simple(Token::Kind::kEmptyList, 3);
    return ErrorHere("expected ']' after '|[', which is the empty list; a list with elements has no bar");
  }
  if (IsDigit(c) || ((c == '-' || c == '+') && (IsDigit(Peek(1)) || Peek(1) == '.'))) return ScanNumber();
  if (IsOperatorCharacter(c)) {
    std::size_t length = 1;
    while (length < 2 && IsOperatorCharacter(Peek(length))) ++length;
    return simple(Token::Kind::kName, length);
  }
  if (c == '!' && IsLetter(Peek(1))) {
    std::size_t length = 1;
    while (IsNameCharacter(Peek(length))) ++length;
    return simple(Token::Kind::kDirective, length);
  }
  if (IsLetter(c) || (c == '|' && IsLetter(Peek(1)))) return ScanName();
  return ErrorHere("unexpected character '" + Printable(text_.substr(start, 1)) + "'");
}

Status SyntaxReader::ScanString() {
  const std::size_t start = at_;
  next_.kind = Token::Kind::kString;
  Skip(1);
  while (at_ < text_.size() && Peek() != '"' && Peek() != '\n') {
    char c = Peek();
    std::size_t length = 1;
    if (c == '\\') {
      const std::optional<Escape> escape = ParseEscape(text_.substr(at_));
      if (!escape) {
        next_.line = line_;
        next_.column = column_;
        return ErrorHere(
            "expected \\\", \\\\, \\n, \\t or \\x and two hexadecimal digits after a backslash in a text");
      }
      c = escape->character;
      length = escape->length;
    }
    next_.text += c;
    Skip(length);
  }
  if (Peek() != '"' || at_ >= text_.size()) {
    return ErrorHere("expected a closing '\"' on the same line as the text begins");
  }
  Skip(1);
  next_.source = text_.substr(start, at_ - start);
  return Ok();
}

Status SyntaxReader::ScanNumber() {
  std::size_t length = 1;
  while (true) {
    const char c = Peek(length);
    const char previous = Peek(length - 1);
    const bool exponent_sign = (c == '-' || c == '+') && (previous == 'e' || previous == 'E');
    if (!IsNameCharacter(c) && c != ':' && !exponent_sign) break;
    ++length;
  }
  next_.source = text_.substr(at_, length);
  if (const auto number = ParseNumber(next_.source)) {
    next_.kind = Token::Kind::kNumber;
    next_.number = *number;
  } else if (const auto span = ParseSpan(next_.source)) {
    next_.kind = Token::Kind::kDuration;
    next_.us = *span;
  } else if (const auto instant = ParseInstant(next_.source)) {
    next_.kind = Token::Kind::kInstant;
    next_.us = *instant;
  } else {
    return ErrorHere("expected a number, a duration such as 100ms or a time such as 0s:100ms:0us, " +
                     FoundHere());
  }
  Skip(length);
  return Ok();
}

Status SyntaxReader::ScanName() {
  std::size_t length = 1;
  while (IsNameCharacter(Peek(length))) ++length;
  next_.kind = Token::Kind::kName;
  next_.source = text_.substr(at_, length);
  Skip(length);
  if (Peek() != ':') return Ok();
  Skip(1);
  const char after = Peek();
  const bool ends =
      at_ >= text_.size() || IsSpace(after) || after == ')' || after == ']' || after == ';' || after == ':';
  next_.kind = ends ? Token::Kind::kVariable : Token::Kind::kLabel;
  return Ok();
}

SyntaxNode SyntaxReader::NodeHere(SyntaxNode::Kind kind) const {
  SyntaxNode node;
  node.kind = kind;
  node.text = next_.kind == Token::Kind::kString ? next_.text : std::string(next_.source);
  node.number = next_.number;
  node.us = next_.us;
  node.line = next_.line;
  node.column = next_.column;
  return node;
}

Result<SyntaxNode> SyntaxReader::ReadExpression(int depth) {
  if (depth > kMaxNesting) {
    return ErrorHere("expected at most " + std::to_string(kMaxNesting) + " expressions inside each other");
  }
  std::string label;
  const int line = next_.line;
  const int column = next_.column;
  if (next_.kind == Token::Kind::kLabel) {
    label = next_.source;
    // A bar in front denies, as in |fact; a label with one could be read but not written.
    if (label.starts_with('|')) return ErrorHere("expected a label without a bar in front, " + FoundHere());
    if (Status status = Advance(); !status) return status.error();
    if (next_.kind == Token::Kind::kLabel)
      return ErrorHere("expected one label before an expression, " + FoundHere());
  }
  const auto read = [&]() -> Result<SyntaxNode> {
    if (next_.kind == Token::Kind::kOpen) return ReadGroup(depth);
    if (next_.kind == Token::Kind::kListOpen || next_.kind == Token::Kind::kEmptyList) return ReadList(depth);
    if (next_.kind != Token::Kind::kName) return ReadAtom();
    const auto definition = definitions_.find(next_.source);
    if (definition == definitions_.end()) return ReadAtom();
    if (depth + Depth(definition->second) > kMaxNesting + 1) {
      return ErrorHere("expected at most " + std::to_string(kMaxNesting) + " expressions inside each other");
    }
    SyntaxNode node = definition->second;
    node.line = next_.line;
    node.column = next_.column;
    if (Status status = Advance(); !status) return status.error();
    return node;
  };
  Result<SyntaxNode> node = read();
  if (!node || label.empty()) return node;
  node->label = std::move(label);
  node->line = line;
  node->column = column;
  return node;
}

Result<SyntaxNode> SyntaxReader::ReadAtom() {
  SyntaxNode::Kind kind = SyntaxNode::Kind::kName;
  switch (next_.kind) {
    case Token::Kind::kName:
      break;
    case Token::Kind::kVariable:
      kind = SyntaxNode::Kind::kVariable;
      break;
    case Token::Kind::kNumber:
      kind = SyntaxNode::Kind::kNumber;
      break;
    case Token::Kind::kInstant:
      kind = SyntaxNode::Kind::kInstant;
      break;
    case Token::Kind::kDuration:
      kind = SyntaxNode::Kind::kDuration;
      break;
    case Token::Kind::kString:
      kind = SyntaxNode::Kind::kString;
      break;
    case Token::Kind::kWildcard:
      kind = SyntaxNode::Kind::kWildcard;
      break;
    case Token::Kind::kRest:
      kind = SyntaxNode::Kind::kRest;
      break;
    case Token::Kind::kEnd:
    case Token::Kind::kOpen:
    case Token::Kind::kClose:
    case Token::Kind::kListOpen:
    case Token::Kind::kListClose:
    case Token::Kind::kEmptyList:
    case Token::Kind::kLabel:
    case Token::Kind::kDirective:
      return ErrorHere("expected a value, " + FoundHere());
  }
  SyntaxNode node = NodeHere(kind);
  if (Status status = Advance(); !status) return status.error();
  return node;
}

Result<SyntaxNode> SyntaxReader::ReadGroup(int depth) {
  SyntaxNode node = NodeHere(SyntaxNode::Kind::kGroup);
  node.text.clear();
  if (Status status = Advance(); !status) return status.error();
  if (next_.kind != Token::Kind::kName) {
    return ErrorHere("expected the name of a class or operator after '(', " + FoundHere());
  }
  node.text = next_.source;
  if (Status status = Advance(); !status) return status.error();
  while (next_.kind != Token::Kind::kClose) {
    if (next_.kind == Token::Kind::kEnd || next_.kind == Token::Kind::kListClose) {
      return ErrorHere("expected ')' to close (" + Printable(node.text) + " of line " +
                       std::to_string(node.line) + ", " + FoundHere());
    }
    Result<SyntaxNode> item = ReadExpression(depth + 1);
    if (!item) return item;
    node.items.push_back(std::move(*item));
  }
  if (Status status = Advance(); !status) return status.error();
  return node;
}

Result<SyntaxNode> SyntaxReader::ReadList(int depth) {
  SyntaxNode node = NodeHere(SyntaxNode::Kind::kList);
  node.text.clear();
  const bool surely_empty = next_.kind == Token::Kind::kEmptyList;
  const int outer_indent = next_.indent;
  if (Status status = Advance(); !status) return status.error();
  if (surely_empty) return node;
  while (next_.kind != Token::Kind::kListClose) {
    if (next_.kind == Token::Kind::kEnd || next_.kind == Token::Kind::kClose) {
      return ErrorHere("expected ']' to close the list of line " + std::to_string(node.line) + ", " +
                       FoundHere());
    }
    Result<SyntaxNode> item = ReadExpression(depth + 1);
    if (!item) return item;
    node.items.push_back(std::move(*item));
  }
  if (Status status = Advance(); !status) return status.error();
  if (!node.items.empty() || !next_.first_on_line || next_.indent <= outer_indent) return node;
  // `[]` at the end of a line, then deeper lines: these are the elements.
  const int indent = next_.indent;
  while (next_.kind != Token::Kind::kEnd && next_.kind != Token::Kind::kClose &&
         next_.kind != Token::Kind::kListClose && !(next_.first_on_line && next_.indent < indent)) {
    Result<SyntaxNode> item = ReadExpression(depth + 1);
    if (!item) return item;
    node.items.push_back(std::move(*item));
  }
  return node;
}

Status SyntaxReader::ReadDefinition() {
  if (Status status = Advance(); !status) return status;
  if (next_.kind != Token::Kind::kName || !IsLetter(next_.source.front())) {
    return ErrorHere("expected a name after !def (definitions with parameters are not read), " + FoundHere());
  }
  const std::string name(next_.source);
  if (Status status = Advance(); !status) return status;
  if (next_.first_on_line) return ErrorHere("expected the value of " + name + " on the line of its !def");
  Result<SyntaxNode> value = ReadExpression(1);
  if (!value) return value.error();
  if (NodeCount(*value) > kMaxDefinitionNodes) {
    return ErrorAt(
        {file_, value->line, value->column},
        "expected at most " + std::to_string(kMaxDefinitionNodes) + " words in the value of a !def");
  }
  definitions_.insert_or_assign(name, std::move(*value));
  return Ok();
}

// `78(94) label:(...)`, `78 label:(...)` or `(8407) label:(...)`: goes on to the label.
Status SyntaxReader::SkipDumpNumbers() {
  if (next_.kind == Token::Kind::kNumber) {
    if (Status status = Advance(); !status) return status;
  }
  if (next_.kind != Token::Kind::kOpen || !IsDigit(Peek())) return Ok();
  for (const Token::Kind expected : {Token::Kind::kNumber, Token::Kind::kClose}) {
    if (Status status = Advance(); !status) return status;
    if (next_.kind != expected)
      return ErrorHere("expected the number of an object in parentheses, " + FoundHere());
  }
  return Advance();
}

Result<std::optional<SyntaxStatement>> SyntaxReader::NextStatement() {
  if (text_.size() > kMaxReplicodeBytes) {
    return Error{file_ + ": expected at most " + std::to_string(kMaxReplicodeBytes >> 20) +
                 " MiB of Replicode, found " + std::to_string(text_.size() >> 20) + " MiB"};
  }
  if (!started_) {
    started_ = true;
    if (Status status = Advance(); !status) return status.error();
  }
  if (options_.dump) {
    if (Status status = SkipDumpNumbers(); !status) return status.error();
  }
  while (next_.kind == Token::Kind::kDirective && next_.source == "!def") {
    if (Status status = ReadDefinition(); !status) return status.error();
  }
  if (next_.kind == Token::Kind::kEnd) return std::optional<SyntaxStatement>();
  SyntaxStatement statement;
  if (next_.kind == Token::Kind::kDirective) {
    statement.directive = true;
    statement.object = NodeHere(SyntaxNode::Kind::kName);
    SkipLine();
    if (Status status = Advance(); !status) return status.error();
    return std::optional(std::move(statement));
  }
  if (next_.kind != Token::Kind::kOpen && next_.kind != Token::Kind::kLabel) {
    return ErrorHere("expected an object such as name:(ent 1), " + FoundHere());
  }
  Result<SyntaxNode> object = ReadExpression(1);
  if (!object) return object.error();
  if (object->kind != SyntaxNode::Kind::kGroup) {
    return ErrorAt({file_, object->line, object->column},
                   "expected an object in parentheses after the label '" + Printable(object->label) + ":'");
  }
  statement.object = std::move(*object);
  if (next_.kind == Token::Kind::kListOpen || next_.kind == Token::Kind::kEmptyList) {
    Result<SyntaxNode> views = ReadList(1);
    if (!views) return views.error();
    statement.views = std::move(*views);
  }
  return std::optional(std::move(statement));
}

Result<SyntaxNode> SyntaxReader::OnlyExpression() {
  if (Status status = Advance(); !status) return status.error();
  Result<SyntaxNode> node = ReadExpression(1);
  if (node && next_.kind != Token::Kind::kEnd)
    return ErrorHere("expected nothing after the expression, " + FoundHere());
  return node;
}

}  // namespace aerascope
