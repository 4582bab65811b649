#include "engine/episode/run_episode.h"

#include <algorithm>
#include <map>
#include <optional>

#include "engine/base/text.h"
#include "engine/episode/recorded_world.h"
#include "engine/event/digest_sink.h"
#include "engine/reason/reasoner.h"
#include "engine/store/episode_writer.h"
#include "engine/world/mujoco_world.h"
#include "engine/world/scripted_world.h"

namespace aerascope {
namespace {

std::vector<Parameter> ParametersOf(const ReasonerParameters& p, const EventKindSet& left_out) {
  return {{"analogy_mode", std::string(ToText(p.analogy_mode))},
          {"analogy_min_matched", std::to_string(p.analogy_min_matched)},
          {"analogy_min_psi", FormatNumber(p.analogy_min_psi)},
          {"mdl_inertia_sr_thr", FormatNumber(p.mdl_inertia_sr_thr)},
          {"mdl_inertia_cnt_thr", std::to_string(p.mdl_inertia_cnt_thr)},
          {"primary_act_thr", FormatNumber(p.primary_act_thr)},
          {"secondary_act_thr", FormatNumber(p.secondary_act_thr)},
          {"primary_thz", ToText(p.primary_thz)},
          {"secondary_thz", ToText(p.secondary_thz)},
          {"tpx_time_horizon_frames", std::to_string(p.tpx_time_horizon_frames)},
          {"goal_induction", std::string(ToText(p.goal_induction))},
          {"value_roles", std::string(ToText(p.value_roles))},
          {"max_veto_ways", std::to_string(p.max_veto_ways)},
          {"max_prediction_chain", std::to_string(p.max_prediction_chain)},
          {"max_plan_depth", std::to_string(p.max_plan_depth)},
          {"max_simulation_nodes", std::to_string(p.max_simulation_nodes)},
          {"goal_offset", ToText(p.goal_offset)},
          {"command_offset", ToText(p.command_offset)},
          {"commit_offset", ToText(p.commit_offset)},
          {"events_off", NamesOf(left_out)}};
}

// Counts what passes through.
class CountingSink : public EventSink {
 public:
  explicit CountingSink(EventSink* next) : next_(next) {}
  void Append(Event event) override {
    ++count_;
    next_->Append(std::move(event));
  }
  std::int64_t count() const { return count_; }

 private:
  EventSink* next_;
  std::int64_t count_ = 0;
};

class EpisodeLoop {
 public:
  EpisodeLoop(const Scenario& scenario, World* world, EventSink* sink, const OnProgress& on_progress)
      : scenario_(scenario),
        world_(*world),
        counting_(sink),
        reasoner_(scenario.reasoner, scenario.sampling_period, &counting_),
        on_progress_(on_progress) {}

  Result<EpisodeOutcome> Run() {
    Journal& journal = reasoner_.journal();
    journal.LeaveOut(scenario_.left_out);
    journal.Write(Time{0}, EpisodeStarted{scenario_.title, std::string(WorldKind(scenario_)),
                                          static_cast<std::int64_t>(scenario_.random_seed),
                                          scenario_.sampling_period.us,
                                          ParametersOf(scenario_.reasoner, scenario_.left_out)});
    LoadSeed();
    for (frame_ = 0; frame_ <= scenario_.max_frames; ++frame_) {
      auto goes_on = RunFrame();
      if (!goes_on) return goes_on.error();
      if (!*goes_on) break;
    }
    outcome_.frames = std::min(frame_, scenario_.max_frames) + 1;
    outcome_.drives = static_cast<std::int64_t>(scenario_.drives.size());
    // A drive that is given when it is reached already is settled a little after the start of the frame.
    journal.Write(std::max(FrameInterval().after, reasoner_.knowledge().now()),
                  EpisodeEnded{outcome_.frames, outcome_.drives_reached, outcome_.drives});
    outcome_.events = counting_.count();
    return outcome_;
  }

 private:
  TimeInterval FrameInterval() const {
    const Duration period = scenario_.sampling_period;
    return {Time{frame_ * period.us}, Time{(frame_ + 1) * period.us}};
  }

  void LoadSeed() {
    std::vector<Fact> properties = world_.Properties();
    for (const SeedFact& fact : scenario_.seed.facts) properties.push_back(fact.fact);
    std::vector<CompositeState> states;
    for (const SeedCompositeState& state : scenario_.seed.composite_states) states.push_back(state.state);
    std::vector<SeedModelDefinition> models;
    for (const SeedModel& model : scenario_.seed.models)
      models.push_back({model.model, model.evidence, model.strong, model.state});
    reasoner_.LoadSeed(scenario_.seed.symbols, properties, states, models);
  }

  // False when the episode is over.
  Result<bool> RunFrame() {
    auto sensed = world_.Observe(FrameInterval());
    if (!sensed) return sensed.error();
    reasoner_.BeginFrame(frame_, *sensed);
    RecordState(world_.State(), FrameInterval().after);
    CountSettledDrive();

    std::vector<Asked> asked;
    auto teacher = TeachersCommands(*sensed);
    if (!teacher) return teacher.error();
    asked = std::move(*teacher);
    doing_.clear();
    // In a teacher's frame the agent watches.
    if (asked.empty()) {
      if (KeepDriven() == Driven::kNothingLeft && NothingToWaitFor()) {
        Report();
        return false;
      }
      if (auto wish = reasoner_.Decide()) {
        asked.push_back({wish->command, reasoner_.CommandIssued(wish->command, Commander::kAgent, wish->drive,
                                                                wish->event)});
        doing_ = scenario_.drives[next_drive_ - 1].title + ": ";
      }
    } else if (!asked.empty()) {
      doing_ = "teacher: ";
    }
    for (const Asked& one : asked) doing_ += ToText(one.command) + " ";
    Report();
    if (Status status = Act(asked); !status) return status.error();
    return true;
  }

  void Report() {
    if (!on_progress_) return;
    if (!doing_.empty() && doing_.back() == ' ') doing_.pop_back();
    on_progress_({frame_, scenario_.max_frames, FrameInterval().after, doing_});
  }

  struct Asked {
    Term command;
    EventId event;
  };

  Result<std::vector<Asked>> TeachersCommands(const std::vector<Fact>& sensed) {
    std::vector<Asked> asked;
    for (const TeacherCommand& command : scenario_.teacher) {
      if (command.frame != frame_) continue;
      auto complete = CompleteCommand(command, scenario_, sensed);
      if (!complete) return complete.error();
      asked.push_back({*complete, reasoner_.CommandIssued(*complete, Commander::kTeacher, {}, {})});
    }
    return asked;
  }

  enum class Driven { kByADrive, kNotYet, kNothingLeft };

  // The teacher is done, and the episode has lasted as long as it should.
  bool NothingToWaitFor() const {
    const bool taught = scenario_.teacher.empty() || scenario_.teacher.back().frame < frame_;
    return taught && frame_ + 1 >= scenario_.min_frames && frame_ > 0;
  }

  void CountSettledDrive() {
    if (counted_ || reasoner_.drive_open()) return;
    counted_ = true;
    if (reasoner_.last_drive_reached()) ++outcome_.drives_reached;
  }

  // Gives the next drives until one is open.
  Driven KeepDriven() {
    while (!reasoner_.drive_open()) {
      if (next_drive_ >= scenario_.drives.size()) return Driven::kNothingLeft;
      if (frame_ < scenario_.drives[next_drive_].frame) return Driven::kNotYet;
      const Drive& drive = scenario_.drives[next_drive_++];
      const Time deadline{(frame_ + drive.frames) * scenario_.sampling_period.us};
      counted_ = reasoner_.SetDrive(drive.title, drive.goal, deadline);
      if (counted_) ++outcome_.drives_reached;
    }
    return Driven::kByADrive;
  }

  Status Act(const std::vector<Asked>& asked) {
    std::vector<Term> commands;
    for (const Asked& one : asked) commands.push_back(one.command);
    const TimeInterval during{FrameInterval().after + scenario_.reasoner.commit_offset,
                              FrameInterval().before};
    auto done = world_.Act(commands, during);
    if (!done) return done.error();
    std::vector<bool> answered(asked.size());
    for (const Term& executed : done->executed) {
      reasoner_.Executed(executed, IssuedFor(executed, asked, &answered));
    }
    Journal& journal = reasoner_.journal();
    for (std::size_t i = 0; i < done->notes.size() && !asked.empty(); ++i) {
      const Asked& one = asked[std::min(i, asked.size() - 1)];
      journal.Write(during.after, CommandRefused{one.command, done->notes[i]}, {one.event});
    }
    // The state at the frame's end is the one the next frame begins with.
    for (const WorldState& state : done->states) {
      if (state.time < FrameInterval().before) RecordState(state, state.time);
    }
    return Ok();
  }

  // The command that was asked for with this function and has no answer yet.
  static EventId IssuedFor(const Term& executed, const std::vector<Asked>& asked,
                           std::vector<bool>* answered) {
    for (std::size_t i = 0; i < asked.size(); ++i) {
      if ((*answered)[i] || !IsCommand(executed) || !(asked[i].command[0] == executed[0])) continue;
      (*answered)[i] = true;
      return asked[i].event;
    }
    return asked.empty() ? EventId{} : asked.front().event;
  }

  void RecordState(const WorldState& state, Time at) {
    if (last_recorded_ && at <= *last_recorded_) return;
    last_recorded_ = at;
    // Written when the world has answered: never before what was written already.
    const Time now = std::max(at, reasoner_.knowledge().now());
    reasoner_.journal().Write(now, WorldStateRecorded{at, state.qpos, state.qvel, state.ctrl});
  }

  const Scenario& scenario_;
  World& world_;
  CountingSink counting_;
  Reasoner reasoner_;
  const OnProgress& on_progress_;
  EpisodeOutcome outcome_;
  std::int64_t frame_ = 0;
  std::size_t next_drive_ = 0;
  bool counted_ = true;  // whether the last drive's outcome is; there is none at first
  std::string doing_;
  std::optional<Time> last_recorded_;
};

EpisodeHeader HeaderFor(const Scenario& scenario, const World& world, const std::string& program_version) {
  EpisodeHeader header;
  header.program_version = program_version;
  const WorldDescription description = world.Description();
  header.settings["title"] = scenario.title;
  header.settings["story"] = scenario.story;
  header.settings["world.kind"] = description.kind;
  header.settings["world.cameras"] = Join(description.cameras, " ");
  header.settings["random_seed"] = std::to_string(scenario.random_seed);
  for (const auto& [entity, body] : description.body_of_entity)
    header.settings["world.body." + entity] = body;
  for (const auto& [name, text] : scenario.files) header.files.push_back({name, text});
  if (!description.model_text.empty()) header.files.push_back({"world/scene.xml", description.model_text});
  for (const WorldAsset& asset : description.assets)
    header.files.push_back({"world/" + asset.name, asset.bytes});
  return header;
}

}  // namespace

Result<std::unique_ptr<World>> MakeWorld(const Scenario& scenario) {
  if (const auto* scripted = std::get_if<ScriptedWorldConfig>(&scenario.world))
    return MakeScriptedWorld(*scripted);
  return MakeMujocoWorld(std::get<MujocoWorldConfig>(scenario.world));
}

Result<EpisodeOutcome> RunEpisode(const Scenario& scenario, World* world, EventSink* sink,
                                  const OnProgress& on_progress) {
  return EpisodeLoop(scenario, world, sink, on_progress).Run();
}

Result<RecordedEpisode> RecordEpisode(const Scenario& scenario, const std::string& path,
                                      const std::string& program_version, const OnProgress& on_progress) {
  auto world = MakeWorld(scenario);
  if (!world) return world.error();
  auto writer = EpisodeWriter::Create(path, HeaderFor(scenario, **world, program_version));
  if (!writer) return writer.error();
  auto outcome = RunEpisode(scenario, world->get(), writer->get(), on_progress);
  if (!outcome) return outcome.error();
  auto digest = (*writer)->Finish();
  if (!digest) return digest.error();
  return RecordedEpisode{*outcome, *digest};
}

Result<Hash128> ReplayDigest(const EpisodeFile& episode) {
  std::map<std::string, std::string> files;
  for (const NamedFile& file : episode.header.files) files[file.name] = file.bytes;
  auto scenario = LoadScenarioFromFiles(files);
  if (!scenario) return scenario.error();
  const auto* started =
      episode.events.empty() ? nullptr : std::get_if<EpisodeStarted>(&episode.events.front().body);
  if (!started) return Error{"the episode does not begin with EpisodeStarted; it cannot be replayed"};
  const Scenario seeded = WithRandomSeed(std::move(*scenario), static_cast<std::uint64_t>(started->seed));
  RecordedWorld world(episode, seeded.seed.facts.size());
  DigestSink digest;
  auto outcome = RunEpisode(seeded, &world, &digest);
  if (!outcome) return outcome.error();
  return digest.Value();
}

}  // namespace aerascope
