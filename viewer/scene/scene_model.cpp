#include "viewer/scene/scene_model.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "engine/base/text.h"
#include "viewer/scene/mujoco_guard.h"

namespace aerascope {
namespace {

constexpr const char* kModelName = "aerascope_scene.xml";

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};

// MuJoCo's files in memory: 2 MB of fixed tables, always on the heap.
class VirtualFiles {
 public:
  VirtualFiles() : files_(std::make_unique<mjVFS>()) { mj_defaultVFS(files_.get()); }
  ~VirtualFiles() { mj_deleteVFS(files_.get()); }
  VirtualFiles(const VirtualFiles&) = delete;
  VirtualFiles& operator=(const VirtualFiles&) = delete;

  Status Add(const std::string& name, const std::string& bytes) {
    const auto refused = [&name](const char* why) {
      return Error{"the scene's file " + Printable(name) + " cannot be used: " + why};
    };
    if (name.size() >= mjMAXVFSNAME) return refused("its name is too long");
    if (bytes.empty()) return refused("it is empty");
    if (bytes.size() > 0x7fffffff) return refused("it is larger than 2 GiB");
    const int answer = mj_makeEmptyFileVFS(files_.get(), name.c_str(), static_cast<int>(bytes.size()));
    if (answer == 1) return refused("there are too many files");
    if (answer != 0) return refused("its name is used twice");
    std::memcpy(files_->filedata[mj_findFileVFS(files_.get(), name.c_str())], bytes.data(), bytes.size());
    return Ok();
  }

  bool Contains(const std::string& name) const { return mj_findFileVFS(files_.get(), name.c_str()) >= 0; }
  const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

std::string WithoutFolder(const std::string& path) {
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

// The attribute name that ends in front of the "=" at `equals`.
std::string NameBefore(const std::string& text, std::size_t equals) {
  std::size_t end = equals;
  while (end > 0 && std::strchr(" \t\r\n", text[end - 1]) != nullptr) --end;
  std::size_t begin = end;
  while (begin > 0 && std::strchr(" \t\r\n<\"'", text[begin - 1]) == nullptr) --begin;
  return text.substr(begin, end - begin);
}

// Calls visit(name, value) for the attributes of an XML text; text that is not XML gives whatever looks like
// some.
template <class Visit>
void ForEachAttribute(const std::string& text, Visit&& visit) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = text.find("-->", at);
      if (at == std::string::npos) return;
    } else if (text[at] == '=') {
      const std::size_t open = text.find_first_not_of(" \t\r\n", at + 1);
      if (open == std::string::npos || (text[open] != '"' && text[open] != '\'')) continue;
      const std::size_t close = text.find(text[open], open + 1);
      if (close == std::string::npos) return;
      visit(NameBefore(text, at), text.substr(open + 1, close - open - 1));
      at = close;
    }
  }
}

// A file that the text names and that is not given. MuJoCo would look for it on this machine's disk, where by
// chance a file of that name may lie.
std::optional<std::string> MissingFile(const std::string& text, const VirtualFiles& files) {
  std::optional<std::string> missing;
  ForEachAttribute(text, [&](const std::string& name, const std::string& value) {
    if (name.starts_with("file") && !missing && !files.Contains(WithoutFolder(value))) missing = value;
  });
  return missing;
}

Status CheckFiles(const SceneSource& source, const VirtualFiles& files) {
  std::optional<std::string> missing = MissingFile(source.model_text, files);
  for (const SceneFile& file : source.files) {
    if (!missing && file.name.ends_with(".xml")) missing = MissingFile(file.bytes, files);
  }
  if (!missing) return Ok();
  return Error{"the scene's model names the file " + Printable(*missing) +
               ", which is not among the files given with it"};
}

Result<std::unique_ptr<mjModel, ModelDeleter>> Compile(const SceneSource& source) {
  VirtualFiles files;
  for (const SceneFile& file : source.files) {
    if (Status status = files.Add(WithoutFolder(file.name), file.bytes); !status) return status.error();
  }
  if (Status status = CheckFiles(source, files); !status) return status.error();
  if (Status status = files.Add(kModelName, source.model_text); !status) return status.error();
  char message[1000] = "";
  std::unique_ptr<mjModel, ModelDeleter> model(mj_loadXML(kModelName, files.get(), message, sizeof(message)));
  if (!model) return Error{"MuJoCo cannot load the scene's model: " + MujocoMessage(message)};
  return model;
}

std::vector<std::string> NamesOf(const mjModel& model, int type, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    const char* name = mj_id2name(&model, type, i);
    if (name != nullptr && *name != '\0') names.emplace_back(name);
  }
  return names;
}

Status CheckBodies(const mjModel& model, const SceneSource& source) {
  for (const auto& [entity, body] : source.body_of_entity) {
    if (mj_name2id(&model, mjOBJ_BODY, body.c_str()) >= 0) continue;
    const std::string close = ClosestWord(body, NamesOf(model, mjOBJ_BODY, model.nbody));
    return Error{"the entity " + Printable(entity) + " is said to be the body " + Printable(body) +
                 ", which the scene's model does not have" +
                 (close.empty() ? "" : "; did you mean " + Printable(close) + "?")};
  }
  return Ok();
}

}  // namespace

Result<std::shared_ptr<const SceneModel>> SceneModel::Load(const SceneSource& source) {
  const auto load = [&source]() -> Result<std::shared_ptr<const SceneModel>> {
    auto model = Compile(source);
    if (!model) return model.error();
    if (Status status = CheckBodies(**model, source); !status) return status.error();
    return std::shared_ptr<const SceneModel>(new SceneModel(model->release(), source));
  };
  return GuardMujoco("MuJoCo cannot load the scene's model", load);
}

SceneModel::SceneModel(mjModel_* model, const SceneSource& source)
    : model_(model), cameras_(NamesOf(*model, mjOBJ_CAMERA, model->ncam)) {
  std::vector<int> entity_of_body(static_cast<std::size_t>(model->nbody), -1);
  for (const auto& [entity, body] : source.body_of_entity) {
    const int id = mj_name2id(model, mjOBJ_BODY, body.c_str());
    entity_of_body[static_cast<std::size_t>(id)] = static_cast<int>(entities_.size());
    entities_.push_back({entity, body});
  }
  // Parents come before their children in MuJoCo's numbering.
  for (int body = 1; body < model->nbody; ++body) {
    int& owner = entity_of_body[static_cast<std::size_t>(body)];
    if (owner < 0) owner = entity_of_body[static_cast<std::size_t>(model->body_parentid[body])];
  }
  for (int geom = 0; geom < model->ngeom; ++geom) {
    entity_of_geom_.push_back(entity_of_body[static_cast<std::size_t>(model->geom_bodyid[geom])]);
  }
}

SceneModel::~SceneModel() {
  mj_deleteModel(model_);
}

int SceneModel::EntityOfGeom(int geom) const {
  if (geom < 0 || geom >= static_cast<int>(entity_of_geom_.size())) return -1;
  return entity_of_geom_[static_cast<std::size_t>(geom)];
}

int SceneModel::FindEntity(std::string_view entity) const {
  for (std::size_t i = 0; i < entities_.size(); ++i)
    if (entities_[i].entity == entity) return static_cast<int>(i);
  return -1;
}

std::string SceneModel::GeomName(int geom) const {
  const char* name = mj_id2name(model_, mjOBJ_GEOM, geom);
  if (name != nullptr && *name != '\0') return name;
  const int body = model_->geom_bodyid[geom];
  const char* body_name = mj_id2name(model_, mjOBJ_BODY, body);
  return "geom " + std::to_string(geom - model_->body_geomadr[body]) + " of " +
         (body_name == nullptr ? "" : body_name);
}

}  // namespace aerascope
