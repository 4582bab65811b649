// The run at a glance: what was wanted and reached, learned, predicted, and by which analogies.
#pragma once

#include <string>
#include <vector>

#include "engine/query/goal_tree.h"
#include "engine/query/run.h"

namespace aerascope {

struct DriveOutcome {
  GoalId goal;
  std::string title;
  Fact target;
  EventId event;
  Time from;
  Time deadline;
  Outcome outcome = Outcome::kOpen;
  EventId outcome_event;
  Time until;  // when it was decided; end of the run while open
};

// Predictions about the world made in earnest: those of requirement models and of simulations are not
// counted.
struct PredictionRecordOfRun {
  PredictionId prediction;
  ModelId model;
  std::vector<ModelId> requirements;
  Fact target;
  EventId event;
  Time time;
  Outcome outcome = Outcome::kOpen;
  EventId outcome_event;
  Time until;
};
struct PredictionScore {
  std::int64_t made = 0;
  std::int64_t came_true = 0;
  std::int64_t failed = 0;
  std::int64_t decided() const { return came_true + failed; }
  std::int64_t open() const { return made - decided(); }
};

struct AnalogyOfRun {
  EventId event;
  Time time;
  const AnalogyCompared* compared = nullptr;  // in the run
  bool made_knowledge = false;                // its result was created by it, not known before
};

// A stretch of frames in which only the teacher, or only the agent, commands.
struct Phase {
  Commander by = Commander::kAgent;
  TimeInterval interval;
};

struct EpisodeSummary {
  std::string title;
  bool complete = false;
  std::int64_t frames = 0;
  std::int64_t events = 0;
  Time end;
  std::vector<DriveOutcome> drives;
  std::int64_t drives_reached = 0;
  std::vector<PredictionRecordOfRun> predictions;
  PredictionScore score;
  std::vector<AnalogyOfRun> analogies;  // every comparison, accepted or not, in order
  std::vector<ModelId> learned;         // requirement models not from the seed: one a piece of knowledge
  std::vector<ModelId> by_analogy;      // those of them made by analogy
  std::vector<ModelId> given_up;        // those of them that were deleted by the end
  std::vector<Phase> phases;
  // "5 of 5 goals reached", "9 pieces of knowledge learned, 4 by analogy, 2 given up", "9 of 9 predictions
  // came true", and where it applies "incomplete, last event 211": what a heading says.
  std::vector<std::string> headline;
};

EpisodeSummary Summarise(const Run& run);

}  // namespace aerascope
