// MuJoCo's errors become exceptions and its warnings are collected; without this it would wait for a key
// press.
#include "engine/world/mujoco_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

namespace aerascope {
namespace {

TEST(MujocoErrorHandler, AnErrorIsThrown) {
  InstallMujocoErrorHandler();
  try {
    mju_error("the beam broke");
    FAIL() << "nothing was thrown";
  } catch (const MujocoError& error) {
    EXPECT_STREQ(error.what(), "the beam broke");
  }
}

TEST(MujocoErrorHandler, WarningsAreCollectedOnce) {
  InstallMujocoErrorHandler();
  TakeMujocoWarnings();

  mju_warning("first");
  mju_warning("second");

  EXPECT_THAT(TakeMujocoWarnings(), testing::ElementsAre("first", "second"));
  EXPECT_THAT(TakeMujocoWarnings(), testing::IsEmpty());
}

}  // namespace
}  // namespace aerascope
