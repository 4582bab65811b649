#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "engine/base/text.h"
#include "viewer/render/gl_context.h"

namespace aerascope {
namespace {

// From OpenGL's registry; its headers are not needed for more than this.
constexpr unsigned kGlRenderer = 0x1F01;
constexpr unsigned kGlVersion = 0x1F02;
using GetString = const unsigned char* (*)(unsigned name);

std::string EglTrouble() {
  switch (eglGetError()) {
    case EGL_SUCCESS:
      return "no reason given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED, no driver starts";
    case EGL_BAD_PARAMETER:
      return "EGL_BAD_PARAMETER, not supported";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC, out of memory";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    default:
      return "unknown error";
  }
}

bool HasExtension(EGLDisplay display, const char* name) {
  const char* list = eglQueryString(display, EGL_EXTENSIONS);
  return list != nullptr &&
         (" " + std::string(list) + " ").find(" " + std::string(name) + " ") != std::string::npos;
}

template <class Function>
Function FunctionNamed(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// What one way of getting a display led to.
struct Attempt {
  std::string platform;
  std::string trouble;
};

class EglContext : public GlContext {
 public:
  EglContext(std::string platform, EGLDisplay display) : platform_(std::move(platform)), display_(display) {}

  // The display stays: ending it would unload the driver, which forgets some of its memory then, and the next
  // context would have to load it again.
  ~EglContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
  }

  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  // What went wrong, or "".
  std::string Start() {
    if (!eglInitialize(display_, nullptr, nullptr)) return EglTrouble();
    if (!eglBindAPI(EGL_OPENGL_API)) return "desktop OpenGL is not supported, " + EglTrouble();
    const std::array<EGLint, 11> wanted{EGL_SURFACE_TYPE,
                                        EGL_PBUFFER_BIT,
                                        EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT,
                                        EGL_RED_SIZE,
                                        8,
                                        EGL_GREEN_SIZE,
                                        8,
                                        EGL_BLUE_SIZE,
                                        8,
                                        EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_, wanted.data(), &config, 1, &count)) return EglTrouble();
    if (count < 1) return "no suitable configuration";
    // Without attributes this is a compatibility profile, which MuJoCo's renderer needs.
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) return EglTrouble();
    if (!HasExtension(display_, "EGL_KHR_surfaceless_context")) {
      const std::array<EGLint, 5> size{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
      surface_ = eglCreatePbufferSurface(display_, config, size.data());
      if (surface_ == EGL_NO_SURFACE) return EglTrouble();
    }
    if (!eglMakeCurrent(display_, surface_, surface_, context_)) return EglTrouble();
    return "";
  }

  std::string Platform() const override { return platform_; }
  std::string DriverName() const override { return DriverText(kGlRenderer); }
  std::string DriverVersion() const override { return DriverText(kGlVersion); }

 private:
  static std::string DriverText(unsigned name) {
    const auto get_string = FunctionNamed<GetString>("glGetString");
    const unsigned char* text = get_string == nullptr ? nullptr : get_string(name);
    return text == nullptr ? "unknown" : Printable(reinterpret_cast<const char*>(text));
  }

  std::string platform_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
};

// Tries the displays one way after the other; the first on which a context starts is it.
class Search {
 public:
  std::unique_ptr<GlContext> Find() {
    const auto get_display = FunctionNamed<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get_display == nullptr || !HasExtension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
      attempts_.push_back({"EGL", "no driver for any platform is installed"});
      return nullptr;
    }
    if (auto context =
            Try("surfaceless", get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr))) {
      return context;
    }
    for (EGLDeviceEXT device : Devices()) {
      if (auto context = Try("device", get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr))) return context;
    }
    return nullptr;
  }

  std::string Troubles() const {
    std::vector<std::string> parts;
    for (const Attempt& attempt : attempts_) parts.push_back(attempt.platform + ": " + attempt.trouble);
    return Join(parts, "; ");
  }

 private:
  std::unique_ptr<GlContext> Try(const std::string& platform, EGLDisplay display) {
    if (display == EGL_NO_DISPLAY) {
      attempts_.push_back({platform, EglTrouble()});
      return nullptr;
    }
    auto context = std::make_unique<EglContext>(platform, display);
    const std::string trouble = context->Start();
    if (trouble.empty()) return context;
    attempts_.push_back({platform, trouble});
    return nullptr;
  }

  std::vector<EGLDeviceEXT> Devices() {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    const auto query = FunctionNamed<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    if (query == nullptr || !query(static_cast<EGLint>(devices.size()), devices.data(), &count) ||
        count < 1) {
      attempts_.push_back({"device", "none found"});
      return {};
    }
    return {devices.begin(), devices.begin() + count};
  }

  std::vector<Attempt> attempts_;
};

}  // namespace

Result<std::unique_ptr<GlContext>> GlContext::Create() {
  // What goes wrong comes back as a sentence; the libraries' own messages on standard error would only repeat
  // it. A cache of shaders in the user's home is not worth the files.
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  Search search;
  if (std::unique_ptr<GlContext> context = search.Find()) return context;
  return Error{"frames cannot be drawn: EGL gives no OpenGL (" + search.Troubles() +
               "); install the packages libegl1, libegl-mesa0 and libgl1-mesa-dri"};
}

}  // namespace aerascope
