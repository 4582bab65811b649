// Any text inside XML and HTML.
#include "engine/base/markup.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace aerascope {
namespace {

TEST(EscapeMarkup, MarkupBecomesEntities) {
  EXPECT_EQ(EscapeMarkup("<a b=\"c\">'&</a>"), "&lt;a b=&quot;c&quot;&gt;&#39;&amp;&lt;/a&gt;");
  EXPECT_EQ(EscapeMarkup("&lt;"), "&amp;lt;");
  EXPECT_EQ(EscapeMarkup(""), "");
}

TEST(EscapeMarkup, ALineFeedStaysOne) {
  EXPECT_EQ(EscapeMarkup("a\n\nb\n"), "a&#10;&#10;b&#10;");
}

TEST(EscapeMarkup, WhatXmlCannotHoldIsWrittenVisibly) {
  EXPECT_EQ(EscapeMarkup(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(EscapeMarkup("\x1b[31m\t\r"), "\\x1b[31m\\x09\\x0d");
  EXPECT_EQ(EscapeMarkup("\xff<"), "\\xff&lt;");
  EXPECT_EQ(EscapeMarkup("\xef\xbf\xbe\xef\xbf\xbf\xef\xbf\xbd"), "\\u{fffe}\\u{ffff}\xef\xbf\xbd");
  EXPECT_EQ(EscapeMarkup("\xe2\x80\xae"), "\\u{202e}");
  EXPECT_EQ(EscapeMarkup("gr\xc3\xb6\xc3\x9f"), "gr\xc3\xb6\xc3\x9f");
}

// Own: whatever the bytes, no character of markup is left, and every & begins an entity.
TEST(EscapeMarkup, NothingThatEndsAnElementOrAttributeIsLeft) {
  EXPECT_TRUE(rc::check([](const std::string& text) {
    const std::string escaped = EscapeMarkup(text);
    RC_ASSERT(escaped.find_first_of("<>\"'") == std::string::npos);
    for (const char c : escaped) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
    for (std::size_t at = escaped.find('&'); at != std::string::npos; at = escaped.find('&', at + 1)) {
      const std::size_t end = escaped.find(';', at);
      RC_ASSERT(end != std::string::npos && end - at <= 5);
    }
  }));
}

}  // namespace
}  // namespace aerascope
