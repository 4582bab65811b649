// How fast knowledge moves: folding events into a knowledge base, matching, and the canonical form.
#include <benchmark/benchmark.h>

#include "engine/event/apply.h"
#include "engine/kb/term_codec.h"
#include "tests/bench/peak_memory.h"

namespace aerascope {
namespace {

FactPattern Component(Term object, const char* attribute, Term value) {
  return {true, MakeValue(std::move(object), Term::Ontology(attribute), std::move(value)), Term::Variable(0),
          Term::Variable(1)};
}

// A learned condition of four components, as for a grasp; `variant` keeps contents apart.
CompositeState Grasp(std::int64_t id, std::int64_t variant) {
  const Term hand = Term::Variable(2);
  const Term object = Term::Variable(3);
  const Term position = Term::Variable(4);
  return {{id},
          {Component(hand, "holding", Term::Set({})), Component(hand, "position", position),
           Component(object, "size", Term::Ontology("large")), Component(object, "position", position),
           Component(object, "kind", Term::Number(static_cast<double>(variant)))},
          {},
          {}};
}

Model Requirement(std::int64_t id, std::int64_t state, std::int64_t target) {
  Model model;
  model.id = {id};
  model.lhs = {true, MakeIcst({state}, {}, {Term::Variable(0), Term::Variable(1), Term::Variable(2)}),
               Term::Variable(3), Term::Variable(4)};
  model.rhs = {true, MakeImdl({target}, {Term::Set({})}, {Term::Variable(0), Term::Variable(1)}),
               Term::Variable(3), Term::Variable(4)};
  return model;
}

// A run as the reasoner makes it: frames of twenty facts, predictions, outcomes, and now and then new
// knowledge.
std::vector<Event> Run(std::int64_t count) {
  std::vector<Event> events;
  std::int64_t next_object = 1;
  const auto add = [&](std::int64_t frame, EventBody body) {
    const auto id = static_cast<std::int64_t>(events.size()) + 1;
    events.push_back({{id}, {frame * 100'000}, frame, {}, {}, std::move(body)});
  };
  for (std::int64_t frame = 0; static_cast<std::int64_t>(events.size()) < count; ++frame) {
    const TimeInterval interval{{frame * 100'000}, {(frame + 1) * 100'000}};
    add(frame, FrameStarted{interval});
    for (int i = 0; i < 20; ++i) {
      add(frame,
          FactObserved{{next_object++},
                       {true,
                        MakeValue(Term::Entity("object" + std::to_string(i)), Term::Ontology("position"),
                                  Term::Number(0.01 * static_cast<double>((frame + i) % 100))),
                        interval, 1},
                       FactSource::kSensor});
    }
    if (frame % 20 == 0) {
      const std::int64_t state = next_object++;
      add(frame, CompositeStateCreated{Grasp(state, frame), Origin::kInduction, {}});
      add(frame, ModelCreated{Requirement(next_object++, state, 1), {1, 1}, false, Origin::kInduction, {}});
    }
    const PredictionId prediction{next_object++};
    add(frame, PredictionMade{prediction, {22}, {{23}}, {}, {true, Term::Entity("x"), interval, 1}});
    add(frame, PredictionSucceeded{prediction, {1}});
    add(frame, EvidenceUpdated{{23}, true, {1, 1}, {2, 2}, false, false});
  }
  return events;
}

void ApplyEvents(benchmark::State& state) {
  const std::vector<Event> events = Run(200'000);
  for ([[maybe_unused]] auto round : state) {
    KnowledgeBase kb;
    for (const Event& event : events) Apply(event, &kb);
    benchmark::DoNotOptimize(kb.models().size());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(events.size()));
  state.counters["peak MiB"] = PeakMemoryMiB();
}

void CanonicalFormOfACondition(benchmark::State& state) {
  const KnowledgeBase kb;
  const CompositeState grasp = Grasp(1, 1);
  for ([[maybe_unused]] auto round : state) benchmark::DoNotOptimize(kb.CanonicalOf(grasp));
  state.SetItemsProcessed(state.iterations());
}

void CanonicalFormOfSixLikeComponents(benchmark::State& state) {
  const KnowledgeBase kb;
  CompositeState like{{1}, {}, {}, {}};
  for (int i = 0; i < 6; ++i)
    like.components.push_back(Component(Term::Variable(i + 2), "size", Term::Ontology("large")));
  for ([[maybe_unused]] auto round : state) benchmark::DoNotOptimize(kb.CanonicalOf(like));
  state.SetItemsProcessed(state.iterations());
}

void MatchAFact(benchmark::State& state) {
  const FactPattern pattern = Component(Term::Variable(2), "position", Term::Variable(3));
  const Fact fact{true,
                  MakeValue(Term::Entity("h"), Term::Ontology("position"),
                            Term::Struct("vec3", {Term::Number(0.1), Term::Number(0.2), Term::Number(0.3)})),
                  {{0}, {100'000}},
                  1};
  for ([[maybe_unused]] auto round : state) {
    Bindings bindings;
    benchmark::DoNotOptimize(MatchFact(pattern, fact, bindings));
  }
  state.SetItemsProcessed(state.iterations());
}

void DecodeADefinition(benchmark::State& state) {
  const std::string text = Encode(DefinitionToTerm(Grasp(1, 1)));
  for ([[maybe_unused]] auto round : state) benchmark::DoNotOptimize(DecodeTerm(text));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

BENCHMARK(ApplyEvents)->Unit(benchmark::kMillisecond);
BENCHMARK(CanonicalFormOfACondition)->Unit(benchmark::kMicrosecond);
BENCHMARK(CanonicalFormOfSixLikeComponents)->Unit(benchmark::kMicrosecond);
BENCHMARK(MatchAFact);
BENCHMARK(DecodeADefinition)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace aerascope
