#include "engine/query/kind_titles.h"

#include <algorithm>
#include <array>
#include <utility>

namespace aerascope {
namespace {

constexpr auto kTitles = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"EpisodeStarted", "Episode begins"},
    {"SymbolDeclared", "Name declared"},
    {"FrameStarted", "Frame begins"},
    {"WorldStateRecorded", "World recorded"},
    {"FactObserved", "Observation"},
    {"CompositeStateCreated", "New composite state"},
    {"ModelCreated", "New model"},
    {"InductionStarted", "Surprise"},
    {"CauseConsidered", "Possible cause"},
    {"IcstFound", "Composite state holds"},
    {"ImdlPredicted", "Requirement speaks"},
    {"PredictionMade", "Prediction"},
    {"PredictionSucceeded", "Prediction came true"},
    {"PredictionFailed", "Prediction failed"},
    {"EvidenceUpdated", "Evidence"},
    {"ModelStateChanged", "Model retired or restored"},
    {"DriveInjected", "Drive given"},
    {"GoalSet", "Goal set"},
    {"GoalSkipped", "Goal not pursued"},
    {"AnalogyCompared", "Comparison for an analogy"},
    {"SimulationStarted", "Plan tried in the head"},
    {"SimulationEnded", "End of a tried plan"},
    {"PlanCommitted", "Plan chosen"},
    {"CommandIssued", "Command"},
    {"CommandRefused", "Command refused"},
    {"GoalAchieved", "Goal reached"},
    {"GoalFailed", "Goal missed"},
    {"EpisodeEnded", "Episode ends"},
    {"ModelRejected", "Model not learned"},
    {"ChainingDecided", "Whether a model applies"},
    {"ImdlFired", "Model in force"},
    {"InstanceProgress", "Composite state partly met"},
    {"PredictionInvalidated", "Prediction withdrawn"},
    {"FactPromoted", "Fact taken to hold on"},
    {"PromotionDefeated", "Fact that does not hold on"},
    {"CommandImagined", "Command imagined"},
    {"PlanRejected", "Plan not chosen"},
    {"GoalSuspended", "Goal left waiting"},
    {"GoalResumed", "Goal taken up again"},
    {"GoalDropped", "Goal dropped"},
    {"FrameCounted", "Frame in numbers"},
});

}  // namespace

std::string_view KindTitle(std::string_view kind) {
  const auto found =
      std::find_if(kTitles.begin(), kTitles.end(), [&](const auto& entry) { return entry.first == kind; });
  return found == kTitles.end() ? std::string_view() : found->second;
}

}  // namespace aerascope
