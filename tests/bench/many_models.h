// A knowledge base with many conditions and models, of which the facts of a frame concern a few, whatever the
// number: the world of a grasping robot with very many kinds of things, of which twenty are in sight.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/event/apply.h"
#include "engine/reason/situation.h"

namespace aerascope {

inline constexpr int kThingsInSight = 20;

struct ManyModels {
  KnowledgeBase knowledge;
  std::int64_t triads = 0;
};

// `models` models: half requirement models, half causal models, and a composite state for each pair: a hand
// that holds nothing, and a thing of kind i and size i at the place of the hand.
inline ManyModels MakeManyModels(std::int64_t models) {
  ManyModels made;
  made.triads = models / 2;
  std::int64_t id = 0;
  std::int64_t event = 0;
  const auto apply = [&](EventBody body) {
    Apply({{++event}, {}, 0, {}, {}, std::move(body)}, &made.knowledge);
  };
  const auto v = [](int i) { return Term::Variable(i); };
  const auto component = [&](Term object, const char* attribute, Term value) {
    return FactPattern{true, MakeValue(std::move(object), Term::Ontology(attribute), std::move(value)), v(0),
                       v(1)};
  };
  for (std::int64_t i = 0; i < made.triads; ++i) {
    const std::string number = std::to_string(i);
    CompositeState state{
        {++id},
        {component(v(2), "holding", Term::Set({})), component(v(3), "kind", Term::Ontology("kind" + number)),
         component(v(3), "size", Term::Ontology("size" + number)), component(v(3), "place", v(4)),
         component(v(2), "place", v(4))},
        {},
        {}};
    apply(CompositeStateCreated{state, Origin::kSeed, {}});
    Model causal;
    causal.id = {++id};
    causal.lhs = {true, MakeCommand(Term::Ontology("grab" + number), {v(0)}), v(1), v(2)};
    causal.rhs = {true, MakeValue(v(0), Term::Ontology("holding"), Term::Set({v(3)})), v(4), v(5)};
    apply(ModelCreated{causal, {}, false, Origin::kSeed, {}});
    Model requirement;
    requirement.id = {++id};
    requirement.lhs = {true, MakeIcst(state.id, {}, {v(0), v(1), v(2)}), v(3), v(4)};
    requirement.rhs = {true, MakeImdl(causal.id, {}, {v(0), v(1), v(5), v(6)}), v(3), v(4)};
    apply(ModelCreated{requirement, {}, false, Origin::kSeed, {}});
  }
  return made;
}

// What is seen in one frame: the hand, and things of `kThingsInSight` kinds, spread over all kinds that are
// known.
struct SeenThing {
  std::string name;
  std::int64_t kind = 0;
  std::int64_t place = 0;
};
inline std::vector<SeenThing> ThingsInSight(const ManyModels& many, std::int64_t frame) {
  std::vector<SeenThing> things;
  for (int i = 0; i < kThingsInSight; ++i) {
    things.push_back(
        {"thing" + std::to_string(i), (i * 7919 + (frame + i) / kThingsInSight * 31) % many.triads, i % 4});
  }
  return things;
}
inline constexpr int kFactsInFrame = 2 + 3 * kThingsInSight;

inline Situation SeeFrame(const ManyModels& many, std::int64_t frame) {
  const TimeInterval interval{{frame * 100'000}, {(frame + 1) * 100'000}};
  Situation situation(interval);
  const auto see = [&](Term object, const char* attribute, Term value) {
    SituationFact fact;
    fact.fact = {true, MakeValue(std::move(object), Term::Ontology(attribute), std::move(value)), interval,
                 1};
    situation.Add(std::move(fact));
  };
  const auto place = [](std::int64_t i) { return Term::Entity("place" + std::to_string(i)); };
  see(Term::Entity("h"), "holding", Term::Set({}));
  see(Term::Entity("h"), "place", place(frame % 4));
  for (const SeenThing& thing : ThingsInSight(many, frame)) {
    const Term object = Term::Entity(thing.name);
    see(object, "kind", Term::Ontology("kind" + std::to_string(thing.kind)));
    see(object, "size", Term::Ontology("size" + std::to_string(thing.kind)));
    see(object, "place", place(thing.place));
  }
  return situation;
}

}  // namespace aerascope
