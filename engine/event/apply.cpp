#include "engine/event/apply.h"

namespace aerascope {
namespace {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

void Apply(const Event& event, KnowledgeBase* knowledge_base) {
  KnowledgeBase& kb = *knowledge_base;
  kb.SetNow(event.time, event.frame);
  if (event.simulation.valid()) return;
  // Kinds that are only reported are listed, so that a new kind must be decided on here.
  std::visit(
      Overloaded{
          [&](const SymbolDeclared& e) { kb.AddSymbol(e.symbol); },
          [&](const FrameStarted& e) { kb.ExpireFacts(e.interval.after); },
          [&](const FactObserved& e) {
            kb.AddFact({e.fact_id, e.fact, e.source, event.id});
          },
          [&](const CompositeStateCreated& e) {
            kb.AddCompositeState({e.state, e.origin, e.derived_from, event.time, event.id, {}});
          },
          [&](const ModelCreated& e) {
            kb.AddModel({e.model,
                         e.origin,
                         e.derived_from,
                         event.time,
                         event.id,
                         e.evidence,
                         e.strong,
                         ModelState::kActive,
                         {},
                         {},
                         false,
                         {}});
          },
          [&](const EvidenceUpdated& e) { kb.SetEvidence(e.model, e.after, e.strong_after, event.id); },
          [&](const ModelStateChanged& e) {
            const bool failed = e.after == ModelState::kDeleted && e.reason == StateChangeReason::kRating;
            kb.SetState(e.model, e.after, failed, event.id);
          },
          [&](const PredictionMade& e) {
            kb.OpenPrediction({e.prediction, e.model, e.requirements, e.target, event.id, e.grounds});
          },
          [&](const PredictionSucceeded& e) { kb.ClosePrediction(e.prediction); },
          [&](const PredictionFailed& e) { kb.ClosePrediction(e.prediction); },
          [&](const DriveInjected& e) {
            kb.OpenGoal({e.goal, {}, e.target, event.id});
          },
          [&](const GoalAchieved& e) { kb.CloseGoal(e.goal); },
          [&](const GoalFailed& e) { kb.CloseGoal(e.goal); },
          [&](const EpisodeStarted&) {},
          [&](const WorldStateRecorded&) {},
          [&](const InductionStarted&) {},
          [&](const CauseConsidered&) {},
          [&](const IcstFound&) {},
          [&](const ImdlPredicted&) {},
          [&](const GoalSet&) {},
          [&](const GoalSkipped&) {},
          [&](const AnalogyCompared&) {},
          [&](const SimulationStarted&) {},
          [&](const SimulationEnded&) {},
          [&](const PlanCommitted&) {},
          [&](const CommandIssued&) {},
          [&](const CommandRefused&) {},
          [&](const EpisodeEnded&) {},
          [&](const ModelRejected&) {},
          [&](const ChainingDecided&) {},
          [&](const ImdlFired&) {},
          [&](const InstanceProgress&) {},
          [&](const PredictionInvalidated& e) { kb.ClosePrediction(e.prediction); },
          [&](const FactPromoted&) {},
          [&](const PromotionDefeated&) {},
          [&](const CommandImagined&) {},
          [&](const PlanRejected&) {},
          [&](const GoalSuspended&) {},
          [&](const GoalResumed&) {},
          [&](const GoalDropped& e) { kb.CloseGoal(e.goal); },
          [&](const FrameCounted&) {}},
      event.body);
}

}  // namespace aerascope
