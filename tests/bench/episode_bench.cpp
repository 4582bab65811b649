// What an episode costs: reasoning through the paper's task with and without a file, the physics beside it,
// reading and indexing the run, and the report without pictures. Peak memory is that of the whole process.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/episode/run_episode.h"
#include "engine/query/run.h"
#include "engine/store/episode_writer.h"
#include "tests/bench/peak_memory.h"
#include "viewer/page/report.h"

namespace aerascope {
namespace {

class NoSink : public EventSink {
 public:
  void Append(Event) override { ++count; }
  std::int64_t count = 0;
};

Scenario Load(const std::string& name) {
  auto scenario = LoadScenario(std::string(AERASCOPE_SOURCE_DIR) + "/assets/scenarios/" + name);
  if (!scenario) {
    std::fprintf(stderr, "%s\n", scenario.error().message.c_str());
    std::exit(1);
  }
  return *std::move(scenario);
}

std::string ScratchEpisode() {
  return (std::filesystem::temp_directory_path() /
          ("aerascope_bench_" + std::to_string(getpid()) + ".episode"))
      .string();
}

// The paper's task, and its drives again until the episode is 3 s of engine time, or as many times as long.
Scenario ThreeSeconds(int times = 1) {
  Scenario scenario = Load("pick_and_place_scripted.toml");
  const std::vector<Drive> task = scenario.drives;
  const auto put_down = [&] { scenario.drives.push_back(task[1]); };  // what was taken last
  for (int time = 0; time < times; ++time) {
    if (time > 0) {
      put_down();
      scenario.drives.insert(scenario.drives.end(), task.begin(), task.end());
    }
    put_down();
    scenario.drives.insert(scenario.drives.end(), task.begin(), task.end());
    put_down();
    scenario.drives.insert(scenario.drives.end(), task.begin(), task.begin() + 3);
  }
  scenario.max_frames *= 4 * times;
  return scenario;
}

void Report(benchmark::State& state, const Scenario& scenario, const EpisodeOutcome& outcome) {
  if (outcome.drives_reached != outcome.drives) state.SkipWithError("a drive was missed");
  state.counters["engine_s"] = static_cast<double>(outcome.frames * scenario.sampling_period.us) / 1e6;
  state.counters["events"] = static_cast<double>(outcome.events);
  state.counters["peak_MiB"] = PeakMemoryMiB();
}

void ReasonThreeSeconds(benchmark::State& state) {
  const Scenario scenario = ThreeSeconds();
  NoSink sink;
  EpisodeOutcome last;
  for (auto _ : state) {
    auto world = MakeWorld(scenario);
    auto outcome = RunEpisode(scenario, world->get(), &sink);
    if (outcome.ok()) last = *outcome;
  }
  Report(state, scenario, last);
}
BENCHMARK(ReasonThreeSeconds)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void ReasonThreeSecondsIntoFile(benchmark::State& state) {
  const Scenario scenario = ThreeSeconds();
  const std::string path = ScratchEpisode();
  EpisodeOutcome last;
  for (auto _ : state) {
    auto recorded = RecordEpisode(scenario, path, "bench");
    if (recorded.ok()) last = recorded->outcome;
  }
  std::filesystem::remove(path);
  Report(state, scenario, last);
}
BENCHMARK(ReasonThreeSecondsIntoFile)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// What the thread that reasons pays for its events being stored (target: under 5 %): its own CPU time with a
// file and with a sink that drops everything, in turns, each after a run that is not counted, so that both
// find the caches alike. The median of the pairs. Also over an episode so long that the writer is at work all
// the time, not only at the end.
void LoggingCostToTheReasoner(benchmark::State& state) {
  const Scenario scenario = ThreeSeconds(static_cast<int>(state.range(0)));
  const std::string path = ScratchEpisode();
  const auto thread_ms = [] {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
  };
  const auto run_into = [&](EventSink* sink) {
    NoSink nowhere;
    auto world = MakeWorld(scenario);
    benchmark::DoNotOptimize(RunEpisode(scenario, world->get(), &nowhere).ok());
    world = MakeWorld(scenario);
    const double start = thread_ms();
    benchmark::DoNotOptimize(RunEpisode(scenario, world->get(), sink).ok());
    return thread_ms() - start;
  };
  std::vector<double> without;
  std::vector<double> with;
  std::vector<double> cost;
  for (auto _ : state) {
    NoSink nowhere;
    without.push_back(run_into(&nowhere));
    auto writer = EpisodeWriter::Create(path, {});
    if (!writer.ok()) return state.SkipWithError("no file");
    with.push_back(run_into(writer->get()));
    benchmark::DoNotOptimize((*writer)->Finish().ok());
    cost.push_back(100 * (with.back() - without.back()) / without.back());
  }
  std::filesystem::remove(path);
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  state.counters["without_ms"] = median(without);
  state.counters["with_ms"] = median(with);
  state.counters["cost_percent"] = median(cost);
}
BENCHMARK(LoggingCostToTheReasoner)->Unit(benchmark::kMillisecond)->Arg(1)->Iterations(100);
BENCHMARK(LoggingCostToTheReasoner)->Unit(benchmark::kMillisecond)->Arg(10)->Iterations(30);

// Keeps what it is given.
class ListSink : public EventSink {
 public:
  void Append(Event event) override { events.push_back(std::move(event)); }
  std::vector<Event> events;
};

// Events into a file in the mixture of kinds that the paper's task has, over and over (target: 400 000 a
// second).
void StoreTheMixOfARun(benchmark::State& state) {
  constexpr std::size_t kEvents = 500'000;
  const Scenario scenario = Load("pick_and_place_scripted.toml");
  ListSink run;
  auto world = MakeWorld(scenario);
  if (!RunEpisode(scenario, world->get(), &run).ok()) return state.SkipWithError("no run");
  std::vector<Event> events;
  for (std::int64_t earlier = 0; events.size() < kEvents;
       earlier = static_cast<std::int64_t>(events.size())) {
    for (Event event : run.events) {
      event.id.value += earlier;
      for (EventId& cause : event.causes) cause.value += earlier;
      events.push_back(std::move(event));
    }
  }
  const std::string path = ScratchEpisode();
  for (auto _ : state) {
    state.PauseTiming();
    auto writer = EpisodeWriter::Create(path, {});
    if (!writer.ok()) return state.SkipWithError("no file");
    state.ResumeTiming();
    for (const Event& event : events) (*writer)->Append(event);
    (*writer)->Flush();
    state.PauseTiming();
    benchmark::DoNotOptimize((*writer)->Finish().ok());
    state.ResumeTiming();
  }
  std::filesystem::remove(path);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(events.size()));
}
BENCHMARK(StoreTheMixOfARun)->Unit(benchmark::kMillisecond)->UseRealTime();

void RunWithPhysics(benchmark::State& state) {
  const Scenario scenario = Load("pick_and_place.toml");
  const std::string path = ScratchEpisode();
  for (auto _ : state) benchmark::DoNotOptimize(RecordEpisode(scenario, path, "bench").ok());
  std::filesystem::remove(path);
  state.counters["peak_MiB"] = PeakMemoryMiB();
}
BENCHMARK(RunWithPhysics)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

// Each shipped scenario: engine time, events, wall time of its reasoning and world without a file, and the
// most memory the process had meanwhile.
void RunShippedScenario(benchmark::State& state, const std::string& name) {
  const Scenario scenario = Load(name);
  NoSink sink;
  EpisodeOutcome last;
  ForgetPeakMemory();
  for (auto _ : state) {
    auto world = MakeWorld(scenario);
    auto outcome = RunEpisode(scenario, world->get(), &sink);
    if (outcome.ok()) last = *outcome;
  }
  state.counters["engine_s"] = static_cast<double>(last.frames * scenario.sampling_period.us) / 1e6;
  state.counters["events"] = static_cast<double>(last.events);
  state.counters["drives"] = static_cast<double>(last.drives);
  state.counters["reached"] = static_cast<double>(last.drives_reached);
  state.counters["peak_MiB"] = RecentPeakMemoryMiB();
}
BENCHMARK_CAPTURE(RunShippedScenario, pick_and_place_scripted, "pick_and_place_scripted.toml")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, size_pruned_first_scripted, "size_pruned_first_scripted.toml")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, push_then_grab, "push_then_grab.toml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, hand_grab_sphere_learn, "hand_grab_sphere_learn.toml")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, moving_ball, "moving_ball.toml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, two_ways, "two_ways.toml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, pick_and_place, "pick_and_place.toml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunShippedScenario, size_pruned_first, "size_pruned_first.toml")
    ->Unit(benchmark::kMillisecond);

void OpenAndIndexRun(benchmark::State& state) {
  const std::string path = ScratchEpisode();
  if (!RecordEpisode(Load("pick_and_place.toml"), path, "bench").ok()) state.SkipWithError("no episode");
  for (auto _ : state) {
    auto run = OpenRun(path);
    benchmark::DoNotOptimize(run.ok());
  }
  std::filesystem::remove(path);
}
BENCHMARK(OpenAndIndexRun)->Unit(benchmark::kMillisecond);

void BuildReportWithoutPictures(benchmark::State& state) {
  const std::string path = ScratchEpisode();
  if (!RecordEpisode(Load("pick_and_place.toml"), path, "bench").ok()) state.SkipWithError("no episode");
  auto run = OpenRun(path);
  std::filesystem::remove(path);
  std::size_t bytes = 0;
  for (auto _ : state) {
    auto report = BuildReport(*run, {});
    bytes = report.ok() ? report->html.size() : 0;
  }
  state.counters["bytes"] = static_cast<double>(bytes);
  state.counters["peak_MiB"] = PeakMemoryMiB();
}
BENCHMARK(BuildReportWithoutPictures)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerascope
