#include "engine/world/mujoco_error.h"

#include <mujoco/mujoco.h>

namespace aerascope {
namespace {

// MuJoCo gives its handlers no context, so what they collect has to be found by the thread they run in.
thread_local std::vector<std::string> warnings;

void OnError(const char* message) {
  throw MujocoError(message);
}

void OnWarning(const char* message) {
  if (warnings.size() < 100) warnings.emplace_back(message);
}

}  // namespace

void InstallMujocoErrorHandler() {
  mju_user_error = OnError;
  mju_user_warning = OnWarning;
}

std::vector<std::string> TakeMujocoWarnings() {
  std::vector<std::string> taken;
  taken.swap(warnings);
  return taken;
}

}  // namespace aerascope
