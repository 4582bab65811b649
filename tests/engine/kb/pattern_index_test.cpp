// The index of patterns gives all that match, and few others.
#include "engine/kb/pattern_index.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "tests/engine/kb/build_terms.h"

namespace aerascope {
namespace {

// Small worlds, so that payloads and patterns meet: two things, two attributes, a few values of each sort.
Term AnySlot(int choice) {
  switch (choice % 12) {
    case 0:
      return E("a");
    case 1:
      return E("b");
    case 2:
      return O("red");
    case 3:
      return N(1);
    case 4:
      return N(1.000004);  // equal to 1 within the tolerance
    case 5:
      return Set({});
    case 6:
      return Set({E("a")});
    case 7:
      return Set({V(2)});
    case 8:
      return V(0);
    case 9:
      return V(1);
    case 10:
      return W();
    default:
      return T(100);
  }
}

Term AnyPayload(const std::vector<int>& choices) {
  const auto slot = [&](std::size_t i) { return AnySlot(choices[i % choices.size()]); };
  switch (choices[0] % 4) {
    case 0:
      return MakeCommand(O(choices[1] % 2 ? "f" : "g"), {slot(2)});
    case 1: {
      std::vector<Term> arguments;
      for (int i = 0; i < choices[1] % 4; ++i) arguments.push_back(slot(static_cast<std::size_t>(i) + 2));
      return MakeIcst({choices[2] % 2 + 1}, {}, arguments);
    }
    default:
      return MakeValue(slot(1), choices[2] % 3 == 0 ? V(3) : O(choices[2] % 3 == 1 ? "p" : "q"), slot(3));
  }
}

auto Choices() {
  return rc::gen::container<std::vector<int>>(6, rc::gen::inRange(0, 1200));
}

TEST(PatternIndex, MissesNothingThatMatches) {
  // Own: what the index leaves out does not match, for payloads of facts and for payloads that are wanted.
  EXPECT_TRUE(rc::check([] {
    const auto patterns = *rc::gen::container<std::vector<std::vector<int>>>(Choices());
    const Term payload = AnyPayload(*Choices());
    PatternIndex<int, true> all;
    PatternIndex<int, false> of_facts;
    for (std::size_t i = 0; i < patterns.size(); ++i) {
      all.Add(AnyPayload(patterns[i]), static_cast<int>(i));
      of_facts.Add(AnyPayload(patterns[i]), static_cast<int>(i));
    }
    std::vector<int> found;
    all.Find(payload, [&](int i) { found.push_back(i); });
    if (payload.ground()) {
      std::vector<int> the_same;
      of_facts.Find(payload, [&](int i) { the_same.push_back(i); });
      std::sort(found.begin(), found.end());
      std::sort(the_same.begin(), the_same.end());
      RC_ASSERT(found == the_same);
    }
    for (std::size_t i = 0; i < patterns.size(); ++i) {
      Bindings bindings;
      if (!Match(AnyPayload(patterns[i]), payload, bindings)) continue;
      RC_ASSERT(std::count(found.begin(), found.end(), static_cast<int>(i)) == 1);
    }
  }));
}

TEST(PatternIndex, LeavesOutOtherConstants) {
  PatternIndex<int, false> index;
  index.Add(MakeValue(V(0), O("shape"), O("cube")), 1);
  index.Add(MakeValue(V(0), O("shape"), O("sphere")), 2);
  index.Add(MakeValue(V(0), O("size"), O("cube")), 3);
  index.Add(MakeValue(V(0), O("shape"), V(1)), 4);
  std::vector<int> found;
  index.Find(MakeValue(E("c"), O("shape"), O("cube")), [&](int i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<int>{1, 4}));
}

TEST(PatternIndex, ForgetsWhatIsRemoved) {
  PatternIndex<int, true> index;
  index.Add(MakeValue(V(0), O("shape"), V(1)), 1);
  index.Add(MakeValue(V(0), O("shape"), V(1)), 2);
  index.Remove(MakeValue(V(0), O("shape"), V(1)), 1);
  std::vector<int> found;
  index.Find(MakeValue(W(), O("shape"), W()), [&](int i) { found.push_back(i); });
  EXPECT_EQ(found, (std::vector<int>{2}));
}

}  // namespace
}  // namespace aerascope
