// What an episode file holds of its scene: the MJCF, the meshes, and which body each entity is (scene_model.h
// has the names under which the file keeps them).
#pragma once

#include <optional>

#include "engine/store/episode_header.h"
#include "viewer/scene/scene_model.h"

namespace aerascope {

// Nothing when the episode's world has no scene to draw (the scripted world). Fails when a scene was promised
// and its model is missing.
Result<std::optional<SceneSource>> SceneSourceOf(const EpisodeHeader& header);

}  // namespace aerascope
