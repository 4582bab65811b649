#include "engine/reason/situation.h"

#include "engine/kb/pattern_index.h"

namespace aerascope {
namespace {

// The entry of a slot for patterns that leave it open.
constexpr std::uint64_t kOpen = pattern_index::kOpen;

}  // namespace

Situation::Situation(TimeInterval interval) : interval_(interval), content_(std::make_shared<Content>()) {}

Situation::Content& Situation::Own() {
  if (content_.use_count() != 1) content_ = std::make_shared<Content>(*content_);
  return *content_;
}

std::size_t Situation::Add(SituationFact fact) {
  Content& content = Own();
  const auto position = static_cast<std::uint32_t>(content.facts.size());
  const PayloadSlots own = PayloadSlots::Of(fact.fact.payload, nullptr);
  // Stored under each key a pattern may ask with: every slot known or open.
  for (int choice = 0; choice < 1 << own.used; ++choice) {
    std::array<std::uint64_t, 3> slots = own.slots;
    bool distinct = true;
    for (int i = 0; i < own.used; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      if ((choice >> i & 1) == 0) continue;
      distinct = distinct && PayloadSlots::IsExact(slots[slot]);
      slots[slot] = PayloadSlots::kUnknown;
    }
    if (!distinct) continue;
    for (std::uint64_t& slot : slots) slot = PayloadSlots::IsExact(slot) ? slot : kOpen;
    content.facts_by_key.Add(pattern_index::Key(own.kind, slots, own.used), position);
  }
  content.facts.push_back(std::move(fact));
  return position;
}

void Situation::Add(Requirement requirement) {
  Content& content = Own();
  content.requirements_by_target.Add(static_cast<std::uint64_t>(requirement.target.value),
                                     static_cast<std::uint32_t>(content.requirements.size()));
  content.requirements.push_back(std::move(requirement));
}

void Situation::SetEvent(std::size_t fact, FactId id, EventId event) {
  Content& content = Own();
  content.facts[fact].id = id;
  content.facts[fact].event = event;
}

Situation::Positions Situation::Candidates(const Term& payload, const Bindings& bindings) const {
  PayloadSlots wanted = PayloadSlots::Of(payload, &bindings);
  for (std::uint64_t& slot : wanted.slots) slot = PayloadSlots::IsExact(slot) ? slot : kOpen;
  return content_->facts_by_key.Find(pattern_index::Key(wanted.kind, wanted.slots, wanted.used));
}

Situation::Positions Situation::RequirementsOn(ModelId target) const {
  return content_->requirements_by_target.Find(static_cast<std::uint64_t>(target.value));
}

std::size_t Situation::FindMatch(const Term& payload, bool positive, const Bindings& bindings) const {
  const Positions candidates = Candidates(payload, bindings);
  if (candidates.empty()) return npos;
  Bindings trial = bindings;
  for (const std::size_t i : candidates) {
    if (facts()[i].fact.positive != positive) continue;
    const Bindings::Mark mark = trial.Save();
    if (Match(payload, facts()[i].fact.payload, trial)) return i;
    trial.Restore(mark);
  }
  return npos;
}

}  // namespace aerascope
