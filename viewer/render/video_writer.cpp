#include "viewer/render/video_writer.h"

#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

#include <future>
#include <utility>
#include <vector>

#include "viewer/render/webm.h"

namespace aerascope {
namespace {

Error Failed(const std::string& why) {
  return {"the video cannot be written: " + why};
}

struct PlanesFree {
  void operator()(vpx_image_t* planes) const { vpx_img_free(planes); }
};

// Red, green and blue to luma and halved chroma: BT.709, broadcast range, 16 bits behind the point.
class Bt709 {
 public:
  static std::uint8_t Luma(int r, int g, int b) {
    return Byte((11966 * r + 40254 * g + 4064 * b + kHalf) / kOne + 16);
  }
  // From sums over four pixels.
  static std::uint8_t Blue(int r, int g, int b) {
    return Byte((-6596 * r - 22189 * g + 28784 * b + 512 * kOne + 2 * kOne) / (4 * kOne));
  }
  static std::uint8_t Red(int r, int g, int b) {
    return Byte((28784 * r - 26145 * g - 2639 * b + 512 * kOne + 2 * kOne) / (4 * kOne));
  }

 private:
  static constexpr int kOne = 65536;
  static constexpr int kHalf = kOne / 2;
  static std::uint8_t Byte(int value) { return static_cast<std::uint8_t>(value); }
};

void FillPlanes(const Image& image, vpx_image_t& planes) {
  const auto width = static_cast<std::size_t>(image.size.width);
  const auto height = static_cast<std::size_t>(image.size.height);
  const auto row_of = [&planes](int plane, std::size_t y) {
    return planes.planes[plane] + static_cast<std::size_t>(planes.stride[plane]) * y;
  };
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* rgb = image.rgb.data() + 3 * width * y;
    std::uint8_t* luma = row_of(VPX_PLANE_Y, y);
    for (std::size_t x = 0; x < width; ++x, rgb += 3) luma[x] = Bt709::Luma(rgb[0], rgb[1], rgb[2]);
  }
  for (std::size_t y = 0; y < height / 2; ++y) {
    const std::uint8_t* upper = image.rgb.data() + 3 * width * (2 * y);
    const std::uint8_t* lower = upper + 3 * width;
    std::uint8_t* blue = row_of(VPX_PLANE_U, y);
    std::uint8_t* red = row_of(VPX_PLANE_V, y);
    for (std::size_t x = 0; x < width / 2; ++x, upper += 6, lower += 6) {
      const auto sum = [&](std::size_t c) { return upper[c] + upper[c + 3] + lower[c] + lower[c + 3]; };
      blue[x] = Bt709::Blue(sum(0), sum(1), sum(2));
      red[x] = Bt709::Red(sum(0), sum(1), sum(2));
    }
  }
}

}  // namespace

class VideoWriter::Encoder {
 public:
  explicit Encoder(const VideoOptions& options) : options_(options) {}
  ~Encoder() {
    if (working_.valid()) working_.wait();
    if (open_) vpx_codec_destroy(&codec_);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  Status Open() {
    const PictureSize size = options_.size;
    constexpr int kLongestSide = 8192;
    const bool fits = size.width >= 2 && size.height >= 2 && size.width <= kLongestSide &&
                      size.height <= kLongestSide && size.width % 2 == 0 && size.height % 2 == 0;
    if (!fits) {
      return Failed("expected even sides of 2 to " + std::to_string(kLongestSide) + " pixels, found " +
                    std::to_string(size.width) + " x " + std::to_string(size.height));
    }
    if (options_.picture_ms < 1 || options_.key_distance < 1 || options_.quantizer < 0 ||
        options_.quantizer > 63)
      return Failed("expected pictures of a millisecond or more, key pictures, and a quantizer of 0 to 63");
    vpx_codec_enc_cfg_t config;
    if (vpx_codec_enc_config_default(vpx_codec_vp9_cx(), &config, 0) != VPX_CODEC_OK)
      return Failed("libvpx has no VP9 encoder");
    config.g_w = static_cast<unsigned>(size.width);
    config.g_h = static_cast<unsigned>(size.height);
    config.g_timebase = {static_cast<int>(options_.picture_ms), 1000};
    config.g_threads = 1;
    config.g_lag_in_frames = 0;
    config.g_error_resilient = 0;
    config.rc_end_usage = VPX_Q;
    config.rc_min_quantizer = config.rc_max_quantizer = static_cast<unsigned>(options_.quantizer);
    config.rc_dropframe_thresh = 0;
    config.rc_resize_allowed = 0;
    // Key pictures are asked for one by one.
    config.kf_mode = VPX_KF_DISABLED;
    if (vpx_codec_enc_init(&codec_, vpx_codec_vp9_cx(), &config, 0) != VPX_CODEC_OK)
      return Failed("libvpx says " + std::string(vpx_codec_error(&codec_)));
    open_ = true;
    constexpr int kSpeed = 7;
    vpx_codec_control(&codec_, VP8E_SET_CPUUSED, kSpeed);
    vpx_codec_control(&codec_, VP8E_SET_CQ_LEVEL, static_cast<unsigned>(options_.quantizer));
    vpx_codec_control(&codec_, VP9E_SET_TILE_COLUMNS, 0);
    vpx_codec_control(&codec_, VP9E_SET_ROW_MT, 0u);
    vpx_codec_control(&codec_, VP9E_SET_AQ_MODE, 0u);
    vpx_codec_control(&codec_, VP9E_SET_COLOR_SPACE, VPX_CS_BT_709);
    vpx_codec_control(&codec_, VP9E_SET_COLOR_RANGE, VPX_CR_STUDIO_RANGE);
    planes_.reset(vpx_img_alloc(nullptr, VPX_IMG_FMT_I420, config.g_w, config.g_h, 16));
    if (!planes_) return Failed("there is not enough memory");
    return Ok();
  }

  Status Add(Image image) {
    const auto bytes =
        3 * static_cast<std::size_t>(options_.size.width) * static_cast<std::size_t>(options_.size.height);
    if (image.size != options_.size || image.rgb.size() != bytes)
      return Failed("a picture has another size than the video");
    return Start([this, picture = std::move(image)] {
      FillPlanes(picture, *planes_);
      filled_ = true;
      return Encode();
    });
  }

  Status Repeat() {
    return Start([this] { return filled_ ? Encode() : Status(Failed("there is no picture to repeat")); });
  }

  std::size_t pictures() const { return count_; }

  Result<std::string> Finish() {
    if (Status done = Wait(); !done) return done.error();
    if (vpx_codec_encode(&codec_, nullptr, -1, 1, 0, VPX_DL_REALTIME) != VPX_CODEC_OK)
      return Failed("libvpx says " + std::string(vpx_codec_error(&codec_)));
    Collect();
    if (packed_.size() != count_)
      return Failed("libvpx gave " + std::to_string(packed_.size()) + " pictures for " +
                    std::to_string(count_));
    return WebmFile({.size = options_.size, .picture_ms = options_.picture_ms}, packed_);
  }

 private:
  // One picture is encoded while the caller draws the next.
  template <class Work>
  Status Start(Work work) {
    if (Status done = Wait(); !done) return done;
    ++count_;
    working_ = std::async(std::launch::async, std::move(work));
    return Ok();
  }
  Status Wait() {
    if (working_.valid()) outcome_ = working_.get();
    return outcome_;
  }

  Status Encode() {
    const vpx_enc_frame_flags_t flags =
        encoded_ % options_.key_distance == 0 ? vpx_enc_frame_flags_t{VPX_EFLAG_FORCE_KF} : 0;
    if (vpx_codec_encode(&codec_, planes_.get(), encoded_, 1, flags, VPX_DL_REALTIME) != VPX_CODEC_OK)
      return Failed("libvpx says " + std::string(vpx_codec_error(&codec_)));
    ++encoded_;
    Collect();
    return Ok();
  }

  void Collect() {
    vpx_codec_iter_t iterator = nullptr;
    while (const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&codec_, &iterator)) {
      if (packet->kind != VPX_CODEC_CX_FRAME_PKT) continue;
      const auto& frame = packet->data.frame;
      packed_.push_back({std::string(static_cast<const char*>(frame.buf), frame.sz),
                         (frame.flags & VPX_FRAME_IS_KEY) != 0});
    }
  }

  VideoOptions options_;
  vpx_codec_ctx_t codec_{};
  bool open_ = false;
  std::unique_ptr<vpx_image_t, PlanesFree> planes_;
  bool filled_ = false;
  std::int64_t encoded_ = 0;
  std::vector<PackedPicture> packed_;
  std::size_t count_ = 0;
  Status outcome_ = Ok();
  std::future<Status> working_;
};

VideoWriter::VideoWriter(std::unique_ptr<Encoder> encoder) : encoder_(std::move(encoder)) {}
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

Result<VideoWriter> VideoWriter::Create(const VideoOptions& options) {
  auto encoder = std::make_unique<Encoder>(options);
  if (Status opened = encoder->Open(); !opened) return opened.error();
  return VideoWriter(std::move(encoder));
}

Status VideoWriter::Add(Image image) {
  return encoder_->Add(std::move(image));
}
Status VideoWriter::Repeat() {
  return encoder_->Repeat();
}
std::size_t VideoWriter::pictures() const {
  return encoder_->pictures();
}
Result<std::string> VideoWriter::Finish() {
  return encoder_->Finish();
}

}  // namespace aerascope
