#include "engine/query/kind_titles.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "engine/event/event_body.h"

namespace aerascope {
namespace {

TEST(KindTitles, EveryKindOfEventHasATitleOfItsOwnInPlainWords) {
  std::set<std::string_view> titles;
  ForEachKind([&]<class Body>() {
    const std::string_view title = KindTitle(Body::kName);
    EXPECT_FALSE(title.empty()) << Body::kName;
    EXPECT_TRUE(titles.insert(title).second) << title;
    // Words as people write them, without the engine's abbreviations.
    for (const char* word : {"Icst", "icst", "Imdl", "imdl"})
      EXPECT_EQ(title.find(word), std::string_view::npos) << title;
    for (std::size_t i = 1; i < title.size(); ++i) EXPECT_FALSE(title[i] >= 'A' && title[i] <= 'Z') << title;
  });
  EXPECT_EQ(titles.size(), kEventKinds);
}

TEST(KindTitles, WhatIsNoKindHasNone) {
  EXPECT_EQ(KindTitle("Nothing"), "");
}

}  // namespace
}  // namespace aerascope
