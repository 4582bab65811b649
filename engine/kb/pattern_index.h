// The PatternIndex finds, among many patterns, the few that a payload can match, without looking at the
// others (alpha index, semantics 11.2).
//
// A payload has up to three slots that tell it from others: what it speaks of (attribute, function,
// knowledge), the object, and the value. A pattern with a variable in a slot fits any payload there; a
// payload with a variable or wildcard in a slot (a goal) fits any pattern there. What is found is a superset
// of what matches: values that are compared with a tolerance are not told apart here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "engine/base/flat_multimap.h"
#include "engine/kb/match.h"

namespace aerascope {

// The slots of a payload as hashes, which are odd.
struct PayloadSlots {
  static constexpr std::uint64_t kUnknown = 0;   // a variable or wildcard stands there
  static constexpr std::uint64_t kTolerant = 8;  // a number or time: equal to others that are near
  static bool IsExact(std::uint64_t slot) { return (slot & 1) != 0; }

  std::uint64_t kind = 0;
  std::array<std::uint64_t, 3> slots{};  // what, object, value
  int used = 0;                          // slots this kind of payload has
  int exact() const {
    return static_cast<int>(IsExact(slots[0])) + static_cast<int>(IsExact(slots[1])) +
           static_cast<int>(IsExact(slots[2]));
  }

  // Variables that `bindings` binds count as their values; null for none.
  static PayloadSlots Of(const Term& payload, const Bindings* bindings);
};

namespace pattern_index {

inline constexpr std::uint64_t kAny = 2;   // the pattern has a variable there
inline constexpr std::uint64_t kOpen = 4;  // for payloads that leave the slot open

inline std::uint64_t Key(std::uint64_t kind, const std::array<std::uint64_t, 3>& slots, int used) {
  std::uint64_t key = kind * 0x9e3779b97f4a7c15ULL;
  for (int i = 0; i < used; ++i) {
    key = (key ^ slots[static_cast<std::size_t>(i)]) * 0x9fb21c651e98df25ULL;
    key ^= key >> 32;
  }
  return key;
}

}  // namespace pattern_index

// `Owner` tells what a pattern belongs to. kForOpenPayloads: payloads may leave slots open; costs up to eight
// entries a pattern instead of one.
template <class Owner, bool kForOpenPayloads>
class PatternIndex {
 public:
  void Add(const Term& pattern, Owner owner) {
    ForEachKey(pattern, [&](std::uint64_t key) { owners_.Add(key, owner); });
  }
  void Remove(const Term& pattern, Owner owner) {
    ForEachKey(pattern, [&](std::uint64_t key) { owners_.Remove(key, owner); });
  }

  // How many patterns lie where this one would: what a payload that matches it has to look through.
  std::size_t CrowdAt(const Term& pattern) const {
    std::size_t crowd = 0;
    bool first = true;
    ForEachKey(pattern, [&](std::uint64_t key) {
      if (std::exchange(first, false)) crowd = owners_.Find(key).size();
    });
    return crowd;
  }

  // Calls visit(owner) for each pattern the payload can match.
  template <class Visit>
  void Find(const Term& payload, Visit&& visit) const {
    const PayloadSlots query = PayloadSlots::Of(payload, nullptr);
    std::array<std::uint64_t, 3> slots{};
    for (int choice = 0; choice < 1 << query.used; ++choice) {
      bool wanted = true;
      for (int i = 0; i < query.used; ++i) {
        const auto slot = static_cast<std::size_t>(i);
        const bool any = (choice >> i & 1) != 0;
        if (query.slots[slot] == PayloadSlots::kUnknown) {
          // Open in the payload: one look finds all patterns. Without such entries nothing is found.
          wanted = wanted && !any;
          slots[slot] = pattern_index::kOpen;
        } else if (query.slots[slot] == PayloadSlots::kTolerant) {
          wanted = wanted && !any;
          slots[slot] = pattern_index::kAny;
        } else {
          slots[slot] = any ? pattern_index::kAny : query.slots[slot];
        }
      }
      if (!wanted) continue;
      for (const Owner& owner : owners_.Find(pattern_index::Key(query.kind, slots, query.used))) visit(owner);
    }
  }

 private:
  template <class Use>
  void ForEachKey(const Term& pattern, Use&& use) const {
    const PayloadSlots own = PayloadSlots::Of(pattern, nullptr);
    std::array<std::uint64_t, 3> slots{};
    for (int choice = 0; choice < (kForOpenPayloads ? 1 << own.used : 1); ++choice) {
      for (int i = 0; i < own.used; ++i) {
        const auto slot = static_cast<std::size_t>(i);
        if (choice >> i & 1) {
          slots[slot] = pattern_index::kOpen;
        } else {
          slots[slot] = PayloadSlots::IsExact(own.slots[slot]) ? own.slots[slot] : pattern_index::kAny;
        }
      }
      use(pattern_index::Key(own.kind, slots, own.used));
    }
  }

  FlatMultimap<Owner> owners_;
};

}  // namespace aerascope
