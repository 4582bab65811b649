// Videos read back by others: the file by libwebm's parser, the pictures by libvpx.
#include "viewer/render/video_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vpx/vp8dx.h>
#include <vpx/vpx_decoder.h>
#include <webm/buffer_reader.h>
#include <webm/callback.h>
#include <webm/webm_parser.h>

#include <cmath>
#include <cstdlib>

#include "viewer/render/webm.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr PictureSize kSize{96, 64};

// A grey picture with a bright square that moves to the right.
Image Frame(int number, PictureSize size = kSize) {
  Image image{size, {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool square = x >= 2 * number && x < 2 * number + 24 && y >= 20 && y < 44;
      for (const int channel : {square ? 230 : 90, square ? 60 : 90, square ? 40 : 90})
        image.rgb.push_back(static_cast<std::uint8_t>(channel));
    }
  }
  return image;
}

// What a reader finds in a file.
struct Found : webm::Callback {
  struct Block {
    std::int64_t at_ms = 0;
    bool key = false;
    std::string bytes;
  };
  struct Cue {
    std::uint64_t at_ms = 0;
    std::uint64_t cluster = 0;  // from the first byte inside the segment
  };

  webm::Status OnSegmentBegin(const webm::ElementMetadata& metadata, webm::Action* action) override {
    segment = metadata.position + metadata.header_size;
    *action = webm::Action::kRead;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnSeek(const webm::ElementMetadata&, const webm::Seek& seek) override {
    seeks.push_back(seek.position.value());
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnInfo(const webm::ElementMetadata& metadata, const webm::Info& info_found) override {
    info = info_found;
    starts.push_back(metadata.position - segment);
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnTrackEntry(const webm::ElementMetadata&, const webm::TrackEntry& entry) override {
    track = entry;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnCuePoint(const webm::ElementMetadata&, const webm::CuePoint& cue) override {
    cues.push_back({cue.time.value(), cue.cue_track_positions.at(0).value().cluster_position.value()});
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnClusterBegin(const webm::ElementMetadata& metadata, const webm::Cluster& cluster,
                              webm::Action* action) override {
    clusters.push_back({cluster.timecode.value(), metadata.position - segment});
    *action = webm::Action::kRead;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnSimpleBlockBegin(const webm::ElementMetadata&, const webm::SimpleBlock& block,
                                  webm::Action* action) override {
    blocks.push_back(
        {static_cast<std::int64_t>(clusters.back().at_ms) + block.timecode, block.is_key_frame, ""});
    *action = webm::Action::kRead;
    return webm::Status(webm::Status::kOkCompleted);
  }
  webm::Status OnFrame(const webm::FrameMetadata&, webm::Reader* reader, std::uint64_t* left) override {
    while (*left > 0) {
      std::uint8_t byte = 0;
      std::uint64_t count = 0;
      const webm::Status status = reader->Read(1, &byte, &count);
      if (!status.completed_ok()) return status;
      blocks.back().bytes += static_cast<char>(byte);
      --*left;
    }
    return webm::Status(webm::Status::kOkCompleted);
  }

  std::uint64_t segment = 0;
  std::vector<std::uint64_t> seeks;
  std::vector<std::uint64_t> starts;
  webm::Info info;
  webm::TrackEntry track;
  std::vector<Cue> cues;
  std::vector<Cue> clusters;
  std::vector<Block> blocks;
};

Found Parse(const std::string& file) {
  Found found;
  webm::BufferReader reader(std::vector<std::uint8_t>(file.begin(), file.end()));
  webm::WebmParser parser;
  const webm::Status status = parser.Feed(&found, &reader);
  EXPECT_TRUE(status.completed_ok()) << status.code;
  return found;
}

// The luma of the decoded pictures at a point.
std::vector<int> LumaAt(const Found& found, int x, int y) {
  vpx_codec_ctx_t codec{};
  EXPECT_EQ(vpx_codec_dec_init(&codec, vpx_codec_vp9_dx(), nullptr, 0), VPX_CODEC_OK);
  std::vector<int> luma;
  for (const Found::Block& block : found.blocks) {
    EXPECT_EQ(vpx_codec_decode(&codec, reinterpret_cast<const std::uint8_t*>(block.bytes.data()),
                               static_cast<unsigned>(block.bytes.size()), nullptr, 0),
              VPX_CODEC_OK);
    vpx_codec_iter_t iterator = nullptr;
    const vpx_image_t* picture = vpx_codec_get_frame(&codec, &iterator);
    if (picture == nullptr) {
      ADD_FAILURE() << "a block without a picture";
      break;
    }
    EXPECT_EQ(picture->d_w, static_cast<unsigned>(kSize.width));
    EXPECT_EQ(picture->d_h, static_cast<unsigned>(kSize.height));
    luma.push_back(picture->planes[VPX_PLANE_Y][y * picture->stride[VPX_PLANE_Y] + x]);
  }
  vpx_codec_destroy(&codec);
  return luma;
}

std::string Film(int pictures, VideoOptions options = {.size = kSize, .picture_ms = 50, .key_distance = 8}) {
  auto writer = VideoWriter::Create(options);
  EXPECT_TRUE(writer) << writer.error().message;
  for (int i = 0; i < pictures; ++i) EXPECT_TRUE(writer->Add(Frame(i)));
  auto file = writer->Finish();
  EXPECT_TRUE(file) << file.error().message;
  return *file;
}

TEST(VideoWriter, EveryPictureIsWhereItsNumberSays) {
  const Found found = Parse(Film(20));
  ASSERT_EQ(found.blocks.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(found.blocks[i].at_ms, static_cast<std::int64_t>(50 * i));
    EXPECT_EQ(found.blocks[i].key, i % 8 == 0) << i;
  }
  EXPECT_EQ(found.info.duration.value(), 1000);
  EXPECT_EQ(found.info.timecode_scale.value(), 1'000'000u);
  EXPECT_EQ(found.track.codec_id.value(), "V_VP9");
  EXPECT_EQ(found.track.default_duration.value(), 50'000'000u);
  EXPECT_EQ(found.track.video.value().pixel_width.value(), 96u);
  EXPECT_EQ(found.track.video.value().pixel_height.value(), 64u);
}

TEST(VideoWriter, PicturesComeBackAsTheyWere) {
  const Found found = Parse(Film(20));
  const std::vector<int> luma = LumaAt(found, 40, 32);
  ASSERT_EQ(luma.size(), 20u);
  // The square (luma 98 by BT.709 in broadcast range) covers this point from picture 9 on; before it is grey
  // (93).
  const std::vector<int> corner = LumaAt(found, 1, 1);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(corner[i], 93, 4) << i;
  EXPECT_NEAR(luma[2], 93, 4);
  EXPECT_NEAR(luma[15], 16 + 0.8588 * (0.2126 * 230 + 0.7152 * 60 + 0.0722 * 40), 4);
}

TEST(VideoWriter, TheIndexLeadsToEachKeyPicture) {
  const std::string file = Film(20);
  const Found found = Parse(file);
  ASSERT_EQ(found.cues.size(), 3u);
  ASSERT_EQ(found.clusters.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.cues[i].at_ms, 400 * i);
    EXPECT_EQ(found.cues[i].at_ms, found.clusters[i].at_ms);
    EXPECT_EQ(found.cues[i].cluster, found.clusters[i].cluster);
  }
  // The first entry of the table of contents is Info; the last one the index itself, which stands before the
  // pictures.
  ASSERT_EQ(found.seeks.size(), 3u);
  EXPECT_EQ(found.seeks[0], found.starts.at(0));
  EXPECT_EQ(file.substr(found.segment + found.seeks[2], 4), "\x1C\x53\xBB\x6B");
  EXPECT_LT(found.seeks[2], found.clusters[0].cluster);
}

TEST(VideoWriter, SamePicturesSameBytesAndNothingOfThisMachine) {
  const std::string file = Film(20);
  EXPECT_EQ(file, Film(20));
  const Found found = Parse(file);
  EXPECT_FALSE(found.info.date_utc.is_present());
  EXPECT_EQ(found.info.muxing_app.value(), "aerascope");
  EXPECT_EQ(found.info.writing_app.value(), "aerascope");
  EXPECT_EQ(found.track.track_uid.value(), 1u);
}

TEST(VideoWriter, WhatStandsStillCostsNextToNothing) {
  auto writer = VideoWriter::Create({.size = kSize});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->Add(Frame(5)));
  for (int i = 0; i < 9; ++i) ASSERT_TRUE(writer->Repeat());
  EXPECT_EQ(writer->pictures(), 10u);
  const Found found = Parse(*writer->Finish());
  ASSERT_EQ(found.blocks.size(), 10u);
  for (std::size_t i = 5; i < 10; ++i) EXPECT_LT(found.blocks[i].bytes.size(), 40u);
}

TEST(VideoWriter, LongPicturesStayWithinTheReachOfTheirCluster) {
  const Found found = Parse(Film(20, {.size = kSize, .picture_ms = 20'000, .key_distance = 20}));
  ASSERT_EQ(found.blocks.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(found.blocks[i].at_ms, static_cast<std::int64_t>(20'000 * i));
  EXPECT_EQ(found.cues.size(), 1u);
  EXPECT_GT(found.clusters.size(), 5u);
}

TEST(VideoWriter, WhatCannotBeIsSaid) {
  EXPECT_THAT(VideoWriter::Create({.size = {95, 64}}).error().message,
              HasSubstr("expected even sides of 2 to 8192 pixels, found 95 x 64"));
  EXPECT_FALSE(VideoWriter::Create({.size = kSize, .picture_ms = 0}));
  EXPECT_FALSE(VideoWriter::Create({.size = kSize, .quantizer = 64}));
  auto writer = VideoWriter::Create({.size = kSize});
  ASSERT_TRUE(writer);
  EXPECT_THAT(writer->Add(Frame(0, {64, 64})).error().message, HasSubstr("another size than the video"));
  auto empty = VideoWriter::Create({.size = kSize});
  ASSERT_TRUE(empty->Repeat());
  EXPECT_THAT(empty->Finish().error().message, HasSubstr("no picture to repeat"));
}

TEST(WebmFile, AnEmptyOneIsStillAFile) {
  const Found found = Parse(WebmFile({.size = kSize}, {}));
  EXPECT_TRUE(found.blocks.empty());
  EXPECT_EQ(found.info.duration.value(), 0);
}

}  // namespace
}  // namespace aerascope
