#include "viewer/render/frame_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace aerascope {
namespace {

using ::testing::ElementsAre;

Image Plain(int width, std::uint8_t grey) {
  return {{width, 1}, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width), grey)};
}

Result<std::string> FirstByte(const Image& image) {
  return std::to_string(image.rgb[0]) + "/" + std::to_string(image.size.width);
}

TEST(FrameWriter, EncodesInOrderAndEqualPicturesOnce) {
  std::vector<std::string> files;
  FrameWriter writer(FirstByte, [&](std::size_t number, std::string bytes) {
    EXPECT_EQ(number, files.size());
    files.push_back(std::move(bytes));
    return Ok();
  });
  std::vector<std::size_t> numbers;
  for (const int grey : {5, 6, 5, 7, 6})
    numbers.push_back(writer.Add(Plain(4, static_cast<std::uint8_t>(grey))));
  numbers.push_back(writer.Add(Plain(8, 5)));
  ASSERT_TRUE(writer.Finish());
  EXPECT_THAT(numbers, ElementsAre(0, 1, 0, 2, 1, 3));
  EXPECT_THAT(files, ElementsAre("5/4", "6/4", "7/4", "5/8"));
}

TEST(FrameWriter, ManyMoreThanWaitAtATimeAllArrive) {
  std::size_t arrived = 0;
  FrameWriter writer(FirstByte, [&](std::size_t number, std::string) {
    EXPECT_EQ(number, arrived++);
    return Ok();
  });
  for (int i = 0; i < 1000; ++i)
    writer.Add({{1, 1}, {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 256), 0}});
  ASSERT_TRUE(writer.Finish());
  EXPECT_EQ(arrived, 1000u);
}

TEST(FrameWriter, TheFirstFailureIsToldAndTheRestIsNotEncoded) {
  int calls = 0;
  const Encoder fails_on_second = [&](const Image& image) -> Result<std::string> {
    if (++calls == 2) return Error{"no more room for " + std::to_string(image.rgb[0])};
    return std::string("x");
  };
  FrameWriter writer(fails_on_second, [](std::size_t, std::string) { return Ok(); });
  for (int i = 0; i < 100; ++i) writer.Add(Plain(1, static_cast<std::uint8_t>(i)));
  const Status status = writer.Finish();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "no more room for 1");
  EXPECT_EQ(calls, 2);
}

TEST(FrameWriter, OneThatIsNotFinishedGoesAway) {
  FrameWriter writer(FirstByte, [](std::size_t, std::string) { return Ok(); });
  writer.Add(Plain(1, 1));
}

}  // namespace
}  // namespace aerascope
