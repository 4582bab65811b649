// aerascope verify: is the file whole, does every event have its causes, does replaying give the same digest?
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "engine/episode/run_episode.h"
#include "engine/query/run.h"
#include "engine/store/episode_reader.h"
#include "viewer/app/commands.h"
#include "viewer/app/terminal.h"

namespace aerascope {
namespace {

// One line a check: what was looked at, and how it came out.
class Checks {
 public:
  void Report(bool good, const std::string& text) {
    std::printf("%s  %s\n", good ? "ok  " : "FAIL", text.c_str());
    all_good_ = all_good_ && good;
  }
  bool all_good() const { return all_good_; }

 private:
  bool all_good_ = true;
};

void CheckCauses(const EpisodeFile& episode, Checks* checks) {
  std::int64_t without = 0;
  std::int64_t links = 0;
  std::int64_t wrong = 0;
  std::string first_trouble;
  for (const Event& event : episode.events) {
    links += static_cast<std::int64_t>(event.causes.size());
    for (const EventId cause : event.causes) {
      if (cause.value >= 1 && cause < event.id) continue;
      ++wrong;
      if (first_trouble.empty()) first_trouble = ToText(event);
    }
    if (event.causes.empty() && !MayBeUncaused(event.body)) {
      ++without;
      if (first_trouble.empty()) first_trouble = ToText(event);
    }
  }
  if (without + wrong == 0) {
    checks->Report(true, std::to_string(links) +
                             " causes, each an earlier event; every event that must have one has one");
  } else {
    checks->Report(false, std::to_string(without) + " events lack a cause, " + std::to_string(wrong) +
                              " causes are no earlier events; the first: " + first_trouble);
  }
}

int Verify(const std::string& path) {
  auto episode = ReadEpisode(path);
  if (!episode) return Fail(episode.error());
  Checks checks;
  checks.Report(episode->complete, episode->complete
                                       ? std::to_string(episode->events.size()) + " events, complete"
                                       : "incomplete: the run was cut short; the last event is #" +
                                             std::to_string(episode->events.size()));
  EventDigest digest;
  for (const Event& event : episode->events) digest.Add(event);
  if (episode->stored_digest) {
    checks.Report(digest.Value() == *episode->stored_digest,
                  "digest of the events " + ToText(digest.Value()) +
                      (digest.Value() == *episode->stored_digest
                           ? ", as stored"
                           : ", but stored is " + ToText(*episode->stored_digest)));
  }
  if (episode->older) {
    std::puts(
        "note  written by an earlier aerascope: it lacks what was added since, so digests cannot be "
        "compared");
  }
  CheckCauses(*episode, &checks);
  if (episode->complete && !episode->older) {
    auto replayed = ReplayDigest(*episode);
    if (!replayed) {
      checks.Report(false, "replay: " + replayed.error().message);
    } else {
      checks.Report(*replayed == digest.Value(), "replaying the observations gives " + ToText(*replayed));
    }
  }
  return checks.all_good() ? kDone : kDifferent;
}

}  // namespace

void AddVerifyCommand(CLI::App& app, Chosen* chosen) {
  auto path = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("verify", "Check an episode: integrity, causes, and replay to the same digest");
  command->add_option("episode", *path, "The episode file")->required();
  command->callback([=] { *chosen = [=] { return Verify(*path); }; });
}

}  // namespace aerascope
