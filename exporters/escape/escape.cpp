#include "exporters/escape/escape.h"

#include <ostream>

#include "engine/base/text.h"

namespace aerascope {
namespace {

// Printable, line by line.
std::string PrintableLines(std::string_view text) {
  std::string lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines += Printable(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string DotQuoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : PrintableLines(text)) {
    switch (c) {
      case '"':
        quoted += "\\\"";
        break;
      case '\\':
        quoted += "\\\\";
        break;
      case '\n':
        quoted += "\\l";
        break;
      default:
        quoted += c;
    }
  }
  return quoted + "\"";
}

std::string MarkdownText(std::string_view text) {
  std::string escaped;
  for (const char c : Printable(text)) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      case '\\':
      case '`':
      case '*':
      case '_':
      case '[':
      case ']':
      case '|':
      case '#':
        escaped += '\\';
        [[fallthrough]];
      default:
        escaped += c;
    }
  }
  return escaped;
}

Status StatusOf(const std::ostream& out, std::string_view what) {
  if (out.good()) return Ok();
  return Error{std::string(what) + " could not be written completely; is there space left where it goes?"};
}

}  // namespace aerascope
