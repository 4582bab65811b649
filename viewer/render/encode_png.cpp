#include <png.h>

#include <csetjmp>
#include <cstddef>

#include "viewer/render/encode.h"

namespace aerascope {
namespace {

constexpr int kCompressionLevel = 6;

struct Output {
  std::string bytes;
  std::string trouble;
};

void OnError(png_structp png, png_const_charp message) {
  static_cast<Output*>(png_get_error_ptr(png))->trouble = message;
  png_longjmp(png, 1);
}

void OnWarning(png_structp, png_const_charp) {}

void OnBytes(png_structp png, png_bytep data, png_size_t size) {
  static_cast<Output*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
}

void OnFlush(png_structp) {}

// libpng leaves by longjmp when it fails: nothing with a destructor may live here.
bool Write(png_structp png, png_infop info, const Image& image) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_compression_level(png, kCompressionLevel);
  png_set_filter(png, 0, PNG_FILTER_NONE);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.size.width),
               static_cast<png_uint_32>(image.size.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (int y = 0; y < image.size.height; ++y) {
    png_write_row(
        png, image.rgb.data() + 3 * static_cast<std::size_t>(image.size.width) * static_cast<std::size_t>(y));
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::string> EncodePng(const Image& image) {
  Output output;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, OnError, OnWarning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool written = false;
  if (info != nullptr) {
    png_set_write_fn(png, &output, OnBytes, OnFlush);
    written = Write(png, info, image);
  }
  png_destroy_write_struct(&png, &info);
  if (!written) return Error{"a picture cannot be written as PNG: " + output.trouble};
  return std::move(output.bytes);
}

}  // namespace aerascope
