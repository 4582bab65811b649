// The tabletop world of the demo, configured as its scenario does it, and short ways to command and observe
// it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/world/mujoco_world.h"

namespace aerascope {

inline MujocoWorldConfig TabletopConfig(std::uint64_t seed) {
  MujocoWorldConfig config;
  config.model_path = AERASCOPE_SOURCE_DIR "/assets/worlds/tabletop/scene.xml";
  config.hand.entity = "h";
  config.hand.properties = {{"essence", "hand"}};
  config.hand.tool_site = "tool";
  config.hand.arm_joints = {"arm_yaw",         "arm_shoulder",   "arm_elbow",
                            "arm_wrist_pitch", "arm_wrist_tilt", "arm_wrist_roll"};
  config.hand.home_posture = {0, 0.23, 0.24, -0.47, 0, -1.57};
  config.hand.home_position_m = {0, -0.03};
  config.hand.tool_yaw_rad = 0;
  config.hand.finger_bodies = {"finger_left", "finger_right"};
  config.hand.finger_actuators = {{"fingers", 0.5, 0}};
  config.hand.start_gap_m = 0.06;
  config.objects = {{"c1", "c1", {{"shape", "cube"}, {"size", "small"}}},
                    {"c2", "c2", {{"shape", "cube"}, {"size", "large"}}},
                    {"s1", "s1", {{"shape", "sphere"}, {"size", "large"}}},
                    {"s2", "s2", {{"shape", "sphere"}, {"size", "small"}}},
                    {"cyl", "cyl", {{"shape", "cylinder"}, {"size", "large"}}}};
  config.noise = {seed, 0.015, 0.1, 0.11};
  config.motion.grasp_height_m = 0.025;
  config.motion.workspace_min_m = {-0.24, -0.15};
  config.motion.workspace_max_m = {0.24, 0.07};
  config.commands = {{"move", CommandKind::kMove, 0, 0},
                     {"grab_type_1", CommandKind::kGrab, 0.044, 0.018},
                     {"grab_type_2", CommandKind::kGrab, 0.090, 0.052},
                     {"release", CommandKind::kRelease, 0.090, 0}};
  return config;
}

// Drives a world in frames, commands being issued 60 ms into each frame.
class Driver {
 public:
  explicit Driver(World& world, Duration frame = Seconds(1)) : world_(world), frame_(frame) {}

  TimeInterval Frame() const { return {now_, now_ + frame_}; }

  ActOutcome Do(std::vector<Term> commands) {
    Result<ActOutcome> outcome = world_.Act(commands, {now_ + Milliseconds(60), now_ + frame_});
    now_ = now_ + frame_;
    if (!outcome) return {{}, {}, {"failed: " + outcome.error().message}};
    return *outcome;
  }
  ActOutcome Command(const std::string& name) {
    return Do({MakeCommand(Term::Ontology(name), {Term::Entity("h")})});
  }
  ActOutcome Move(double x, double y) {
    const Term delta = Term::Struct("vec2", {Term::Number(x), Term::Number(y)});
    return Do({MakeCommand(Term::Ontology("move"), {Term::Entity("h"), delta})});
  }
  // Moves the hand to where the object is reported to be.
  ActOutcome MoveTo(const std::string& object) {
    const Term hand = Value("h", "position");
    const Term place = Value(object, "position");
    return Move(place[0].number() - hand[0].number(), place[1].number() - hand[1].number());
  }

  Term Value(const std::string& object, const std::string& attribute) {
    Result<std::vector<Fact>> facts = world_.Observe(Frame());
    if (!facts) return Term::String(facts.error().message);
    for (const Fact& fact : *facts) {
      if (fact.payload[0].name() == object && fact.payload[1].name() == attribute) return fact.payload[2];
    }
    return Term::Nil();
  }
  std::string Holding() { return ToText(Value("h", "holding")); }

 private:
  World& world_;
  Duration frame_;
  Time now_;
};

}  // namespace aerascope
