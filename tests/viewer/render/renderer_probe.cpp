// Says on one line whether frames can be drawn here; a program of its own because it is run with other
// environments.
#include <iostream>

#include "viewer/render/renderer.h"

int main() {
  const auto renderer = aerascope::Renderer::Create();
  std::cout << (renderer ? "works" : renderer.error().message) << std::endl;
}
