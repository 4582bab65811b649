#include "viewer/page/text_columns.h"

#include <algorithm>

namespace aerascope {
namespace {

constexpr char kPlace = '\x01';
// A browser's numbers are exact up to 2^53, also as differences.
constexpr std::size_t kMostDigits = 9, kMostDecimals = 6;

// A number as it was written: digits / 10^decimals.
struct Decimal {
  std::int64_t digits = 0;
  std::size_t decimals = 0;
};

struct SplitText {
  std::string form;
  std::vector<Decimal> numbers;
};

bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t DigitsAt(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && IsDigit(text[end])) ++end;
  return end - at;
}

// Whether a minus before a number belongs to it: "(-2" and "at -2" say so, "a-2" and "5-2" do not.
bool MayFollowMinus(const std::string& form) {
  return form.empty() || form.back() == ' ' || form.back() == '(' || form.back() == '[' || form.back() == '"';
}

// Numbers that would not be written back as they were ("007", "1.50", "-0", very long ones) stay in the form.
SplitText Split(std::string_view text) {
  SplitText split;
  std::size_t i = 0;
  while (i < text.size()) {
    const bool minus = text[i] == '-' && MayFollowMinus(split.form);
    const std::size_t start = i + (minus ? 1 : 0);
    const std::size_t length = DigitsAt(text, start);
    if (length == 0) {
      // Texts are of one line and without control characters; should one hold any, the columns stay readable.
      split.form += static_cast<unsigned char>(text[i]) < 0x20 ? ' ' : text[i];
      ++i;
      continue;
    }
    std::size_t decimals = 0;
    if (start + length < text.size() && text[start + length] == '.') {
      decimals = DigitsAt(text, start + length + 1);
      if (decimals > kMostDecimals || (decimals > 0 && text[start + length + decimals] == '0')) decimals = 0;
    }
    const bool odd = length > kMostDigits || (length > 1 && text[start] == '0') ||
                     (minus && length == 1 && text[start] == '0' && decimals == 0);
    if (odd) {
      split.form += text.substr(i, start + length - i);
      i = start + length;
      continue;
    }
    Decimal number{0, decimals};
    const std::size_t end = start + length + (decimals > 0 ? decimals + 1 : 0);
    for (std::size_t k = start; k < end; ++k)
      if (text[k] != '.') number.digits = number.digits * 10 + (text[k] - '0');
    if (minus) number.digits = -number.digits;
    split.numbers.push_back(number);
    split.form += kPlace;
    i = end;
  }
  return split;
}

std::int64_t Scaled(const Decimal& number, std::size_t decimals) {
  std::int64_t digits = number.digits;
  for (std::size_t k = number.decimals; k < decimals; ++k) digits *= 10;
  return digits;
}

// A guess at what differences take when they are compressed: their bytes, and each change.
std::size_t Weight(const std::vector<std::int64_t>& differences) {
  std::size_t weight = 0;
  std::int64_t before = 0;
  for (const std::int64_t difference : differences) {
    weight += difference != before ? 1 : 0;
    before = difference;
    for (std::int64_t rest = difference < 0 ? ~difference : difference; rest >= 0x40; rest >>= 7) ++weight;
  }
  return weight;
}

}  // namespace

std::size_t TextColumns::FormNumber(const std::string& form) {
  const auto [entry, is_new] = numbers_.try_emplace(form, numbers_.size() + 1);
  if (is_new) forms_ += form + '\n';
  return entry->second;
}

void TextColumns::Add(const std::vector<TextCell>& column) {
  struct Row {
    std::int64_t row;
    std::vector<Decimal> numbers;
  };
  std::map<std::size_t, std::size_t> position;  // of a form in `by_form`
  std::vector<std::vector<Row>> by_form;        // in the order of their first rows
  for (const TextCell& cell : column) {
    if (!cell.text) {
      columns_.Unsigned(0);
      continue;
    }
    SplitText split = Split(*cell.text);
    const std::size_t form = FormNumber(split.form);
    columns_.Unsigned(form);
    const auto [entry, is_new] = position.try_emplace(form, by_form.size());
    if (is_new) by_form.emplace_back();
    by_form[entry->second].push_back({cell.row, std::move(split.numbers)});
  }
  for (const std::vector<Row>& rows : by_form) {
    for (std::size_t place = 0; place < rows.front().numbers.size(); ++place) {
      std::size_t decimals = 0;
      for (const Row& row : rows) decimals = std::max(decimals, row.numbers[place].decimals);
      std::vector<std::int64_t> from_before, from_row;
      std::int64_t before = 0;
      for (const Row& row : rows) {
        const std::int64_t value = Scaled(row.numbers[place], decimals);
        from_before.push_back(value - before);
        from_row.push_back(value - row.row);
        before = value;
      }
      const bool counted = decimals == 0 && Weight(from_row) < Weight(from_before);
      columns_.Unsigned(2 * decimals + (counted ? 1 : 0));
      for (const std::int64_t difference : counted ? from_row : from_before) columns_.Signed(difference);
    }
  }
}

std::string TextColumns::bytes() const {
  ColumnWriter head;
  head.Unsigned(forms_.size());
  return head.bytes() + forms_ + columns_.bytes();
}

}  // namespace aerascope
