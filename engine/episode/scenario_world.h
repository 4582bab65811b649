// The [world] table of a scenario, read into the world's own configuration.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "engine/episode/config.h"
#include "engine/replicode/seed.h"
#include "engine/world/mujoco_world_config.h"
#include "engine/world/scripted_world.h"

namespace aerascope {

// A fact that is a property: (mk.val entity attribute value) of symbols, sure and for ever.
bool IsLastingProperty(const Fact& fact);

// Where the model's file is looked for: in a folder, or among texts that an episode file kept.
struct ModelSource {
  std::string folder;
  const std::map<std::string, std::string>* kept = nullptr;
};

ScriptedWorldConfig ReadScriptedWorld(ConfigTable world, const SeedKnowledge& seed, ConfigErrors* errors);
MujocoWorldConfig ReadMujocoWorld(ConfigTable world, const SeedKnowledge& seed, const ModelSource& source,
                                  ConfigErrors* errors);

}  // namespace aerascope
