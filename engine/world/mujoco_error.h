// MuJoCo reports trouble through two global function pointers; by default it waits for a key and ends the
// process. Ours throw an exception, which the code of this folder catches at its border, and collect the
// warnings.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace aerascope {

class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Call first in main, before any thread starts. LoadModel calls it too.
void InstallMujocoErrorHandler();

// The warnings of this thread since the last call, oldest first, at most 100.
std::vector<std::string> TakeMujocoWarnings();

}  // namespace aerascope
