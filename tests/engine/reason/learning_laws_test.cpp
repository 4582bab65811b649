// A law of learning, on random lives: the order in which simultaneous facts are sensed plays no part in what
// is learned.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "tests/engine/reason/agent.h"
#include "tests/support/slowness.h"

namespace aerascope {
namespace {

// What an agent knows, by content: evidence and state of each model, and the composite states.
using Learned = std::map<Hash128, std::tuple<double, double, int>>;

Learned WhatWasLearned(const Agent& agent) {
  Learned learned;
  for (const auto& [id, record] : agent.kb().composite_states()) learned[record.canonical.hash] = {0, 0, -1};
  for (const auto& [id, record] : agent.kb().models()) {
    learned[record.canonical.hash] = {record.evidence.positive, record.evidence.total,
                                      static_cast<int>(record.state)};
  }
  return learned;
}

// A line with a hand and three things; what is in the hand goes along. Grasps and releases fail now and then.
class Line {
 public:
  std::vector<Term> Facts() const {
    std::vector<Term> facts{Val("h", "position", N(hand_))};
    for (const auto& [thing, at] : things_)
      facts.push_back(MakeValue(E(thing.c_str()), O("position"), N(at)));
    facts.push_back(Val("h", "holding", held_.empty() ? Set({}) : Set({E(held_.c_str())})));
    return facts;
  }

  Term Act(std::mt19937& random) {
    const auto roll = random() % 4;
    if (roll == 0) {
      const bool works = random() % 4 != 0;
      for (const auto& [thing, at] : things_) {
        if (works && held_.empty() && at == hand_) held_ = thing;
      }
      return Cmd("grab", {E("h")});
    }
    if (roll == 1) {
      if (random() % 4 != 0) held_.clear();
      return Cmd("release", {E("h")});
    }
    const int step = static_cast<int>(random() % 7) - 3;
    hand_ += step;
    if (!held_.empty()) things_[held_] = hand_;
    return Cmd("move", {E("h"), N(step)});
  }

 private:
  int hand_ = 0;
  std::map<std::string, int> things_{{"a", 0}, {"b", 2}, {"c", -1}};
  std::string held_;
};

struct Life {
  Life(unsigned seed, bool shuffled);
  Agent agent;
};

Life::Life(unsigned seed, bool shuffled)
    : agent({Holds(Val("h", "essence", O("hand")), kAlways), Holds(Val("a", "shape", O("cube")), kAlways),
             Holds(Val("b", "shape", O("sphere")), kAlways), Holds(Val("c", "shape", O("cube")), kAlways)},
            {HandAt(1), ThingAt(2, "shape")}) {
  std::mt19937 random(seed);
  std::mt19937 order(seed + 1);
  Line line;
  for (int frame = 0; frame < 16; ++frame) {
    std::vector<Term> facts = line.Facts();
    if (shuffled) std::shuffle(facts.begin(), facts.end(), order);
    agent.Sense(facts);
    agent.Do(line.Act(random));
  }
}

TEST(LearningLaws, TheOrderOfSimultaneousFactsPlaysNoPart) {
  // Own.
  for (unsigned seed = 0; seed < static_cast<unsigned>(CasesToTry(2000)); ++seed) {
    const Life plain(seed, false);
    const Life shuffled(seed, true);
    ASSERT_EQ(WhatWasLearned(plain.agent), WhatWasLearned(shuffled.agent)) << "life " << seed;
  }
}

TEST(LearningLaws, TheLivesAreRichEnoughToMeanSomething) {
  // Own: models of each kind that induction makes are learned in these lives.
  std::map<ModelKind, int> learned;
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Life life(seed, false);
    for (const auto& [id, record] : life.agent.kb().models()) ++learned[KindOf(record.model)];
  }
  for (const ModelKind kind :
       {ModelKind::kCausal, ModelKind::kWeakRequirement, ModelKind::kStrongRequirement, ModelKind::kReuse}) {
    EXPECT_GT(learned[kind], 10) << ToText(kind);
  }
}

}  // namespace
}  // namespace aerascope
