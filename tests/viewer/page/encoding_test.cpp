#include "viewer/page/encoding.h"

#include <gtest/gtest.h>
#include <zlib.h>

namespace aerascope {
namespace {

std::string Gunzip(const std::string& packed) {
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);
  std::string text(1 << 20, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

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

}  // namespace
}  // namespace aerascope
