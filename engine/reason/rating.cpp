#include "engine/reason/rating.h"

#include <cmath>

#include "engine/base/text.h"

namespace aerascope {

Rating Rate(const Rating& before, bool success, const ReasonerParameters& parameters) {
  Rating after = before;
  if (before.state == ModelState::kDeleted) return after;
  if (before.state == ModelState::kPhasedOut) {
    const bool watched = before.evidence.rate() > parameters.secondary_act_thr;
    if (!success || !watched) return after;
  }
  after.evidence.total += 1;
  // Rounded like every number of the language, so that knowledge written as text loses nothing.
  if (success) after.evidence.positive = RoundNumber(after.evidence.positive + 1);
  const double rate = after.evidence.rate();
  if (before.state == ModelState::kPhasedOut) {
    if (rate > parameters.primary_act_thr) after.state = ModelState::kActive;
    return after;
  }
  if (success && rate >= parameters.mdl_inertia_sr_thr &&
      after.evidence.total >= parameters.mdl_inertia_cnt_thr) {
    const double count = std::floor(1 / rate);
    after.evidence = {count, count};
    after.strong = true;
  }
  if (!success && rate <= parameters.primary_act_thr) {
    after.state = before.strong ? ModelState::kPhasedOut : ModelState::kDeleted;
  }
  return after;
}

}  // namespace aerascope
