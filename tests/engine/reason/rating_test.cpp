// How outcomes move evidence, strength and state (semantics 3.5, the table in 10.3).
#include "engine/reason/rating.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace aerascope {
namespace {

Rating After(Rating rating, const std::string& outcomes) {
  for (const char outcome : outcomes) rating = Rate(rating, outcome == 'S', {});
  return rating;
}

Rating Start(double count, double rate, bool strong = false) { return {{rate * count, count}, strong, ModelState::kActive}; }

TEST(Rating, OneFailureOfAFreshModelIsSurvived) {
  const Rating rating = After(Start(1, 1), "F");
  EXPECT_EQ(rating.evidence, (Evidence{1, 2}));
  EXPECT_EQ(rating.state, ModelState::kActive);
}

TEST(Rating, TwoFailuresDeleteAFreshModel) {
  const Rating rating = After(Start(1, 1), "FF");
  EXPECT_NEAR(rating.evidence.rate(), 1.0 / 3, 1e-9);
  EXPECT_EQ(rating.state, ModelState::kDeleted);
}

TEST(Rating, FiveSuccessesMakeAModelStrongAndStartTheCountAnew) {
  EXPECT_FALSE(After(Start(1, 1), "SSSS").strong);
  const Rating rating = After(Start(1, 1), "SSSSS");
  EXPECT_TRUE(rating.strong);
  EXPECT_EQ(rating.evidence, (Evidence{1, 1}));
}

TEST(Rating, AStrongModelIsPhasedOutAndComesBack) {
  Rating rating = After(Start(1, 1, true), "FF");
  EXPECT_EQ(rating.state, ModelState::kPhasedOut);
  EXPECT_NEAR(rating.evidence.rate(), 1.0 / 3, 1e-9);
  // Its failures are not counted while it is out; the failing evidence itself is kept (unlike OpenAERA).
  rating = After(rating, "F");
  EXPECT_EQ(rating.evidence.total, 3);
  rating = After(rating, "S");
  EXPECT_EQ(rating.state, ModelState::kActive);
  EXPECT_DOUBLE_EQ(rating.evidence.rate(), 0.5);
}

TEST(Rating, AnAnalogyRisesWithSuccessAndGoesWithTheFirstFailure) {
  EXPECT_DOUBLE_EQ(After(Start(1, .75), "S").evidence.rate(), .875);
  EXPECT_NEAR(After(Start(1, .75), "SS").evidence.rate(), .916667, 1e-6);
  EXPECT_TRUE(After(Start(1, .75), "SSSSS").strong);
  const Rating failed = After(Start(1, .75), "F");
  EXPECT_DOUBLE_EQ(failed.evidence.rate(), .375);
  EXPECT_EQ(failed.state, ModelState::kDeleted);
}

TEST(Rating, KnownRunsOfOutcomes) {
  EXPECT_NEAR(After(Start(1, .6), "SSSS").evidence.rate(), .92, 1e-9);
  EXPECT_EQ(After(Start(1, .6), "F").state, ModelState::kDeleted);
  EXPECT_EQ(After(Start(3, .8666666667), "FFF").state, ModelState::kActive);
  EXPECT_EQ(After(Start(3, .8666666667), "FFFF").state, ModelState::kDeleted);
  EXPECT_NEAR(After(Start(3, 1), "FFFF").evidence.rate(), .428571, 1e-6);
}

RC_GTEST_PROP(RatingLaw, ConfidenceStaysAShareAndOnlyOutcomesMoveIt, (const std::vector<bool>& outcomes)) {
  Rating rating = Start(1, 1);
  for (const bool success : outcomes) {
    const Rating before = rating;
    rating = Rate(rating, success, {});
    RC_ASSERT(rating.evidence.rate() >= 0 && rating.evidence.rate() <= 1);
    if (before.state == ModelState::kDeleted) {
      RC_ASSERT(rating == before);
    } else if (before.state == ModelState::kActive && success) {
      RC_ASSERT(rating.evidence.rate() >= before.evidence.rate() - 1e-12);
    } else if (before.state == ModelState::kActive) {
      RC_ASSERT(rating.evidence.rate() <= before.evidence.rate() + 1e-12);
    }
  }
}

}  // namespace
}  // namespace aerascope
