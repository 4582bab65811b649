#include "viewer/render/gl_context.h"

namespace aerascope {

Result<std::unique_ptr<GlContext>> GlContext::Create() {
  return Error{
      "frames cannot be drawn: this program was built without EGL; install the packages libegl-dev and "
      "libgl1-mesa-dri "
      "and build again"};
}

}  // namespace aerascope
