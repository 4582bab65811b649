// An OpenGL context without a window, current in the thread that made it. Private to viewer/render.
#pragma once

#include <memory>
#include <string>

#include "engine/base/result.h"

namespace aerascope {

class GlContext {
 public:
  // Fails with a sentence that says what was tried and what to install.
  static Result<std::unique_ptr<GlContext>> Create();
  virtual ~GlContext() = default;

  // How it was made: "surfaceless" or "device".
  virtual std::string Platform() const = 0;
  // OpenGL's own words, from the driver.
  virtual std::string DriverName() const = 0;
  virtual std::string DriverVersion() const = 0;
};

}  // namespace aerascope
