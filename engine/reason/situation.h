// A Situation is what holds during one frame, seen or imagined: facts, instances of composite states, and
// what the requirement models say about them. Facts are found by key (kind of payload, then attribute,
// function or knowledge number, then object, then value), so a pattern meets only facts that can match it.
//
// A value: simulation copies one and moves the copy to the next frame. Copies share their content until one
// changes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/flat_multimap.h"
#include "engine/event/event.h"

namespace aerascope {

struct SituationFact {
  FactId id;  // invalid for imagined facts
  Fact fact;
  EventId event;                        // what made it known
  bool permanent = false;               // a property: holds in every frame
  std::vector<std::size_t> components;  // of an instance: its components, as positions in the situation
  bool concluded = false;               // an absence, concluded from what was expected and did not come
};

// A requirement model's word on a model in this situation.
struct Requirement {
  ModelId requirement;
  ModelId target;
  Fact imdl;  // its polarity tells a positive from a negative requirement
  EventId event;
  // The fact (usually an instance) on its left side, as a position in the situation; npos if that was another
  // situation.
  std::size_t from = 0;
  // What requirement models on this one said here, as positions in the situation's requirements. If they do
  // not allow it to speak, it speaks with confidence 0.
  std::vector<std::size_t> above = {};
  bool allowed = true;
};

class Situation {
 public:
  explicit Situation(TimeInterval interval);

  TimeInterval interval() const { return interval_; }
  const std::vector<SituationFact>& facts() const { return content_->facts; }
  const SituationFact& operator[](std::size_t i) const { return content_->facts[i]; }

  std::size_t Add(SituationFact fact);
  void Add(Requirement requirement);
  const std::vector<Requirement>& requirements() const { return content_->requirements; }
  void SetEvent(std::size_t fact, FactId id, EventId event);

  using Positions = FlatMultimap<std::uint32_t>::Range;
  // Positions of the facts a payload pattern can match under bindings, ascending. Good until the next change.
  Positions Candidates(const Term& payload, const Bindings& bindings) const;
  // Positions of the requirements that speak about a model, ascending.
  Positions RequirementsOn(ModelId target) const;

  // The first fact that matches payload and polarity under a copy of bindings; npos if none.
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
  std::size_t FindMatch(const Term& payload, bool positive, const Bindings& bindings) const;

 private:
  struct Content {
    std::vector<SituationFact> facts;
    std::vector<Requirement> requirements;
    FlatMultimap<std::uint32_t> facts_by_key;
    FlatMultimap<std::uint32_t> requirements_by_target;
  };
  Content& Own();  // a content that no copy shares

  TimeInterval interval_;
  std::shared_ptr<Content> content_;  // shared by copies until one of them changes
};

}  // namespace aerascope
