#include "engine/episode/scenario.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "engine/base/text.h"
#include "engine/episode/config.h"
#include "engine/episode/scenario_world.h"
#include "engine/episode/world_keys.h"
#include "engine/event/event.h"
#include "engine/kb/match.h"
#include "engine/replicode/reader.h"

namespace aerascope {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 16 << 20;
constexpr std::int64_t kMaxFrames = 1'000'000;
constexpr std::string_view kScenarioFile = "scenario.toml";
constexpr std::string_view kSeedFile = "seed.replicode";

Result<std::string> ReadTextFile(const std::string& path, std::string_view what) {
  std::error_code trouble;
  const auto status = std::filesystem::status(path, trouble);
  if (!std::filesystem::exists(status)) {
    return Error{Printable(path) + ": expected " + std::string(what) + ", found no such file"};
  }
  if (std::filesystem::is_directory(status)) {
    return Error{Printable(path) + ": expected " + std::string(what) + ", found a folder"};
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  char buffer[65536];
  while (stream && text.size() <= kMaxFileBytes) {
    stream.read(buffer, sizeof buffer);
    text.append(buffer, static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > kMaxFileBytes) {
    return Error{Printable(path) + ": expected " + std::string(what) + " of at most 16 MiB, found more"};
  }
  if (!stream.eof())
    return Error{Printable(path) + ": expected " + std::string(what) + ", found a file that cannot be read"};
  return text;
}

// Builds a scenario from its texts.
class ScenarioReader {
 public:
  // `file` is how messages call the scenario.
  ScenarioReader(std::string file, ModelSource source)
      : errors_(std::move(file)), source_(std::move(source)) {}

  // Gives the seed's name for messages and its text.
  using SeedText = std::pair<std::string, std::string>;

  // `open_seed(name in the scenario)` fetches the seed.
  template <class OpenSeed>
  Result<Scenario> Read(const std::string& text, OpenSeed open_seed) {
    const Result<ConfigValue> config = ParseConfig(text, errors_.file());
    if (!config) return config.error();
    ConfigTable root(*config, "the scenario", &errors_);
    root.Know({"title", "story", "sampling_period_ms", "random_seed", "min_frames", "max_frames", "seed",
               "world", "reasoner", "recording", "events", "teacher", "drives"});
    root.Finish();
    ReadHead(root);
    if (Status status = ReadSeed(root, open_seed); !status) return status.error();
    ReadWorld(root);
    if (Status status = errors_.First(); !status) return status.error();
    if (auto reasoner = root.Table("reasoner")) {
      ReadReasoner(*reasoner);
    } else if (scenario_.reasoner.commit_offset >= scenario_.sampling_period) {
      root.Fail(root.value(), "expected a sampling_period_ms above the " +
                                  std::to_string(scenario_.reasoner.commit_offset.us / 1000) +
                                  " ms after which commands are issued (commit_offset_ms)");
    }
    if (auto recording = root.Table("recording")) ReadRecording(*recording);
    if (auto events = root.Table("events")) ReadEvents(*events);
    for (ConfigTable& command : root.Tables("teacher")) ReadTeacherCommand(command);
    for (ConfigTable& drive : root.Tables("drives")) ReadDrive(drive);
    ReadFrames(root);
    if (Status status = errors_.First(); !status) return status.error();
    MovePropertiesToWorld();
    scenario_.files.emplace(kScenarioFile, text);
    return std::move(scenario_);
  }

 private:
  void ReadHead(ConfigTable& root) {
    scenario_.title = root.RequiredString("title");
    scenario_.story = root.String("story", "");
    scenario_.sampling_period = Milliseconds(root.Integer("sampling_period_ms", 100, 1, 3'600'000));
    scenario_.random_seed = static_cast<std::uint64_t>(
        root.Integer("random_seed", 0, 0, std::numeric_limits<std::int64_t>::max()));
  }

  template <class OpenSeed>
  Status ReadSeed(ConfigTable& root, OpenSeed open_seed) {
    root.Require("seed");
    std::optional<ConfigTable> table = root.Table("seed");
    const std::string name = table ? table->RequiredString("replicode") : "";
    if (table) table->Finish();
    if (Status status = errors_.First(); !status) return status;
    Result<SeedText> text = open_seed(name);
    if (!text) {
      const ConfigValue& where = *table->Get("replicode");
      return ErrorAt({errors_.file(), where.line, where.column}, text.error().message);
    }
    Result<SeedKnowledge> seed =
        ReadReplicode(text->second, text->first, {scenario_.sampling_period, {}, false});
    if (!seed) return seed.error();
    scenario_.seed = std::move(*seed);
    scenario_.files.emplace(kSeedFile, std::move(text->second));
    return Ok();
  }

  void ReadWorld(ConfigTable& root) {
    root.Require("world");
    std::optional<ConfigTable> world = root.Table("world");
    if (!world) return;
    const std::optional<std::size_t> kind = world->Choice("kind", {"scripted", "mujoco"}, 0);
    if (kind == 0u) {
      ScriptedWorldConfig scripted = ReadScriptedWorld(*world, scenario_.seed, &errors_);
      if (!scripted.held_values.empty() && scenario_.sampling_period <= kTimeTolerance * 2) {
        root.Fail(root.value(), "expected a sampling_period_ms above the " +
                                    std::to_string(kTimeTolerance.us * 2 / 1000) +
                                    " ms after which held values such as speeds begin");
      }
      scenario_.world = std::move(scripted);
    } else if (kind == 1u) {
      scenario_.world = ReadMujocoWorld(*world, scenario_.seed, source_, &errors_);
      std::get<MujocoWorldConfig>(scenario_.world).noise.seed = scenario_.random_seed;
    }
  }

  void ReadReasoner(ConfigTable& table) {
    ReasonerParameters& p = scenario_.reasoner;
    const auto milliseconds = [&](std::string_view key, Duration fallback) {
      return Milliseconds(table.Integer(key, fallback.us / 1000, 0, scenario_.sampling_period.us / 1000));
    };
    p.analogy_mode = table.Choice("analogy_mode", {"paper", "openaera"}, 0) == 1u ? AnalogyMode::kOpenaera
                                                                                  : AnalogyMode::kPaper;
    const bool openaera = p.analogy_mode == AnalogyMode::kOpenaera;
    if (openaera) p.analogy_min_matched = 3;
    p.goal_induction = table.Choice("goal_induction", {"all", "side_effects"}, openaera ? 1 : 0) == 1u
                           ? GoalInduction::kSideEffects
                           : GoalInduction::kAll;
    p.value_roles = table.Choice("value_roles", {"apart", "together"}, openaera ? 1 : 0) == 1u
                        ? ValueRoles::kTogether
                        : ValueRoles::kApart;
    p.max_veto_ways = static_cast<int>(table.Integer("max_veto_ways", p.max_veto_ways, 1, 4096));
    p.analogy_min_matched =
        static_cast<int>(table.Integer("analogy_min_matched", p.analogy_min_matched, 1, 1000));
    p.analogy_min_psi = table.Number("analogy_min_psi", p.analogy_min_psi, 0, 1);
    p.mdl_inertia_sr_thr = table.Number("mdl_inertia_sr_thr", p.mdl_inertia_sr_thr, 0, 1);
    p.mdl_inertia_cnt_thr =
        static_cast<int>(table.Integer("mdl_inertia_cnt_thr", p.mdl_inertia_cnt_thr, 1, 1'000'000));
    p.primary_act_thr = table.Number("primary_act_thr", p.primary_act_thr, 0, 1);
    p.secondary_act_thr = table.Number("secondary_act_thr", p.secondary_act_thr, 0, 1);
    p.tpx_time_horizon_frames =
        static_cast<int>(table.Integer("tpx_time_horizon_frames", p.tpx_time_horizon_frames, 1, 1000));
    const auto horizon = [&](std::string_view key, Duration fallback) {
      return Milliseconds(table.Integer(key, fallback.us / 1000, 1, 1'000'000'000'000));
    };
    p.primary_thz = horizon("primary_thz_ms", p.primary_thz);
    p.secondary_thz = horizon("secondary_thz_ms", p.secondary_thz);
    p.max_prediction_chain =
        static_cast<int>(table.Integer("max_prediction_chain", p.max_prediction_chain, 0, 100));
    p.max_plan_depth = static_cast<int>(table.Integer("max_plan_depth", p.max_plan_depth, 1, 100));
    p.max_simulation_nodes =
        static_cast<int>(table.Integer("max_simulation_nodes", p.max_simulation_nodes, 1, 100'000'000));
    p.goal_offset = milliseconds("goal_offset_ms", p.goal_offset);
    p.command_offset = milliseconds("command_offset_ms", p.command_offset);
    p.commit_offset = milliseconds("commit_offset_ms", p.commit_offset);
    if (p.goal_offset > p.commit_offset || p.commit_offset >= scenario_.sampling_period ||
        p.command_offset >= scenario_.sampling_period) {
      table.Fail(table.value(),
                 "expected goal_offset_ms <= commit_offset_ms, and commit_offset_ms and command_offset_ms "
                 "below the sampling period of " +
                     std::to_string(scenario_.sampling_period.us / 1000) + " ms");
    }
    table.Finish();
  }

  void ReadRecording(ConfigTable& table) {
    const double rate = table.Number("world_states_per_second", 20, 0.1, 1000);
    if (auto* mujoco = std::get_if<MujocoWorldConfig>(&scenario_.world)) mujoco->recorded_states_per_s = rate;
    table.Finish();
  }

  void ReadEvents(ConfigTable& table) {
    const bool given = table.Has("off");
    const std::vector<std::string> names = table.Strings("off");
    table.Finish();
    if (!given || !errors_.First()) return;
    scenario_.left_out.reset();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const ConfigValue& where = table.Get("off")->items[i];
      const std::vector<std::string> reports = ReportKindNames();
      const std::size_t kind = KindOfName(names[i]);
      if (IsReportKind(kind)) {
        scenario_.left_out.set(kind);
      } else if (kind < kEventKinds) {
        table.Fail(where, "expected kinds of events that can be switched off (" + Join(reports, ", ") +
                              "), found " + names[i] +
                              ", without which the episode could not be understood or replayed");
      } else {
        const std::string closest = ClosestWord(names[i], reports);
        table.Fail(where, "expected kinds of events that can be switched off (" + Join(reports, ", ") +
                              "), found '" + Printable(names[i]) + "'" +
                              (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
      }
    }
  }

  void ReadTeacherCommand(ConfigTable& table) {
    TeacherCommand read;
    table.Require("frame");
    read.frame = table.Integer("frame", 0, 0, kMaxFrames);
    if (!scenario_.teacher.empty() && read.frame < scenario_.teacher.back().frame && table.Has("frame")) {
      table.Fail(*table.Get("frame"), "expected the teacher's commands by rising frame, found frame " +
                                          std::to_string(read.frame) + " after " +
                                          std::to_string(scenario_.teacher.back().frame));
    }
    const std::string command = table.RequiredString("command");
    read.to = table.String("to", "");
    if (const ConfigValue* to = table.Get("to"); to && !read.to.empty()) {
      CheckEntity(scenario_.seed, *to, read.to, &errors_);
      CheckIsInWorld(*to, read.to);
    }
    if (!command.empty()) read.command = ReadCommand(table, command, !read.to.empty());
    table.Finish();
    scenario_.teacher.push_back(std::move(read));
  }

  // What of the command can be known now.
  Term ReadCommand(ConfigTable& table, const std::string& text, bool has_target) {
    const ConfigValue& where = *table.Get("command");
    Term command;
    if (text.front() == '(') {
      if (has_target) table.Fail(*table.Get("to"), "expected no 'to' beside a command that is written out");
      command = ReadPayloadAt(where, text);
      if (command.is(TermKind::kNil)) return command;
      if (!IsCommand(command)) {
        table.Fail(where, "expected a command such as (cmd release [h]), found " + Printable(text));
        return {};
      }
    } else {
      command = MakeCommand(Term::Ontology(text), {HandOf(scenario_)});
    }
    const std::optional<CommandKind> kind = KindOfCommand(where, command[0].name());
    if (kind && text.front() != '(' && (*kind == CommandKind::kMove) != has_target) {
      table.Fail(where, has_target
                            ? "expected a move, the only command with 'to', found '" + text + "'"
                            : "expected 'to', the entity to move to, beside '" + text + "', found none");
    }
    return command;
  }

  std::optional<CommandKind> KindOfCommand(const ConfigValue& where, const std::string& name) {
    return std::visit(
        [&](const auto& world) -> std::optional<CommandKind> {
          std::vector<std::string> known;
          for (const auto& command : world.commands) {
            if (command.name == name) return command.kind;
            known.push_back(command.name);
          }
          const std::string closest = ClosestWord(name, known);
          errors_.Add(where, "expected a command of the world (" + Join(known, ", ") + "), found '" +
                                 Printable(name) + "'" +
                                 (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
          return std::nullopt;
        },
        scenario_.world);
  }

  void CheckIsInWorld(const ConfigValue& where, const std::string& entity) {
    const bool known = std::visit(
        [&](const auto& world) {
          return std::any_of(world.objects.begin(), world.objects.end(),
                             [&](const auto& object) { return object.entity == entity; });
        },
        scenario_.world);
    if (!known && FindSymbol(scenario_.seed, entity)) {
      errors_.Add(where,
                  "expected an object of the world, found '" + Printable(entity) + "', which is not one");
    }
  }

  // Nil after an error.
  Term ReadPayloadAt(const ConfigValue& where, const std::string& text) {
    const Result<Term> payload = ReadPayload(text, {errors_.file(), where.line, where.column + 1},
                                             {scenario_.sampling_period, scenario_.seed.symbols, false});
    if (payload) return *payload;
    errors_.Add(where.line, where.column, payload.error());
    return {};
  }

  void ReadDrive(ConfigTable& table) {
    Drive drive;
    drive.title = table.RequiredString("title");
    drive.frames = table.Integer("frames", drive.frames, 1, kMaxFrames);
    drive.frame = ReadDriveFrame(table);
    const std::string goal = table.String("goal", "");
    drive.model_label = table.String("model", "");
    if (goal.empty() == drive.model_label.empty()) {
      table.Fail(
          table.value(),
          "expected either 'goal', such as \"(mk.val h holding [])\", or 'model', the label of a drive "
          "model of the seed, in [[drives]], found " +
              std::string(goal.empty() ? "neither" : "both"));
    } else if (!goal.empty()) {
      drive.goal = ReadPayloadAt(*table.Get("goal"), goal);
      if (!drive.goal.is(TermKind::kNil) && !IsValue(drive.goal)) {
        table.Fail(*table.Get("goal"), "expected a goal (mk.val ...), found " + Printable(goal));
      }
    } else {
      drive.goal = GoalOfModel(*table.Get("model"), drive.model_label);
    }
    table.Finish();
    scenario_.drives.push_back(std::move(drive));
  }

  // A drive that names no frame waits for the teacher's last command if it is the first one.
  std::int64_t ReadDriveFrame(ConfigTable& table) {
    const bool first = scenario_.drives.empty();
    const std::int64_t earliest = first ? 0 : scenario_.drives.back().frame;
    const std::int64_t taught = scenario_.teacher.empty() ? 1 : scenario_.teacher.back().frame + 1;
    const std::int64_t frame = table.Integer("frame", first ? taught : earliest, 0, kMaxFrames);
    if (frame < earliest) {
      table.Fail(*table.Get("frame"), "expected the drives by rising frame, found frame " +
                                          std::to_string(frame) + " after " + std::to_string(earliest));
    }
    return frame;
  }

  Term GoalOfModel(const ConfigValue& where, const std::string& label) {
    const SeedModel* model = FindModel(scenario_.seed, label);
    if (!model || KindOf(model->model) != ModelKind::kDrive) {
      std::vector<std::string> known;
      for (const SeedModel& candidate : scenario_.seed.models) {
        if (KindOf(candidate.model) == ModelKind::kDrive) known.push_back(candidate.label);
      }
      const std::string closest = ClosestWord(label, known);
      errors_.Add(where, "expected the label of a drive model of the seed, found '" + Printable(label) + "'" +
                             (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
      return {};
    }
    const FactPattern& wanted = model->model.lhs;
    if (wanted.positive && IsValue(wanted.payload) && wanted.payload.ground()) return wanted.payload;
    errors_.Add(
        where,
        "expected a drive model whose left side is a (fact (mk.val ...) ...) without variables, found '" +
            Printable(label) + "', which has another");
    return {};
  }

  void ReadFrames(ConfigTable& root) {
    scenario_.min_frames = root.Integer("min_frames", 0, 0, kMaxFrames);
    std::int64_t frames = 0;
    for (const Drive& drive : scenario_.drives) frames = std::max(frames, drive.frame) + drive.frames;
    if (!scenario_.teacher.empty()) frames = std::max(frames, scenario_.teacher.back().frame + 1);
    frames = std::max(frames + 1, scenario_.min_frames);
    scenario_.max_frames = root.Integer("max_frames", std::min(frames, kMaxFrames), 1, kMaxFrames);
    if (scenario_.max_frames < scenario_.min_frames) {
      root.Fail(*root.Get("max_frames"), "expected a max_frames of at least min_frames, found fewer");
    }
  }

  // They are reported by the world now.
  void MovePropertiesToWorld() {
    std::vector<std::string> entities;
    std::visit(
        [&](const auto& world) {
          entities.push_back(HandOf(scenario_).name());
          for (const auto& object : world.objects) entities.push_back(object.entity);
        },
        scenario_.world);
    std::erase_if(scenario_.seed.facts, [&](const SeedFact& fact) {
      return IsLastingProperty(fact.fact) &&
             std::find(entities.begin(), entities.end(), fact.fact.payload[0].name()) != entities.end();
    });
  }

  ConfigErrors errors_;
  ModelSource source_;
  Scenario scenario_;
};

// The position of an entity as the sensors report it; null if they do not.
const Term* PositionIn(std::span<const Fact> observed, const Term& entity, const Term& attribute) {
  for (const Fact& fact : observed) {
    if (fact.positive && IsValue(fact.payload) && fact.payload[0] == entity && fact.payload[1] == attribute) {
      return &fact.payload[2];
    }
  }
  return nullptr;
}

}  // namespace

Result<Scenario> LoadScenario(const std::string& path) {
  const Result<std::string> text = ReadTextFile(path, "a scenario file");
  if (!text) return text.error();
  if (text->starts_with("SQLite format 3")) {
    return Error{path + ": expected a scenario, found an episode, which was run already; `aerascope report " +
                 path + "` shows it"};
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  ScenarioReader reader(path, {folder.string(), nullptr});
  return reader.Read(*text, [&](const std::string& name) -> Result<ScenarioReader::SeedText> {
    const std::string seed_path = (folder / name).lexically_normal().string();
    Result<std::string> seed = ReadTextFile(seed_path, "the seed of the scenario");
    if (!seed) return seed.error();
    return ScenarioReader::SeedText{seed_path, std::move(*seed)};
  });
}

Result<Scenario> LoadScenarioFromFiles(const std::map<std::string, std::string>& files) {
  const auto text = files.find(std::string(kScenarioFile));
  if (text == files.end()) {
    return Error{"expected the file " + std::string(kScenarioFile) + " in the episode, found none"};
  }
  ScenarioReader reader(std::string(kScenarioFile), {"", &files});
  return reader.Read(text->second, [&](const std::string&) -> Result<ScenarioReader::SeedText> {
    const auto seed = files.find(std::string(kSeedFile));
    if (seed == files.end())
      return Error{"expected the file " + std::string(kSeedFile) + " in the episode, found none"};
    return ScenarioReader::SeedText{std::string(kSeedFile), seed->second};
  });
}

Scenario WithRandomSeed(Scenario scenario, std::uint64_t seed) {
  scenario.random_seed = seed;
  if (auto* mujoco = std::get_if<MujocoWorldConfig>(&scenario.world)) mujoco->noise.seed = seed;
  return scenario;
}

std::string_view WorldKind(const Scenario& scenario) {
  return std::holds_alternative<MujocoWorldConfig>(scenario.world) ? "mujoco" : "scripted";
}

Term HandOf(const Scenario& scenario) {
  if (const auto* mujoco = std::get_if<MujocoWorldConfig>(&scenario.world))
    return Term::Entity(mujoco->hand.entity);
  return Term::Entity(std::get<ScriptedWorldConfig>(scenario.world).hand_entity);
}

Term PositionAttributeOf(const Scenario& scenario) {
  if (const auto* mujoco = std::get_if<MujocoWorldConfig>(&scenario.world)) {
    return Term::Ontology(mujoco->sensors.position_attribute);
  }
  return Term::Ontology(std::get<ScriptedWorldConfig>(scenario.world).position_attribute);
}

Result<Term> CompleteCommand(const TeacherCommand& command, const Scenario& scenario,
                             std::span<const Fact> observed) {
  if (command.to.empty()) return command.command;
  const Term attribute = PositionAttributeOf(scenario);
  const Term* target = PositionIn(observed, Term::Entity(command.to), attribute);
  const Term* hand = PositionIn(observed, HandOf(scenario), attribute);
  if (!target || !hand) {
    return Error{"expected the " + attribute.name() + " of " + (hand ? command.to : HandOf(scenario).name()) +
                 " among the facts of frame " + std::to_string(command.frame) +
                 ", which the teacher needs, found none"};
  }
  const auto way = Evaluate(Term::Struct("-", {*target, *hand}), Bindings());
  if (!way) {
    return Error{"expected positions that can be subtracted, found " + ToText(*target) + " of " + command.to +
                 " and " + ToText(*hand) + " of the hand"};
  }
  std::vector<Term> arguments(command.command[1].items().begin(), command.command[1].items().end());
  arguments.push_back(*way);
  return MakeCommand(command.command[0], std::move(arguments));
}

}  // namespace aerascope
