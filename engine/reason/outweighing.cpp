#include "engine/reason/outweighing.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "engine/kb/pattern_index.h"

namespace aerascope {
namespace {

// What speaks of the same thing and attribute, or at least is of one kind, lies in one crowd: only there can
// anything contradict.
using Crowd = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>;

Crowd CrowdOf(const Term& payload) {
  const PayloadSlots slots = PayloadSlots::Of(payload, nullptr);
  return {slots.kind, slots.slots[0], slots.slots[1]};
}

}  // namespace

std::vector<Outweighed> FindOutweighed(const KnowledgeBase& knowledge, PredictionId since) {
  const auto& open = knowledge.predictions();
  std::map<Crowd, std::vector<const PredictionRecord*>> crowds;
  for (auto it = open.upper_bound(since); it != open.end(); ++it) {
    if (it->second.target.confidence > 0) crowds.try_emplace(CrowdOf(it->second.target.payload));
  }
  if (crowds.empty()) return {};
  for (const auto& [id, prediction] : open) {
    if (prediction.target.confidence <= 0) continue;
    const auto crowd = crowds.find(CrowdOf(prediction.target.payload));
    if (crowd != crowds.end()) crowd->second.push_back(&prediction);
  }
  std::vector<Outweighed> found;
  for (auto& [crowd, predictions] : crowds) {
    std::stable_sort(predictions.begin(), predictions.end(), [](const auto* a, const auto* b) {
      return a->target.confidence > b->target.confidence;
    });
    std::set<PredictionId> fallen;
    for (auto surer = predictions.begin(); surer != predictions.end(); ++surer) {
      if (fallen.contains((*surer)->id)) continue;
      for (auto other = std::next(surer); other != predictions.end(); ++other) {
        if ((*other)->target.confidence >= (*surer)->target.confidence) continue;
        if ((*surer)->id <= since && (*other)->id <= since) continue;
        if (EvidenceFor((*surer)->target, (*other)->target) != EvidenceVerdict::kNegative) continue;
        if (fallen.insert((*other)->id).second) found.push_back({(*other)->id, (*surer)->id});
      }
    }
  }
  // Crowds are in the order of hashes.
  std::sort(found.begin(), found.end(), [&](const Outweighed& a, const Outweighed& b) {
    const double sure_a = open.at(a.prediction).target.confidence;
    const double sure_b = open.at(b.prediction).target.confidence;
    return sure_a != sure_b ? sure_a > sure_b : a.prediction < b.prediction;
  });
  return found;
}

}  // namespace aerascope
