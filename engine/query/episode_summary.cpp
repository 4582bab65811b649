#include "engine/query/episode_summary.h"

#include <map>

#include "engine/query/describe.h"

namespace aerascope {
namespace {

std::string Count(std::int64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::vector<DriveOutcome> DrivesOf(const GoalTree& tree) {
  std::vector<DriveOutcome> drives;
  for (const GoalNode& goal : tree.goals) {
    if (!goal.drive) continue;
    drives.push_back({goal.goal, goal.title, goal.target, goal.event, goal.time, goal.target.interval.before,
                      goal.outcome, goal.outcome_event, goal.outcome_time});
  }
  return drives;
}

// About the world: not about instances of composite states or models.
bool IsAboutTheWorld(const Event& event, const PredictionMade& made) {
  return !event.simulation.valid() && !IsIcst(made.target.payload) && !IsImdl(made.target.payload);
}

std::vector<PredictionRecordOfRun> PredictionsOf(const Run& run) {
  std::vector<PredictionRecordOfRun> predictions;
  std::map<PredictionId, std::size_t> positions;
  for (const EventId id : run.OfKind<PredictionMade>()) {
    const Event& event = *run.Find(id);
    const auto& made = std::get<PredictionMade>(event.body);
    // A confidence of zero is a silent prediction: a vetoed model is only watched.
    if (!IsAboutTheWorld(event, made) || made.target.confidence <= 0) continue;
    positions[made.prediction] = predictions.size();
    predictions.push_back({made.prediction,
                           made.model,
                           made.requirements,
                           made.target,
                           id,
                           event.time,
                           Outcome::kOpen,
                           {},
                           run.end()});
  }
  const auto close = [&](EventId id, PredictionId prediction, Outcome outcome) {
    const auto it = positions.find(prediction);
    const Event& event = *run.Find(id);
    if (it == positions.end() || event.simulation.valid()) return;
    PredictionRecordOfRun& record = predictions[it->second];
    if (record.outcome != Outcome::kOpen) return;
    record.outcome = outcome;
    record.outcome_event = id;
    record.until = event.time;
  };
  for (const EventId id : run.OfKind<PredictionSucceeded>()) {
    close(id, run.FindBody<PredictionSucceeded>(id)->prediction, Outcome::kReached);
  }
  for (const EventId id : run.OfKind<PredictionFailed>()) {
    close(id, run.FindBody<PredictionFailed>(id)->prediction, Outcome::kFailed);
  }
  return predictions;
}

std::vector<AnalogyOfRun> AnalogiesOf(const Run& run) {
  std::vector<AnalogyOfRun> analogies;
  for (const EventId id : run.OfKind<AnalogyCompared>()) {
    const auto* compared = run.FindBody<AnalogyCompared>(id);
    const EventId made = run.CreationOf(compared->result_requirement);
    analogies.push_back(
        {id, run.Find(id)->time, compared, compared->result_requirement.valid() && made > id});
  }
  return analogies;
}

// Frames with commands of one commander in a row; the stretch of the next one begins with its first command's
// frame.
std::vector<Phase> PhasesOf(const Run& run) {
  std::vector<Phase> phases;
  for (const IssuedCommand& command : CommandsOf(run)) {
    const std::optional<std::size_t> frame = run.FrameAt(command.time);
    const Time from = frame ? run.frames()[*frame].interval.after : command.time;
    if (!phases.empty() && phases.back().by == command.by) continue;
    if (!phases.empty()) phases.back().interval.before = from;
    phases.push_back({command.by, {from, run.end()}});
  }
  return phases;
}

std::vector<std::string> HeadlineOf(const Run& run, const EpisodeSummary& summary) {
  std::vector<std::string> headline;
  if (!summary.drives.empty()) {
    headline.push_back(std::to_string(summary.drives_reached) + " of " +
                       Count(static_cast<std::int64_t>(summary.drives.size()), "goal", "goals") + " reached");
  }
  std::string learned = Count(static_cast<std::int64_t>(summary.learned.size()), "piece of knowledge learned",
                              "pieces of knowledge learned");
  if (!summary.by_analogy.empty())
    learned += ", " + std::to_string(summary.by_analogy.size()) + " by analogy";
  if (!summary.given_up.empty()) learned += ", " + std::to_string(summary.given_up.size()) + " given up";
  headline.push_back(std::move(learned));
  if (summary.score.made > 0) {
    headline.push_back(std::to_string(summary.score.came_true) + " of " +
                       Count(summary.score.decided(), "prediction", "predictions") + " came true");
    if (summary.score.open() > 0)
      headline.back() += ", " + std::to_string(summary.score.open()) + " not decided";
  }
  if (!summary.complete) {
    headline.push_back(run.events().empty() ? "incomplete, no events"
                                            : "incomplete, last event " + IdText(run.events().back().id));
  }
  return headline;
}

}  // namespace

EpisodeSummary Summarise(const Run& run) {
  EpisodeSummary summary;
  summary.title = run.title();
  summary.complete = run.complete();
  summary.frames = static_cast<std::int64_t>(run.frames().size());
  summary.events = static_cast<std::int64_t>(run.events().size());
  summary.end = run.end();
  summary.drives = DrivesOf(MakeGoalTree(run));
  for (const DriveOutcome& drive : summary.drives)
    summary.drives_reached += drive.outcome == Outcome::kReached ? 1 : 0;
  summary.predictions = PredictionsOf(run);
  for (const PredictionRecordOfRun& prediction : summary.predictions) {
    ++summary.score.made;
    summary.score.came_true += prediction.outcome == Outcome::kReached ? 1 : 0;
    summary.score.failed += prediction.outcome == Outcome::kFailed ? 1 : 0;
  }
  summary.analogies = AnalogiesOf(run);
  for (const auto& [id, record] : run.final_knowledge().models()) {
    if (!IsRequirement(record.model) || record.origin == Origin::kSeed) continue;
    summary.learned.push_back(id);
    if (record.origin == Origin::kAnalogy) summary.by_analogy.push_back(id);
    if (record.state == ModelState::kDeleted) summary.given_up.push_back(id);
  }
  summary.phases = PhasesOf(run);
  summary.headline = HeadlineOf(run, summary);
  return summary;
}

}  // namespace aerascope
