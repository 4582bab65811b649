// How much room text takes, and text made to fit: with fixed widths of characters, those of DejaVu Sans,
// which is wider than most fonts. No font is asked, so equal input gives equal output on every machine.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "viewer/draw/svg.h"

namespace aerascope {

enum class TextWeight { kRegular, kBold, kMono };

// Pixels that the text takes at a font size in pixels, rounded up.
int TextWidth(std::string_view text, double size, TextWeight weight = TextWeight::kRegular);

// The text, or as much of its beginning as fits with "…" behind it.
std::string FitText(std::string_view text, int width, double size, TextWeight weight = TextWeight::kRegular);

// The first character of the text, which may be several bytes; empty of an empty text.
std::string_view FirstLetter(std::string_view text);

// At most max_lines lines broken between words; a word wider than a line is broken inside; the last line is
// cut like FitText.
std::vector<std::string> WrapText(std::string_view text, int width, double size, std::size_t max_lines,
                                  TextWeight weight = TextWeight::kRegular);

// As many of the sentences, whole and in their order, as WrapText has room for in these lines; the first
// always.
std::string FitSentences(const std::vector<std::string>& sentences, int width, double size,
                         std::size_t max_lines);

// The text in pieces, names of variables in italics. Names are found as whole words.
std::vector<TextRun> WithVariables(std::string_view text, const std::vector<std::string>& variables,
                                   const std::string& classes = "");

// Sentences mark quoted knowledge by back quotes; a drawing has the quotes of print in their place.
std::string InPrint(std::string_view sentence);

// A confidence with two decimals: "0.75", "1.00"; and short, for a ring: ".75", "1.0".
std::string TwoDecimals(double share);
std::string RingText(double share);

}  // namespace aerascope
