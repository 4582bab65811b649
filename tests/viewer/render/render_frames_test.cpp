#include "viewer/render/render_frames.h"

#include <gmock/gmock.h>

#include "tests/viewer/render/render_test_support.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(RenderTest, FramesComeInOrderAndEqualOnesOnce) {
  const std::vector<WorldStateRecorded> states{SmallWorldState(0), SmallWorldState(0.1), SmallWorldState(0.1),
                                               SmallWorldState(0)};
  std::vector<const WorldStateRecorded*> film;
  for (const WorldStateRecorded& state : states) film.push_back(&state);
  std::vector<std::size_t> progress;
  FrameOptions options;
  options.camera = camera;
  options.size = {160, 90};
  options.progress = [&](std::size_t done) { progress.push_back(done); };
  const Result<RenderedFrames> frames = RenderFrames(*renderer, *scene, film, options);
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_THAT(frames->picture_of, ElementsAre(0, 1, 1, 0));
  EXPECT_THAT(progress, ElementsAre(1, 2, 3, 4));
  ASSERT_EQ(frames->pictures.size(), 2u);

  // Each is what drawing and encoding one by one gives.
  for (std::size_t i = 0; i < states.size(); ++i) {
    ASSERT_TRUE(scene->Show(states[i], camera));
    const Result<Image> image = renderer->Draw(*scene, options.size);
    EXPECT_EQ(frames->pictures[frames->picture_of[i]], *EncodePng(*image)) << i;
  }
}

TEST_F(RenderTest, WhatIsNotSeenMakesNoNewPicture) {
  WorldStateRecorded hidden = SmallWorldState(50);
  WorldStateRecorded hidden_further = SmallWorldState(60);
  FrameOptions options;
  options.camera = camera;
  options.size = {160, 90};
  const std::vector<const WorldStateRecorded*> film{&hidden, &hidden_further};
  const Result<RenderedFrames> frames = RenderFrames(*renderer, *scene, film, options);
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_THAT(frames->picture_of, ElementsAre(0, 0));
  EXPECT_EQ(frames->pictures.size(), 1u);
}

TEST_F(RenderTest, ABadStateAmongTheFramesIsAnError) {
  const WorldStateRecorded good = SmallWorldState();
  WorldStateRecorded bad = SmallWorldState();
  bad.qpos.clear();
  const std::vector<const WorldStateRecorded*> film{&good, &bad};
  FrameOptions options;
  options.camera = camera;
  options.size = {16, 9};
  const Result<RenderedFrames> frames = RenderFrames(*renderer, *scene, film, options);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, HasSubstr("expected 16 positions (qpos), found 0"));
}

}  // namespace
}  // namespace aerascope
