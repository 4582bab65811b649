// Kinds of events switched off in the scenario: what is refused, and that episodes stay whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"
#include "engine/query/run.h"
#include "engine/store/episode_reader.h"
#include "tests/engine/store/temporary_folder.h"

namespace aerascope {
namespace {

using testing::HasSubstr;

std::string TextOf(const std::string& name) {
  return FileBytes(std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios/" + name);
}

// The scripted pick-and-place with `tail` at its end.
Result<Scenario> ScriptedTask(const std::string& tail) {
  return LoadScenarioFromFiles({{"scenario.toml", TextOf("pick_and_place_scripted.toml") + tail},
                                {"seed.replicode", TextOf("pick_and_place.replicode")}});
}

std::string AllOff() {
  std::string list;
  for (const std::string& name : ReportKindNames()) list += "\"" + name + "\", ";
  return "\n[events]\noff = [" + list + "]\n";
}

EpisodeFile Recorded(const Scenario& scenario, const std::string& path) {
  const auto outcome = RecordEpisode(scenario, path, "test");
  EXPECT_TRUE(outcome.ok()) << outcome.error().message;
  auto episode = ReadEpisode(path);
  EXPECT_TRUE(episode.ok()) << episode.error().message;
  return std::move(*episode);
}

std::string SettingOf(const EpisodeFile& episode, const std::string& name) {
  for (const Parameter& parameter : std::get<EpisodeStarted>(episode.events.front().body).parameters) {
    if (parameter.name == name) return parameter.value;
  }
  return "not given";
}

TEST(EventsOff, TheScenarioNamesTheKinds) {
  const auto scenario = ScriptedTask("\n[events]\noff = [\"GoalSkipped\", \"CauseConsidered\"]\n");
  ASSERT_TRUE(scenario.ok()) << scenario.error().message;
  EXPECT_EQ(NamesOf(scenario->left_out), "CauseConsidered GoalSkipped");
  const auto nothing = ScriptedTask("\n[events]\noff = []\n");
  ASSERT_TRUE(nothing.ok()) << nothing.error().message;
  EXPECT_TRUE(nothing->left_out.none());
  EXPECT_EQ(NamesOf(ScriptedTask("")->left_out), "InstanceProgress");
}

TEST(EventsOff, ThePageOfScenarioFilesListsAllKinds) {
  const std::string page = FileBytes(std::string(AERASCOPE_SOURCE_DIR) + "/docs/scenario-file.md");
  for (const std::string& name : ReportKindNames()) EXPECT_THAT(page, HasSubstr("`" + name + "`"));
}

TEST(EventsOff, WhatMakesTheStoryCannotBeOff) {
  const auto scenario = ScriptedTask("\n[events]\noff = [\"FactObserved\"]\n");
  ASSERT_FALSE(scenario.ok());
  EXPECT_THAT(scenario.error().message, HasSubstr(":8: expected kinds of events that can be switched off ("));
  EXPECT_THAT(scenario.error().message,
              HasSubstr("found FactObserved, without which the episode could not be"));
}

TEST(EventsOff, AMisspeltKindIsCorrected) {
  const auto scenario = ScriptedTask("\n[events]\noff = [\"GoalSkiped\"]\n");
  ASSERT_FALSE(scenario.ok());
  EXPECT_THAT(scenario.error().message, HasSubstr("found 'GoalSkiped'; did you mean 'GoalSkipped'?"));
}

// Own.
TEST(EventsOff, TheEpisodeIsSmallerAndReplaysToItsDigest) {
  const TemporaryFolder folder;
  const auto full_scenario = ScriptedTask("\n[events]\noff = []\n");
  const auto thin_scenario = ScriptedTask(AllOff());
  ASSERT_TRUE(full_scenario.ok() && thin_scenario.ok());
  const EpisodeFile full = Recorded(*full_scenario, folder / "full.episode");
  const EpisodeFile thin = Recorded(*thin_scenario, folder / "thin.episode");

  // Fewer events, none of them of a kind that is off; the file says which these are
  EXPECT_LT(thin.events.size(), full.events.size());
  for (const Event& event : thin.events) EXPECT_FALSE(IsReportKind(event.body.index())) << ToText(event);
  EXPECT_EQ(SettingOf(thin, "events_off"), NamesOf(thin_scenario->left_out));
  EXPECT_EQ(SettingOf(full, "events_off"), "");

  // It replays to the same digest
  EventDigest digest;
  for (const Event& event : thin.events) digest.Add(event);
  const auto replayed = ReplayDigest(thin);
  ASSERT_TRUE(replayed.ok()) << replayed.error().message;
  EXPECT_EQ(*replayed, digest.Value());
  EXPECT_EQ(thin.stored_digest, digest.Value());

  // And the knowledge is the same
  const aerascope::Run full_run = aerascope::Run::FromEvents(full);
  const aerascope::Run thin_run = aerascope::Run::FromEvents(thin);
  EXPECT_TRUE(thin_run.complete());
  ASSERT_EQ(full_run.final_knowledge().models().size(), thin_run.final_knowledge().models().size());
  for (const auto& [id, record] : full_run.final_knowledge().models()) {
    const ModelRecord* same = thin_run.final_knowledge().Find(id);
    ASSERT_TRUE(same);
    EXPECT_EQ(record.canonical.hash, same->canonical.hash);
    EXPECT_EQ(record.evidence, same->evidence);
  }
}

// Own: "why" still leads from each command of the agent to something observed or given.
TEST(EventsOff, CausesStillLeadBackToWhatWasObserved) {
  const TemporaryFolder folder;
  const auto scenario = ScriptedTask(AllOff());
  ASSERT_TRUE(scenario.ok()) << scenario.error().message;
  const aerascope::Run run = aerascope::Run::FromEvents(Recorded(*scenario, folder / "thin.episode"));
  for (const Event& event : run.events()) {
    EXPECT_TRUE(MayBeUncaused(event.body) || !event.causes.empty()) << ToText(event);
  }
  for (const EventId command : run.OfKind<CommandIssued>()) {
    if (run.FindBody<CommandIssued>(command)->by != Commander::kAgent) continue;
    EventId at = command;
    while (!run.Causes(at).empty()) at = run.Causes(at).front();
    EXPECT_TRUE(MayBeUncaused(run.Find(at)->body)) << ToText(*run.Find(at));
  }
}

}  // namespace
}  // namespace aerascope
