#include "viewer/scene/mujoco_guard.h"

#include <mujoco/mujoco.h>

#include <mutex>
#include <stdexcept>

#include "engine/base/text.h"

namespace aerascope {
namespace {

void ThrowError(const char* message) {
  throw std::runtime_error(message);
}

// Warnings speak of physics (bad velocities, full contact lists), which is not run here; by default MuJoCo
// prints them and writes a log file into the current folder.
void IgnoreWarning(const char*) {}

}  // namespace

void EnsureMujocoThrows() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (mju_user_error == nullptr) mju_user_error = ThrowError;
    if (mju_user_warning == nullptr) mju_user_warning = IgnoreWarning;
  });
}

std::string MujocoMessage(const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (c != '\n') {
      line += c;
    } else if (!line.empty() && !line.ends_with("; ")) {
      line += "; ";
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == ';')) line.pop_back();
  return Printable(line);
}

}  // namespace aerascope
