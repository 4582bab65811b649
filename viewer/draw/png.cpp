#include "viewer/draw/png.h"

#include <cairo.h>
#include <librsvg/rsvg.h>

#include <cmath>
#include <memory>

#include "engine/base/text.h"

namespace aerascope {
namespace {

constexpr double kMaxSide = 32767;  // cairo's own limit

struct Unref {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(GInputStream* stream) const { g_object_unref(stream); }
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref>;

std::string Words(GError* error) {
  const Owned<GError> owned(error);
  return owned ? Printable(owned->message) : "no reason was given";
}

cairo_status_t AppendBytes(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

Result<Owned<RsvgHandle>> Read(std::string_view svg) {
  const Owned<GInputStream> stream(
      g_memory_input_stream_new_from_data(svg.data(), static_cast<gssize>(svg.size()), nullptr));
  GError* error = nullptr;
  // Pictures inside are long attributes; without a base file librsvg opens no other file.
  Owned<RsvgHandle> handle(
      rsvg_handle_new_from_stream_sync(stream.get(), nullptr, RSVG_HANDLE_FLAG_UNLIMITED, nullptr, &error));
  if (!handle) return Error{"the drawing is not an SVG that librsvg can read: " + Words(error)};
  return handle;
}

}  // namespace

Result<std::string> SvgToPng(std::string_view svg, double scale) {
  auto handle = Read(svg);
  if (!handle) return handle.error();
  double width = 0;
  double height = 0;
  if (!rsvg_handle_get_intrinsic_size_in_pixels(handle->get(), &width, &height)) {
    return Error{"the drawing does not say how large it is; expected a width and a height in pixels"};
  }
  width = std::ceil(width * scale);
  height = std::ceil(height * scale);
  if (!(width >= 1 && height >= 1 && width <= kMaxSide && height <= kMaxSide &&
        width * height <= kMaxPngPixels)) {
    return Error{"a picture of " + FormatNumber(width) + " x " + FormatNumber(height) +
                 " pixels cannot be made; expected 1 to 32767 a side and at most " +
                 std::to_string(kMaxPngPixels) + " in all: choose a smaller scale"};
  }
  const Owned<cairo_surface_t> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)));
  const Owned<cairo_t> context(cairo_create(surface.get()));
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  const RsvgRectangle page{0, 0, width, height};
  GError* error = nullptr;
  if (!rsvg_handle_render_document(handle->get(), context.get(), &page, &error)) {
    return Error{"librsvg could not draw the SVG: " + Words(error)};
  }
  std::string png;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), AppendBytes, &png);
  if (status != CAIRO_STATUS_SUCCESS) {
    return Error{std::string("cairo could not write the PNG: ") + cairo_status_to_string(status)};
  }
  return png;
}

}  // namespace aerascope
