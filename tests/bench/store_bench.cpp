// How fast events go into an episode file, and come out again. Target: 400 000 small events a second, writing
// included.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "engine/store/episode_reader.h"
#include "engine/store/episode_writer.h"
#include "tests/bench/peak_memory.h"

namespace aerascope {
namespace {

constexpr std::int64_t kEvents = 500'000;

Term Position(std::int64_t i) {
  return Term::Struct(
      "vec3", {Term::Number(0.01 * static_cast<double>(i % 100)), Term::Number(0.02), Term::Number(0.3)});
}

// What a sensor says: five objects, positions that keep coming back at the sensor's resolution.
Event FactEvent(std::int64_t i) {
  const TimeInterval frame{Time{i / 20 * 100'000}, Time{(i / 20 + 1) * 100'000}};
  static const char* kObjects[] = {"h", "c1", "c2", "s1", "cyl"};
  return {
      {i},
      frame.after,
      i / 20,
      {},
      {},
      FactObserved{
          {i},
          {true, MakeValue(Term::Entity(kObjects[i % 5]), Term::Ontology("position"), Position(i)), frame, 1},
          FactSource::kSensor}};
}

// A composite state of four components that holds: caused by four facts.
Event IcstEvent(std::int64_t i, std::size_t causes) {
  const TimeInterval frame{Time{i / 20 * 100'000}, Time{(i / 20 + 1) * 100'000}};
  Event event{{i},
              frame.after,
              i / 20,
              {},
              {},
              IcstFound{{i},
                        {true, MakeIcst({12}, {}, {Term::Entity("h"), Term::Entity("c1"), Position(i)}),
                         frame, 0.75}}};
  for (std::size_t c = 1; c <= causes && static_cast<std::int64_t>(c) < i; ++c) {
    event.causes.push_back({i - static_cast<std::int64_t>(c)});
  }
  return event;
}

// A payload never seen before in each event: the worst case of interning.
Event FreshEvent(std::int64_t i) {
  Event event = FactEvent(i);
  std::get<FactObserved>(event.body).fact.payload =
      MakeValue(Term::Entity("h"), Term::Ontology("position"), Term::Number(static_cast<double>(i) * 0.001));
  return event;
}

Event WorldEvent(std::int64_t i) {
  WorldStateRecorded world{Time{i * 10'000}, std::vector<double>(49), std::vector<double>(44),
                           std::vector<double>(8)};
  for (std::size_t k = 0; k < world.qpos.size(); ++k)
    world.qpos[k] = 0.001 * static_cast<double>(i) + static_cast<double>(k);
  return {{i}, world.at, i, {}, {}, std::move(world)};
}

class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "aerascope-bench-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string File() const { return (path_ / "bench.episode").string(); }

 private:
  std::filesystem::path path_;
};

// Events are made before the clock runs; the time is from the first Append to the end of Flush (everything
// committed).
template <class Make>
void WriteEvents(benchmark::State& state, std::int64_t count, const Make& make) {
  const Folder folder;
  std::vector<Event> events;
  events.reserve(static_cast<std::size_t>(count));
  for (std::int64_t i = 1; i <= count; ++i) events.push_back(make(i));
  for ([[maybe_unused]] auto round : state) {
    state.PauseTiming();
    auto writer = EpisodeWriter::Create(folder.File(), {});
    if (!writer) return state.SkipWithError(writer.error().message.c_str());
    state.ResumeTiming();
    for (const Event& event : events) (*writer)->Append(event);
    (*writer)->Flush();
    state.PauseTiming();
    const auto digest = (*writer)->Finish();
    if (!digest) return state.SkipWithError(digest.error().message.c_str());
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * count);
  state.counters["bytes/event"] =
      static_cast<double>(std::filesystem::file_size(folder.File())) / static_cast<double>(count);
  state.counters["peak MiB"] = PeakMemoryMiB();
}

void StoreFactObserved(benchmark::State& state) {
  WriteEvents(state, kEvents, FactEvent);
}
void StoreFactNeverSeenBefore(benchmark::State& state) {
  WriteEvents(state, kEvents, FreshEvent);
}
void StoreIcstFoundOneCause(benchmark::State& state) {
  WriteEvents(state, kEvents, [](std::int64_t i) { return IcstEvent(i, 1); });
}
void StoreIcstFoundFourCauses(benchmark::State& state) {
  WriteEvents(state, kEvents, [](std::int64_t i) { return IcstEvent(i, 4); });
}
void StoreWorldState(benchmark::State& state) {
  WriteEvents(state, 50'000, WorldEvent);
}

// What the appending thread itself pays for one event, as long as the queue is not full.
void AppendCostToTheReasoner(benchmark::State& state) {
  const Folder folder;
  auto writer = EpisodeWriter::Create(folder.File(), {});
  if (!writer) return state.SkipWithError(writer.error().message.c_str());
  std::int64_t i = 0;
  for ([[maybe_unused]] auto round : state) {
    state.PauseTiming();
    std::vector<Event> events;
    for (int k = 0; k < 1000; ++k) events.push_back(FactEvent(++i));
    (*writer)->Flush();
    state.ResumeTiming();
    for (Event& event : events) (*writer)->Append(std::move(event));
  }
  state.SetItemsProcessed(state.iterations() * 1000);
  state.counters["peak MiB"] = PeakMemoryMiB();  // runs first: the writer's own need, however many events
  if (!(*writer)->Finish()) state.SkipWithError("the episode could not be finished");
}

// Indexes, digest, one plain file.
void FinishEpisode(benchmark::State& state) {
  const Folder folder;
  for ([[maybe_unused]] auto round : state) {
    state.PauseTiming();
    auto writer = EpisodeWriter::Create(folder.File(), {});
    if (!writer) return state.SkipWithError(writer.error().message.c_str());
    for (std::int64_t i = 1; i <= kEvents; ++i) (*writer)->Append(IcstEvent(i, 2));
    (*writer)->Flush();
    state.ResumeTiming();
    if (!(*writer)->Finish()) return state.SkipWithError("the episode could not be finished");
  }
  state.SetItemsProcessed(state.iterations() * kEvents);
}

void ReadFacts(benchmark::State& state) {
  const Folder folder;
  auto writer = EpisodeWriter::Create(folder.File(), {});
  if (!writer) return state.SkipWithError(writer.error().message.c_str());
  for (std::int64_t i = 1; i <= kEvents; ++i) (*writer)->Append(i % 5 == 0 ? IcstEvent(i, 3) : FactEvent(i));
  if (!(*writer)->Finish()) return state.SkipWithError("the episode could not be finished");
  for ([[maybe_unused]] auto round : state) {
    const Result<EpisodeFile> file = ReadEpisode(folder.File());
    if (!file) return state.SkipWithError(file.error().message.c_str());
    benchmark::DoNotOptimize(file->events.data());
  }
  state.SetItemsProcessed(state.iterations() * kEvents);
  state.counters["peak MiB"] = PeakMemoryMiB();
}

void Digest(benchmark::State& state) {
  const Event event = FactEvent(1234567);
  EventDigest digest;
  for ([[maybe_unused]] auto round : state) digest.Add(event);
  benchmark::DoNotOptimize(digest.Value());
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(AppendCostToTheReasoner)->Unit(benchmark::kMicrosecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(StoreFactObserved)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(StoreFactNeverSeenBefore)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(StoreIcstFoundOneCause)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(StoreIcstFoundFourCauses)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(StoreWorldState)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(FinishEpisode)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(ReadFacts)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(Digest);

}  // namespace
}  // namespace aerascope
