#include "engine/kb/pattern_index.h"

namespace aerascope {
namespace {

// Numbers, instants and durations are equal within a tolerance: a hash does not tell.
bool HasTolerance(const Term& term) {
  if (term.is(TermKind::kNumber) || term.is(TermKind::kTime) || term.is(TermKind::kDuration)) return true;
  for (const Term& item : term.items()) {
    if (HasTolerance(item)) return true;
  }
  return false;
}

std::uint64_t SlotOf(const Term& term, const Bindings* bindings) {
  const Term* value = &term;
  if (bindings && term.is(TermKind::kVariable)) {
    value = bindings->Find(term.variable());
    if (!value) return PayloadSlots::kUnknown;
  }
  if (!value->ground()) return PayloadSlots::kUnknown;
  return HasTolerance(*value) ? PayloadSlots::kTolerant : value->hash() | 1;
}

}  // namespace

PayloadSlots PayloadSlots::Of(const Term& payload, const Bindings* bindings) {
  PayloadSlots found;
  found.kind = static_cast<std::uint64_t>(payload.payload_kind()) + 1;
  switch (payload.payload_kind()) {
    case PayloadKind::kValue:
      found.slots = {SlotOf(payload[1], bindings), SlotOf(payload[0], bindings),
                     SlotOf(payload[2], bindings)};
      found.used = 3;
      break;
    case PayloadKind::kIcst: {
      found.slots[0] = SlotOf(payload[0], bindings);
      // A list that is left open as a whole leaves each argument open; where a list ends is known.
      constexpr std::uint64_t kEnded = 1;
      const bool open = !payload[2].is(TermKind::kSet);
      for (std::size_t i = 0; i < 2; ++i) {
        const bool given = i < payload[2].size();
        found.slots[i + 1] = open ? kUnknown : given ? SlotOf(payload[2][i], bindings) : kEnded;
      }
      found.used = 3;
      break;
    }
    case PayloadKind::kCommand:
    case PayloadKind::kImdl:
      found.slots[0] = SlotOf(payload[0], bindings);
      found.used = 1;
      break;
    case PayloadKind::kOther:
      break;
  }
  return found;
}

}  // namespace aerascope
