// A law: what holds for everything, tried on thousands of cases, each made from a number of its own.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>
#include <iostream>

#include "tests/support/slowness.h"

namespace aerascope {

// Whether law(number) holds for `cases` random numbers (fewer where programs are slow, see slowness.h). A
// failure prints the number, which makes the same case again; RC_PARAMS="seed=..." repeats a whole run.
template <class Law>
bool Holds(int cases, Law&& law) {
  rc::detail::TestParams parameters = rc::detail::configuration().testParams;
  parameters.maxSuccess = Slowness() > 1 ? CasesToTry(cases) : std::max(parameters.maxSuccess, cases);
  const auto property = [&law] {
    const auto whole_range = rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>());
    law(*rc::gen::noShrink(whole_range));
  };
  const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata(), parameters);
  rc::detail::printResultMessage(result, std::cerr);
  std::cerr << '\n';
  return result.template is<rc::detail::SuccessResult>();
}

}  // namespace aerascope
