#include "viewer/draw/text_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/text.h"

namespace aerascope {
namespace {

// Advance widths of the ASCII characters from the space on, in thousandths of the font size.
constexpr std::array<int, 95> kRegular = {
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
constexpr std::array<int, 95> kBold = {
    348, 456,  521, 838, 696, 1002, 872, 306, 457, 457, 523, 838, 380, 415,  380, 365, 696, 696,  696,
    696, 696,  696, 696, 696, 696,  696, 400, 400, 838, 838, 838, 580, 1000, 774, 762, 734, 830,  683,
    683, 821,  837, 372, 372, 775,  637, 995, 837, 850, 733, 850, 770, 720,  682, 812, 774, 1103, 771,
    724, 725,  457, 365, 457, 838,  500, 500, 675, 716, 593, 716, 678, 435,  716, 712, 343, 343,  665,
    343, 1042, 712, 687, 716, 716,  493, 595, 478, 712, 652, 924, 645, 652,  582, 712, 365, 712,  838};
constexpr int kMonoAdvance = 602;
constexpr std::string_view kEllipsis = "…";

// One character of valid UTF-8.
struct Character {
  std::string_view bytes;
  char32_t code = 0;
};

Character FirstCharacter(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  std::size_t length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  length = std::min(length, text.size());
  char32_t code = lead < 0x80 ? lead : lead & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) code = (code << 6) | (static_cast<unsigned char>(text[i]) & 0x3Fu);
  return {text.substr(0, length), code};
}

int Advance(char32_t code, TextWeight weight) {
  if (weight == TextWeight::kMono) return code < 0x1100 ? kMonoAdvance : 2 * kMonoAdvance;
  const bool bold = weight == TextWeight::kBold;
  if (code >= 0x20 && code < 0x7F) return (bold ? kBold : kRegular)[code - 0x20];
  if (code == 0xB7) return bold ? 380 : 318;
  if (code >= 0x300 && code < 0x370) return 0;  // combining marks
  if (code == 0x2018 || code == 0x2019) return bold ? 380 : 318;
  if (code == 0x201C || code == 0x201D) return bold ? 657 : 518;
  if (code < 0x1100) return bold ? 900 : 780;  // letters of other alphabets, on the wide side
  return 1000;                                 // arrows, signs, East Asian letters, pictures
}

// Thousandths of the font size.
long long Thousandths(std::string_view text, TextWeight weight) {
  long long sum = 0;
  while (!text.empty()) {
    const Character first = FirstCharacter(text);
    sum += Advance(first.code, weight);
    text.remove_prefix(first.bytes.size());
  }
  return sum;
}

long long Room(int width, double size) {
  return static_cast<long long>(std::max(0, width) * 1000.0 / size);
}

// How many bytes of the text fit.
std::size_t BytesThatFit(std::string_view text, long long room, TextWeight weight) {
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    const Character next = FirstCharacter(text.substr(bytes));
    room -= Advance(next.code, weight);
    if (room < 0) break;
    bytes += next.bytes.size();
  }
  return bytes;
}

bool IsWordByte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || c == '_' || (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= 'a' && byte <= 'z');
}

std::string TrimEnd(std::string text) {
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

int TextWidth(std::string_view text, double size, TextWeight weight) {
  return static_cast<int>(
      std::ceil(static_cast<double>(Thousandths(Printable(text), weight)) * size / 1000.0));
}

std::string FitText(std::string_view text, int width, double size, TextWeight weight) {
  const std::string printable = Printable(text);
  const long long room = Room(width, size);
  if (Thousandths(printable, weight) <= room) return printable;
  const long long rest = room - Thousandths(kEllipsis, weight);
  if (rest < 0) return "";
  return TrimEnd(printable.substr(0, BytesThatFit(printable, rest, weight))) + std::string(kEllipsis);
}

std::string_view FirstLetter(std::string_view text) {
  return text.empty() ? text : FirstCharacter(text).bytes;
}

std::vector<std::string> WrapText(std::string_view text, int width, double size, std::size_t max_lines,
                                  TextWeight weight) {
  const std::string printable = Printable(text);
  const long long room = Room(width, size);
  std::vector<std::string> lines;
  std::string_view rest = printable;
  while (!rest.empty() && lines.size() < max_lines) {
    if (lines.size() + 1 == max_lines || Thousandths(rest, weight) <= room) {
      lines.push_back(FitText(rest, width, size, weight));
      break;
    }
    std::size_t fit = std::max(BytesThatFit(rest, room, weight), FirstCharacter(rest).bytes.size());
    if (const std::size_t space = rest.rfind(' ', fit); space != std::string_view::npos && space > 0)
      fit = space;
    lines.push_back(TrimEnd(std::string(rest.substr(0, fit))));
    rest.remove_prefix(fit);
    while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  }
  return lines;
}

std::string FitSentences(const std::vector<std::string>& sentences, int width, double size,
                         std::size_t max_lines) {
  std::string text;
  for (const std::string& sentence : sentences) {
    const std::string longer = text.empty() ? sentence : text + " " + sentence;
    if (text.empty() || WrapText(longer, width, size, max_lines + 1).size() <= max_lines) text = longer;
  }
  return text;
}

std::vector<TextRun> WithVariables(std::string_view text, const std::vector<std::string>& variables,
                                   const std::string& classes) {
  std::vector<TextRun> runs;
  const auto add = [&](std::string_view piece, bool variable) {
    if (piece.empty()) return;
    const std::string style = variable ? (classes.empty() ? "d-v" : classes + " d-v") : classes;
    if (!runs.empty() && runs.back().classes == style) {
      runs.back().text += piece;
    } else {
      runs.push_back({std::string(piece), style});
    }
  };
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = at;
    const bool word = IsWordByte(text[at]);
    while (end < text.size() && IsWordByte(text[end]) == word) ++end;
    const std::string_view piece = text.substr(at, end - at);
    add(piece, word && std::find(variables.begin(), variables.end(), piece) != variables.end());
    at = end;
  }
  return runs;
}

std::string InPrint(std::string_view sentence) {
  std::string text;
  bool open = false;
  for (const char c : sentence) {
    if (c == '`') open = !open;
    text += c != '`' ? std::string(1, c) : open ? "\u201c" : "\u201d";
  }
  return text;
}

std::string TwoDecimals(double share) {
  const double clean = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
  // Half a hundredth goes up; the small term undoes what binary fractions lose.
  const int hundredths = static_cast<int>(std::floor(clean * 100 + 0.5 + 1e-9));
  const std::string fraction = std::to_string(hundredths % 100);
  return std::to_string(hundredths / 100) + "." + (fraction.size() < 2 ? "0" : "") + fraction;
}

std::string RingText(double share) {
  const std::string text = TwoDecimals(share);
  return text == "1.00" ? "1.0" : text.substr(1);
}

}  // namespace aerascope
