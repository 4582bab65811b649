#include "engine/query/model_history.h"

#include <algorithm>
#include <map>

#include "engine/query/describe.h"

namespace aerascope {
namespace {

// What was seen that moved the evidence: the evidence of the outcome that the event names as a cause.
std::string ReasonOf(const Run& run, const Event& event, bool success) {
  const KnowledgeBase& knowledge = run.final_knowledge();
  for (const EventId cause : event.causes) {
    const auto* came_true = run.FindBody<PredictionSucceeded>(cause);
    const auto* failed = run.FindBody<PredictionFailed>(cause);
    if (!came_true && !failed) continue;
    const PredictionId prediction = came_true ? came_true->prediction : failed->prediction;
    const auto* made = run.FindBody<PredictionMade>(run.CreationOf(prediction));
    // A veto was right when the prediction was not.
    if (made) return FactText(knowledge, made->target) + (came_true ? " came true" : " did not come true");
  }
  return success ? "was right" : "was wrong";
}

std::string ReasonOf(const ModelCreated& created) {
  switch (created.origin) {
    case Origin::kSeed:
      return "given";
    case Origin::kAnalogy:
      return "by analogy";
    case Origin::kInduction:
    case Origin::kPredictionFailure:
    case Origin::kGoalSuccess:
      return "learned";
  }
  return {};
}

class Historian {
 public:
  explicit Historian(const Run& run) : run_(run) {}

  void Note(const Event& event) {
    if (event.simulation.valid()) return;
    if (const auto* created = std::get_if<ModelCreated>(&event.body)) {
      histories_[created->model.id] = {created->model.id,
                                       {{event.time, event.id, created->evidence, created->strong,
                                         ModelState::kActive, std::nullopt, ReasonOf(*created)}}};
    }
    if (const auto* updated = std::get_if<EvidenceUpdated>(&event.body)) {
      if (ModelHistory* history = Find(updated->model)) {
        history->steps.push_back({event.time, event.id, updated->after, updated->strong_after,
                                  history->steps.back().state, updated->success,
                                  ReasonOf(run_, event, updated->success)});
      }
    }
    if (const auto* changed = std::get_if<ModelStateChanged>(&event.body)) {
      if (ModelHistory* history = Find(changed->model)) {
        const ConfidenceStep& last = history->steps.back();
        history->steps.push_back({event.time, event.id, last.evidence, last.strong, changed->after,
                                  std::nullopt, std::string(EnumName(changed->after))});
      }
    }
  }

  std::vector<ModelHistory> Result() {
    std::vector<ModelHistory> list;
    for (auto& [id, history] : histories_) list.push_back(std::move(history));
    return list;
  }

 private:
  ModelHistory* Find(ModelId id) {
    const auto it = histories_.find(id);
    return it == histories_.end() ? nullptr : &it->second;
  }

  const Run& run_;
  std::map<ModelId, ModelHistory> histories_;
};

// The events that matter, in order of the log.
std::vector<EventId> Relevant(const Run& run) {
  std::vector<EventId> events = run.OfKind<ModelCreated>();
  const auto& updated = run.OfKind<EvidenceUpdated>();
  const auto& changed = run.OfKind<ModelStateChanged>();
  events.insert(events.end(), updated.begin(), updated.end());
  events.insert(events.end(), changed.begin(), changed.end());
  std::sort(events.begin(), events.end());
  return events;
}

}  // namespace

std::optional<double> ModelHistory::ConfidenceAt(Time t) const {
  std::optional<double> confidence;
  for (const ConfidenceStep& step : steps) {
    if (step.time <= t) confidence = step.evidence.rate();
  }
  return confidence;
}

std::vector<ModelHistory> Histories(const Run& run) {
  Historian historian(run);
  for (const EventId id : Relevant(run)) historian.Note(*run.Find(id));
  return historian.Result();
}

ModelHistory HistoryOf(const Run& run, ModelId model) {
  for (ModelHistory& history : Histories(run)) {
    if (history.model == model) return std::move(history);
  }
  return {model, {}};
}

ModelUse UseOf(const Run& run, ModelId model, Time t) {
  ModelUse use;
  const auto by_model = [&](PredictionId prediction) {
    const auto* made = run.FindBody<PredictionMade>(run.CreationOf(prediction));
    if (!made) return false;
    return made->model == model ||
           std::find(made->requirements.begin(), made->requirements.end(), model) != made->requirements.end();
  };
  const auto in_earnest = [&](EventId id) {
    const Event& event = *run.Find(id);
    return !event.simulation.valid() && event.time <= t;
  };
  for (const EventId id : run.OfKind<PredictionMade>()) {
    if (in_earnest(id) && by_model(run.FindBody<PredictionMade>(id)->prediction)) ++use.predicted;
  }
  for (const EventId id : run.OfKind<PredictionSucceeded>()) {
    if (in_earnest(id) && by_model(run.FindBody<PredictionSucceeded>(id)->prediction)) ++use.came_true;
  }
  for (const EventId id : run.OfKind<PredictionFailed>()) {
    if (in_earnest(id) && by_model(run.FindBody<PredictionFailed>(id)->prediction)) ++use.failed;
  }
  return use;
}

}  // namespace aerascope
