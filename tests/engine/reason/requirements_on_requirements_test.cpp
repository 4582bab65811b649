// Requirement models on requirement models, in the chaining of what is really seen (semantics 3.2, 3.3, one
// level up; 3.5, credit).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

// `go` brings h to the table if it is awake; that it is awake counts only if it has shoes on (upper, weak),
// or only if it is not tired (upper, strong). A wet floor vetoes `go`; a mat (upper, strong) vetoes that
// veto.
struct Mind : ToyMind {
  enum Number : std::int64_t { kGo = 10, kMayGo, kShod, kTired, kNever, kMat };

  void Learn(const std::vector<Number>& numbers) {
    std::vector<CompositeState> states{
        State(1, {Value(V(0), "awake", O("yes"))}, 1), State(2, {Value(V(0), "shoes", O("on"))}, 1),
        State(3, {Value(V(0), "tired", O("yes"))}, 1), State(4, {Value(V(0), "floor", O("wet"))}, 1),
        State(5, {Value(V(0), "mat", O("there"))}, 1)};
    const Model go = Causal(kGo, Command("go", {V(2)}), Value(V(2), "place", O("table")));
    const auto on = [&](std::int64_t number, std::int64_t state, const Model& model, bool positive) {
      return Requires(number, MakeIcst({state}, {}, {V(0)}), model, {V(0), V(4), V(5)}, 2, positive);
    };
    const Model may = on(kMayGo, 1, go, true);
    const Model never = on(kNever, 4, go, false);
    std::map<std::int64_t, SeedModelDefinition> known{{kGo, {go, {}, false}},
                                                      {kMayGo, {may, {}, false}},
                                                      {kShod, {on(kShod, 2, may, true), {3, 4}, false}},
                                                      {kTired, {on(kTired, 3, may, false), {9, 10}, false}},
                                                      {kNever, {never, {}, false}},
                                                      {kMat, {on(kMat, 5, never, false), {3, 4}, false}}};
    std::vector<SeedModelDefinition> models;
    for (const Number number : numbers) models.push_back(known.at(number));
    Know({}, states, models);
    std::size_t i = 0;
    for (const auto& [id, record] : reasoner.knowledge().models()) id_of[numbers[i++]] = id;
  }

  // h is told to go, under these circumstances.
  void Go(std::vector<std::pair<const char*, const char*>> circumstances) {
    std::vector<Term> seen{Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door"))};
    for (const auto& [attribute, value] : circumstances) seen.push_back(Value(E("h"), attribute, O(value)));
    See(seen);
    const Term command = Command("go", {E("h")});
    reasoner.Executed(command, reasoner.CommandIssued(command, Commander::kTeacher, {}, {}));
  }
  double Expected() const {
    const auto made = All<PredictionMade>();
    return made.empty() ? -1 : made.back()->target.confidence;
  }
  const ChainingDecided* DecisionOn(Number number) const {
    const ChainingDecided* last = nullptr;
    for (const ChainingDecided* decided : All<ChainingDecided>()) {
      if (decided->model == id_of.at(number)) last = decided;
    }
    return last;
  }
  Evidence Of(Number number) const { return reasoner.knowledge().Find(id_of.at(number))->evidence; }

  std::map<Number, ModelId> id_of;
};

TEST(RequirementOnRequirement, AllowsItToSpeak) {
  // OpenAERA (semantics 3.3, 3.5): with shoes on it is expected, and both levels are credited.
  Mind mind;
  mind.Learn({Mind::kGo, Mind::kMayGo, Mind::kShod});
  mind.Go({{"shoes", "on"}});
  EXPECT_EQ(mind.Expected(), 1);
  ASSERT_NE(mind.DecisionOn(Mind::kMayGo), nullptr);
  EXPECT_EQ(mind.DecisionOn(Mind::kMayGo)->status, ChainingStatus::kEnabled);
  EXPECT_EQ(mind.DecisionOn(Mind::kMayGo)->winner, mind.id_of[Mind::kShod]);
  mind.See({Value(E("h"), "place", O("table"))});
  EXPECT_EQ(mind.Of(Mind::kMayGo), (Evidence{2, 2}));
  EXPECT_EQ(mind.Of(Mind::kShod), (Evidence{4, 5}));
}

TEST(RequirementOnRequirement, WithoutItItDoesNotSpeak) {
  // own (semantics 3.3, WEAK_DISABLED one level up): barefoot it speaks without weight, so nothing is
  // expected; when it comes true it was right, when not it is left alone.
  for (const bool arrives : {true, false}) {
    Mind mind;
    mind.Learn({Mind::kGo, Mind::kMayGo, Mind::kShod});
    mind.Go({});
    EXPECT_EQ(mind.Expected(), 0) << "silently";
    EXPECT_EQ(mind.DecisionOn(Mind::kMayGo)->status, ChainingStatus::kWeakDisabled);
    EXPECT_EQ(mind.DecisionOn(Mind::kGo)->status, ChainingStatus::kWeakDisabled);
    mind.See({Value(E("h"), "place", O(arrives ? "table" : "door"))});
    EXPECT_EQ(mind.Of(Mind::kMayGo), arrives ? (Evidence{2, 2}) : (Evidence{1, 1}));
    EXPECT_EQ(mind.Of(Mind::kShod), (Evidence{3, 4})) << "it did not speak";
  }
}

TEST(RequirementOnRequirement, AVetoOnItStopsIt) {
  // own (semantics 3.3, STRONG_NO_WEAK one level up). If it arrives all the same, the veto was wrong (3.5).
  Mind mind;
  mind.Learn({Mind::kGo, Mind::kMayGo, Mind::kTired});
  mind.Go({{"tired", "yes"}});
  EXPECT_EQ(mind.Expected(), 0);
  EXPECT_EQ(mind.DecisionOn(Mind::kMayGo)->status, ChainingStatus::kStrongDisabled);
  mind.See({Value(E("h"), "place", O("table"))});
  EXPECT_EQ(mind.Of(Mind::kTired), (Evidence{9, 11}));
  EXPECT_EQ(mind.Of(Mind::kMayGo), (Evidence{2, 2}));
}

TEST(RequirementOnRequirement, TheSurerOfTheTwoDecides) {
  // OpenAERA (semantics 3.3): shoes at 3/4 against tiredness at 9/10.
  Mind mind;
  mind.Learn({Mind::kGo, Mind::kMayGo, Mind::kShod, Mind::kTired});
  mind.Go({{"tired", "yes"}, {"shoes", "on"}});
  EXPECT_EQ(mind.Expected(), 0);
  EXPECT_EQ(mind.DecisionOn(Mind::kMayGo)->status, ChainingStatus::kVetoed);
  EXPECT_EQ(mind.DecisionOn(Mind::kMayGo)->considered.size(), 2u);
}

TEST(RequirementOnRequirement, AVetoThatIsVetoedStopsNothing) {
  // own (semantics 3.3). Given a wet floor, `go` is vetoed; with a mat it is not. When that goes well, the
  // mat was right, and the veto, which was silenced and would have been wrong, is left alone.
  Mind mind;
  mind.Learn({Mind::kGo, Mind::kMayGo, Mind::kNever, Mind::kMat});
  mind.Go({{"floor", "wet"}});
  EXPECT_EQ(mind.Expected(), 0);
  EXPECT_EQ(mind.DecisionOn(Mind::kGo)->status, ChainingStatus::kVetoed);
  mind.Go({{"floor", "wet"}, {"mat", "there"}});
  EXPECT_EQ(mind.Expected(), 1);
  EXPECT_EQ(mind.DecisionOn(Mind::kNever)->status, ChainingStatus::kStrongDisabled);
  mind.See({Value(E("h"), "place", O("table"))});
  EXPECT_EQ(mind.Of(Mind::kMat), (Evidence{4, 5}));
  EXPECT_EQ(mind.Of(Mind::kNever), (Evidence{1, 1}));
}

TEST(RequirementOnRequirement, ThePlanAndWhatIsSeenAgree) {
  // own. What the chaining of facts does not allow, planning does not either, in the frame that is present.
  Mind mind;
  mind.Learn({Mind::kGo, Mind::kMayGo, Mind::kTired});
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
            Value(E("h"), "tired", O("yes"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Wish(), "");
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door"))});
  EXPECT_EQ(mind.Wish(), "(cmd go [h])");
}

}  // namespace
}  // namespace aerascope::toy
