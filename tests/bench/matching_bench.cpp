// How the cost of matching a fact grows with the knowledge that has nothing to do with it, beside CLIPS with
// the same rules and facts; joins that could explode.
//
// CLIPS (a Rete engine, Debian package clips) runs as a program of its own and measures itself between
// loading its rules and its end; where it is not installed its rows say so.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "engine/reason/chaining.h"
#include "tests/bench/many_models.h"
#include "tests/bench/peak_memory.h"

namespace aerascope {
namespace {

constexpr int kFrames = 100;

// One for each number of models: making the largest takes longer than measuring it.
const ManyModels& Many(std::int64_t models) {
  static std::map<std::int64_t, ManyModels> made;
  auto it = made.find(models);
  if (it == made.end()) it = made.emplace(models, MakeManyModels(models)).first;
  return it->second;
}

// Instances and requirements found in one frame.
std::size_t ChainFrame(const ManyModels& many, Situation* situation) {
  std::size_t found = AddInstances(many.knowledge, situation).size();
  for (const ModelId id : RequirementModelsFor(many.knowledge, *situation)) {
    for (Requirement& requirement : RequirementsFrom(*many.knowledge.Find(id), *situation)) {
      situation->Add(std::move(requirement));
      ++found;
    }
  }
  return found;
}

// s_a_fact, in seconds: time from a fact being added to everything that follows from it, over all facts of a
// frame.
void MatchFactsOfAFrame(benchmark::State& state) {
  const ManyModels& many = Many(state.range(0));
  std::size_t found = 0;
  std::int64_t frame = 0;
  for ([[maybe_unused]] auto round : state) {
    Situation situation = SeeFrame(many, frame++ % kFrames);
    found += ChainFrame(many, &situation);
  }
  const double facts = static_cast<double>(state.iterations()) * kFactsInFrame;
  state.counters["s_a_fact"] =
      benchmark::Counter(facts, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["found_a_frame"] = static_cast<double>(found) / static_cast<double>(state.iterations());
  state.counters["peak_MiB"] = PeakMemoryMiB();
}

// Every model looked at for every fact, as a reasoner without indexes does.
void MatchFactsOfAFrameWithoutIndex(benchmark::State& state) {
  const ManyModels& many = Many(state.range(0));
  std::int64_t frame = 0;
  for ([[maybe_unused]] auto round : state) {
    Situation situation = SeeFrame(many, frame++ % kFrames);
    for (const auto& [id, record] : many.knowledge.composite_states()) AddInstances(record.state, &situation);
    for (const auto& [id, record] : many.knowledge.models()) {
      for (Requirement& requirement : RequirementsFrom(record, situation))
        situation.Add(std::move(requirement));
    }
  }
  const double facts = static_cast<double>(state.iterations()) * kFactsInFrame;
  state.counters["s_a_fact"] =
      benchmark::Counter(facts, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// The same rules and facts in CLIPS's language: an instance fact for each composite state, and from it one
// for the requirement model; a frame's facts are asserted, run, and retracted.
std::string ClipsProgram(const ManyModels& many) {
  std::ostringstream out;
  for (std::int64_t i = 0; i < many.triads; ++i) {
    out << "(defrule cst" << i << " (val ?h holding nothing) (val ?x kind kind" << i << ") (val ?x size size"
        << i << ") (val ?x place ?p) (val ?h place ?p) => (assert (icst cst" << i << " ?h ?x ?p)))\n"
        << "(defrule mreq" << i << " (icst cst" << i << " ?h ?x ?p) => (assert (imdl mdl" << i
        << " ?h ?x)))\n";
  }
  for (std::int64_t frame = 0; frame < kFrames; ++frame) {
    out << "(deffunction frame" << frame << " () (assert (val h holding nothing)) (assert (val h place place"
        << frame % 4 << "))";
    for (const SeenThing& thing : ThingsInSight(many, frame)) {
      out << "(assert (val " << thing.name << " kind kind" << thing.kind << "))(assert (val " << thing.name
          << " size size" << thing.kind << "))(assert (val " << thing.name << " place place" << thing.place
          << "))";
    }
    out << "(run) (bind ?*found* (+ ?*found* (length$ (find-all-facts ((?f icst)) TRUE))"
        << " (length$ (find-all-facts ((?f imdl)) TRUE)))) (do-for-all-facts ((?f val)) TRUE (retract ?f))"
        << " (do-for-all-facts ((?f icst)) TRUE (retract ?f)) (do-for-all-facts ((?f imdl)) TRUE (retract "
           "?f)))\n";
  }
  out << "(deffunction all () ";
  for (std::int64_t frame = 0; frame < kFrames; ++frame) out << "(frame" << frame << ")";
  out << ")\n(deffunction measure () (all) (bind ?*found* 0) (bind ?start (time)) (all)"
      << " (printout t \"seconds \" (- (time) ?start) \" found \" ?*found* crlf))\n(measure)\n(exit)\n";
  return "(defglobal ?*found* = 0)\n(assert (val none none none)) (assert (icst none)) (assert (imdl "
         "none))\n" +
         out.str();
}

struct ClipsResult {
  double seconds = 0;
  double found = 0;
};

// Nothing if there is no CLIPS here or it did not answer.
std::optional<ClipsResult> RunClips(const ManyModels& many) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("aerascope_bench_" + std::to_string(getpid()) + ".clp"))
          .string();
  std::ofstream(file) << ClipsProgram(many);
  FILE* pipe = popen(("clips -f2 '" + file + "' 2>/dev/null").c_str(), "r");
  if (!pipe) return std::nullopt;
  std::string answer;
  char buffer[4096];
  for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) answer.append(buffer, n);
  pclose(pipe);
  std::filesystem::remove(file);
  const std::size_t at = answer.rfind("seconds ");
  ClipsResult result;
  if (at == std::string::npos ||
      std::sscanf(answer.c_str() + at, "seconds %lf found %lf", &result.seconds, &result.found) != 2) {
    return std::nullopt;
  }
  return result;
}

// ours_to_clips: our time for the same frames over that of CLIPS; below 1 we are faster.
void ClipsOnTheSame(benchmark::State& state) {
  const ManyModels& many = Many(state.range(0));
  std::optional<ClipsResult> clips;
  for ([[maybe_unused]] auto round : state) {
    clips = RunClips(many);
    if (!clips) {
      state.SkipWithError("no answer of the program clips (Debian package clips)");
      return;
    }
    state.SetIterationTime(clips->seconds);
  }
  std::size_t found = 0;
  const auto start = std::chrono::steady_clock::now();
  for (std::int64_t frame = 0; frame < kFrames; ++frame) {
    Situation situation = SeeFrame(many, frame);
    found += ChainFrame(many, &situation);
  }
  const double ours = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (static_cast<double>(found) != clips->found) state.SkipWithError("CLIPS found something else");
  state.counters["s_a_fact"] = clips->seconds / (kFrames * kFactsInFrame);
  state.counters["found_a_frame"] = clips->found / kFrames;
  state.counters["ours_to_clips"] = ours / clips->seconds;
}

// Eight components that share the hand only, ten facts for each: ten to the eighth combinations.
void EightComponentsTenFactsEach(benchmark::State& state) {
  const bool joined = state.range(0) != 0;  // they also share the place, so that few combinations fit
  const TimeInterval interval{{0}, {100'000}};
  CompositeState condition{{1}, {}, {}, {}};
  Situation situation(interval);
  for (int c = 0; c < 8; ++c) {
    const Term attribute = Term::Ontology("attribute" + std::to_string(c));
    condition.components.push_back(
        {true, MakeValue(Term::Variable(c + 3), attribute, joined ? Term::Variable(2) : Term::Wildcard()),
         Term::Variable(0), Term::Variable(1)});
    for (int i = 0; i < 10; ++i) {
      SituationFact fact;
      fact.fact = {true,
                   MakeValue(Term::Entity("x" + std::to_string(c) + "_" + std::to_string(i)), attribute,
                             Term::Entity("place" + std::to_string(i))),
                   interval, 1};
      situation.Add(std::move(fact));
    }
  }
  JoinWork work;
  std::size_t found = 0;
  for ([[maybe_unused]] auto round : state) {
    work = {};
    found = JointMatches(condition, situation, {}, {}, &work).size();
  }
  state.counters["found"] = static_cast<double>(found);
  state.counters["facts_tried"] = static_cast<double>(work.steps);
  state.counters["cut"] = static_cast<double>(work.cut);
  state.counters["peak_MiB"] = PeakMemoryMiB();
}

BENCHMARK(EightComponentsTenFactsEach)->ArgName("joined")->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);
BENCHMARK(MatchFactsOfAFrame)
    ->ArgName("models")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(MatchFactsOfAFrameWithoutIndex)
    ->ArgName("models")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(ClipsOnTheSame)
    ->ArgName("models")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerascope
