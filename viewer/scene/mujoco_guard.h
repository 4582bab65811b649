// Calls into MuJoCo made safe: where MuJoCo would wait for a key and end the process, the caller gets an
// Error.
//
// MuJoCo reports trouble through a global function pointer. One that is set already is left alone as long as
// it throws something derived from std::exception; otherwise the first guarded call sets one. Used by
// viewer/scene and viewer/render only.
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "engine/base/result.h"

namespace aerascope {

void EnsureMujocoThrows();

// MuJoCo's message on one line, printable.
std::string MujocoMessage(const std::string& message);

// Runs `call`, which returns a Result or a Status; what MuJoCo throws meanwhile becomes "<what>: <its
// message>".
template <class Call>
auto GuardMujoco(const std::string& what, Call&& call) -> decltype(call()) {
  EnsureMujocoThrows();
  try {
    return std::forward<Call>(call)();
  } catch (const std::exception& trouble) {
    return Error{what + ": " + MujocoMessage(trouble.what())};
  }
}

}  // namespace aerascope
