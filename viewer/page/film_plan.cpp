#include "viewer/page/film_plan.h"

#include <algorithm>
#include <set>

#include "engine/query/goal_tree.h"
#include "viewer/draw/key_moments.h"

namespace aerascope {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;
constexpr int kStillsWithoutVideo = 4;   // a second
constexpr int kOutlinesPerSecond = 4;    // in short episodes
constexpr std::int64_t kShort_s = 90;    // an episode up to here is short
constexpr std::size_t kEvenStills = 40;  // in long episodes, so that none is without stills for long

Time BeginningOf(const Run& run) {
  return run.frames().empty() ? Time{} : run.frames().front().interval.after;
}
Time EndOf(const Run& run) {
  return std::max(run.end(), BeginningOf(run));
}

// At most `most` of the times, evenly chosen, first and last among them.
std::vector<Time> Evenly(const std::vector<Time>& times, std::size_t most) {
  if (times.size() <= most) return times;
  std::vector<Time> chosen;
  for (std::size_t i = 0; i < most; ++i) {
    const std::size_t at = most == 1 ? 0 : i * (times.size() - 1) / (most - 1);
    chosen.push_back(times[at]);
  }
  return chosen;
}

std::vector<Time> FrameStarts(const Run& run) {
  std::vector<Time> starts;
  for (const RunFrame& frame : run.frames()) starts.push_back(frame.interval.after);
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  if (starts.empty()) starts.push_back(BeginningOf(run));
  return starts;
}

// The moments of a run that matter most, weightiest first in case of doubt.
std::vector<Time> MomentsThatMatter(const Run& run, const std::vector<Time>& starts, std::size_t most) {
  if (starts.size() <= most) return starts;
  std::set<Time> moments;
  const auto add = [&](const std::vector<Time>& times, std::size_t limit) {
    for (const Time at : times) {
      if (moments.size() >= limit) return;
      moments.insert(at);
    }
  };
  add(Evenly(starts, std::min(kEvenStills, most / 4 + 1)), most);
  add(KeyMoments(run, most), most - most / 4);
  std::vector<Time> commands;
  for (const IssuedCommand& command : CommandsOf(run)) {
    const auto frame = run.FrameAt(command.time);
    commands.push_back(frame ? run.frames()[*frame].interval.after : command.time);
  }
  add(Evenly(commands, most), most);
  return {moments.begin(), moments.end()};
}

std::vector<Time> Steps(const Run& run, int per_second) {
  std::vector<Time> steps;
  if (per_second <= 0) return steps;
  const std::int64_t step_us = kSecond_us / per_second;
  for (Time at = BeginningOf(run); at < EndOf(run) && steps.size() <= kMostOutlines; at.us += step_us)
    steps.push_back(at);
  return steps;
}

std::vector<Time> Joined(const std::vector<Time>& some, const std::vector<Time>& more) {
  std::set<Time> all(some.begin(), some.end());
  all.insert(more.begin(), more.end());
  return {all.begin(), all.end()};
}

// The finest pace that stays within kMostVideoPictures.
Time PictureTime(std::int64_t length_us) {
  for (const std::int64_t picture_ms : {50, 100, 200, 250, 500, 1000, 2000, 5000, 10'000}) {
    if (length_us <= picture_ms * 1000 * kMostVideoPictures) return {picture_ms * 1000};
  }
  const std::int64_t longest_ms = length_us / 1000 / kMostVideoPictures + 1;
  return {longest_ms * 1000};
}

void PlanVideo(const Run& run, const FilmWishes& wishes, FilmPlan& plan) {
  const std::int64_t length_us = (EndOf(run) - BeginningOf(run)).us;
  if (!wishes.video || length_us <= 0) return;
  plan.video_from = BeginningOf(run);
  plan.video_picture = wishes.video_fps ? Time{kSecond_us / *wishes.video_fps} : PictureTime(length_us);
  plan.video_pictures = (length_us + plan.video_picture.us - 1) / plan.video_picture.us;
}

}  // namespace

const std::vector<int>& VideoRates() {
  static const std::vector<int> rates = {1, 2, 4, 5, 8, 10, 20, 25, 40, 50};
  return rates;
}

FilmPlan PlanFilm(const Run& run, const FilmWishes& wishes) {
  FilmPlan plan;
  PlanVideo(run, wishes, plan);
  const std::vector<Time> starts = FrameStarts(run);
  plan.stills = MomentsThatMatter(run, starts, kMostStills);
  const bool all_frames = plan.stills.size() == starts.size();
  const int per_second = wishes.stills_per_second.value_or(plan.video_pictures > 0 ? 0 : kStillsWithoutVideo);
  // Asked for: as many as asked; else only as long as there is room.
  const std::vector<Time> between = Steps(run, per_second);
  const std::vector<Time> more = Joined(plan.stills, between);
  if (wishes.stills_per_second || more.size() <= kMostStills) plan.stills = more;
  const bool is_short = (EndOf(run) - BeginningOf(run)).us <= kShort_s * kSecond_us;
  plan.outlines = Joined(plan.stills, Evenly(starts, kMostOutlines));
  if (is_short && plan.video_pictures > 0)
    plan.outlines = Joined(plan.outlines, Steps(run, kOutlinesPerSecond));
  plan.views = Evenly(MomentsThatMatter(run, starts, kMostViewStills), kMostViewStills);
  if (!all_frames && !wishes.stills_per_second) {
    plan.note = std::to_string(plan.stills.size()) + " sharp stills of " + std::to_string(starts.size()) +
                " frames: where something was learned, reached, failed or commanded, and a few in between.";
  }
  return plan;
}

}  // namespace aerascope
