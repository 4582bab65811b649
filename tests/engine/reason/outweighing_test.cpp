// Predictions that cannot both come true (semantics 3.4): which is given up, what falls with it, and that
// nobody is rated for it.
#include "engine/reason/outweighing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tests/engine/reason/toy_mind.h"
#include "tests/support/law.h"

namespace aerascope::toy {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Term X(const char* state) {
  return Value(E("x"), "state", O(state));
}
Term Y(const char* state) {
  return Value(E("y"), "state", O(state));
}

// A model that needs no requirement, right so often of ten times.
SeedModelDefinition Tenths(std::int64_t id, Term lhs, Term rhs, double right, bool positive = true) {
  SeedModelDefinition given{Free(id, std::move(lhs), std::move(rhs)), {right, 10}, false};
  given.model.rhs.positive = positive;
  return given;
}

// "b outweighed by z": states, and the reason.
std::vector<std::string> AllGivenUp(const ToyMind& mind) {
  std::map<PredictionId, std::string> targets;
  for (const PredictionMade* made : mind.All<PredictionMade>()) {
    targets[made->prediction] = (made->target.positive ? "" : "not ") + ToText(made->target.payload[2]);
  }
  std::vector<std::string> given_up;
  for (const PredictionInvalidated* event : mind.All<PredictionInvalidated>()) {
    std::string text = targets[event->prediction] + " " + std::string(EnumName(event->reason));
    if (event->surer.valid()) text += " by " + targets[event->surer];
    given_up.push_back(text);
  }
  return given_up;
}

TEST(Outweighing, ASurerPredictionAgainstItGivesAPredictionUpUnrated) {
  // OpenAERA (semantics 3.4: predicted counter-evidence of higher confidence: invalidate, no rating). x is to
  // be b, half surely, and because of y it is to be z, nearly surely. When b comes after all, only the model
  // that said z is judged.
  ToyMind mind;
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 5), Tenths(2, Y("a"), X("z"), 9)});
  mind.See({X("a"), Y("a")});
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("b outweighed by z"));
  EXPECT_FALSE(mind.All<PredictionInvalidated>()[0]->by.valid()) << "no fact decided it";
  EXPECT_EQ(mind.reasoner.knowledge().predictions().size(), 1u);
  mind.See({X("b")});
  EXPECT_THAT(mind.All<PredictionSucceeded>(), IsEmpty());
  EXPECT_EQ(mind.All<PredictionFailed>().size(), 1u);
  const auto rated = mind.All<EvidenceUpdated>();
  ASSERT_EQ(rated.size(), 1u);
  EXPECT_EQ(rated[0]->before.total, 10);
  EXPECT_EQ(rated[0]->before.positive, 9);
}

TEST(Outweighing, ItsCausesAreBothPredictions) {
  // own: "why was it given up?" leads to what was expected, and to what was expected more surely.
  ToyMind mind;
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 5), Tenths(2, Y("a"), X("z"), 9)});
  mind.See({X("a"), Y("a")});
  const auto made = mind.Found<PredictionMade>();
  const auto given_up = mind.Found<PredictionInvalidated>();
  ASSERT_EQ(made.size(), 2u);
  ASSERT_EQ(given_up.size(), 1u);
  EXPECT_THAT(given_up[0]->causes, ::testing::UnorderedElementsAre(made[0]->id, made[1]->id));
}

TEST(Outweighing, OneAsSureOutweighsNothing) {
  // OpenAERA (semantics 3.4: higher, so not equal). Both stand until it is seen which was right, and both are
  // rated.
  ToyMind mind;
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 5), Tenths(2, Y("a"), X("z"), 5)});
  mind.See({X("a"), Y("a")});
  EXPECT_THAT(AllGivenUp(mind), IsEmpty());
  mind.See({X("b")});
  EXPECT_EQ(mind.All<PredictionSucceeded>().size(), 1u);
  EXPECT_EQ(mind.All<PredictionFailed>().size(), 1u);
  EXPECT_EQ(mind.All<EvidenceUpdated>().size(), 2u);
}

TEST(Outweighing, OneLessSureOutweighsNothingAndIsOutweighed) {
  // own, the other way round: whichever of the two is made first, the less sure one goes.
  ToyMind mind;
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 9), Tenths(2, Y("a"), X("z"), 5)});
  mind.See({X("a"), Y("a")});
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("z outweighed by b"));
}

TEST(Outweighing, ThatItWillNotBeOutweighsThatItWill) {
  // OpenAERA (semantics 1.6: an anti-fact speaks against the fact). And what speaks of another thing, or says
  // the same, speaks against nothing.
  ToyMind mind;
  mind.Know({}, {},
            {Tenths(1, X("a"), X("b"), 5), Tenths(2, Y("a"), X("b"), 9, false), Tenths(3, Y("a"), Y("z"), 9),
             Tenths(4, X("a"), X("b"), 6)});
  mind.See({X("a"), Y("a")});
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("b outweighed by not b", "b outweighed by not b"));
  EXPECT_EQ(mind.reasoner.knowledge().predictions().size(), 2u);
}

TEST(Outweighing, AnotherTimeIsNoContradiction) {
  // own: x is z two frames from now, b in the next.
  ToyMind mind;
  Model later = Free(2, Y("a"), X("z"));
  for (Guard& guard : later.forward)
    guard.expression = Term::Struct("+", {guard.expression[0], Term::Span(kFrame * 2)});
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 5), {later, {9, 10}, false}});
  mind.See({X("a"), Y("a")});
  ASSERT_EQ(mind.All<PredictionMade>().size(), 2u);
  EXPECT_THAT(AllGivenUp(mind), IsEmpty());
}

TEST(Outweighing, WhatRestsOnTheOutweighedOneFallsWithIt) {
  // OpenAERA (semantics 3.4: a ground got counter-evidence). c was to follow b, and d to
  // follow c; then a command makes z surer than b.
  ToyMind mind;
  mind.Know({}, {},
            {Tenths(1, X("a"), X("b"), 5), Tenths(2, X("b"), Value(E("v"), "state", O("c")), 10),
             Tenths(3, Value(E("v"), "state", O("c")), Value(E("w"), "state", O("d")), 10),
             Tenths(4, Command("tell", {E("y")}), X("z"), 9)});
  mind.See({X("a")});
  ASSERT_EQ(mind.reasoner.knowledge().predictions().size(), 3u);
  const Term tell = Command("tell", {E("y")});
  mind.reasoner.Executed(tell, mind.reasoner.CommandIssued(tell, Commander::kTeacher, {}, {}));
  EXPECT_THAT(AllGivenUp(mind),
              ElementsAre("b outweighed by z", "c premise_outweighed by z", "d premise_outweighed by z"));
  EXPECT_EQ(mind.reasoner.knowledge().predictions().size(), 1u);
}

TEST(Outweighing, OfWhatACommandBringsNothingIsExpectedFromWhatIsOutweighed) {
  // own. A command is to make x b, half surely, and z, nearly surely: b is given up before c is expected from
  // it.
  ToyMind mind;
  const Term tell = Command("tell", {E("y")});
  mind.Know({}, {},
            {Tenths(1, tell, X("b"), 5), Tenths(2, tell, X("z"), 9),
             Tenths(3, X("b"), Value(E("v"), "state", O("c")), 10)});
  mind.See({X("a")});
  mind.reasoner.Executed(tell, mind.reasoner.CommandIssued(tell, Commander::kTeacher, {}, {}));
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("b outweighed by z"));
  EXPECT_EQ(mind.All<PredictionMade>().size(), 2u);
}

TEST(Outweighing, WhatFollowsFromACommandIsWeighedAtOnce) {
  // own. q and then z are to come because of y. A command makes b, from which c would follow: it is
  // outweighed by z in the same frame.
  ToyMind mind;
  const Term tell = Command("tell", {E("y")});
  mind.Know({}, {},
            {Tenths(1, tell, X("b"), 10), Tenths(2, X("b"), X("c"), 5), Tenths(3, Y("p"), Y("q"), 10),
             Tenths(4, Y("q"), X("z"), 9)});
  mind.See({Y("p")});
  mind.reasoner.Executed(tell, mind.reasoner.CommandIssued(tell, Commander::kTeacher, {}, {}));
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by z"));
}

TEST(Outweighing, WhatWasOutweighedIsNotExpectedAgainWhileThatIsOpen) {
  // own. x leads over b to c, y over q to z instead of c. In the head c is given up once, not each time that
  // the mind thinks on; when b and q are seen, c is predicted from b once more, and outweighed once more.
  ToyMind mind;
  mind.Know({}, {},
            {Tenths(1, X("a"), X("b"), 10), Tenths(2, X("b"), X("c"), 5), Tenths(3, Y("p"), Y("q"), 10),
             Tenths(4, Y("q"), X("z"), 9)});
  mind.See({X("a"), Y("p")});
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by z"));
  const Term nothing = Command("nothing", {});
  mind.reasoner.Executed(nothing, mind.reasoner.CommandIssued(nothing, Commander::kTeacher, {}, {}));
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by z"));
  EXPECT_EQ(mind.All<PredictionMade>().size(), 4u);
  mind.See({X("b"), Y("q")});
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by z", "c outweighed by z", "z renewed"));
}

TEST(Outweighing, ASilentPredictionStands) {
  // own. The model that says b is phased out: it predicts with confidence 0 to show that it is right again,
  // which it can.
  ToyMind mind;
  SeedModelDefinition silent = Tenths(1, X("a"), X("b"), 4);
  silent.strong = true;
  silent.state = ModelState::kPhasedOut;
  mind.Know({}, {}, {silent, Tenths(2, Y("a"), X("z"), 9)});
  mind.See({X("a"), Y("a")});
  EXPECT_THAT(AllGivenUp(mind), IsEmpty());
  mind.See({X("b")});
  EXPECT_EQ(mind.All<PredictionSucceeded>().size(), 1u);
}

TEST(Outweighing, WhatIsOutweighedOutweighsNothing) {
  // own. c is outweighed by d, so c does not outweigh b, which d says nothing against.
  ToyMind mind;
  mind.Know({}, {},
            {Tenths(1, X("a"), X("b"), 5), Tenths(2, Y("a"), X("c"), 6),
             Tenths(3, Value(E("w"), "state", O("a")), X("c"), 7, false)});
  mind.See({X("a"), Y("a"), Value(E("w"), "state", O("a"))});
  EXPECT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by not c"));
}

TEST(Outweighing, WhatItSaidIsNoSurpriseWhenItComes) {
  // OpenAERA (semantics 5.1: predicted, even if wrongly, so nothing is induced). b was predicted, and
  // outweighed by that it will not be; it comes.
  ToyMind mind;
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 5), Tenths(2, Y("a"), X("b"), 9, false)});
  mind.See({X("a"), Y("a")});
  ASSERT_THAT(AllGivenUp(mind), ElementsAre("b outweighed by not b"));
  mind.See({X("b"), Y("a")});
  for (const InductionStarted* started : mind.All<InductionStarted>())
    EXPECT_NE(started->induction, InductionKind::kChange);
}

// How often it was surprised that x came to be so.
int SurprisedBy(const ToyMind& mind, const char* state) {
  int times = 0;
  for (const Event* event : mind.Found<InductionStarted>()) {
    const auto& started = std::get<InductionStarted>(event->body);
    if (started.induction != InductionKind::kChange) continue;
    for (const FactObserved* seen : mind.All<FactObserved>())
      times += seen->fact_id == started.consequent && seen->fact.payload == X(state) ? 1 : 0;
  }
  return times;
}

TEST(Outweighing, WhatItSaidIsASurpriseAtAnotherTime) {
  // own. That b was predicted for the next frame, and outweighed, explains nothing that comes a frame later.
  ToyMind mind;
  mind.Know({}, {}, {Tenths(1, Y("a"), X("b"), 5), Tenths(2, Y("a"), X("b"), 9, false)});
  mind.See({X("a"), Y("a")});
  ASSERT_THAT(AllGivenUp(mind), ElementsAre("b outweighed by not b"));
  mind.See({X("a"), Y("n")});
  EXPECT_EQ(SurprisedBy(mind, "k"), 0);
  mind.See({X("k"), Y("n")});
  EXPECT_EQ(SurprisedBy(mind, "k"), 1);
}

TEST(Outweighing, WhatOnlyFollowedFromPredictionsIsASurpriseWhenItComes) {
  // own. c was to follow from b, and z from q, which outweighed it; neither b nor q came, so nothing had
  // predicted c from what was seen.
  ToyMind mind;
  mind.Know({}, {},
            {Tenths(1, X("a"), X("b"), 10), Tenths(2, X("b"), X("c"), 5), Tenths(3, Y("p"), Y("q"), 10),
             Tenths(4, Y("q"), X("z"), 9)});
  mind.See({X("a"), Y("p")});
  ASSERT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by z"));
  mind.See({X("m"), Y("n")});
  mind.See({X("c"), Y("n")});
  EXPECT_EQ(SurprisedBy(mind, "c"), 1);
}

TEST(Outweighing, TheSurestIsGivenUpFirstAndOfEqualsTheOneMadeFirst) {
  // own: the order of events is that of sureness, then of numbers, in whichever order models come and
  // whatever they speak of.
  for (const bool surer_first : {false, true}) {
    ToyMind mind;
    mind.Know(
        {}, {},
        {Tenths(1, X("a"), X(surer_first ? "c" : "b"), surer_first ? 6 : 5),
         Tenths(2, X("a"), X(surer_first ? "b" : "c"), surer_first ? 5 : 6), Tenths(3, X("a"), X("z"), 9)});
    mind.See({X("a")});
    EXPECT_THAT(AllGivenUp(mind), ElementsAre("c outweighed by z", "b outweighed by z"));
  }
  ToyMind mind;
  std::vector<SeedModelDefinition> models;
  std::vector<Term> seen;
  std::vector<std::string> expected;
  for (std::int64_t i = 0; i < 12; ++i) {
    const Term thing = E("t" + std::to_string(i));
    seen.push_back(Value(thing, "state", O("a")));
    models.push_back(Tenths(2 * i + 1, seen.back(), Value(thing, "state", O("b" + std::to_string(i))), 5));
    models.push_back(Tenths(2 * i + 2, seen.back(), Value(thing, "state", O("z")), 9));
    expected.push_back("b" + std::to_string(i) + " outweighed by z");
  }
  mind.Know({}, {}, models);
  mind.See(seen);
  EXPECT_EQ(AllGivenUp(mind), expected);
}

TEST(Outweighing, ADriveThatItPromisedIsPursuedAgain) {
  // OpenAERA (semantics 4.8). b is wanted and promised; then a command makes z surer.
  ToyMind mind;
  const Term tell = Command("tell", {E("y")});
  mind.Know({}, {}, {Tenths(1, X("a"), X("b"), 5), Tenths(2, tell, X("z"), 9)});
  mind.See({X("a")});
  mind.Want(X("b"));
  EXPECT_EQ(mind.Act(), "");
  ASSERT_EQ(mind.All<GoalSuspended>().size(), 1u);
  mind.reasoner.Executed(tell, mind.reasoner.CommandIssued(tell, Commander::kTeacher, {}, {}));
  const auto resumed = mind.Found<GoalResumed>();
  ASSERT_EQ(resumed.size(), 1u);
  const auto given_up = mind.Found<PredictionInvalidated>();
  ASSERT_EQ(given_up.size(), 1u);
  EXPECT_THAT(resumed[0]->causes, ::testing::Contains(given_up[0]->id));
  EXPECT_EQ(mind.All<GoalSuspended>().size(), 1u) << "z promises nothing";
}

TEST(Outweighing, DoesNotDependOnTheOrderOfPredictions) {
  // own. Whatever models speak of the next state of x, which of their predictions stand is the same in every
  // order of the models; and of what stands nothing is contradicted by anything surer.
  EXPECT_TRUE(Holds(2000, [](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](int limit) {
      return static_cast<int>(random() % static_cast<std::uint64_t>(limit));
    };
    const char* names[] = {"b", "c", "d"};
    struct Says {
      std::string state;
      bool positive;
      double tenths;
      auto operator<=>(const Says&) const = default;
    };
    std::vector<Says> all;
    for (int i = 2 + below(8); i > 0; --i) all.push_back({names[below(3)], below(2) == 0, 1.0 + below(10)});
    const auto standing = [](const std::vector<Says>& order) {
      ToyMind mind;
      std::vector<SeedModelDefinition> models;
      for (const Says& says : order) {
        // Different left sides, so that equal predictions are different models.
        const auto id = static_cast<std::int64_t>(models.size()) + 1;
        const Term trigger = Value(E("t" + std::to_string(id)), "state", O("a"));
        models.push_back(Tenths(id, trigger, X(says.state.c_str()), says.tenths, says.positive));
      }
      mind.Know({}, {}, models);
      std::vector<Term> seen;
      for (const SeedModelDefinition& model : models) seen.push_back(model.model.lhs.payload);
      mind.See(seen);
      std::multiset<Says> left;
      for (const auto& [id, record] : mind.reasoner.knowledge().predictions()) {
        for (const auto& [other_id, other] : mind.reasoner.knowledge().predictions()) {
          RC_ASSERT(other.target.confidence <= record.target.confidence ||
                    EvidenceFor(other.target, record.target) != EvidenceVerdict::kNegative);
        }
        left.insert({ToText(record.target.payload[2]), record.target.positive, record.target.confidence});
      }
      return left;
    };
    const auto first = standing(all);
    std::shuffle(all.begin(), all.end(), random);
    RC_ASSERT(standing(all) == first);
  }));
}

}  // namespace
}  // namespace aerascope::toy
