// How outcomes move evidence, strength and state: semantics 3.5, a test for each row of the table in 10.3.
#include "engine/reason/rating.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

namespace aerascope {
namespace {

Rating After(Rating rating, const std::string& outcomes) {
  for (const char outcome : outcomes) rating = Rate(rating, outcome == 'S', {});
  return rating;
}

Rating Start(double count, double rate, bool strong = false) {
  return {{rate * count, count}, strong, ModelState::kActive};
}

Rating PhasedOut(double count, double rate) {
  return {{rate * count, count}, true, ModelState::kPhasedOut};
}

std::vector<double> Rates(Rating rating, const std::string& outcomes) {
  std::vector<double> rates;
  for (const char outcome : outcomes) {
    rating = Rate(rating, outcome == 'S', {});
    rates.push_back(rating.evidence.rate());
  }
  return rates;
}

void ExpectRates(const Rating& start, const std::string& outcomes, const std::vector<double>& expected) {
  const std::vector<double> rates = Rates(start, outcomes);
  ASSERT_EQ(rates.size(), expected.size());
  for (std::size_t i = 0; i < rates.size(); ++i)
    EXPECT_NEAR(rates[i], expected[i], 1e-4) << "outcome " << i + 1;
}

TEST(Rating, Row1_OneFailureOfAFreshModelIsSurvived) {
  // OpenAERA (semantics 10.3, row 1): 1, 1, 0 | F | 2, .5 stays.
  const Rating rating = After(Start(1, 1), "F");
  EXPECT_EQ(rating.evidence, (Evidence{1, 2}));
  EXPECT_EQ(rating.state, ModelState::kActive);
}

TEST(Rating, Row2_TwoFailuresDeleteAFreshModel) {
  // OpenAERA (semantics 10.3, row 2): 1, 1, 0 | F F | deleted at 3, .3333. The black list: credit_test.cpp.
  const Rating rating = After(Start(1, 1), "FF");
  EXPECT_EQ(rating.evidence, (Evidence{1, 3}));
  EXPECT_EQ(rating.state, ModelState::kDeleted);
}

TEST(Rating, Row3_FourSuccessesDoNotMakeAModelStrong) {
  // OpenAERA (semantics 10.3, row 3): 1, 1, 0 | S S S S | 5, 1, strength 0.
  const Rating rating = After(Start(1, 1), "SSSS");
  EXPECT_EQ(rating.evidence, (Evidence{5, 5}));
  EXPECT_FALSE(rating.strong);
}

TEST(Rating, Row4_FiveSuccessesMakeAModelStrongAndStartTheCountAnew) {
  // OpenAERA (semantics 10.3, row 4): 1, 1, 0 | S x5 | cnt 6 -> trimmed to 1, sr 1, strength 1.
  const Rating rating = After(Start(1, 1), "SSSSS");
  EXPECT_EQ(rating.evidence, (Evidence{1, 1}));
  EXPECT_TRUE(rating.strong);
}

TEST(Rating, Row5_AStrongModelIsPhasedOutWhereAnotherIsDeleted) {
  // OpenAERA (semantics 10.3, row 5): 1, 1, 1 | F F | 2, .5; then .3333: phased out. Own: the failing
  // evidence is stored (OpenAERA keeps 2, .5).
  const Rating first = After(Start(1, 1, true), "F");
  EXPECT_EQ(first.evidence, (Evidence{1, 2}));
  EXPECT_EQ(first.state, ModelState::kActive);
  const Rating second = After(first, "F");
  EXPECT_EQ(second.evidence, (Evidence{1, 3}));
  EXPECT_EQ(second.state, ModelState::kPhasedOut);
  EXPECT_TRUE(second.strong);
}

TEST(Rating, Row6_ASuccessPhasesInAgain) {
  // OpenAERA (semantics 10.3, row 6): cnt 2, sr .5 in secondary | S | 3, .6667 -> phased in.
  const Rating as_openaera_keeps_it = After(PhasedOut(2, .5), "S");
  EXPECT_EQ(as_openaera_keeps_it.evidence, (Evidence{2, 3}));
  EXPECT_EQ(as_openaera_keeps_it.state, ModelState::kActive);
}

TEST(Rating, Row6_WithTheFailingEvidenceStoredItTakesTheSameSuccess) {
  // Own (semantics 3.5): 3, .3333 in secondary | S | 4, .5 -> phased in.
  const Rating rating = After(Start(1, 1, true), "FFS");
  EXPECT_EQ(rating.evidence, (Evidence{2, 4}));
  EXPECT_EQ(rating.state, ModelState::kActive);
}

TEST(Rating, FailuresInSecondaryAreNotCounted) {
  // OpenAERA (semantics 3.5): in secondary only successes are rated.
  EXPECT_EQ(After(PhasedOut(3, 1.0 / 3), "FFF"), PhasedOut(3, 1.0 / 3));
}

TEST(Rating, BelowTheSecondaryThresholdAModelIsNotWatchedAnyMore) {
  // OpenAERA (semantics 3.5): secondary act := sr if > 0.3.
  const Rating gone = After(Start(1, .6, true), "F");
  EXPECT_EQ(gone.state, ModelState::kPhasedOut);
  EXPECT_NEAR(gone.evidence.rate(), .3, 1e-9);
  EXPECT_EQ(After(gone, "SSSS"), gone);
}

TEST(Rating, Row7_AnAnalogyOfOpenaeraBecomesStrong) {
  // OpenAERA (semantics 10.3, row 7): 1, .6, 0 | S x5 | .8, .8667, .9, .92, .9333 -> strong.
  ExpectRates(Start(1, .6), "SSSS", {.8, .8667, .9, .92});
  EXPECT_FALSE(After(Start(1, .6), "SSSS").strong);
  const Rating rating = After(Start(1, .6), "SSSSS");
  EXPECT_TRUE(rating.strong);
  EXPECT_EQ(rating.evidence, (Evidence{1, 1}));
}

TEST(Rating, Row8_AnAnalogyOfOpenaeraGoesWithTheFirstFailure) {
  // OpenAERA (semantics 10.3, row 8): 1, .6, 0 | F | .3 deleted.
  ExpectRates(Start(1, .6), "F", {.3});
  EXPECT_EQ(After(Start(1, .6), "F").state, ModelState::kDeleted);
}

TEST(Rating, Row9_FourFailuresAfterTwoSuccesses) {
  // OpenAERA (semantics 10.3, row 9): 3, .8667, 0 | F F F F | .65, .52, .4333, .3714 -> deleted at the 4th.
  const Rating start = Start(3, 2.6 / 3);
  ExpectRates(start, "FFFF", {.65, .52, .4333, .3714});
  EXPECT_EQ(After(start, "FFF").state, ModelState::kActive);
  EXPECT_EQ(After(start, "FFFF").state, ModelState::kDeleted);
}

TEST(Rating, Row10_FourFailuresOfAModelThatWasAlwaysRight) {
  // OpenAERA (semantics 10.3, row 10): 3, 1, 0 | F F F F | .75, .6, .5, .4286 stays.
  ExpectRates(Start(3, 1), "FFFF", {.75, .6, .5, .4286});
  EXPECT_EQ(After(Start(3, 1), "FFFF").state, ModelState::kActive);
}

TEST(Rating, Row11_AnAnalogyOfThePaper) {
  // paper (semantics 10.3, row 11): 1, .75, 0 | S / F | .875 / .375 deleted.
  EXPECT_DOUBLE_EQ(After(Start(1, .75), "S").evidence.rate(), .875);
  const Rating failed = After(Start(1, .75), "F");
  EXPECT_DOUBLE_EQ(failed.evidence.rate(), .375);
  EXPECT_EQ(failed.state, ModelState::kDeleted);
}

TEST(Rating, AnAnalogyOfThePaperBecomesStrong) {
  // paper (semantics 6.3): 0.75 -> 0.875 -> 0.9167 -> 0.9375 -> 0.95 -> strong.
  ExpectRates(Start(1, .75), "SSSS", {.875, .9167, .9375, .95});
  EXPECT_TRUE(After(Start(1, .75), "SSSSS").strong);
}

RC_GTEST_PROP(RatingLaw, ConfidenceStaysAShareAndOnlyOutcomesMoveIt, (const std::vector<bool>& outcomes)) {
  // Own.
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
