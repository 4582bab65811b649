// Snapshots in files: comparing, and accepting with a file beside that then takes the place of the old one.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "exporters/snapshot/snapshot.h"

namespace aerascope {
namespace {

// Of a file, to see whether it begins as a snapshot does.
constexpr std::size_t kEnoughToTell = 200;

}  // namespace

Result<SnapshotComparison> TestSnapshot(const std::string& path, const KnowledgeBase& knowledge) {
  std::error_code trouble;
  if (!std::filesystem::exists(path, trouble)) {
    return Error{"expected a snapshot in " + path + ", found none; make it with `aerascope snapshot accept`"};
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream stored;
  if (!file || !(stored << file.rdbuf())) {
    return Error{"expected a snapshot in " + path + ", but it cannot be read; is it a file, and readable?"};
  }
  const Result<bool> evidence = SnapshotHasEvidence(stored.str(), path);
  if (!evidence) return evidence.error();
  return CompareSnapshots(stored.str(), SnapshotText(knowledge, {*evidence}), path);
}

Status AcceptSnapshot(const std::string& path, const KnowledgeBase& knowledge,
                      const SnapshotOptions& options) {
  const std::filesystem::path target(path);
  const std::filesystem::path beside = path + ".new";
  std::error_code trouble;
  if (std::filesystem::is_regular_file(target, trouble)) {
    std::ifstream file(target, std::ios::binary);
    std::string beginning(kEnoughToTell, '\0');
    file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    beginning.resize(static_cast<std::size_t>(file.gcount()));
    if (!beginning.empty() && !IsSnapshot(beginning)) {
      return Error{
          "cannot write " + path +
          ": expected no file or an earlier snapshot there, found another kind of file; name another one, or "
          "remove it first"};
    }
  }
  if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), trouble);
  {
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    if (file) file << SnapshotText(knowledge, options) << std::flush;
    if (!file) {
      std::filesystem::remove(beside, trouble);
      return Error{"the snapshot " + path +
                   " cannot be written; does its folder exist, is it writable, and is there space?"};
    }
  }
  std::filesystem::rename(beside, target, trouble);
  if (!trouble) return Ok();
  const std::string reason = trouble.message();
  std::filesystem::remove(beside, trouble);
  return Error{"the snapshot " + path + " cannot be put in place: " + reason};
}

}  // namespace aerascope
