#include "viewer/draw/key_moments.h"

#include <algorithm>
#include <array>
#include <map>

#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"

namespace aerascope {
namespace {

constexpr std::size_t kKinds = 4;  // without the start
constexpr std::array<double, kKinds> kWeights = {6, 4, 4, 3.5};
// How much less each further one of a kind weighs.
constexpr std::array<double, kKinds> kWear = {0.2, 0.5, 1, 1};

// All candidates, one a time: the weightiest kind, and of that the first event.
std::vector<KeyMoment> Candidates(const Run& run, const EpisodeSummary& summary) {
  std::map<Time, KeyMoment> by_time;
  const auto add = [&](Time at, MomentKind kind, EventId event) {
    const auto [found, fresh] = by_time.emplace(at, KeyMoment{at, kind, event, ""});
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
  for (auto& [at, moment] : by_time) candidates.push_back(std::move(moment));
  return candidates;
}

// The candidate of a kind that is farthest in time from all of that kind chosen before; the first where none
// was.
std::size_t Farthest(const std::vector<KeyMoment>& candidates, const std::vector<bool>& chosen,
                     MomentKind kind) {
  std::size_t best = candidates.size();
  std::int64_t best_distance = -1;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (chosen[i] || candidates[i].kind != kind) continue;
    std::int64_t distance = kForever.us;
    for (std::size_t j = 0; j < candidates.size(); ++j) {
      if (!chosen[j] || candidates[j].kind != kind) continue;
      const std::int64_t away = (candidates[i].at - candidates[j].at).us;
      distance = std::min(distance, away < 0 ? -away : away);
    }
    if (distance > best_distance) {
      best_distance = distance;
      best = i;
    }
  }
  return best;
}

// Sentences mark quoted knowledge by back quotes; a caption has the quotes of print.
std::string InPrint(std::string_view sentence) {
  std::string text;
  bool open = false;
  for (const char c : sentence) {
    if (c == '`') open = !open;
    text += c != '`' ? std::string(1, c) : open ? "“" : "”";
  }
  return text;
}

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
  std::vector<KeyMoment> candidates = Candidates(run, Summarise(run));
  std::vector<KeyMoment> moments;
  if (candidates.empty()) {
    moments = FirstAndLastFrame(run, max);
  } else {
    // Far more candidates than pictures are not looked at one by one: the first and the last of them serve.
    constexpr std::size_t kMost = 2000;
    if (candidates.size() > kMost) {
      candidates.erase(candidates.begin() + kMost / 2, candidates.end() - kMost / 2);
    }
    std::vector<bool> chosen(candidates.size(), false);
    std::array<double, kKinds> count = {};
    for (std::size_t n = 0; n < max; ++n) {
      std::size_t best = candidates.size();
      double best_weight = 0;
      for (std::size_t kind = 0; kind < kKinds; ++kind) {
        const std::size_t next = Farthest(candidates, chosen, static_cast<MomentKind>(kind));
        const double weight = kWeights[kind] / (1 + kWear[kind] * count[kind]);
        if (next == candidates.size() || weight <= best_weight) continue;
        best = next;
        best_weight = weight;
      }
      if (best == candidates.size()) break;
      chosen[best] = true;
      count[static_cast<std::size_t>(candidates[best].kind)] += 1;
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (chosen[i]) moments.push_back(candidates[i]);
    }
  }
  for (KeyMoment& moment : moments) moment.caption = CaptionOf(run, moment);
  return moments;
}

std::vector<Time> KeyMoments(const Run& run, std::size_t max) {
  std::vector<Time> times;
  for (const KeyMoment& moment : KeyMomentsOf(run, max)) times.push_back(moment.at);
  return times;
}

}  // namespace aerascope
