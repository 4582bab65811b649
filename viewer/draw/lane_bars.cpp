#include "viewer/draw/lane_bars.h"

#include <algorithm>

#include "engine/base/text.h"
#include "engine/query/describe.h"

namespace aerascope {
namespace {

using LatestValues = std::map<std::string, std::map<std::string, Term>>;  // attribute, entity, value

bool IsPlace(const Term& value) {
  return value.IsStruct("vec2") || value.IsStruct("vec3");
}

std::string ShortTarget(const Run& run, const Fact& target, const LatestValues& latest) {
  const Term& payload = target.payload;
  if (!IsValue(payload)) return FactText(run.final_knowledge(), target);
  const std::string sign = target.positive ? "" : "not ";
  if (!IsPlace(payload[2]) && !payload[2].is(TermKind::kNumber)) return sign + ValueText(payload[2]);
  const std::string relation = payload[1].name() == "position" ? "at " : Printable(payload[1].name()) + " ";
  // A number is as short as the name of what happens to have it.
  if (const auto others = latest.find(payload[1].name()); IsPlace(payload[2]) && others != latest.end())
    for (const auto& [name, value] : others->second) {
      const bool itself = payload[0].is(TermKind::kEntity) && payload[0].name() == name;
      if (!itself && SameValue(value, payload[2])) return sign + relation + Printable(name);
    }
  return sign + relation + ValueText(payload[2]);
}

}  // namespace

TimeInterval InWholeFrames(const Run& run, Time from, Time until) {
  const auto start = [&run](Time t) {
    const auto frame = run.FrameAt(t);
    return frame ? run.frames()[*frame].interval.after : t;
  };
  const Time begin = start(from);
  if (const Time end = start(until); end > begin) return {begin, end};
  const auto frame = run.FrameAt(from);
  return {begin, frame ? run.frames()[*frame].interval.before : std::max(until, from)};
}

std::string CommandWords(const KnowledgeBase& knowledge, const Term& command) {
  if (!IsCommand(command)) return PayloadText(knowledge, command);
  std::string words = Printable(command[0].name());
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::map<PredictionId, std::string> ShortTargets(const Run& run,
                                                 const std::vector<PredictionRecordOfRun>& predictions) {
  std::map<EventId, const PredictionRecordOfRun*> made_by;
  for (const PredictionRecordOfRun& prediction : predictions) made_by[prediction.event] = &prediction;
  LatestValues latest;
  std::map<PredictionId, std::string> targets;
  for (const Event& event : run.events()) {
    if (event.simulation.valid()) continue;
    if (const auto* observed = std::get_if<FactObserved>(&event.body)) {
      const Term& payload = observed->fact.payload;
      if (observed->fact.positive && IsValue(payload) && payload[0].is(TermKind::kEntity))
        latest[payload[1].name()][payload[0].name()] = payload[2];
    }
    if (const auto found = made_by.find(event.id); found != made_by.end())
      targets[found->second->prediction] = ShortTarget(run, found->second->target, latest);
  }
  return targets;
}

std::string LastResort(const std::string& short_target) {
  const std::size_t space = short_target.find(' ');
  if (space == std::string::npos || short_target[0] == '[' || short_target[0] == '(') return short_target;
  if (short_target.starts_with("not ")) return "not";
  return short_target.substr(space + 1);
}

}  // namespace aerascope
