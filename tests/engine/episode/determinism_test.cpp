// The same scenario gives the same events (semantics 10.9): over runs, and whatever threads there are. Over
// levels of optimisation: the test engine/episode/optimisation, see same_digests.py.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"
#include "engine/event/digest_sink.h"
#include "tests/engine/store/temporary_folder.h"

namespace aerascope {
namespace {

// The scripted ones of the shipped scenarios.
std::vector<Scenario> ScriptedScenarios() {
  std::set<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios")) {
    if (entry.path().extension() == ".toml") paths.insert(entry.path());
  }
  std::vector<Scenario> scenarios;
  for (const std::filesystem::path& path : paths) {
    auto scenario = LoadScenario(path.string());
    EXPECT_TRUE(scenario.ok()) << scenario.error().message;
    if (scenario.ok() && WorldKind(*scenario) == "scripted") scenarios.push_back(*std::move(scenario));
  }
  EXPECT_GE(scenarios.size(), 3u);
  return scenarios;
}

std::string DigestOf(const Scenario& scenario) {
  auto world = MakeWorld(scenario);
  if (!world.ok()) return world.error().message;
  DigestSink sink;
  const auto outcome = RunEpisode(scenario, world->get(), &sink);
  return outcome.ok() ? ToText(sink.Value()) : outcome.error().message;
}

TEST(Oracle10_9, ThreeRunsHaveTheSameDigest) {
  // OpenAERA (semantics 10.9): same seed, 3 runs, identical event logs.
  for (const Scenario& scenario : ScriptedScenarios()) {
    const std::string first = DigestOf(scenario);
    EXPECT_EQ(DigestOf(scenario), first) << scenario.title;
    EXPECT_EQ(DigestOf(scenario), first) << scenario.title;
  }
}

TEST(Oracle10_9, TheNumberOfThreadsDoesNotMatter) {
  // OpenAERA (semantics 10.9): one thread; one more that stores the events; several that reason at once.
  const TemporaryFolder folder;
  for (const Scenario& scenario : ScriptedScenarios()) {
    const std::string alone = DigestOf(scenario);
    const auto recorded = RecordEpisode(scenario, folder / "run.episode", "test");
    ASSERT_TRUE(recorded.ok()) << recorded.error().message;
    EXPECT_EQ(ToText(recorded->digest), alone) << scenario.title;
    std::vector<std::string> at_once(3);
    std::vector<std::thread> threads;
    for (std::string& digest : at_once) threads.emplace_back([&] { digest = DigestOf(scenario); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(at_once, std::vector<std::string>(3, alone)) << scenario.title;
  }
}

TEST(Oracle10_9, AnotherScenarioHasAnotherDigest) {
  // Own: the digest tells runs apart at all.
  std::set<std::string> digests;
  const std::vector<Scenario> scenarios = ScriptedScenarios();
  for (const Scenario& scenario : scenarios) digests.insert(DigestOf(scenario));
  EXPECT_EQ(digests.size(), scenarios.size());
}

}  // namespace
}  // namespace aerascope
