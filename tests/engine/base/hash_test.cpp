#include "engine/base/hash.h"

#include <gtest/gtest.h>

namespace aerascope {
namespace {

TEST(Hash, IsTheSameOnEveryMachine) {
  // XXH3-128 of nothing, as its specification gives it: episodes and snapshots rely on it.
  EXPECT_EQ(ToText(HashOf("")), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(ToText(HashOf("aerascope")), ToText(HashOf(std::string("aera") + "scope")));
  EXPECT_NE(HashOf("a"), HashOf("b"));
}

TEST(Hash, StreamInPiecesEqualsTheWhole) {
  const std::string text(100'000, 'x');
  Hasher hasher;
  for (std::size_t at = 0, piece = 1; at < text.size(); at += piece, piece = piece * 3 % 1009 + 1) {
    hasher.Add(std::string_view(text).substr(at, piece));
  }
  EXPECT_EQ(hasher.Digest(), HashOf(text));
}

TEST(Hash, TextHasLeadingZeros) {
  EXPECT_EQ(ToText(Hash128{1, 0xabc}), "00000000000000010000000000000abc");
}

}  // namespace
}  // namespace aerascope
