// What an episode file says about itself before its first event: who wrote it, under which settings, and
// every file that is needed to look at it years later on another machine.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace aerascope {

// Raised when the meaning of a table or field changes. A newer file is refused, an older one is read.
inline constexpr std::int32_t kSchemaVersion = 6;

// "AERA" in ASCII: tells an episode from any other SQLite file (`file run.episode` shows it).
inline constexpr std::int32_t kEpisodeApplicationId = 0x41455241;

struct NamedFile {
  std::string name;   // relative, with slashes: "scenario.toml", "world/scene.xml"
  std::string bytes;  // any bytes
  bool operator==(const NamedFile&) const = default;
};

struct EpisodeHeader {
  std::string program_version;
  std::map<std::string, std::string> settings;  // name -> value, no wall-clock times (same run, same bytes)
  std::vector<NamedFile> files;                 // names are unique; the order is kept
  bool operator==(const EpisodeHeader&) const = default;
};

}  // namespace aerascope
