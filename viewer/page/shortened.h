// Text that is too long to be shown whole is cut, and says how long it is.
#pragma once

#include <string>
#include <string_view>

namespace aerascope {

// At most `longest` code points of UTF-8 text; a longer one ends with an ellipsis and its length.
inline std::string Shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t letters = 0, cut = text.size();
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) continue;
    if (++letters == longest + 1) cut = i;
  }
  if (letters <= longest) return std::string(text);
  return std::string(text.substr(0, cut)) + "\u2026 (" + std::to_string(letters) + " characters)";
}

}  // namespace aerascope
