// Text from an episode, made safe for a format. What a format cannot hold (control characters, invalid UTF-8)
// is written visibly, as Printable does, and never dropped.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace aerascope {

// In double quotes, for DOT. A line feed becomes \l, which ends a line set to the left.
std::string DotQuoted(std::string_view text);

// For one cell or line of Markdown: what would be markup is escaped.
std::string MarkdownText(std::string_view text);

// Ok, or a sentence if the stream could not take all that was written.
Status StatusOf(const std::ostream& out, std::string_view what);

}  // namespace aerascope
