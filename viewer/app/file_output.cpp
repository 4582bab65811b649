#include "viewer/app/file_output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/store/episode_header.h"

namespace aerascope {
namespace {

Error Trouble(const std::string& what, const std::string& path, int number) {
  return {what + " " + path + ": " + std::strerror(number)};
}

Status WriteAll(int file, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EPIPE)
      return Ok();  // A reader that has seen enough, such as `head`, is no trouble.
    if (written < 0) return Trouble("cannot write", path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return Ok();
}

// Episodes are written by `run` alone; a report or picture named like one is a slip that would cost the
// episode.
bool IsEpisode(const std::string& path) {
  constexpr std::size_t kApplicationIdAt = 68;  // in the header of every SQLite file
  std::array<char, kApplicationIdAt + 4> header{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(header.data(), header.size())) return false;
  std::int32_t id = 0;
  for (std::size_t i = kApplicationIdAt; i < header.size(); ++i)
    id = id << 8 | static_cast<unsigned char>(header[i]);
  constexpr std::string_view kSqlite("SQLite format 3\0", 16);  // with its NUL
  return std::string_view(header.data(), kSqlite.size()) == kSqlite && id == kEpisodeApplicationId;
}

bool IsPlainOrNew(const std::string& path) {
  struct stat info {};
  return stat(path.c_str(), &info) != 0 || S_ISREG(info.st_mode);
}

}  // namespace

Status CheckWritable(const std::string& path) {
  if (path == "-") return Ok();
  if (path.empty()) return Error{"expected the name of a file to write, found an empty one"};
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return Error{"cannot write " + path + ": it is a folder; name a file in it"};
  }
  if (!IsPlainOrNew(path)) return Ok();
  if (IsEpisode(path)) {
    return Error{"cannot write " + path + ": it is an episode; name another file, or remove it first"};
  }
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  if (access(folder.c_str(), W_OK | X_OK) == 0) return Ok();
  if (errno == ENOENT) return Error{"cannot write " + path + ": there is no folder " + folder.string()};
  return Trouble("cannot write", path, errno);
}

Status WriteFile(const std::string& path, std::string_view bytes) {
  if (path == "-") return WriteAll(STDOUT_FILENO, bytes, "standard output");
  if (Status fine = CheckWritable(path); !fine) return fine;
  // A device or pipe takes the bytes as they come; there is nothing to rename.
  if (!IsPlainOrNew(path)) {
    const int device = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (device < 0) return Trouble("cannot write", path, errno);
    Status status = WriteAll(device, bytes, path);
    close(device);
    return status;
  }
  const std::string beside = path + "." + std::to_string(getpid()) + ".new";
  const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return Trouble("cannot write", path, errno);
  Status status = WriteAll(file, bytes, path);
  if (status && fsync(file) != 0 && errno != EINVAL) status = Trouble("cannot write", path, errno);
  if (close(file) != 0 && status) status = Trouble("cannot write", path, errno);
  if (status && std::rename(beside.c_str(), path.c_str()) != 0) status = Trouble("cannot write", path, errno);
  if (!status) unlink(beside.c_str());
  return status;
}

Result<std::string> ReadFile(const std::string& path) {
  if (std::filesystem::is_directory(path)) return Error{"cannot read " + path + ": it is a folder"};
  std::ifstream file(path, std::ios::binary);
  if (!file) return Trouble("cannot read", path, errno);
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) return Trouble("cannot read", path, errno);
  return text.str();
}

Status MakeFolder(const std::string& path) {
  if (path.empty() || path == ".") return Ok();
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return Error{"cannot make the folder " + path + ": " + error.message()};
  return Ok();
}

std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace aerascope
