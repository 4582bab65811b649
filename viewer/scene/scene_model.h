// A SceneModel is the MuJoCo model of an episode's world, compiled again from what the episode file carries:
// what there is to see, from which cameras, and which of the model's bodies the episode's entities are.
//
// Immutable after loading; several threads may look at one. Loading is for one thread at a time (MuJoCo's
// compiler keeps state of its own). Nothing is read from disk: a model that names a file which is not given
// is refused.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

struct mjModel_;  // MuJoCo's model

namespace aerascope {

// A file of the scene, in memory. The name has no folder.
struct SceneFile {
  std::string name;
  std::string bytes;
};

// Everything a scene is made from.
struct SceneSource {
  std::string model_text;        // MJCF
  std::vector<SceneFile> files;  // the meshes, textures and included files it names
  std::map<std::string, std::string> body_of_entity;
};

// An entity and the body that it is. Everything attached to the body belongs to it (a hand has its fingers),
// up to bodies that are entities themselves.
struct SceneEntity {
  std::string entity;
  std::string body;
};

class SceneModel {
 public:
  // Shared, because the scenes of a model and the renderer that has its meshes uploaded outlive each other in
  // any order.
  static Result<std::shared_ptr<const SceneModel>> Load(const SceneSource& source);
  ~SceneModel();
  SceneModel(const SceneModel&) = delete;
  SceneModel& operator=(const SceneModel&) = delete;

  // The named cameras in the model's order; the first one is the default view.
  const std::vector<std::string>& cameras() const { return cameras_; }
  // Sorted by name.
  const std::vector<SceneEntity>& entities() const { return entities_; }

  // The position in entities() of the entity a geom of the model belongs to; -1 for scenery.
  int EntityOfGeom(int geom) const;
  // The position in entities() of an entity; -1 if there is none of that name.
  int FindEntity(std::string_view entity) const;
  // The geom's name, or "geom 3 of hand" where it has none.
  std::string GeomName(int geom) const;

  const mjModel_& mujoco() const { return *model_; }

 private:
  SceneModel(mjModel_* model, const SceneSource& source);

  mjModel_* model_;  // owned
  std::vector<std::string> cameras_;
  std::vector<SceneEntity> entities_;
  std::vector<int> entity_of_geom_;
};

// Names of the header settings of an episode file that speak of the scene.
inline constexpr std::string_view kWorldKindSetting =
    "world.kind";  // "mujoco": there is a scene; else there is none
inline constexpr std::string_view kWorldBodySetting =
    "world.body.";  // + entity = name of its body in the model
inline constexpr std::string_view kWorldFilePrefix =
    "world/";  // of the embedded files the scene is made from
inline constexpr std::string_view kWorldModelFile = "world/scene.xml";  // the MJCF among them

}  // namespace aerascope
