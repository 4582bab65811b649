#include "viewer/draw/key_moments.h"

#include <algorithm>
#include <array>
#include <set>

#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

// How telling the first of a kind is, and how much less each further one weighs: a failure and what was made
// of it before what was reached, that before an analogy, that before a first lesson; repeats last.
constexpr std::array<double, kMomentKinds> kWeights = {7, 6, 4, 4, 4.5, 3.5, 1.2};
constexpr std::array<double, kMomentKinds> kWear = {0.25, 0.2, 0.5, 1, 1, 1, 0.5};

std::vector<KeyMoment> Candidates(const Run& run, const EpisodeSummary& summary) {
  std::vector<KeyMoment> candidates;
  for (StoryMoment& moment : StoryOf(run, summary)) {
    for (std::string& sentence : moment.sentences) sentence = InPrint(sentence);
    candidates.push_back(
        {run.frames()[moment.frame].interval.after, moment.kind, moment.event, std::move(moment.sentences)});
  }
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
    for (std::size_t kind = 0; kind < kMomentKinds; ++kind) {
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
  std::array<double, kMomentKinds> count_ = {};
};

// A frame of which there is nothing telling to say.
KeyMoment Plain(const Run& run, Time at) {
  KeyMoment moment{at, MomentKind::kStart, {}, {}};
  if (const std::optional<std::size_t> frame = run.FrameAt(at))
    moment.sentences.push_back(InPrint(SentenceOfFrame(run, *frame)));
  return moment;
}

std::vector<KeyMoment> FirstAndLastFrame(const Run& run, std::size_t max) {
  std::vector<KeyMoment> moments;
  if (run.frames().empty() || max == 0) return moments;
  moments.push_back(Plain(run, run.frames().front().interval.after));
  if (run.frames().size() > 1 && max > 1) moments.push_back(Plain(run, run.frames().back().interval.after));
  return moments;
}

}  // namespace

KeyStory KeyMomentsOf(const Run& run, std::size_t max) {
  const std::vector<KeyMoment> candidates = Candidates(run, Summarise(run));
  Picker picker(candidates);
  for (std::size_t n = 0; n < max && picker.Pick(); ++n) {
  }
  KeyStory story{candidates.empty() ? FirstAndLastFrame(run, max) : picker.Picked(), 0};
  if (!candidates.empty()) story.left_out = candidates.size() - story.moments.size();
  return story;
}

KeyStory MomentsAt(const Run& run, const std::vector<Time>& times) {
  const std::vector<KeyMoment> candidates = Candidates(run, Summarise(run));
  KeyStory story;
  std::set<Time> told;
  for (const Time at : times) {
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const KeyMoment& candidate) {
      return run.FrameAt(candidate.at) == run.FrameAt(at);
    });
    if (found != candidates.end()) told.insert(found->at);
    story.moments.push_back(found != candidates.end() ? *found : Plain(run, at));
    story.moments.back().at = at;
  }
  story.left_out = candidates.size() - told.size();
  return story;
}

std::vector<Time> KeyMoments(const Run& run, std::size_t max) {
  std::vector<Time> times;
  for (const KeyMoment& moment : KeyMomentsOf(run, max).moments) times.push_back(moment.at);
  // A single picture shows no course of things.
  std::vector<Time> ends;
  if (!run.frames().empty()) ends = {run.frames().back().interval.after, run.frames().front().interval.after};
  for (const Time end : ends) {
    if (times.size() >= std::min(max, kLeastPictures)) break;
    if (std::find(times.begin(), times.end(), end) == times.end()) times.push_back(end);
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace aerascope
