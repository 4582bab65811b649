#include "engine/base/markup.h"

#include "engine/base/text.h"

namespace aerascope {
namespace {

// U+FFFE and U+FFFF are valid UTF-8 and still forbidden in XML.
bool AtNonCharacter(std::string_view text) {
  return text.starts_with("\xef\xbf\xbe") || text.starts_with("\xef\xbf\xbf");
}

// One line, without line feeds.
void AppendEscapedLine(std::string_view line, std::string* escaped) {
  const std::string printable = Printable(line);
  for (std::size_t i = 0; i < printable.size(); ++i) {
    switch (printable[i]) {
      case '&':
        *escaped += "&amp;";
        break;
      case '<':
        *escaped += "&lt;";
        break;
      case '>':
        *escaped += "&gt;";
        break;
      case '"':
        *escaped += "&quot;";
        break;
      case '\'':
        *escaped += "&#39;";
        break;
      default:
        if (AtNonCharacter(std::string_view(printable).substr(i))) {
          *escaped += printable[i + 2] == '\xbe' ? "\\u{fffe}" : "\\u{ffff}";
          i += 2;
        } else {
          *escaped += printable[i];
        }
    }
  }
}

}  // namespace

std::string EscapeMarkup(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (true) {
    const std::size_t end = text.find('\n');
    AppendEscapedLine(text.substr(0, end), &escaped);
    if (end == std::string_view::npos) return escaped;
    escaped += "&#10;";
    text.remove_prefix(end + 1);
  }
}

}  // namespace aerascope
