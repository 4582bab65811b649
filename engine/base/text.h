// Numbers and words as text, in one fixed format each, chosen here and nowhere else.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace aerascope {

// Rounds to 9 significant decimal digits. All numbers inside terms are rounded so; their text is then exact.
double RoundNumber(double value);

// At most `digits` significant digits, no trailing zeros, never "-0"; "nan", "inf", "-inf" spelled so.
std::string FormatNumber(double value, int digits = 9);

// The same into an existing text.
void AppendNumber(double value, int digits, std::string* text);
// The shortest digits that are read back as exactly this number; "nan", "inf", "-inf" spelled so, "-0" is
// "0".
void AppendExactNumber(double value, std::string* text);
void AppendInteger(std::int64_t value, std::string* text);

// A share or confidence for people: at most three decimals, "0.75", "1", "0.333".
std::string FormatConfidence(double value);

std::string Join(const std::vector<std::string>& parts, std::string_view separator);

// Text as it is safe on one terminal line: control characters, invalid UTF-8 and bidirectional overrides
// become \xNN or \u{NNNN}; nothing else changes.
std::string Printable(std::string_view text);

// The known word most like `word` (edit distance at most 2 and less than half its length), or "".
std::string ClosestWord(std::string_view word, const std::vector<std::string>& known);

}  // namespace aerascope
