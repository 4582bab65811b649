#include "engine/event/report_kinds.h"

#include <type_traits>

#include "engine/base/text.h"

namespace aerascope {
namespace {

template <class Body, class... Kinds>
constexpr bool kIsOneOf = (std::is_same_v<Body, Kinds> || ...);

// Not here although Apply passes over them: what gives a number to something (IcstFound, GoalSet,
// SimulationStarted ...), what a replay is fed with (WorldStateRecorded, CommandRefused), and what was really
// asked of the world.
template <class Body>
constexpr bool kIsReport =
    kIsOneOf<Body, InductionStarted, CauseConsidered, GoalSkipped, AnalogyCompared, SimulationEnded,
             PlanCommitted, ModelRejected, ChainingDecided, InstanceProgress, FactPromoted, PromotionDefeated,
             CommandImagined, PlanRejected, GoalSuspended, GoalResumed, FrameCounted>;

template <class Test>
EventKindSet KindsWhere(Test&& test) {
  EventKindSet kinds;
  std::size_t kind = 0;
  ForEachKind([&]<class Body>() { kinds[kind++] = test.template operator()<Body>(); });
  return kinds;
}

std::vector<std::string> NameList(const EventKindSet& kinds) {
  std::vector<std::string> names;
  std::size_t kind = 0;
  ForEachKind([&]<class Body>() {
    if (kinds[kind++]) names.emplace_back(Body::kName);
  });
  return names;
}

EventKindSet Reports() {
  return KindsWhere([]<class Body>() { return kIsReport<Body>; });
}

}  // namespace

bool IsReportKind(std::size_t kind) {
  return kind < kEventKinds && Reports()[kind];
}

std::vector<std::string> ReportKindNames() {
  return NameList(Reports());
}

// One a fact and pattern.
EventKindSet LeftOutByDefault() {
  return EventKindSet().set(KindOf<InstanceProgress>());
}

std::string NamesOf(const EventKindSet& kinds) {
  return Join(NameList(kinds), " ");
}

}  // namespace aerascope
