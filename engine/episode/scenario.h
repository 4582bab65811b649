// A Scenario is everything that decides an episode: what the agent knows at the start, the world, what the
// teacher does, what the agent is driven to, and the parameters of its reasoning. It is read from one TOML
// file and the Replicode seed that file names; docs/scenario-file.md lists the keys.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/time.h"
#include "engine/event/report_kinds.h"
#include "engine/kb/fact.h"
#include "engine/kb/term.h"
#include "engine/reason/parameters.h"
#include "engine/replicode/seed.h"
#include "engine/world/mujoco_world_config.h"
#include "engine/world/scripted_world.h"

namespace aerascope {

// The teacher makes the agent's body do something in a frame; the agent sees it as an executed command.
struct TeacherCommand {
  std::int64_t frame = 0;
  Term command;  // (cmd grab_type_1 [h]); of a move to something without its last argument: (cmd move [h])
  std::string
      to;  // the entity to move to; its way from the hand becomes the last argument. Empty if complete.
};

// Something to be achieved. Drives follow each other: each is given when the one before is settled, but not
// before its frame, and lasts until it is achieved or its frames are over.
struct Drive {
  std::string title;  // for people: "hold s1"
  Term goal;          // the payload wanted, ground
  std::string
      model_label;  // of the seed's drive model that says so; empty where the scenario gives the goal itself
  std::int64_t frames = 8;
  std::int64_t frame = 0;
};

struct Scenario {
  std::string title;
  std::string story;

  SeedKnowledge
      seed;  // its facts about things of the world are in the world's configuration instead, see below
  std::variant<ScriptedWorldConfig, MujocoWorldConfig> world;
  ReasonerParameters reasoner;
  Duration sampling_period = Milliseconds(100);  // the length of a frame
  std::uint64_t random_seed = 0;                 // of the world's noise; also in its configuration
  std::vector<TeacherCommand> teacher;           // by rising frame
  std::vector<Drive> drives;
  std::int64_t min_frames = 0;                 // the episode goes on at least this long, drives or not
  std::int64_t max_frames = 0;                 // and ends here at the latest
  EventKindSet left_out = LeftOutByDefault();  // kinds of events that are not recorded

  // The texts this was read from: "scenario.toml" and "seed.replicode".
  std::map<std::string, std::string> files;
};

// Reads the file, the seed it names and nothing else; a MuJoCo model is only looked for. Everything the seed
// says for ever about a thing of the world, such as its shape and size, becomes a property in the world's
// configuration and is no longer among the seed's facts: World::Properties reports it.
Result<Scenario> LoadScenario(const std::string& path);

// Builds the same scenario from texts kept in an episode file: "scenario.toml", "seed.replicode", and for
// MuJoCo "world/scene.xml" and its other files under "world/".
Result<Scenario> LoadScenarioFromFiles(const std::map<std::string, std::string>& files);

// The scenario with another random seed.
Scenario WithRandomSeed(Scenario scenario, std::uint64_t seed);

// "scripted" or "mujoco".
std::string_view WorldKind(const Scenario& scenario);
// The agent's hand, and the attribute under which the world reports positions.
Term HandOf(const Scenario& scenario);
Term PositionAttributeOf(const Scenario& scenario);

// The complete command, given what the sensors report in its frame.
Result<Term> CompleteCommand(const TeacherCommand& command, const Scenario& scenario,
                             std::span<const Fact> observed);

}  // namespace aerascope
