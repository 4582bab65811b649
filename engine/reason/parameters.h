// The numbers a Reasoner runs by: thresholds, limits, and the named instants inside a frame.
//
// Names follow OpenAERA where it has the parameter, so that a value can be carried over. The defaults are
// OpenAERA's; what OpenAERA lacks says so. A scenario sets them in its [reasoner] table under these names
// (durations there in milliseconds, with `_ms` at the end).
#pragma once

#include <string_view>

#include "engine/base/time.h"

namespace aerascope {

// How goal-driven analogy judges a partial match. kPaper: confidence = familiarity * success rate of the
// original requirement, over all bindings, without duplicates. kOpenaera: what OpenAERA's analogy branch
// does: constant confidence 0.6, at least three matched components, the first binding only.
enum class AnalogyMode { kPaper, kOpenaera };

constexpr std::string_view ToText(AnalogyMode mode) {
  return mode == AnalogyMode::kPaper ? "paper" : "openaera";
}

// What induction from goals looks at (semantics 5.3). kSideEffects: what OpenAERA's standard setting
// (pass_through) leaves: anti-facts that came about beside what a command was predicted to do. kAll: whatever
// came before an unexpected success.
enum class GoalInduction { kAll, kSideEffects };

constexpr std::string_view ToText(GoalInduction induction) {
  return induction == GoalInduction::kAll ? "all" : "side_effects";
}

// When induction takes two equal quantities for the same one (semantics 10.4, coincidence). kApart: only in
// one role (roles.h), so that a hand moved by 5 to 5 teaches nothing about fives; this project's choice.
// kTogether: wherever they stand, as OpenAERA does.
enum class ValueRoles { kApart, kTogether };

constexpr std::string_view ToText(ValueRoles roles) {
  return roles == ValueRoles::kApart ? "apart" : "together";
}

struct ReasonerParameters {
  // Analogy (not parameters in OpenAERA, where three components are built in and familiarity is not
  // computed).
  AnalogyMode analogy_mode = AnalogyMode::kPaper;
  int analogy_min_matched = 2;   // components that must match, at least; openaera mode: 3
  double analogy_min_psi = 0.5;  // familiarity must be above this, strictly

  // Rating of models (OpenAERA).
  double mdl_inertia_sr_thr = 0.9;  // success rate from which a model can become strong
  int mdl_inertia_cnt_thr = 6;      // number of tries from which a model can become strong
  double primary_act_thr = 0.4;  // a model at or below this success rate is deleted, or phased out if strong
  double secondary_act_thr = 0.3;  // a phased-out model above this is watched for recovery
  Duration primary_thz =
      Seconds(3'600'000);  // a model that nothing has matched for so long is phased out ...
  Duration secondary_thz = Seconds(7'200'000);  // ... and for so long, deleted; a black-listed one forgotten

  // Induction (OpenAERA: 300 ms in frames of 100 ms).
  int tpx_time_horizon_frames = 3;  // how far back the causes of a failed prediction are looked for
  GoalInduction goal_induction = GoalInduction::kAll;  // openaera mode: kSideEffects
  ValueRoles value_roles = ValueRoles::kApart;         // openaera mode: kTogether
  // A condition put together after a failure becomes a veto only if it holds in at most so many ways at once.
  // OpenAERA has no such limit.
  int max_veto_ways = 24;

  // Forward chaining. OpenAERA has no limit of its own here.
  int max_prediction_chain = 4;  // predictions that rest on one another, beyond the one made from facts

  // Planning. OpenAERA limits it by wall-clock time instead; counts keep runs the same on every machine.
  int max_plan_depth = 8;            // goals under goals
  int max_simulation_nodes = 10000;  // simulated steps for one drive in one frame

  // Instants after the start of a frame, the same for every sampling period (OpenAERA, semantics 7.3).
  Duration goal_offset = Milliseconds(10);     // drives are set and backward chaining runs
  Duration command_offset = Milliseconds(20);  // a command's own interval begins
  Duration commit_offset = Milliseconds(60);   // the best plan's first command is issued

  bool operator==(const ReasonerParameters&) const = default;
};

}  // namespace aerascope
