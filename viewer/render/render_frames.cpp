#include "viewer/render/render_frames.h"

#include <map>

#include "viewer/render/frame_writer.h"

namespace aerascope {

Result<RenderedFrames> RenderFrames(Renderer& renderer, Scene& scene,
                                    std::span<const WorldStateRecorded* const> states,
                                    const FrameOptions& options) {
  RenderedFrames frames;
  FrameWriter writer(options.encoder, [&frames](std::size_t, std::string bytes) {
    frames.pictures.push_back(std::move(bytes));
    return Ok();
  });
  // Of a state, only the positions are seen; a world that stands still is drawn once.
  std::map<std::vector<double>, std::size_t> picture_of_positions;
  for (const WorldStateRecorded* state : states) {
    if (Status status = scene.Show(*state, options.camera); !status) return status.error();
    auto known = picture_of_positions.find(state->qpos);
    if (known == picture_of_positions.end()) {
      Result<Image> image = renderer.Draw(scene, options.size, options.quality);
      if (!image) return image.error();
      known = picture_of_positions.emplace(state->qpos, writer.Add(std::move(*image))).first;
    }
    frames.picture_of.push_back(known->second);
    if (options.progress) options.progress(frames.picture_of.size());
  }
  if (Status status = writer.Finish(); !status) return status.error();
  return frames;
}

}  // namespace aerascope
