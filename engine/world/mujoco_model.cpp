#include "engine/world/mujoco_model.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "engine/base/text.h"
#include "engine/world/mesh_import.h"
#include "engine/world/mujoco_error.h"

namespace aerascope {
namespace {

using FileReader = std::function<Result<std::string>(const std::string& path)>;

Result<std::string> ReadFile(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) return Error{path + ": expected a file, found a folder"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{path + ": the file cannot be read: " + std::strerror(errno)};
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return std::move(bytes).str();
}

// --- a lexical look at XML: start tags and where their attribute values stand
// ---------------------------------------

struct XmlAttribute {
  std::string name;
  std::string value;
  std::size_t begin = 0;  // of the value, without quotes
  char quote = '"';
};

struct XmlTag {
  std::string name;
  std::vector<XmlAttribute> attributes;

  const XmlAttribute* Find(std::string_view wanted) const {
    for (const XmlAttribute& attribute : attributes) {
      if (attribute.name == wanted) return &attribute;
    }
    return nullptr;
  }
};

bool IsSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::size_t SkipSpace(const std::string& text, std::size_t at) {
  while (at < text.size() && IsSpace(text[at])) ++at;
  return at;
}

std::size_t EndOfName(const std::string& text, std::size_t at) {
  while (at < text.size() && !IsSpace(text[at]) && std::strchr("=/><\"'", text[at]) == nullptr) ++at;
  return at;
}

// Reads the start tag at `at` (behind its "<"); nothing if it is malformed.
std::optional<XmlTag> ReadTag(const std::string& text, std::size_t at) {
  XmlTag tag;
  std::size_t end = EndOfName(text, at);
  tag.name = text.substr(at, end - at);
  while (true) {
    at = SkipSpace(text, end);
    if (at >= text.size()) return std::nullopt;
    if (text[at] == '/' || text[at] == '>') return tag;
    end = EndOfName(text, at);
    XmlAttribute attribute{text.substr(at, end - at), "", 0, '"'};
    at = SkipSpace(text, end);
    if (attribute.name.empty() || at >= text.size() || text[at] != '=') return std::nullopt;
    at = SkipSpace(text, at + 1);
    if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) return std::nullopt;
    end = text.find(text[at], at + 1);
    if (end == std::string::npos) return std::nullopt;
    attribute.begin = at + 1;
    attribute.quote = text[at];
    attribute.value = text.substr(at + 1, end - at - 1);
    tag.attributes.push_back(std::move(attribute));
    ++end;
  }
}

// All start tags up to the first malformed place; what is wrong there, MuJoCo's own parser says better.
std::vector<XmlTag> StartTags(const std::string& text) {
  std::vector<XmlTag> tags;
  std::size_t at = 0;
  const auto skip_past = [&](std::string_view closing) {
    const std::size_t end = text.find(closing, at);
    at = end == std::string::npos ? text.size() : end + closing.size();
  };
  while ((at = text.find('<', at)) != std::string::npos) {
    if (text.compare(at, 4, "<!--") == 0) {
      skip_past("-->");
    } else if (text.compare(at, 9, "<![CDATA[") == 0) {
      skip_past("]]>");
    } else if (text.compare(at, 2, "<?") == 0 || text.compare(at, 2, "<!") == 0 ||
               text.compare(at, 2, "</") == 0) {
      skip_past(">");
    } else {
      std::optional<XmlTag> tag = ReadTag(text, at + 1);
      if (!tag) return tags;
      tags.push_back(std::move(*tag));
      ++at;
    }
  }
  return tags;
}

// --- packing
// --------------------------------------------------------------------------------------------------------

constexpr const char* kTextureFiles[] = {"file",     "fileright", "fileleft", "fileup",
                                         "filedown", "filefront", "fileback"};

class Packer {
 public:
  Packer(FileReader read, std::string folder) : read_(std::move(read)), folder_(std::move(folder)) {}

  Result<PackedModel> Pack(const std::string& name, const std::string& text) {
    FindFolders(text);
    Result<std::string> packed = PackText(name, text);
    if (!packed) return packed.error();
    PackedModel model{name, std::move(*packed), {}};
    for (auto& [asset, bytes] : assets_) model.assets.push_back({asset, std::move(bytes)});
    return model;
  }

 private:
  struct Edit {
    std::size_t begin;
    std::size_t length;
    std::string replacement;
  };

  // The compiler's meshdir and texturedir hold for the whole model, wherever they stand.
  void FindFolders(const std::string& text) {
    for (const XmlTag& tag : StartTags(text)) {
      if (tag.name != "compiler") continue;
      if (const XmlAttribute* folder = tag.Find("meshdir")) mesh_folder_ = folder->value;
      if (const XmlAttribute* folder = tag.Find("texturedir")) texture_folder_ = folder->value;
    }
  }

  Result<std::string> PackText(const std::string& name, const std::string& text) {
    std::vector<Edit> edits;
    for (const XmlTag& tag : StartTags(text)) {
      if (Status status = PackTag(name, tag, edits); !status) return status.error();
    }
    std::string packed = text;
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
      packed.replace(edit->begin, edit->length, edit->replacement);
    }
    return packed;
  }

  Status PackTag(const std::string& from, const XmlTag& tag, std::vector<Edit>& edits) {
    std::vector<Edit> found;
    for (const XmlAttribute& attribute : tag.attributes) {
      Result<std::string> packed = PackAttribute(from, tag, attribute);
      if (!packed) return packed.error();
      if (*packed == attribute.value) continue;
      std::string replacement = *packed;
      // Without a name, MuJoCo calls a mesh after its file; keep that name when the file's changes.
      const bool names_mesh = tag.name == "mesh" && attribute.name == "file" && !tag.Find("name");
      if (names_mesh) {
        const std::string quote(1, attribute.quote);
        replacement += quote + " name=" + quote + std::filesystem::path(attribute.value).stem().string();
      }
      found.push_back({attribute.begin, attribute.value.size(), replacement});
    }
    edits.insert(edits.end(), found.begin(), found.end());
    return Ok();
  }

  Result<std::string> PackAttribute(const std::string& from, const XmlTag& tag,
                                    const XmlAttribute& attribute) {
    const std::string& value = attribute.value;
    if (tag.name == "compiler" && (attribute.name == "meshdir" || attribute.name == "texturedir"))
      return std::string();
    if (tag.name == "include" && attribute.name == "file") return PackInclude(from, value);
    if (tag.name == "mesh" && attribute.name == "file") return PackMesh(from, value);
    const bool texture = tag.name == "texture" &&
                         std::find(std::begin(kTextureFiles), std::end(kTextureFiles), attribute.name) !=
                             std::end(kTextureFiles);
    if (texture) return PackFile(from, texture_folder_, value);
    if ((tag.name == "hfield" || tag.name == "skin") && attribute.name == "file") {
      return PackFile(from, mesh_folder_, value);
    }
    return value;
  }

  Result<std::string> Read(const std::string& from, const std::string& folder, const std::string& file) {
    Result<std::string> bytes = read_((std::filesystem::path(folder_) / folder / file).string());
    if (!bytes) return Error{from + " names a file that is missing: " + bytes.error().message};
    return bytes;
  }

  Result<std::string> PackInclude(const std::string& from, const std::string& file) {
    Result<std::string> text = Read(from, "", file);
    if (!text) return text.error();
    const std::string asset = AssetName("include " + file, std::filesystem::path(file).filename().string());
    if (!assets_.emplace(asset, "").second) return asset;  // already packed, or including itself
    FindFolders(*text);
    Result<std::string> packed = PackText(file, *text);
    if (!packed) return packed.error();
    assets_[asset] = std::move(*packed);
    return asset;
  }

  Result<std::string> PackMesh(const std::string& from, const std::string& file) {
    const std::filesystem::path path(file);
    const bool native = path.extension() == ".msh" || path.extension() == ".MSH";
    const std::string asset = AssetName("mesh " + file, path.stem().string() + ".msh");
    if (assets_.contains(asset)) return asset;
    Result<std::string> bytes = Read(from, mesh_folder_, file);
    if (!bytes) return bytes.error();
    Result<std::string> mesh = native ? bytes : ConvertMesh(*bytes, file);
    if (!mesh) return mesh.error();
    assets_[asset] = std::move(*mesh);
    return asset;
  }

  Result<std::string> PackFile(const std::string& from, const std::string& folder, const std::string& file) {
    const std::string asset = AssetName("file " + file, std::filesystem::path(file).filename().string());
    if (assets_.contains(asset)) return asset;
    Result<std::string> bytes = Read(from, folder, file);
    if (!bytes) return bytes.error();
    assets_[asset] = std::move(*bytes);
    return asset;
  }

  // One name for each file; files of equal name from different folders are numbered.
  std::string AssetName(const std::string& key, const std::string& wanted) {
    if (const auto known = names_.find(key); known != names_.end()) return known->second;
    const std::filesystem::path path(wanted);
    std::string name = wanted;
    for (int number = 2; !taken_.insert(name).second; ++number) {
      name = path.stem().string() + "_" + std::to_string(number) + path.extension().string();
    }
    names_[key] = name;
    return name;
  }

  FileReader read_;
  std::string folder_;
  std::string mesh_folder_;
  std::string texture_folder_;
  std::map<std::string, std::string> assets_;
  std::map<std::string, std::string> names_;
  std::set<std::string> taken_;
};

// --- loading
// --------------------------------------------------------------------------------------------------------

// 2 MB of fixed tables: always on the heap.
class VirtualFiles {
 public:
  VirtualFiles() : files_(std::make_unique<mjVFS>()) { mj_defaultVFS(files_.get()); }
  ~VirtualFiles() { mj_deleteVFS(files_.get()); }
  VirtualFiles(const VirtualFiles&) = delete;
  VirtualFiles& operator=(const VirtualFiles&) = delete;

  Status Add(const std::string& name, const std::string& bytes) {
    if (bytes.size() > 0x7fffffff) return Error{name + ": expected a file below 2 GiB"};
    const int answer =
        bytes.empty() ? 2 : mj_makeEmptyFileVFS(files_.get(), name.c_str(), static_cast<int>(bytes.size()));
    if (answer != 0) {
      return Error{name + ": the file cannot be given to MuJoCo: " +
                   (bytes.empty() ? "it is empty"
                    : answer == 1 ? "there are too many files"
                                  : "its name is used twice")};
    }
    std::memcpy(files_->filedata[mj_findFileVFS(files_.get(), name.c_str())], bytes.data(), bytes.size());
    return Ok();
  }

  const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

constexpr const char* kModelFile = "aerascope_model.xml";

// MuJoCo's message on one line, e.g. "XML Error: unrecognized attribute: 'sise'; Element 'geom', line 5,
// column 4".
std::string OneLine(const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (c != '\n') {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += "; ";
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == ';')) line.pop_back();
  return Printable(line);
}

}  // namespace

Result<PackedModel> PackModelFile(const std::string& path) {
  Result<std::string> text = ReadFile(path);
  if (!text) return text.error();
  return Packer(ReadFile, std::filesystem::path(path).parent_path().string()).Pack(path, *text);
}

Result<PackedModel> PackModelText(const std::string& text, std::span<const WorldAsset> files) {
  const FileReader read = [files](const std::string& path) -> Result<std::string> {
    const std::string name = std::filesystem::path(path).filename().string();
    for (const WorldAsset& file : files) {
      if (file.name == name || file.name == path) return file.bytes;
    }
    return Error{path + " is not among the model's files"};
  };
  return Packer(read, "").Pack("the model text", text);
}

Result<ModelPointer> LoadModel(const PackedModel& packed) {
  InstallMujocoErrorHandler();
  try {
    VirtualFiles files;
    if (Status status = files.Add(kModelFile, packed.text); !status) return status.error();
    for (const WorldAsset& asset : packed.assets) {
      if (Status status = files.Add(asset.name, asset.bytes); !status) return status.error();
    }
    char message[1000] = "";
    ModelPointer model(mj_loadXML(kModelFile, files.get(), message, sizeof(message)));
    if (!model) return Error{packed.name + ": MuJoCo cannot load the model: " + OneLine(message)};
    return model;
  } catch (const std::exception& trouble) {
    return Error{packed.name + ": MuJoCo cannot load the model: " + OneLine(trouble.what())};
  }
}

}  // namespace aerascope
