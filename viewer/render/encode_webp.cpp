#include <webp/encode.h>

#include <memory>

#include "viewer/render/encode.h"

namespace aerascope {
namespace {

struct PictureFree {
  void operator()(WebPPicture* picture) const { WebPPictureFree(picture); }
};

Error Failed(const std::string& why) {
  return {"a picture cannot be written as WebP: " + why};
}

}  // namespace

Result<std::string> EncodeWebp(const Image& image, const WebpOptions& options) {
  if (image.size.width > WEBP_MAX_DIMENSION || image.size.height > WEBP_MAX_DIMENSION) {
    return Failed("expected at most " + std::to_string(WEBP_MAX_DIMENSION) + " pixels a side, found " +
                  std::to_string(image.size.width) + " x " + std::to_string(image.size.height));
  }
  WebPConfig config;
  if (!WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, 75)) return Failed("the library is of another version");
  config.quality = options.quality;
  config.method = options.effort;
  if (!WebPValidateConfig(&config)) return Failed("the quality must be 0 to 100 and the effort 0 to 6");

  WebPPicture picture;
  if (!WebPPictureInit(&picture)) return Failed("the library is of another version");
  const std::unique_ptr<WebPPicture, PictureFree> picture_owner(&picture);
  picture.width = image.size.width;
  picture.height = image.size.height;
  std::string bytes;
  picture.custom_ptr = &bytes;
  picture.writer = [](const std::uint8_t* data, std::size_t size, const WebPPicture* of) {
    static_cast<std::string*>(of->custom_ptr)->append(reinterpret_cast<const char*>(data), size);
    return 1;
  };
  const bool encoded = WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.size.width) != 0 &&
                       WebPEncode(&config, &picture) != 0;
  if (!encoded) return Failed("error " + std::to_string(picture.error_code) + " of libwebp");
  return bytes;
}

}  // namespace aerascope
