// Events of every kind with varied values in every field, made from a seed through the events' own
// description, so that a new kind or field is covered without a change here.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "engine/event/event.h"
#include "engine/event/report_kinds.h"

namespace aerascope {

class AnyEvents {
 public:
  explicit AnyEvents(std::uint64_t seed) : random_(seed) {}

  std::int64_t Below(std::int64_t limit) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(limit));
  }
  bool Chance() { return (random_() & 1) != 0; }

  // Names as they come, and names made to break readers.
  std::string Name();
  double Real();
  std::int64_t Integer();
  Time Instant() { return Below(10) == 0 ? kForever : Time{Below(100'000'000) - 1'000'000}; }
  TimeInterval Interval() { return {Instant(), Instant()}; }
  Term AnyTerm(int depth = 3);
  std::vector<Term> AnyTerms(int depth);

  Event AnyEvent(std::int64_t id, std::size_t kind);
  Event AnyEvent(std::int64_t id) { return AnyEvent(id, static_cast<std::size_t>(Below(kEventKinds))); }

  // A body by the place of its kind in EventBody, or by its type.
  EventBody AnyBody(std::size_t kind);
  template <class Body>
  Body AnyBody() {
    return std::get<Body>(AnyBody(KindOf<Body>()));
  }

 private:
  std::mt19937_64 random_;
};

// Every field is equal, bit for bit.
bool SameContent(const EventBody& a, const EventBody& b);
bool SameContent(const Event& a, const Event& b);
bool SameContent(const std::vector<Event>& a, const std::vector<Event>& b);

}  // namespace aerascope
