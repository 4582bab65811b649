// Predictions as inputs of models (semantics 3.1, 3.3, 3.4): what follows from what is only expected, and
// what becomes of it when that is decided.
#include "engine/reason/expectation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/engine/reason/toy_mind.h"
#include "tests/support/law.h"

namespace aerascope::toy {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Term X(const char* state) {
  return Value(E("x"), "state", O(state));
}

// x goes through these states, one a frame, as models say that need nothing else. Numbers from 1.
std::vector<SeedModelDefinition> Chain(const std::vector<const char*>& states,
                                       const std::vector<Evidence>& evidence = {}) {
  std::vector<SeedModelDefinition> models;
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i) + 1;
    models.push_back(
        {Free(id, X(states[i]), X(states[i + 1])), i < evidence.size() ? evidence[i] : Evidence{}, false});
  }
  return models;
}

// "c 0.375 on 1": what is predicted, how surely, and on how many predictions it rests.
std::vector<std::string> Predicted(const ToyMind& mind) {
  std::vector<std::string> predicted;
  for (const PredictionMade* made : mind.All<PredictionMade>()) {
    char number[32];
    std::snprintf(number, sizeof number, "%.4g", made->target.confidence);
    predicted.push_back(ToText(made->target.payload[2]) + " " + number + " on " +
                        std::to_string(made->grounds.size()));
  }
  return predicted;
}

std::vector<std::string> GivenUp(const ToyMind& mind) {
  std::map<PredictionId, std::string> targets;
  for (const PredictionMade* made : mind.All<PredictionMade>())
    targets[made->prediction] = ToText(made->target.payload[2]);
  std::vector<std::string> given_up;
  for (const PredictionInvalidated* event : mind.All<PredictionInvalidated>())
    given_up.push_back(targets[event->prediction] + " " + std::string(EnumName(event->reason)));
  return given_up;
}

std::int64_t Ratings(const ToyMind& mind, std::size_t model) {
  std::vector<ModelId> ids;
  for (const auto& [id, record] : mind.reasoner.knowledge().models()) ids.push_back(id);
  const auto all = mind.All<EvidenceUpdated>();
  return std::count_if(all.begin(), all.end(),
                       [&](const EvidenceUpdated* rated) { return rated->model == ids[model]; });
}

TEST(Expectation, APredictionIsAnInputOfFurtherModels) {
  // OpenAERA (semantics 3.3): confidence = input x model, all the way; each rests on the one before.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c"}, {{3, 4}, {1, 2}}));
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 0.75 on 0", "c 0.375 on 1"));
  const auto made = mind.All<PredictionMade>();
  EXPECT_EQ(made[1]->grounds, std::vector<PredictionId>{made[0]->prediction});
  EXPECT_FALSE(made[1]->input.valid()) << "no fact is on its left side";
  EXPECT_EQ(made[1]->target.interval, (TimeInterval{Time{200'000}, Time{300'000}}));
  const auto decided = mind.All<ChainingDecided>();
  ASSERT_EQ(decided.size(), 2u);
  EXPECT_EQ(decided[1]->premise, made[0]->prediction);
}

TEST(Expectation, WhatItRestedOnDidNotComeTrueSoItIsGivenUpUnrated) {
  // OpenAERA (semantics 3.4: a ground got counter-evidence: invalidated, no rating). Given a -> b -> c -> d,
  // when z is seen for b, then b fails, and c and d are given up by what was seen.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c", "d"}));
  mind.See({X("a")});
  mind.See({X("z")});
  EXPECT_THAT(GivenUp(mind), ElementsAre("c premise_contradicted", "d premise_contradicted"));
  const auto failed = mind.All<PredictionFailed>();
  ASSERT_EQ(failed.size(), 1u);
  for (const PredictionInvalidated* event : mind.All<PredictionInvalidated>())
    EXPECT_EQ(event->by, failed[0]->evidence);
  EXPECT_EQ(Ratings(mind, 0), 1);
  EXPECT_EQ(Ratings(mind, 1), 0);
  EXPECT_TRUE(mind.reasoner.knowledge().predictions().empty());
}

TEST(Expectation, WhatNeverComesIsNoGroundEither) {
  // own. Given that nothing is seen of x at all, then b fails when its time is over, and c with it.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c"}));
  mind.See({X("a")});
  mind.See({});
  mind.See({});
  EXPECT_THAT(GivenUp(mind), ElementsAre("c premise_contradicted"));
  EXPECT_TRUE(mind.reasoner.knowledge().predictions().empty());
}

TEST(Expectation, WhenItCameTrueTheModelPredictsFromTheFactInstead) {
  // own: the prediction from the fact takes the other's place, what rested on that rests on it, and each
  // model is rated once for what it predicted from facts.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c", "d"}));
  mind.See({X("a")});
  mind.See({X("b")});
  EXPECT_THAT(GivenUp(mind), ElementsAre("c renewed"));
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0", "c 1 on 1", "d 1 on 1", "c 1 on 0"));
  mind.See({X("c")});
  mind.See({X("d")});
  EXPECT_THAT(GivenUp(mind), ElementsAre("c renewed", "d renewed"));
  EXPECT_EQ(mind.All<PredictionSucceeded>().size(), 3u);
  for (std::size_t model = 0; model < 3; ++model) EXPECT_EQ(Ratings(mind, model), 1) << model;
}

TEST(Expectation, OneThatRestsOnTheRenewedOneFallsWithThat) {
  // own. Given a -> b -> c -> d, when b came and then z for c, then d, which rests on the renewed c, falls.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c", "d"}));
  mind.See({X("a")});
  mind.See({X("b")});
  mind.See({X("z")});
  EXPECT_THAT(GivenUp(mind), ElementsAre("c renewed", "d premise_contradicted"));
  EXPECT_TRUE(mind.reasoner.knowledge().predictions().empty());
}

TEST(Expectation, WhatTheFactMakesSurerIsPredictedAnew) {
  // own. Given models of 3/4 and 1/2, when b is seen, c is expected with 1/2 instead of 3/8, and d with it.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c", "d"}, {{3, 4}, {1, 2}, {1, 2}}));
  mind.See({X("a")});
  mind.See({X("b")});
  EXPECT_THAT(GivenUp(mind), ElementsAre("c renewed", "d renewed"));
  EXPECT_THAT(Predicted(mind),
              ElementsAre("b 0.75 on 0", "c 0.375 on 1", "d 0.1875 on 1", "c 0.5 on 0", "d 0.25 on 1"));
}

TEST(Expectation, ACycleOfModelsEndsAtTheLimit) {
  // own: max_prediction_chain. Given a -> b -> a and four links beyond the first, then five predictions, and
  // the decision against the sixth says why; and over fifty frames no more than one a frame is added.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "a"}));
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0", "a 1 on 1", "b 1 on 1", "a 1 on 1", "b 1 on 1"));
  const auto decided = mind.All<ChainingDecided>();
  ASSERT_FALSE(decided.empty());
  EXPECT_EQ(decided.back()->status, ChainingStatus::kTooDeep);
  EXPECT_EQ(decided.back()->premise, mind.All<PredictionMade>().back()->prediction);
  for (int frame = 1; frame <= 50; ++frame) mind.See({X(frame % 2 == 0 ? "a" : "b")});
  EXPECT_LE(mind.All<PredictionMade>().size(), 5u + 2 * 50u);
  EXPECT_EQ(mind.reasoner.knowledge().predictions().size(), 5u);
  EXPECT_THAT(mind.All<PredictionFailed>(), IsEmpty());
}

TEST(Expectation, ChainsThatBranchEndAtALimitOfTheirOwn) {
  // own. Given that n leads to 2n and to 2n + 1, and links for a hundred frames, then there are no more than
  // a thousand expectations, and the decision against more says why.
  ReasonerParameters parameters;
  parameters.max_prediction_chain = 100;
  ToyMind mind(parameters);
  std::vector<SeedModelDefinition> models;
  for (const int odd : {0, 1}) {
    Model model = Free(odd + 1, Value(E("x"), "number", V(2)), Value(E("x"), "number", V(3)));
    model.forward.push_back({3, Term::Struct("+", {Term::Struct("*", {V(2), N(2)}), N(odd)})});
    models.push_back({model, {}, false});
  }
  mind.Know({}, {}, models);
  mind.See({Value(E("x"), "number", N(1))});
  std::size_t open = 0;
  for (const auto& [id, record] : mind.reasoner.knowledge().predictions())
    open += record.grounds.empty() ? 0 : 1;
  EXPECT_EQ(open, 1000u);
  const auto decided = mind.All<ChainingDecided>();
  EXPECT_TRUE(std::any_of(decided.begin(), decided.end(), [](const ChainingDecided* decision) {
    return decision->status == ChainingStatus::kTooDeep;
  }));
}

TEST(Expectation, WithoutLinksNothingIsPredictedFromPredictions) {
  // own: max_prediction_chain = 0.
  ReasonerParameters parameters;
  parameters.max_prediction_chain = 0;
  ToyMind mind(parameters);
  mind.Know({}, {}, Chain({"a", "b", "c"}));
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0"));
}

// b leads to c only for what is red; the condition is met by what is expected and a property.
void KnowRed(ToyMind* mind, bool red, double veto = -1) {
  const CompositeState red_b = State(1, {Value(V(0), "state", O("b")), Value(V(0), "colour", O("red"))}, 1);
  const Model ab = Free(2, X("a"), X("b"));
  const Model bc = Causal(3, Value(V(2), "state", O("b")), Value(V(2), "state", O("c")));
  const Model may = Requires(4, MakeIcst({1}, {}, {V(0)}), bc, {V(0), V(4), V(5)}, 2);
  const Model never = Requires(5, MakeIcst({1}, {}, {V(0)}), bc, {V(0), V(4), V(5)}, 2, false);
  std::vector<SeedModelDefinition> models{{ab, {}, false}, {bc, {}, false}, {may, {4, 5}, false}};
  if (veto >= 0) models.push_back({never, {veto * 10, 10}, false});
  mind->Know({Value(E("x"), "colour", O(red ? "red" : "blue"))}, {red_b}, models);
}

TEST(Expectation, ACompositeStateMayHoldBecauseOfWhatIsExpected) {
  // OpenAERA (semantics 3.1: some input a prediction, so the instance is one). The requirement's confidence
  // does not enter (3.3).
  ToyMind mind;
  KnowRed(&mind, true);
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0", "c 1 on 1"));
  EXPECT_EQ(mind.All<PredictionMade>()[1]->requirements.size(), 1u);
  EXPECT_THAT(mind.All<IcstFound>(), IsEmpty()) << "it does not hold yet";
}

TEST(Expectation, WithoutItsConditionNothingFollows) {
  // own. The same with what is blue.
  ToyMind mind;
  KnowRed(&mind, false);
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0"));
  EXPECT_EQ(mind.All<ChainingDecided>().back()->status, ChainingStatus::kWeakDisabled);
}

TEST(Expectation, AVetoOnWhatIsExpectedHolds) {
  // own (semantics 3.3). A veto as sure as what allows it: nothing follows, and the decision names it.
  ToyMind mind;
  KnowRed(&mind, true, 0.9);
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0"));
  EXPECT_EQ(mind.All<ChainingDecided>().back()->status, ChainingStatus::kVetoed);
}

TEST(Expectation, AModelThatRidesOnAnExpectedOneIsExpectedToo) {
  // OpenAERA (semantics 3.3: pred of the instance of the model). y follows whenever b -> c fires.
  ToyMind mind;
  std::vector<SeedModelDefinition> models = Chain({"a", "b", "c"});
  Model rides;
  rides.id = {3};
  rides.lhs = {true, MakeImdl({2}, {}, {V(0), V(1)}), V(2), V(3)};
  rides.rhs = {true, Value(E("y"), "state", O("with")), V(0), V(1)};
  models.push_back({rides, {}, false});
  mind.Know({}, {}, models);
  mind.See({X("a")});
  EXPECT_THAT(Predicted(mind), ElementsAre("b 1 on 0", "c 1 on 1", "with 1 on 1"));
  mind.See({X("z")});
  EXPECT_EQ(GivenUp(mind).size(), 2u);
  EXPECT_TRUE(mind.reasoner.knowledge().predictions().empty());
}

TEST(Expectation, ADrivePromisedByAChainWaitsUntilTheChainBreaks) {
  // OpenAERA (semantics 4.8: a predicted success suspends, its failure resumes); own: a renewed promise is
  // the same promise. Given c is wanted, it is suspended for a -> b -> c, through b, until z comes.
  ToyMind mind;
  mind.Know({}, {}, Chain({"a", "b", "c", "d"}));
  mind.See({X("a")});
  mind.Want(X("d"));
  EXPECT_EQ(mind.Act(), "");
  ASSERT_EQ(mind.All<GoalSuspended>().size(), 1u);
  EXPECT_EQ(mind.All<GoalSuspended>()[0]->prediction, mind.All<PredictionMade>()[2]->prediction);
  mind.See({X("b")});
  mind.Act();
  mind.See({X("c")});
  mind.Act();
  EXPECT_EQ(mind.All<GoalSuspended>().size(), 1u);
  EXPECT_THAT(mind.All<GoalResumed>(), IsEmpty());
  mind.See({X("z")});
  EXPECT_EQ(mind.All<GoalResumed>().size(), 1u);
}

TEST(Expectation, EachPredictionIsOpenedOnceAndClosedOnce) {
  // own: whatever states come, in a world of any models between eight states, each prediction is decided by
  // exactly one event, none that rests on others is rated, and grounds are open when they are named.
  EXPECT_TRUE(Holds(2000, [](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](int limit) {
      return static_cast<int>(random() % static_cast<std::uint64_t>(limit));
    };
    const char* names[] = {"a", "b", "c", "d", "e", "f", "g", "i"};
    ToyMind mind;
    std::vector<SeedModelDefinition> models;
    for (int i = 1 + below(8); i > 0; --i) {
      const auto number = static_cast<std::int64_t>(models.size()) + 1;
      const double total = 1 + below(3);
      models.push_back({Free(number, X(names[below(8)]), X(names[below(8)])),
                        Evidence{total - below(2) * 0.5, total}, below(2) == 1});
    }
    mind.Know({}, {}, models);
    for (int frames = 1 + below(12); frames > 0; --frames) {
      std::vector<Term> seen;
      if (below(5) > 0) seen.push_back(X(names[below(8)]));
      mind.See(seen);
    }
    std::map<PredictionId, int> open;
    std::map<PredictionId, bool> rests;
    for (const Event& event : mind.events.events) {
      const auto close = [&](PredictionId id, bool by_rating, bool outweighed = false) {
        RC_ASSERT(open[id] == 1);
        RC_ASSERT(outweighed || rests[id] != by_rating);
        open[id] = 2;
      };
      if (const auto* made = std::get_if<PredictionMade>(&event.body)) {
        RC_ASSERT(open[made->prediction]++ == 0);
        rests[made->prediction] = !made->grounds.empty();
        for (const PredictionId ground : made->grounds) RC_ASSERT(open[ground] == 1);
      } else if (const auto* right = std::get_if<PredictionSucceeded>(&event.body)) {
        close(right->prediction, true);
      } else if (const auto* wrong = std::get_if<PredictionFailed>(&event.body)) {
        close(wrong->prediction, true);
      } else if (const auto* up = std::get_if<PredictionInvalidated>(&event.body)) {
        const bool outweighed = up->reason == InvalidationReason::kOutweighed;
        if (outweighed) RC_ASSERT(open[up->surer] == 1);
        close(up->prediction, false, outweighed);
      }
    }
    for (const auto& [id, record] : mind.reasoner.knowledge().predictions()) RC_ASSERT(open[id] == 1);
  }));
}

}  // namespace
}  // namespace aerascope::toy
