#include "viewer/draw/key_moments.h"

#include <algorithm>
#include <array>
#include <map>

#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

constexpr std::size_t kKinds = 4;  // without the start
constexpr std::array<double, kKinds> kWeights = {6, 4, 4, 3.5};
// How much less each further one of a kind weighs.
constexpr std::array<double, kKinds> kWear = {0.2, 0.5, 1, 1};

// All candidates, one a frame (what happens in one frame is seen on one picture): the weightiest kind, and of
// that the first event.
std::vector<KeyMoment> Candidates(const Run& run, const EpisodeSummary& summary) {
  std::map<std::size_t, KeyMoment> by_frame;
  const auto add = [&](Time at, MomentKind kind, EventId event) {
    const std::optional<std::size_t> frame = run.FrameAt(at);
    if (frame) at = run.frames()[*frame].interval.after;
    const auto [found, fresh] = by_frame.emplace(frame.value_or(0), KeyMoment{at, kind, event, ""});
    if (!fresh && kind < found->second.kind) found->second = {at, kind, event, ""};
  };
  for (const DriveOutcome& drive : summary.drives) {
    if (drive.outcome == Outcome::kReached) add(drive.until, MomentKind::kGoalReached, drive.outcome_event);
    if (drive.outcome == Outcome::kFailed) add(drive.until, MomentKind::kGoalFailed, drive.outcome_event);
  }
  for (const AnalogyOfRun& analogy : summary.analogies) {
    if (analogy.made_knowledge) add(analogy.time, MomentKind::kAnalogy, analogy.event);
  }
  for (const ModelId id : summary.learned) {
    const ModelRecord* record = run.final_knowledge().Find(id);
    if (record != nullptr && record->origin != Origin::kAnalogy)
      add(record->created, MomentKind::kLearned, record->event);
  }
  std::vector<KeyMoment> candidates;
  for (auto& [frame, moment] : by_frame) candidates.push_back(std::move(moment));
  return candidates;
}

// Picks candidates one by one: of each kind the first, then the one farthest in time from all of that kind
// picked before.
class Picker {
 public:
  explicit Picker(const std::vector<KeyMoment>& candidates)
      : candidates_(candidates),
        picked_(candidates.size(), false),
        distance_(candidates.size(), kForever.us) {}

  bool Pick() {
    std::size_t best = candidates_.size();
    double best_weight = 0;
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      const std::size_t next = Farthest(static_cast<MomentKind>(kind));
      const double weight = kWeights[kind] / (1 + kWear[kind] * count_[kind]);
      if (next == candidates_.size() || weight <= best_weight) continue;
      best = next;
      best_weight = weight;
    }
    if (best == candidates_.size()) return false;
    picked_[best] = true;
    count_[static_cast<std::size_t>(candidates_[best].kind)] += 1;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (candidates_[i].kind != candidates_[best].kind) continue;
      const std::int64_t away = (candidates_[i].at - candidates_[best].at).us;
      distance_[i] = std::min(distance_[i], away < 0 ? -away : away);
    }
    return true;
  }

  std::vector<KeyMoment> Picked() const {
    std::vector<KeyMoment> moments;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (picked_[i]) moments.push_back(candidates_[i]);
    }
    return moments;
  }

 private:
  std::size_t Farthest(MomentKind kind) const {
    std::size_t best = candidates_.size();
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (picked_[i] || candidates_[i].kind != kind) continue;
      if (best == candidates_.size() || distance_[i] > distance_[best]) best = i;
    }
    return best;
  }

  const std::vector<KeyMoment>& candidates_;
  std::vector<bool> picked_;
  std::vector<std::int64_t> distance_;  // to the nearest one of its kind that is picked
  std::array<double, kKinds> count_ = {};
};

std::string CaptionOf(const Run& run, const KeyMoment& moment) {
  if (const Event* event = run.Find(moment.event)) return InPrint(SentenceOf(run, *event));
  const std::optional<std::size_t> frame = run.FrameAt(moment.at);
  return frame ? InPrint(SentenceOfFrame(run, *frame)) : "";
}

std::vector<KeyMoment> FirstAndLastFrame(const Run& run, std::size_t max) {
  std::vector<KeyMoment> moments;
  if (run.frames().empty() || max == 0) return moments;
  moments.push_back({run.frames().front().interval.after, MomentKind::kStart, {}, ""});
  if (run.frames().size() > 1 && max > 1) {
    moments.push_back({run.frames().back().interval.after, MomentKind::kStart, {}, ""});
  }
  return moments;
}

}  // namespace

std::vector<KeyMoment> KeyMomentsOf(const Run& run, std::size_t max) {
  const std::vector<KeyMoment> candidates = Candidates(run, Summarise(run));
  Picker picker(candidates);
  for (std::size_t n = 0; n < max && picker.Pick(); ++n) {
  }
  std::vector<KeyMoment> moments = candidates.empty() ? FirstAndLastFrame(run, max) : picker.Picked();
  for (KeyMoment& moment : moments) moment.caption = CaptionOf(run, moment);
  return moments;
}

std::vector<KeyMoment> MomentsAt(const Run& run, const std::vector<Time>& times) {
  const std::vector<KeyMoment> candidates = Candidates(run, Summarise(run));
  std::vector<KeyMoment> moments;
  for (const Time at : times) {
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const KeyMoment& candidate) {
      return run.FrameAt(candidate.at) == run.FrameAt(at);
    });
    moments.push_back(found != candidates.end() ? *found : KeyMoment{at, MomentKind::kStart, {}, ""});
    moments.back().at = at;
    moments.back().caption = CaptionOf(run, moments.back());
  }
  return moments;
}

std::vector<Time> KeyMoments(const Run& run, std::size_t max) {
  std::vector<Time> times;
  for (const KeyMoment& moment : KeyMomentsOf(run, max)) times.push_back(moment.at);
  return times;
}

}  // namespace aerascope
