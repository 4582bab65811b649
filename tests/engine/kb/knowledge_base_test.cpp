// Definitions as terms, instances of composite states and models, and the indexes of the knowledge base.
#include "engine/kb/knowledge_base.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

// S4 of the paper's seed: an object has a size and a position.
CompositeState SizeAndPosition(std::int64_t id) {
  return {{id},
          {Component(V(2), "size", V(3)), Component(V(2), "position", V(4))},
          {},
          {"T0", "T1", "C", "SIZE", "P"}};
}

Model CausalModel(std::int64_t id) {
  Model model;
  model.id = {id};
  model.template_arguments = {V(0), Struct("ti", {V(1), V(2)})};
  model.lhs = {true, MakeCommand(O("move"), {V(3), V(4)}), V(5), V(6)};
  model.rhs = {true, MakeValue(V(3), O("position"), V(7)), V(8), V(9)};
  model.forward = {{7, Struct("+", {V(0), V(4)})}};
  return model;
}

Model Requirement(std::int64_t id, std::int64_t state, std::int64_t target, bool positive = true) {
  Model model;
  model.id = {id};
  model.lhs = {true, MakeIcst({state}, {}, {V(0), V(1), V(2)}), V(3), V(4)};
  model.rhs = {positive,
               MakeImdl({target}, {V(2), Struct("ti", {V(3), V(4)})}, {V(0), V(5), V(6), V(7), V(8)}), V(3),
               V(4)};
  return model;
}

TEST(Definitions, AreReadBackFromTheirTerms) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    AnyEvents any(seed);
    const CompositeState state = any.AnyBody<CompositeStateCreated>().state;
    RC_ASSERT(CompositeStateFromTerm(state.id, DefinitionToTerm(state)) == std::optional(state));
    const Model model = any.AnyBody<ModelCreated>().model;
    RC_ASSERT(ModelFromTerm(model.id, DefinitionToTerm(model)) == std::optional(model));
  }));
}

TEST(Definitions, OtherTermsAreNone) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    const Term term = AnyEvents(seed).AnyTerm(4);
    RC_ASSERT(!CompositeStateFromTerm({1}, term).has_value());
    RC_ASSERT(!ModelFromTerm({1}, term).has_value());
  }));
  EXPECT_FALSE(CompositeStateFromTerm({1}, Struct("cst", {Set({}), Set({}), Set({})})).has_value())
      << "no component";
}

TEST(Instance, ListsAllVariablesButTheInterval) {
  EXPECT_EQ(ArgumentVariables(SizeAndPosition(4)), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(TemplateVariables(CausalModel(5)), (std::vector<int>{0, 1, 2}));
  // The example of semantics 1.3: template [v0 ti(v1 v2)], exposed [v3 v4 v7 v8 v9]; the left side's 5 and 6
  // are not.
  EXPECT_EQ(ExposedVariables(CausalModel(5)), (std::vector<int>{3, 4, 7, 8, 9}));
}

TEST(Instance, BindsBackWhatItShows) {
  const CompositeState state = SizeAndPosition(4);
  Bindings bindings;
  bindings.Set(2, E("c1"));
  bindings.Set(3, O("large"));
  const Term payload = InstancePayload(state, bindings);
  EXPECT_EQ(payload, MakeIcst({4}, {}, {E("c1"), O("large"), V(4)}));
  Bindings back;
  EXPECT_TRUE(BindInstance(state, payload, back));
  EXPECT_EQ(*back.Find(2), E("c1"));
  EXPECT_EQ(back.Find(4), nullptr);
  EXPECT_FALSE(BindInstance(state, MakeIcst({4}, {}, {E("c1")}), back)) << "too few arguments";
  EXPECT_FALSE(BindInstance(state, N(1), back));
}

TEST(ModelKinds, AreToldByTheTwoSides) {
  EXPECT_EQ(KindOf(CausalModel(5)), ModelKind::kCausal);
  EXPECT_EQ(KindOf(Requirement(6, 4, 5)), ModelKind::kWeakRequirement);
  EXPECT_EQ(KindOf(Requirement(6, 4, 5, false)), ModelKind::kStrongRequirement);
  EXPECT_EQ(TargetModel(Requirement(6, 4, 5)), ModelId{5});
  EXPECT_EQ(RequiredState(Requirement(6, 4, 5)), CompositeStateId{4});
  Model reuse = CausalModel(7);
  reuse.lhs.payload = MakeImdl({5}, {}, {});
  EXPECT_EQ(KindOf(reuse), ModelKind::kReuse);
  EXPECT_EQ(TargetModel(reuse), ModelId{5});
  Model drive = CausalModel(8);
  drive.rhs.payload = E("run");
  EXPECT_EQ(KindOf(drive), ModelKind::kDrive);
  EXPECT_FALSE(TargetModel(CausalModel(5)).valid());
}

TEST(KnowledgeBase, FindsKnowledgeByContent) {
  KnowledgeBase kb;
  kb.AddCompositeState({SizeAndPosition(4), Origin::kSeed, {}, {}, {1}, {}});
  kb.AddModel({CausalModel(5), Origin::kSeed, {}, {}, {2}, {}, false, ModelState::kActive, {}});
  CompositeState same = SizeAndPosition(40);
  std::swap(same.components[0], same.components[1]);
  EXPECT_EQ(kb.FindState(kb.CanonicalOf(same).hash), CompositeStateId{4});
  EXPECT_EQ(kb.FindModel(kb.CanonicalOf(CausalModel(50)).hash), ModelId{5});
  EXPECT_FALSE(kb.FindModel(HashOf("other")).valid());
}

TEST(KnowledgeBase, DeletedModelsAreStillFoundByContent) {
  KnowledgeBase kb;
  kb.AddModel({CausalModel(5), Origin::kSeed, {}, {}, {2}, {}, false, ModelState::kActive, {}});
  kb.SetState({5}, ModelState::kDeleted);
  EXPECT_EQ(kb.FindModel(kb.CanonicalOf(CausalModel(50)).hash), ModelId{5});
}

TEST(KnowledgeBase, RequirementsAreListedByIdWithoutDeletedOnes) {
  KnowledgeBase kb;
  kb.AddCompositeState({SizeAndPosition(4), Origin::kSeed, {}, {}, {1}, {}});
  kb.AddModel({CausalModel(5), Origin::kSeed, {}, {}, {2}, {}, false, ModelState::kActive, {}});
  for (const std::int64_t id : {9, 6, 7}) {
    kb.AddModel({Requirement(id, 4, 5), Origin::kInduction, {}, {}, {3}, {}, false, ModelState::kActive, {}});
  }
  EXPECT_EQ(kb.RequirementsOf({5}), (std::vector<ModelId>{{6}, {7}, {9}}));
  kb.SetState({7}, ModelState::kDeleted);
  EXPECT_EQ(kb.RequirementsOf({5}), (std::vector<ModelId>{{6}, {9}}));
  kb.SetState({7}, ModelState::kActive);
  kb.SetState({6}, ModelState::kPhasedOut);
  EXPECT_EQ(kb.RequirementsOf({5}), (std::vector<ModelId>{{6}, {7}, {9}}));
  EXPECT_TRUE(kb.RequirementsOf({77}).empty());
}

TEST(KnowledgeBase, FactsExpireAtTheirEnd) {
  KnowledgeBase kb;
  kb.AddFact({{1}, Holds(E("a"), Ms(100, 200)), FactSource::kSensor, {1}});
  kb.AddFact({{2}, Holds(E("b"), kAlways), FactSource::kProperty, {2}});
  kb.ExpireFacts({199'999});
  EXPECT_EQ(kb.facts().size(), 2u);
  kb.ExpireFacts({200'000});
  ASSERT_EQ(kb.facts().size(), 1u);
  EXPECT_EQ(kb.facts().begin()->first, FactId{2});
}

}  // namespace
}  // namespace aerascope
