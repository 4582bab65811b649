// Writes the episode files that tests of every reader open: hostile_episodes FOLDER.
#include <cstdio>
#include <string>

#include "engine/store/episode_writer.h"
#include "tests/support/hostile_texts.h"

namespace {

bool Write(const std::string& path, aerascope::HostileEpisode episode) {
  auto writer = aerascope::EpisodeWriter::Create(path, std::move(episode.header));
  if (!writer) {
    std::fprintf(stderr, "%s\n", writer.error().message.c_str());
    return false;
  }
  for (aerascope::Event& event : episode.events) (*writer)->Append(std::move(event));
  const auto digest = (*writer)->Finish();
  if (!digest) std::fprintf(stderr, "%s: %s\n", path.c_str(), digest.error().message.c_str());
  return digest.ok();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace aerascope;
  if (argc != 2) {
    std::fputs("usage: hostile_episodes FOLDER\n", stderr);
    return 2;
  }
  const std::string folder = std::string(argv[1]) + "/";
  bool good = true;
  for (int turn = 0; turn < kHostileTurns; ++turn)
    good = Write(folder + "hostile_" + std::to_string(turn) + ".episode", MakeHostileEpisode(turn)) && good;
  good = Write(folder + "endless.episode", MakeEndlessEpisode()) && good;
  good = Write(folder + "no_numbers.episode", MakeEpisodeWithoutNumbers()) && good;
  return good ? 0 : 2;
}
