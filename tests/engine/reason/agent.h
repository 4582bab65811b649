// An agent told by hand what it senses and what is done: frames of 100 ms, one after the other.
#pragma once

#include <string>
#include <vector>

#include "engine/reason/reasoner.h"
#include "tests/engine/kb/build_terms.h"
#include "tests/engine/reason/pick_and_place.h"

namespace aerascope {

class Agent {
 public:
  explicit Agent(const std::vector<Fact>& properties = {}, const std::vector<CompositeState>& states = {},
                 const std::vector<SeedModelDefinition>& models = {}, ReasonerParameters parameters = {})
      : reasoner(parameters, Milliseconds(100), &events) {
    reasoner.LoadSeed({}, properties, states, models);
  }

  // Begins the next frame, in which these payloads hold.
  void Sense(const std::vector<Term>& payloads) {
    std::vector<Fact> facts;
    for (const Term& payload : payloads) facts.push_back(Holds(payload, NextFrame()));
    SenseFacts(facts);
  }
  void SenseFacts(const std::vector<Fact>& facts) {
    ++frame;
    reasoner.BeginFrame(frame, facts);
  }
  // A value held until changed: it starts 20 ms into the next frame, so that it can be a cause.
  Fact Hold(Term payload) const {
    TimeInterval interval = NextFrame();
    interval.after = interval.after + Milliseconds(20);
    return Holds(std::move(payload), interval);
  }
  TimeInterval NextFrame() const { return Ms((frame + 1) * 100, (frame + 2) * 100); }
  // A teacher's command is carried out in this frame.
  void Do(const Term& command) {
    reasoner.Executed(command, reasoner.CommandIssued(command, Commander::kTeacher, {}, {}));
  }

  const KnowledgeBase& kb() const { return reasoner.knowledge(); }
  // The known equal of a definition, or null. Names of variables do not matter.
  const ModelRecord* Find(const Model& model) const {
    return kb().Find(kb().FindModel(kb().CanonicalOf(model).hash));
  }
  const CompositeStateRecord* Find(const CompositeState& state) const {
    return kb().Find(kb().FindState(kb().CanonicalOf(state).hash));
  }
  std::vector<const ModelRecord*> Models(ModelKind kind) const {
    std::vector<const ModelRecord*> found;
    for (const auto& [id, record] : kb().models()) {
      if (KindOf(record.model) == kind) found.push_back(&record);
    }
    return found;
  }
  // All that is known, for messages.
  std::string Text() const {
    std::string text;
    for (const auto& [id, record] : kb().composite_states()) text += ToText(record.state) + "\n";
    for (const auto& [id, record] : kb().models()) text += ToText(record.model) + "\n";
    return text;
  }

  EventList events;
  Reasoner reasoner;
  std::int64_t frame = -1;
};

// ---- terms

inline Term Val(const char* object, const char* attribute, Term value) {
  return MakeValue(E(object), O(attribute), std::move(value));
}
inline Term Cmd(const char* function, std::vector<Term> arguments) {
  return MakeCommand(O(function), std::move(arguments));
}
inline Term Ti(Term after, Term before) {
  return Struct("ti", {std::move(after), std::move(before)});
}

inline Guard Assign(int target, const char* op, Term a, Term b) {
  return {target, Struct(op, {std::move(a), std::move(b)})};
}

// A state of {first, second, ...} over the interval variables `after` and `after + 1`.
inline CompositeState State(std::int64_t id, int after, std::vector<Term> payloads) {
  CompositeState state;
  state.id = CompositeStateId{id};
  for (Term& payload : payloads)
    state.components.push_back({true, std::move(payload), V(after), V(after + 1)});
  return state;
}

// S0: a hand H at P. Arguments [H P].
inline CompositeState HandAt(std::int64_t id) {
  return State(id, 1, {MakeValue(V(0), O("essence"), O("hand")), MakeValue(V(0), O("position"), V(3))});
}
// S3, S4: a thing C of some attribute X at P. Arguments [C X P].
inline CompositeState ThingAt(std::int64_t id, const char* attribute) {
  return State(id, 2, {MakeValue(V(0), O(attribute), V(1)), MakeValue(V(0), O("position"), V(4))});
}

}  // namespace aerascope
