// The scenario file: what a good one gives, and what a bad one is told.
#include "engine/episode/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace aerascope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kScenarios = std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios/";

TEST(Scenario, TheScriptedPickAndPlaceIsComplete) {
  const Result<Scenario> scenario = LoadScenario(kScenarios + "pick_and_place_scripted.toml");
  ASSERT_TRUE(scenario.ok()) << scenario.error().message;
  EXPECT_EQ(scenario->title, "Pick and place on a line");
  EXPECT_EQ(scenario->teacher.size(), 6u);
}

}  // namespace
}  // namespace aerascope
