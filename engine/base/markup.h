// Text made safe for XML and HTML alike: SVG, GraphML and the report use this one rule.
#pragma once

#include <string>
#include <string_view>

namespace aerascope {

// For the content of an element or an attribute, whatever the text: markup is escaped, a line feed stays one,
// and what XML cannot hold or a reader must not be misled by (control characters, bytes that are not UTF-8,
// bidirectional overrides, U+FFFE, U+FFFF) is written visibly, as Printable does. Nothing is dropped.
std::string EscapeMarkup(std::string_view text);

}  // namespace aerascope
