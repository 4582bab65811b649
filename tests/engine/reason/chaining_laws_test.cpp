// Laws of forward chaining, against a reference that tries every way to put facts to components.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "engine/reason/chaining.h"
#include "tests/engine/reason/pick_and_place.h"
#include "tests/support/law.h"

namespace aerascope {
namespace {

constexpr TimeInterval kFrame{{100'000}, {200'000}};

Term V(int index) {
  return Term::Variable(index);
}

// Facts about few things and values, so that many match; conditions of up to four components over them.
class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}

  int Below(int limit) { return static_cast<int>(random_() % static_cast<std::uint64_t>(limit)); }
  Term Thing() { return Term::Entity(std::string(1, static_cast<char>('a' + Below(3)))); }
  Term Attribute() { return Term::Ontology(Below(2) == 0 ? "position" : "size"); }
  Term Value() {
    if (Below(4) == 0) return Term::Set({Thing()});
    return Below(2) == 0 ? Term::Number(Below(2)) : Term::Ontology("large");
  }

  Fact AnyFact() {
    Fact fact{Below(10) > 0, MakeValue(Thing(), Attribute(), Value()), kFrame, (1 + Below(4)) / 4.0};
    if (Below(3) == 0) fact.interval.after.us += 10'000 * (1 + Below(9));
    if (Below(3) == 0) fact.interval.before.us = fact.interval.after.us + 10'000 * (1 + Below(6));
    return fact;
  }

  // Variables 0 and 1 are the interval's.
  CompositeState AnyState(std::int64_t id, const std::vector<CompositeState>& inner) {
    CompositeState state{{id}, {}, {}, {}};
    for (int i = 1 + Below(4); i > 0; --i) {
      Term payload = MakeValue(Below(3) > 0 ? V(2 + Below(3)) : Thing(), Attribute(), AnyPattern());
      if (!inner.empty() && Below(3) == 0) {
        const CompositeState& nested = inner[static_cast<std::size_t>(Below(static_cast<int>(inner.size())))];
        std::vector<Term> arguments;
        for (std::size_t k = 0; k < ArgumentVariables(nested).size(); ++k) arguments.push_back(AnyPattern());
        payload = MakeIcst(nested.id, {}, std::move(arguments));
      }
      state.components.push_back({Below(10) > 0, std::move(payload), V(0), V(1)});
    }
    if (Below(6) == 0) {
      // A test on variables that the components bind, if there are two; one that is never bound always fails.
      state.guards.push_back(
          {std::nullopt, Term::Struct(Below(2) == 0 ? "<>" : "<", {V(2 + Below(6)), V(2 + Below(6))})});
    }
    return state;
  }

 private:
  Term AnyPattern() {
    switch (Below(6)) {
      case 0:
        return Value();
      case 1:
        return Term::Set({V(2 + Below(3))});
      case 2:
        return Term::Wildcard();
      default:
        return Below(5) == 0 ? V(2 + Below(3)) : V(5 + Below(3));
    }
  }

  std::mt19937_64 random_;
};

// One fact for each component, each fact once, all of them one after the other.
class Reference {
 public:
  Reference(const CompositeState& state, const std::vector<Fact>& facts) : state_(state), facts_(facts) {
    Try({});
  }

  struct Joint {
    std::vector<std::size_t> facts;
    Term instance;
    TimeInterval interval;
    double confidence = 1;
  };
  std::vector<Joint> Joints() && { return std::move(joints_); }

 private:
  void Try(std::vector<std::size_t> chosen) {
    if (chosen.size() == state_.components.size()) return Judge(chosen);
    for (std::size_t i = 0; i < facts_.size(); ++i) {
      if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
      chosen.push_back(i);
      Try(chosen);
      chosen.pop_back();
    }
  }

  void Judge(const std::vector<std::size_t>& chosen) {
    Bindings bindings;
    TimeInterval interval = kAlways;
    double confidence = 1;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const Fact& fact = facts_[chosen[k]];
      const FactPattern& pattern = state_.components[k];
      if (fact.positive != pattern.positive || !Match(pattern.payload, fact.payload, bindings)) return;
      const auto common = Intersection(interval, fact.interval);
      if (!common) return;
      interval = *common;
      confidence = std::min(confidence, fact.confidence);
    }
    bindings.Set(0, Term::Instant(interval.after));
    bindings.Set(1, Term::Instant(interval.before));
    if (!RunGuards(state_.guards, bindings)) return;
    joints_.push_back({chosen, InstancePayload(state_, bindings), interval, confidence});
  }

  const CompositeState& state_;
  const std::vector<Fact>& facts_;
  std::vector<Joint> joints_;
};

// Own: the semantics' specification of the join (3.1).
TEST(ChainingLaws, AJoinGivesEachJointlyUnifyingChoiceOfFactsOnce) {
  std::int64_t found = 0;
  EXPECT_TRUE(Holds(5000, [&](std::uint64_t number) {
    Random random(number);
    std::vector<Fact> facts;
    for (int i = 2 + random.Below(7); i > 0; --i) facts.push_back(random.AnyFact());
    const CompositeState state = random.AnyState(1, {});
    Situation situation(kFrame);
    for (const Fact& fact : facts) situation.Add(SituationFact{{}, fact, {}, false, {}});

    std::multiset<std::vector<std::size_t>> expected;
    for (const Reference::Joint& joint : Reference(state, facts).Joints()) expected.insert(joint.facts);
    std::multiset<std::vector<std::size_t>> joined;
    for (const JointMatch& match : JointMatches(state, situation, {})) joined.insert(match.facts);
    RC_ASSERT(joined == expected);
    found += static_cast<std::int64_t>(expected.size());
  }));
  EXPECT_GT(found, CasesToTry(1000)) << "hardly anything matched, so nothing was tested";
}

// Own: and in the whole, with properties, nested composite states, and what the events say.
TEST(ChainingLaws, OneIcstForEachDistinctInstanceThatHolds) {
  std::int64_t found = 0;
  EXPECT_TRUE(Holds(3000, [&](std::uint64_t number) {
    Random random(number);
    std::vector<CompositeState> states;
    for (int i = 1 + random.Below(3); i > 0; --i)
      states.push_back(random.AnyState(static_cast<std::int64_t>(states.size()) + 1, states));
    std::vector<Fact> properties;
    for (int i = random.Below(3); i > 0; --i) {
      properties.push_back(random.AnyFact());
      properties.back().interval = kAlways;
    }
    std::vector<Fact> sensed;
    for (int i = 2 + random.Below(5); i > 0; --i) sensed.push_back(random.AnyFact());
    EventList events;
    Reasoner reasoner({}, Milliseconds(100), &events);
    reasoner.LoadSeed({}, properties, states, {});
    reasoner.BeginFrame(1, sensed);

    // What the events say: the facts, instances among them, in order; and the numbers the states have here.
    std::vector<Fact> facts;
    std::map<std::int64_t, std::vector<const IcstFound*>> instances;
    for (const Event& event : events.events) {
      if (const auto* fact = std::get_if<FactObserved>(&event.body)) facts.push_back(fact->fact);
      if (const auto* instance = std::get_if<IcstFound>(&event.body)) {
        facts.push_back(instance->fact);
        instances[instance->fact.payload[0].composite_state().value].push_back(instance);
      }
    }
    for (const auto& [id, record] : reasoner.knowledge().composite_states()) {
      std::map<std::string, std::vector<Reference::Joint>> expected;  // by what the instance says
      for (const Reference::Joint& joint : Reference(record.state, facts).Joints()) {
        // An instance with open arguments says nothing.
        if (joint.instance.ground()) expected[ToText(joint.instance)].push_back(joint);
      }
      std::set<std::string> said;
      for (const IcstFound* instance : instances[id.value]) {
        const std::string text = ToText(instance->fact.payload);
        RC_ASSERT(said.insert(text).second);
        // Over the common interval of facts that make it true, as sure as the least of them.
        const auto& joints = expected[text];
        RC_ASSERT(std::any_of(joints.begin(), joints.end(), [&](const Reference::Joint& joint) {
          return joint.interval == instance->fact.interval && joint.confidence == instance->fact.confidence;
        }));
      }
      RC_ASSERT(said.size() == expected.size());
      found += static_cast<std::int64_t>(said.size());
    }
  }));
  EXPECT_GT(found, CasesToTry(1000)) << "hardly anything held, so nothing was tested";
}

}  // namespace
}  // namespace aerascope
