// A World is what the agent senses and acts in: it turns its state into facts each frame, carries out
// commands, and can describe itself completely, so that an episode file needs nothing else to show it again.
//
// Not thread-safe: one thread uses a world. Always true: (1) the same configuration and the same calls give
// the same answers; (2) facts come in one fixed order, the hand first, then the objects as configured; (3)
// what Act says was executed is what was really done, not what was asked for.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/time.h"
#include "engine/kb/fact.h"
#include "engine/kb/term.h"

namespace aerascope {

// Enough to draw one moment again. In the scripted world, qpos holds the positions (the hand first) and ctrl
// says for each object whether it is held; what has no position is at 0.
struct WorldState {
  Time time;
  std::vector<double> qpos;
  std::vector<double> qvel;
  std::vector<double> ctrl;

  bool operator==(const WorldState&) const = default;
};

// A file of the world, in memory. The name has no folder.
struct WorldAsset {
  std::string name;
  std::string bytes;

  bool operator==(const WorldAsset&) const = default;
};

// Everything needed to build the scene again elsewhere. For MuJoCo, `model_text` is MJCF which names only the
// assets given here, all of them in formats that MuJoCo itself reads.
struct WorldDescription {
  std::string kind;  // "mujoco" or "scripted"
  std::string model_text;
  std::vector<WorldAsset> assets;
  std::vector<std::string> cameras;  // the first one is the default view
  // Which body of the model an entity is; of the hand, the one that carries its tool. Entities without one
  // are left out.
  std::map<std::string, std::string> body_of_entity{};
};

// How a sensor's word is dated (semantics 7.2). A periodic value holds throughout the frame it was sensed in.
// A held one begins a little later, so that it is not simultaneous with the periodic values and may be taken
// for the cause of what changes next; speeds are sensed so.
enum class SyncMode { kPeriodic, kHold };

// Empty only in a frame too short for a held value.
constexpr TimeInterval SensedDuring(TimeInterval frame, SyncMode sync) {
  return sync == SyncMode::kPeriodic ? frame : TimeInterval{frame.after + kTimeTolerance * 2, frame.before};
}

struct ActOutcome {
  std::vector<Term> executed;      // commands with the arguments that were really carried out
  std::vector<WorldState> states;  // recorded on the way, in order of time
  std::vector<std::string> notes;  // one sentence for each command that was clipped or refused
};

class World {
 public:
  virtual ~World() = default;

  // The changing facts (positions, holding) of this frame, as the sensors report them now.
  virtual Result<std::vector<Fact>> Observe(TimeInterval frame) = 0;
  // The facts that never change (essence, shape, size and whatever else was configured), valid always.
  virtual std::vector<Fact> Properties() const = 0;
  // Waits until `during.after`, carries out the commands one after the other, and runs on to `during.before`.
  virtual Result<ActOutcome> Act(std::span<const Term> commands, TimeInterval during) = 0;
  virtual WorldState State() const = 0;
  virtual WorldDescription Description() const = 0;
};

}  // namespace aerascope
