// Many frames of an episode at once: each recorded state drawn and encoded, what repeats only once.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "viewer/render/encode.h"
#include "viewer/render/renderer.h"

namespace aerascope {

struct FrameOptions {
  Camera camera;
  PictureSize size;
  RenderQuality quality;
  Encoder encoder = EncodePng;
  // Called after each frame with the number of frames done, if given.
  std::function<void(std::size_t frames_done)> progress;
};

struct RenderedFrames {
  std::vector<std::string> pictures;    // the different ones as files, in order of their first frame
  std::vector<std::size_t> picture_of;  // for each state, the position of its picture in `pictures`
};

// Draws the states in order while a second thread encodes. The same input gives the same bytes.
Result<RenderedFrames> RenderFrames(Renderer& renderer, Scene& scene,
                                    std::span<const WorldStateRecorded* const> states,
                                    const FrameOptions& options);

}  // namespace aerascope
