// Laws of all episodes, on random scripted ones.
#include <gtest/gtest.h>

#include <set>

#include "engine/episode/run_episode.h"
#include "engine/episode/scenario.h"
#include "engine/event/apply.h"
#include "engine/reason/reasoner.h"
#include "tests/support/any_scenario.h"
#include "tests/support/knowledge_edits.h"
#include "tests/support/law.h"

namespace aerascope {
namespace {

Scenario Loaded(std::uint64_t number) {
  Result<Scenario> scenario = LoadScenarioFromFiles(AnyScenario(number));
  if (!scenario) RC_FAIL(scenario.error().message);
  return std::move(*scenario);
}

class EventVector : public EventSink {
 public:
  void Append(Event event) override { events.push_back(std::move(event)); }
  std::vector<Event> events;
};

// Moves a knowledge base of its own by what it is told, and nothing else.
class Follower : public EventSink {
 public:
  void Append(Event event) override {
    Apply(event, &knowledge_);
    ++events_;
  }
  const KnowledgeBase& knowledge() const { return knowledge_; }
  std::int64_t events() const { return events_; }

 private:
  KnowledgeBase knowledge_;
  std::int64_t events_ = 0;
};

// The life of a scenario, with the reasoner at hand after every step.
template <class Look>
void Live(const Scenario& scenario, EventSink* sink, Look&& look) {
  auto world = MakeWorld(scenario);
  if (!world) RC_FAIL(world.error().message);
  Reasoner reasoner(scenario.reasoner, scenario.sampling_period, sink);
  reasoner.journal().LeaveOut(scenario.left_out);
  std::vector<CompositeState> states;
  for (const SeedCompositeState& item : scenario.seed.composite_states) states.push_back(item.state);
  reasoner.LoadSeed(scenario.seed.symbols, (*world)->Properties(), states, {});
  look(reasoner);
  std::size_t next_drive = 0;
  for (std::int64_t frame = 0; frame < scenario.max_frames; ++frame) {
    const TimeInterval interval{Time{frame * scenario.sampling_period.us},
                                Time{(frame + 1) * scenario.sampling_period.us}};
    auto sensed = (*world)->Observe(interval);
    if (!sensed) RC_FAIL(sensed.error().message);
    reasoner.BeginFrame(frame, *sensed);
    look(reasoner);
    std::vector<Term> commands;
    std::vector<EventId> issued;
    for (const TeacherCommand& taught : scenario.teacher) {
      if (taught.frame != frame) continue;
      const auto command = CompleteCommand(taught, scenario, *sensed);
      if (!command) RC_FAIL(command.error().message);
      commands.push_back(*command);
      issued.push_back(reasoner.CommandIssued(*command, Commander::kTeacher, {}, {}));
    }
    if (commands.empty()) {
      while (!reasoner.drive_open() && next_drive < scenario.drives.size()) {
        const Drive& drive = scenario.drives[next_drive++];
        reasoner.SetDrive(drive.title, drive.goal, interval.after + scenario.sampling_period * drive.frames);
        look(reasoner);
      }
      if (const auto wish = reasoner.Decide()) {
        commands.push_back(wish->command);
        issued.push_back(reasoner.CommandIssued(wish->command, Commander::kAgent, wish->drive, wish->event));
      }
    }
    look(reasoner);
    auto done = (*world)->Act(commands, {interval.after + scenario.reasoner.commit_offset, interval.before});
    if (!done) RC_FAIL(done.error().message);
    for (const Term& executed : done->executed)
      reasoner.Executed(executed, issued.empty() ? EventId{} : issued.front());
    look(reasoner);
  }
}

// Own: the knowledge base an agent has is the fold of the events, at every frame and after every step of it.
TEST(EpisodeLaws, TheFoldOverEventsIsTheLiveKnowledgeBase) {
  std::int64_t frames = 0;
  std::int64_t learned = 0;
  EXPECT_TRUE(Holds(1000, [&](std::uint64_t number) {
    const Scenario scenario = Loaded(number);
    Follower follower;
    Live(scenario, &follower, [&](const Reasoner& reasoner) {
      ++frames;
      const std::string live = Everything(reasoner.knowledge());
      const std::string folded = Everything(follower.knowledge());
      if (live != folded) RC_FAIL("live:\n" + live + "\nfolded:\n" + folded);
    });
    learned += static_cast<std::int64_t>(follower.knowledge().models().size());
  }));
  EXPECT_GT(learned, CasesToTry(500)) << "hardly anything was learned, so little was tested";
}

// Own: replay equals run.
TEST(EpisodeLaws, ReplayingAnEpisodeGivesItsDigest) {
  EXPECT_TRUE(Holds(500, [](std::uint64_t number) {
    const Scenario scenario = Loaded(number);
    auto world = MakeWorld(scenario);
    RC_ASSERT(world.ok());
    EventVector sink;
    const auto outcome = RunEpisode(scenario, world->get(), &sink);
    if (!outcome) RC_FAIL(outcome.error().message);
    EpisodeFile episode;
    for (const auto& [name, text] : scenario.files) episode.header.files.push_back({name, text});
    episode.events = std::move(sink.events);
    episode.complete = true;
    EventDigest digest;
    for (const Event& event : episode.events) digest.Add(event);
    const auto replayed = ReplayDigest(episode);
    if (!replayed) RC_FAIL(replayed.error().message);
    RC_ASSERT(*replayed == digest.Value());
  }));
}

// Own: every event names earlier events as its causes, and everything but observations has one.
TEST(EpisodeLaws, EverythingHasACause) {
  EXPECT_TRUE(Holds(500, [](std::uint64_t number) {
    const Scenario scenario = Loaded(number);
    auto world = MakeWorld(scenario);
    RC_ASSERT(world.ok());
    EventVector sink;
    RC_ASSERT(RunEpisode(scenario, world->get(), &sink).ok());
    Time last;
    for (std::size_t i = 0; i < sink.events.size(); ++i) {
      const Event& event = sink.events[i];
      RC_ASSERT(event.id == EventId{static_cast<std::int64_t>(i) + 1});
      if (event.time < last)
        RC_FAIL("time goes back: " + ToText(event) + "\nafter " + ToText(sink.events[i - 1]));
      last = event.time;
      if (event.causes.empty() && !MayBeUncaused(event.body)) RC_FAIL(ToText(event));
      std::set<EventId> different;
      for (const EventId cause : event.causes) {
        if (cause.value < 1 || cause >= event.id || !different.insert(cause).second) RC_FAIL(ToText(event));
      }
    }
  }));
}

// Own: a simulation is over at the instant it began, so that nothing it rests on can change meanwhile: it
// ends once, with an outcome, and is never given up halfway.
TEST(EpisodeLaws, EverySimulationEndsAtTheInstantItBegan) {
  std::int64_t simulations = 0;
  EXPECT_TRUE(Holds(2000, [&](std::uint64_t number) {
    const Scenario scenario = Loaded(number);
    auto world = MakeWorld(scenario);
    RC_ASSERT(world.ok());
    EventVector sink;
    RC_ASSERT(RunEpisode(scenario, world->get(), &sink).ok());
    const Event* open = nullptr;
    for (const Event& event : sink.events) {
      if (std::holds_alternative<SimulationStarted>(event.body)) {
        if (open) RC_FAIL("inside another: " + ToText(event));
        open = &event;
        ++simulations;
      }
      const bool inside = open && event.simulation == open->simulation;
      if (inside != event.simulation.valid() || inside != (open != nullptr))
        RC_FAIL("not in the simulation that goes on: " + ToText(event));
      if (inside && (event.time != open->time || event.frame != open->frame))
        RC_FAIL("time went on: " + ToText(event));
      if (std::holds_alternative<SimulationEnded>(event.body)) open = nullptr;
    }
    if (open) RC_FAIL("never ended: " + ToText(*open));
  }));
  EXPECT_GT(simulations, CasesToTry(300)) << "hardly anything was tried in the head, so little was tested";
}

}  // namespace
}  // namespace aerascope
