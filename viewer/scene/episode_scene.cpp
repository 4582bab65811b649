#include "viewer/scene/episode_scene.h"

namespace aerascope {

Result<std::optional<SceneSource>> SceneSourceOf(const EpisodeHeader& header) {
  SceneSource source;
  bool has_model = false;
  for (const NamedFile& file : header.files) {
    if (file.name == kWorldModelFile) {
      source.model_text = file.bytes;
      has_model = true;
    } else if (file.name.starts_with(kWorldFilePrefix)) {
      source.files.push_back({file.name.substr(kWorldFilePrefix.size()), file.bytes});
    }
  }
  const auto kind = header.settings.find(std::string(kWorldKindSetting));
  const bool promised = kind != header.settings.end() && kind->second == "mujoco";
  if (!promised) return std::optional<SceneSource>();
  if (!has_model) {
    return Error{"the episode's world is one of MuJoCo, but the episode file has no " +
                 std::string(kWorldModelFile)};
  }
  for (const auto& [name, value] : header.settings) {
    if (name.starts_with(kWorldBodySetting))
      source.body_of_entity[name.substr(kWorldBodySetting.size())] = value;
  }
  return std::optional<SceneSource>(std::move(source));
}

}  // namespace aerascope
