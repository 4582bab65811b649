// Typed identifiers: a number that says what it numbers, so that swapped ids do not compile.
//
// All objects of one episode (facts, goals, predictions, composite states, models, simulations) share one
// numbering, counted from 1 in order of creation; `cst_12` and `mdl_12` never both exist. Events have their
// own numbering, the position in the log, also from 1. Zero means "none".
#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace aerascope {

template <class Tag>
struct Id {
  std::int64_t value = 0;

  constexpr bool valid() const { return value != 0; }
  constexpr auto operator<=>(const Id&) const = default;
};

using EventId = Id<struct EventIdTag>;
using FactId = Id<struct FactIdTag>;
using GoalId = Id<struct GoalIdTag>;
using PredictionId = Id<struct PredictionIdTag>;
using CompositeStateId = Id<struct CompositeStateIdTag>;
using ModelId = Id<struct ModelIdTag>;
using SimulationId = Id<struct SimulationIdTag>;

}  // namespace aerascope

template <class Tag>
struct std::hash<aerascope::Id<Tag>> {
  std::size_t operator()(aerascope::Id<Tag> id) const noexcept { return std::hash<std::int64_t>{}(id.value); }
};
