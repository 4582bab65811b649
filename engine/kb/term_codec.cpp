#include "engine/kb/term_codec.h"

#include <charconv>
#include <limits>
#include <optional>

#include "engine/base/text.h"

namespace aerascope {
namespace {

// Sums and differences of two times that were read do not overflow.
constexpr std::int64_t kLargestTimeUs = std::numeric_limits<std::int64_t>::max() / 2;

bool IsPlainByte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '-' || c == '+' || c == '*' || c == '/' || c == '<' || c == '>' || c == '=' || c == '?';
}

bool IsPlainName(std::string_view name) {
  if (name.empty() || name == "nil") return false;
  // A name that begins like a number, instant or duration would be read back as one.
  const char first = name[0];
  const bool letter = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || first == '_';
  if (!letter) return false;
  if ((first == 't' || first == 'd') && name.size() > 1 &&
      ((name[1] >= '0' && name[1] <= '9') || name[1] == '-')) {
    return false;
  }
  if (name == "inf" || name == "nan") return false;
  for (const char c : name) {
    if (!IsPlainByte(c)) return false;
  }
  return true;
}

void AppendQuoted(std::string_view text, char quote, std::string* out) {
  static const char kDigits[] = "0123456789abcdef";
  *out += quote;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == quote || c == '\\' || byte < 0x20 || byte == 0x7f) {
      *out += "\\x";
      *out += kDigits[byte >> 4];
      *out += kDigits[byte & 15];
    } else {
      *out += c;
    }
  }
  *out += quote;
}

void AppendName(std::string_view name, std::string* out) {
  if (IsPlainName(name)) {
    *out += name;
  } else {
    AppendQuoted(name, '|', out);
  }
}

// A struct head may be an operator; it stands after "(" and so cannot be taken for something else.
void AppendHead(std::string_view head, std::string* out) {
  bool plain = !head.empty();
  for (const char c : head) plain = plain && IsPlainByte(c);
  if (plain) {
    *out += head;
  } else {
    AppendQuoted(head, '|', out);
  }
}

void Append(const Term& term, std::string* out) {
  switch (term.kind()) {
    case TermKind::kNil:
      *out += "nil";
      return;
    case TermKind::kEntity:
      *out += '@';
      AppendName(term.name(), out);
      return;
    case TermKind::kOntology:
      AppendName(term.name(), out);
      return;
    case TermKind::kNumber:
      AppendNumber(term.number(), 9, out);
      return;
    case TermKind::kTime:
      *out += 't';
      AppendInteger(term.time().us, out);
      return;
    case TermKind::kDuration:
      *out += 'd';
      AppendInteger(term.duration().us, out);
      return;
    case TermKind::kString:
      AppendQuoted(term.name(), '"', out);
      return;
    case TermKind::kBool:
      *out += term.boolean() ? "#t" : "#f";
      return;
    case TermKind::kVariable:
      *out += "$" + std::to_string(term.variable());
      return;
    case TermKind::kWildcard:
      *out += ':';
      return;
    case TermKind::kCompositeState:
      *out += "~c" + std::to_string(term.composite_state().value);
      return;
    case TermKind::kModel:
      *out += "~m" + std::to_string(term.model().value);
      return;
    case TermKind::kSet:
      *out += '[';
      for (std::size_t i = 0; i < term.size(); ++i) {
        if (i > 0) *out += ' ';
        Append(term[i], out);
      }
      *out += ']';
      return;
    case TermKind::kStruct:
      *out += '(';
      AppendHead(term.name(), out);
      for (const Term& item : term.items()) {
        *out += ' ';
        Append(item, out);
      }
      *out += ')';
      return;
  }
}

class Decoder {
 public:
  explicit Decoder(std::string_view text) : text_(text) {}

  Result<Term> Read() {
    std::optional<Term> term = ReadTerm(1);
    if (term && at_ != text_.size()) term = Fail("the end of the text");
    if (!term)
      return Error{"stored term is damaged at byte " + std::to_string(at_) + ": expected " + expected_};
    return *term;
  }

 private:
  std::optional<Term> Fail(std::string expected) {
    if (expected_.empty()) expected_ = std::move(expected);
    return std::nullopt;
  }
  bool Eat(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  std::optional<std::int64_t> ReadInteger() {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) return std::nullopt;
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }
  static int HexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
  }
  // The text up to the closing quote; the opening one is eaten already.
  std::optional<std::string> ReadQuoted(char quote) {
    std::string value;
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == quote) return value;
      if (c != '\\') {
        value += c;
        continue;
      }
      if (at_ + 3 > text_.size() || text_[at_] != 'x') return std::nullopt;
      const int high = HexDigit(text_[at_ + 1]);
      const int low = HexDigit(text_[at_ + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      value += static_cast<char>(high * 16 + low);
      at_ += 3;
    }
    return std::nullopt;
  }
  std::optional<std::string> ReadName() {
    if (Eat('|')) return ReadQuoted('|');
    const std::size_t start = at_;
    while (at_ < text_.size() && IsPlainByte(text_[at_])) ++at_;
    if (at_ == start) return std::nullopt;
    return std::string(text_.substr(start, at_ - start));
  }
  std::optional<std::vector<Term>> ReadItems(char close, int depth) {
    std::vector<Term> items;
    for (bool first = true;; first = false) {
      if (Eat(close)) return items;
      if (!(first && close == ']') && !Eat(' ')) {
        Fail("a space or the closing bracket");
        return std::nullopt;
      }
      auto item = ReadTerm(depth + 1);
      if (!item) return std::nullopt;
      items.push_back(std::move(*item));
    }
  }
  std::optional<Term> ReadTerm(int depth) {
    if (depth > kMaxTermDepth) return Fail("less nesting");
    if (at_ >= text_.size()) return Fail("a term");
    const char c = text_[at_];
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    const bool next_is_digit = (next >= '0' && next <= '9') || next == '-';
    if (Eat(':')) return Term::Wildcard();
    if (Eat('@')) {
      auto name = ReadName();
      return name ? std::optional(Term::Entity(std::move(*name))) : Fail("a name");
    }
    if (Eat('"')) {
      auto value = ReadQuoted('"');
      return value ? std::optional(Term::String(std::move(*value))) : Fail("a closing quote");
    }
    if (Eat('#')) {
      if (Eat('t')) return Term::Bool(true);
      if (Eat('f')) return Term::Bool(false);
      return Fail("#t or #f");
    }
    if (Eat('$')) {
      const auto index = ReadInteger();
      return index && *index >= 0 && *index < (1 << 20)
                 ? std::optional(Term::Variable(static_cast<int>(*index)))
                 : Fail("a variable number");
    }
    if (Eat('~')) {
      const bool state = Eat('c');
      if (!state && !Eat('m')) return Fail("c or m");
      const auto id = ReadInteger();
      if (!id || *id <= 0) return Fail("an object number");
      return state ? Term::Reference(CompositeStateId{*id}) : Term::Reference(ModelId{*id});
    }
    if (Eat('[')) {
      auto items = ReadItems(']', depth);
      return items ? std::optional(Term::Set(std::move(*items))) : std::nullopt;
    }
    if (Eat('(')) {
      auto head = ReadName();
      if (!head) return Fail("a head word");
      auto items = ReadItems(')', depth);
      return items ? std::optional(Term::Struct(std::move(*head), std::move(*items))) : std::nullopt;
    }
    if ((c == 't' || c == 'd') && next_is_digit) {
      ++at_;
      const auto us = ReadInteger();
      if (!us || *us > kLargestTimeUs || *us < -kLargestTimeUs) return Fail("microseconds");
      return c == 't' ? Term::Instant(Time{*us}) : Term::Span(Duration{*us});
    }
    return ReadNumberOrName();
  }
  std::optional<Term> ReadNumberOrName() {
    const std::size_t start = at_;
    const char c = text_[at_];
    while (at_ < text_.size() && IsPlainByte(text_[at_])) ++at_;
    const std::string_view word = text_.substr(start, at_ - start);
    if (word.empty()) {
      if (Eat('|')) {
        auto name = ReadQuoted('|');
        return name ? std::optional(Term::Ontology(std::move(*name))) : Fail("a closing |");
      }
      return Fail("a term");
    }
    if (word == "nil") return Term::Nil();
    // Only these begin a number; from_chars alone would also take "Infinity" or "NaN", which are names.
    const bool number = (c >= '0' && c <= '9') || c == '-' || word == "inf" || word == "nan";
    if (!number) return Term::Ontology(std::string(word));
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc() && end == word.data() + word.size()) return Term::Number(value);
    at_ = start;
    return Fail("a number");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string expected_;
};

}  // namespace

std::string Encode(const Term& term) {
  std::string text;
  Append(term, &text);
  return text;
}

void AppendEncoded(const Term& term, std::string* out) {
  Append(term, out);
}

void AppendEncodedString(std::string_view text, std::string* out) {
  AppendQuoted(text, '"', out);
}

Result<Term> DecodeTerm(std::string_view text) {
  return Decoder(text).Read();
}

}  // namespace aerascope
