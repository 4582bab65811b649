// Small minds for tests of planning: a few composite states and models written by hand, and frames of facts
// fed by hand.
#pragma once

#include <string>
#include <vector>

#include "engine/reason/reasoner.h"
#include "tests/engine/reason/pick_and_place.h"

namespace aerascope::toy {

inline constexpr Duration kFrame = Milliseconds(100);

inline Term E(const std::string& name) {
  return Term::Entity(name);
}
inline Term O(const std::string& name) {
  return Term::Ontology(name);
}
inline Term N(double value) {
  return Term::Number(value);
}
inline Term V(int index) {
  return Term::Variable(index);
}
inline Term None() {
  return Term::Set({});
}
inline Term Just(Term item) {
  return Term::Set({std::move(item)});
}
inline Term Value(Term object, const std::string& attribute, Term value) {
  return MakeValue(std::move(object), O(attribute), std::move(value));
}
inline Term Command(const std::string& function, std::vector<Term> arguments) {
  return MakeCommand(O(function), std::move(arguments));
}

// Components over the interval variables `after`, `after + 1`.
CompositeState State(std::int64_t id, std::vector<Term> payloads, int after);
// template [(ti v0 v1)], lhs [v4, v5) -> rhs [v6, v7) `frames` later; payloads use other variables.
Model Causal(std::int64_t id, Term lhs, Term rhs, int frames = 1);
// The same without a template: needs no requirement. RHS times follow those of the left side's frame.
Model Free(std::int64_t id, Term lhs, Term rhs);
// (icst or fact) [v_after, v_after+1) -> imdl or anti-imdl of the model.
Model Requires(std::int64_t id, Term condition, const Model& model, std::vector<Term> exposed, int after,
               bool positive = true);

class ToyMind {
 public:
  explicit ToyMind(ReasonerParameters parameters = {}) : reasoner(parameters, kFrame, &events) {}

  void Know(const std::vector<Term>& properties, const std::vector<CompositeState>& states,
            const std::vector<SeedModelDefinition>& models);
  void StartAt(std::int64_t frame) { frame_ = frame - 1; }
  // The next frame, with these facts for its duration.
  void See(const std::vector<Term>& payloads);
  // A drive that is open for so many frames from now.
  void Want(const Term& goal, int frames = 8, bool positive = true, double confidence = 1);
  // What it wants to do, as text; "" if nothing. The command is issued, and executed as asked.
  std::string Act();
  // The same without executing.
  std::string Wish();

  template <class Body>
  std::vector<const Body*> All() const {
    return events.All<Body>();
  }
  // The events of this kind in simulations, or outside.
  template <class Body>
  std::vector<const Event*> Found() const {
    std::vector<const Event*> found;
    for (const Event& event : events.events) {
      if (std::holds_alternative<Body>(event.body)) found.push_back(&event);
    }
    return found;
  }

  EventList events;
  Reasoner reasoner;

 private:
  std::int64_t frame_ = -1;
};

}  // namespace aerascope::toy
