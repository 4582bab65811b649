#include "engine/base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

namespace aerascope {
namespace {

constexpr int kTermDigits = 9;

// Zero, one and what is not finite need no digits generator.
bool AppendSpecialNumber(double value, std::string* text) {
  if (value == 0) {
    *text += '0';
  } else if (value == 1) {
    *text += '1';
  } else if (std::isnan(value)) {
    *text += "nan";
  } else if (std::isinf(value)) {
    *text += value < 0 ? "-inf" : "inf";
  } else {
    return false;
  }
  return true;
}

std::string Hex(std::uint32_t value) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, "%02x", static_cast<unsigned>(value));
  return buffer;
}

// One code point of UTF-8 at the front of `text`; length 0 if the bytes are not valid UTF-8.
struct CodePoint {
  std::uint32_t value = 0;
  std::size_t length = 0;
};

CodePoint FirstCodePoint(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  std::uint32_t value = lead & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    value = value << 6 | (byte(i) & 0x3fu);
  }
  const std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (value < smallest[length] || value > 0x10ffff || (value >= 0xd800 && value <= 0xdfff)) return {};
  return {value, length};
}

bool Disturbing(std::uint32_t code_point) {
  return code_point < 0x20 || (code_point >= 0x7f && code_point < 0xa0) || code_point == 0x061c ||
         (code_point >= 0x200b && code_point <= 0x200f) || (code_point >= 0x2028 && code_point <= 0x202e) ||
         (code_point >= 0x2060 && code_point <= 0x206f) || code_point == 0xfeff;
}

}  // namespace

double RoundNumber(double value) {
  if (std::isnan(value))
    return std::numeric_limits<double>::quiet_NaN();  // one NaN, so that equal means equal bits
  if (std::isinf(value)) return value;
  if (value == 0) return 0;  // never -0
  const std::string text = FormatNumber(value, kTermDigits);
  double rounded = value;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

std::string FormatNumber(double value, int digits) {
  std::string text;
  AppendNumber(value, digits, &text);
  return text;
}

void AppendNumber(double value, int digits, std::string* text) {
  if (AppendSpecialNumber(value, text)) return;
  char buffer[64];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  text->append(buffer, error == std::errc() ? static_cast<std::size_t>(end - buffer) : 0);
}

void AppendExactNumber(double value, std::string* text) {
  if (AppendSpecialNumber(value, text)) return;
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text->append(buffer, error == std::errc() ? static_cast<std::size_t>(end - buffer) : 0);
}

void AppendInteger(std::int64_t value, std::string* text) {
  char buffer[24];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text->append(buffer, error == std::errc() ? static_cast<std::size_t>(end - buffer) : 0);
}

std::string FormatConfidence(double value) {
  if (!std::isfinite(value)) return FormatNumber(value);
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, 3);
  if (error != std::errc()) return FormatNumber(value, 6);
  std::string text(buffer, end);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string Join(const std::vector<std::string>& parts, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += separator;
    text += parts[i];
  }
  return text;
}

std::string Printable(std::string_view text) {
  std::string printable;
  while (!text.empty()) {
    const CodePoint first = FirstCodePoint(text);
    if (first.length == 0) {
      printable += "\\x" + Hex(static_cast<unsigned char>(text[0]));
      text.remove_prefix(1);
      continue;
    }
    if (!Disturbing(first.value)) {
      printable += text.substr(0, first.length);
    } else if (first.value < 0x80) {
      printable += "\\x" + Hex(first.value);
    } else {
      printable += "\\u{" + Hex(first.value) + "}";
    }
    text.remove_prefix(first.length);
  }
  return printable;
}

std::string ClosestWord(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::min<std::size_t>(3, (word.size() + 1) / 2 + 1);
  for (const std::string& candidate : known) {
    if (candidate.size() > 64 || word.size() > 64) continue;
    std::vector<std::size_t> row(candidate.size() + 1);
    for (std::size_t j = 0; j <= candidate.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t replaced = diagonal + (word[i - 1] == candidate[j - 1] ? 0 : 1);
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
      }
    }
    if (row.back() < best_distance) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best;
}

}  // namespace aerascope
