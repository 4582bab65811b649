#include "viewer/page/cause_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/query/why.h"
#include "viewer/page/overloaded.h"

namespace aerascope {
namespace {

using nlohmann::json;

// A page tells the nearest causes; cut places say that there is more, which `aerascope why` tells.
constexpr CauseLimits kWhyLimits{4, 40};

// The third number of a node.
enum NodeSign { kPlain = 0, kToldAbove = 1, kHasMore = 2 };

// Whether an effect is worth a line; what is only thought on the way is looked through.
bool IsShownEffect(const Event& event) {
  if (event.simulation.valid()) return false;
  return std::visit(
      Overloaded{[](const PredictionSucceeded&) { return true; },
                 [](const PredictionFailed&) { return true; }, [](const AnalogyCompared&) { return true; },
                 [](const ModelCreated&) { return true; }, [](const ModelStateChanged&) { return true; },
                 [](const CommandIssued&) { return true; }, [](const CommandRefused&) { return true; },
                 [](const GoalAchieved&) { return true; }, [](const GoalFailed&) { return true; },
                 [](const DriveInjected&) { return true; }, [](const auto&) { return false; }},
      event.body);
}

}  // namespace

json WhyData(const ReportContext& context, EventId event) {
  const CauseTree tree = Why(context.run, event, kWhyLimits);
  json nodes = json::array();
  for (const CauseNode& node : tree.nodes) {
    const NodeSign sign = node.mark == CauseMark::kReference ? kToldAbove
                          : node.mark == CauseMark::kCut     ? kHasMore
                                                             : kPlain;
    nodes.push_back({node.event.value, node.depth, static_cast<int>(sign)});
  }
  return {{"nodes", nodes}, {"levels", tree.levels}, {"first", tree.first_causes.size()}, {"cut", tree.cut}};
}

json NoWhyData() {
  return {{"nodes", json::array()}, {"levels", 0}, {"first", 0}, {"cut", false}};
}

json EffectData(const ReportContext& context, EventId event) {
  std::set<EventId> seen{event};
  std::vector<EventId> open{event};
  std::vector<EventId> shown;
  while (!open.empty()) {
    const EventId from = open.back();
    open.pop_back();
    for (const EventId effect : context.run.Effects(from)) {
      if (!seen.insert(effect).second) continue;
      if (IsShownEffect(*context.run.Find(effect)))
        shown.push_back(effect);
      else
        open.push_back(effect);
    }
  }
  std::sort(shown.begin(), shown.end());
  return ListData(shown);
}

json ListData(const std::vector<EventId>& events) {
  json nodes = json::array();
  for (std::size_t i = 0; i < std::min(events.size(), kEventsListed); ++i)
    nodes.push_back({events[i].value, 0, static_cast<int>(kPlain)});
  return {{"nodes", nodes}, {"left_out", events.size() - nodes.size()}};
}

json TellEvents(const ReportContext& context, const json& subjects) {
  std::set<std::int64_t> named;
  for (const json& subject : subjects)
    for (const char* list : {"why", "led"})
      for (const json& node : subject[list]["nodes"]) named.insert(node[0].get<std::int64_t>());
  json told = json::object();
  for (const std::int64_t number : named) {
    const Event& event = *context.run.Find(EventId{number});
    json data = {{"at", event.time.us}, {"mark", MarkOf(event)}, {"text", SentenceOf(context.run, event)}};
    if (TellsOfFailure(event)) data["failed"] = true;
    if (const std::string subject = context.SubjectOf(event); !subject.empty()) data["subject"] = subject;
    told[std::to_string(number)] = std::move(data);
  }
  return told;
}

}  // namespace aerascope
