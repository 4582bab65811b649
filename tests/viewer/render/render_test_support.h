// What the tests of viewer/render share: a renderer or the reason why there is none, and looks at single
// pixels.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>

#include "tests/viewer/scene/small_world.h"
#include "viewer/render/renderer.h"

namespace aerascope {

// A test with a renderer; skipped with the reason where the machine cannot draw.
class RenderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<Renderer>> made = Renderer::Create();
    if (!made) GTEST_SKIP() << made.error().message;
    renderer = std::move(*made);
    auto model = SceneModel::Load(SmallWorld());
    ASSERT_TRUE(model) << model.error().message;
    scene = std::make_unique<Scene>(std::move(*Scene::Create(*model)));
    camera.name = "top";
  }

  std::unique_ptr<Renderer> renderer;
  std::unique_ptr<Scene> scene;  // the small world
  Camera camera;
};

struct Colour {
  int red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

inline std::ostream& operator<<(std::ostream& out, const Colour& c) {
  return out << c.red << ' ' << c.green << ' ' << c.blue;
}

inline Colour PixelOf(const Image& image, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) +
                              static_cast<std::size_t>(x));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

// Drivers round differently.
inline bool Near(Colour a, Colour b, int tolerance = 12) {
  return std::abs(a.red - b.red) <= tolerance && std::abs(a.green - b.green) <= tolerance &&
         std::abs(a.blue - b.blue) <= tolerance;
}

}  // namespace aerascope
