#include "viewer/page/encoding.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/viewer/page/page_reader.h"
#include "viewer/page/columns.h"

namespace aerascope {
namespace {

TEST(Encoding, Base64PadsToGroupsOfFour) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

TEST(Encoding, GzipGivesBackWhatWentInAndTheSameBytesEachTime) {
  const std::string text = std::string(5000, 'a') + std::string("\0\xff", 2);
  const auto packed = Gzip(text);
  ASSERT_TRUE(packed.ok());
  EXPECT_LT(packed->size(), 100u);
  EXPECT_EQ(Gunzip(*packed), text);
  EXPECT_EQ(*Gzip(text), *packed);
  EXPECT_EQ(Gunzip(*Gzip("")), "");
}

TEST(Encoding, HexDigitsBecomeBytes) {
  EXPECT_EQ(BytesOfHex("00ffAb"), std::string("\x00\xff\xab", 3));
}

TEST(Columns, NumbersOfEitherSignComeBack) {
  ColumnWriter writer;
  const std::int64_t numbers[] = {0,
                                  1,
                                  -1,
                                  63,
                                  -64,
                                  64,
                                  1'000'000'000'000,
                                  -7,
                                  std::numeric_limits<std::int64_t>::max(),
                                  std::numeric_limits<std::int64_t>::min()};
  for (const std::int64_t number : numbers) writer.Signed(number);
  writer.Unsigned(std::numeric_limits<std::uint64_t>::max());
  ColumnReader reader(writer.bytes());
  for (const std::int64_t number : numbers) EXPECT_EQ(reader.Signed(), number);
  EXPECT_EQ(reader.Unsigned(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_TRUE(reader.AtEnd());
}

}  // namespace
}  // namespace aerascope
