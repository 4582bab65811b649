// A Situation is what holds during one frame, seen or imagined: facts, instances of composite states, and what the
// requirement models say about them. Facts are found by key (kind of payload, then attribute, function or knowledge
// number, then object), so a pattern meets only facts that can match it.
//
// A value: simulation copies one and moves the copy to the next frame.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/event/event.h"

namespace aerascope {

struct SituationFact {
  FactId id;       // invalid for imagined facts
  Fact fact;
  EventId event;   // what made it known
  bool permanent = false;              // a property: holds in every frame
  std::vector<std::size_t> components;  // of an instance: its components, as positions in the situation
};

// A requirement model's word on a model in this situation.
struct Requirement {
  ModelId requirement;
  ModelId target;
  Fact imdl;                // its polarity tells a positive from a negative requirement
  EventId event;
  std::size_t from = 0;     // the fact (usually an instance) on its left side, as a position in the situation
};

class Situation {
 public:
  explicit Situation(TimeInterval interval) : interval_(interval) {}

  TimeInterval interval() const { return interval_; }
  const std::vector<SituationFact>& facts() const { return facts_; }
  const SituationFact& operator[](std::size_t i) const { return facts_[i]; }

  std::size_t Add(SituationFact fact);
  void Add(Requirement requirement) { requirements_.push_back(std::move(requirement)); }
  const std::vector<Requirement>& requirements() const { return requirements_; }
  void SetEvent(std::size_t fact, FactId id, EventId event);

  // Positions of the facts a payload pattern can match under bindings, ascending.
  const std::vector<std::size_t>& Candidates(const Term& payload, const Bindings& bindings) const;

  // The first fact that matches payload and polarity under a copy of bindings; npos if none.
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  std::size_t FindMatch(const Term& payload, bool positive, const Bindings& bindings) const;

  // The situation one period later if only `effects` change: what is not contradicted persists (semantics 3.1,
  // promotion). Instances, requirements and passing events (commands) do not carry over.
  Situation Successor(const std::vector<SituationFact>& effects, Duration period) const;

 private:
  struct Key {
    int kind = 0;              // head of the payload
    std::uint64_t what = 0;    // attribute, function, or number of the knowledge
    std::uint64_t object = 0;  // hash of the object; 0 = any
    auto operator<=>(const Key&) const = default;
  };
  static Key KeyOf(const Term& payload, const Bindings* bindings);

  TimeInterval interval_;
  std::vector<SituationFact> facts_;
  std::vector<Requirement> requirements_;
  std::map<Key, std::vector<std::size_t>> by_key_;
};

}  // namespace aerascope
