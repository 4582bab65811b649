#include "viewer/page/analogy_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"
#include "viewer/page/shortened.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestLine = 400;  // code points

std::string VerdictText(AnalogyVerdict verdict) {
  switch (verdict) {
    case AnalogyVerdict::kAccepted:
      return "accepted";
    case AnalogyVerdict::kNotRequired:
      return "not required: a better plan reached the goal";
    case AnalogyVerdict::kFullMatch:
      return "nothing to generalise: everything matched";
    case AnalogyVerdict::kTooFewMatched:
      return "rejected: too few conditions hold";
    case AnalogyVerdict::kNotFamiliar:
      return "rejected: not familiar enough";
    case AnalogyVerdict::kNothingObserved:
      return "rejected: no condition that holds speaks of the object";
    case AnalogyVerdict::kFreeVariable:
      return "rejected: what remains leaves a variable open";
    case AnalogyVerdict::kBlackListed:
      return "rejected: it failed before";
    case AnalogyVerdict::kNoPlan:
      return "rejected: no plan through it reaches the goal";
  }
  return "";
}

json ComparedRow(const ReportContext& context, const Condition& condition, const AnalogyCompared& compared) {
  ComponentStatus status = ComponentStatus::kMatched;
  std::vector<std::string> found;
  json facts = json::array();
  for (const ComparedComponent& component : compared.components) {
    const auto index = static_cast<std::size_t>(component.index);
    const auto& parts = condition.components;
    if (std::find(parts.begin(), parts.end(), index) == parts.end()) continue;
    status = std::max(status, component.status);
    if (!component.counterpart.is(TermKind::kNil))
      found.push_back(PayloadText(context.knowledge, component.counterpart));
    const EventId seen = component.found.valid() ? context.run.CreationOf(component.found) : EventId{};
    if (seen.valid()) facts.push_back(IdText(seen));
  }
  return {
      {"condition", ConditionData(condition.text, condition.variables, status == ComponentStatus::kMissed)},
      {"found", found.empty() ? "nothing" : Shortened(Join(found, ", "), kLongestLine)},
      {"facts", facts},
      {"status", std::string(EnumName(status))}};
}

}  // namespace

json ConditionData(const std::string& text, const std::vector<std::string>& variables, bool cut) {
  return {{"text", Shortened(text, kLongestLine)}, {"vars", variables}, {"cut", cut}};
}

json ComparisonData(const ReportContext& context, const Event& event) {
  const auto& compared = std::get<AnalogyCompared>(event.body);
  json rows = json::array();
  if (const CompositeStateRecord* source = context.knowledge.Find(compared.source); source != nullptr)
    for (const Condition& condition : ConditionsOf(context.knowledge, source->state))
      rows.push_back(ComparedRow(context, condition, compared));
  json data = {{"at", event.time.us},
               {"event", IdText(event.id)},
               {"goal", IdText(compared.goal)},
               {"source", IdText(compared.source)},
               {"requirement", IdText(compared.requirement)},
               {"object", Shortened(Printable(ObjectOf(compared)), kLongestLine)},
               {"rows", rows},
               {"matched", compared.matched},
               {"achievable", compared.achievable},
               {"total", compared.total},
               {"psi", FormatConfidence(compared.psi)},
               {"jaccard", FormatConfidence(compared.jaccard)},
               {"confidence", FormatConfidence(compared.confidence)},
               {"verdict", VerdictText(compared.verdict)},
               {"accepted", compared.verdict == AnalogyVerdict::kAccepted}};
  if (const std::string bound = BindingsText(BindingsOf(context.knowledge, compared.bindings));
      !bound.empty())
    data["bindings"] = Shortened(bound, kLongestLine);
  if (compared.result_requirement.valid()) data["result"] = IdText(compared.result_requirement);
  if (compared.psi > 0) data["source_sure"] = FormatConfidence(compared.confidence / compared.psi);
  for (const Parameter& parameter : context.run.started().parameters)
    if (parameter.name == "analogy_min_psi") data["above"] = parameter.value;
  return data;
}

}  // namespace aerascope
