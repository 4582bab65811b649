#include "viewer/page/diff_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/model_history.h"
#include "viewer/page/provenance.h"
#include "viewer/page/shortened.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestTitle = 300;
// Of a curve that is drawn a few hundred pixels wide; fewer where there are very many models.
constexpr std::size_t kMostSteps = 240;
constexpr std::size_t kMostStepsOfAll = 60'000;

std::string Title(const std::string& text) {
  return Shortened(Printable(text), kLongestTitle);
}

// What is no number is null.
json Number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

// How sure one side was of each of its models over time.
class Curves {
 public:
  explicit Curves(const DiffPageSide& side) {
    const std::vector<ModelHistory> histories = Histories(side.run);
    const std::size_t most =
        std::clamp<std::size_t>(kMostStepsOfAll / (histories.size() + 1), 12, kMostSteps);
    for (const ModelHistory& history : histories) {
      json steps = json::array();
      std::vector<const ConfidenceStep*> shown;
      for (const ConfidenceStep& step : history.steps)
        if (step.time <= side.at) shown.push_back(&step);
      const std::size_t stride = shown.size() / most + 1;
      for (std::size_t i = 0; i < shown.size(); ++i) {
        if (i % stride == 0 || i + 1 == shown.size())
          steps.push_back({shown[i]->time.us, Number(shown[i]->evidence.rate())});
      }
      curves_[IdText(history.model)] = std::move(steps);
      if (!shown.empty() && shown.back()->state == ModelState::kDeleted)
        gone_[IdText(history.model)] = SecondsText(shown.back()->time);
    }
  }
  json Of(const std::string& id) const {
    const auto curve = curves_.find(id);
    return curve == curves_.end() ? json::array() : curve->second;
  }

  // When it was given up; empty if it was not.
  std::string GoneAt(const std::string& id) const {
    const auto gone = gone_.find(id);
    return gone == gone_.end() ? "" : gone->second;
  }

 private:
  std::map<std::string, json> curves_;
  std::map<std::string, std::string> gone_;
};

json SideData(const DiffPageSide& side) {
  json data = {{"name", Title(side.name)},
               {"title", Title(side.run.title())},
               {"provenance", ProvenanceOf(side.run, "")},
               {"warning", WarningAbout(side.run)},
               {"at", SecondsText(side.at)},
               {"whole", side.at >= side.run.end()},
               {"end", side.at.us}};
  return data;
}

json PieceData(const std::optional<KbDiffSide>& side, ModelGraphNodeKind kind, const Curves& curves) {
  if (!side) return nullptr;
  json data = {{"id", side->id},
               {"title", Title(side->title)},
               {"state", side->state},
               {"target", side->target},
               {"copies", side->copies},
               {"how", WordsOf(side->origin)},
               {"from", side->derived_from}};
  if (side->delay > Duration{}) data["before"] = SecondsText(Time{side->delay.us});
  if (kind == ModelGraphNodeKind::kCompositeState) return data;
  data["sure"] = Number(side->evidence.rate());
  data["positive"] = Number(side->evidence.positive);
  data["total"] = Number(side->evidence.total);
  data["strong"] = side->strong;
  data["model_state"] = EnumName(side->model_state);
  data["gone"] = curves.GoneAt(side->id);
  data["curve"] = curves.Of(side->id);
  return data;
}

json ItemData(const KbDiffItem& item, const Curves& left, const Curves& right) {
  json rows = json::array();
  for (const AlignedRow& row : item.rows)
    rows.push_back(
        {NameOf(row.role), NameOf(row.status), Printable(row.left), Printable(row.right), row.variables});
  json data = {{"key", ToText(item.content).substr(0, 12)},
               {"change", NameOf(item.change)},
               {"kind", NameOf(item.kind)},
               {"title", Title(item.title)},
               {"aspects", item.aspects},
               {"rows", std::move(rows)},
               {"left", PieceData(item.left, item.kind, left)},
               {"right", PieceData(item.right, item.kind, right)}};
  if (item.relative)
    data["near"] = {{"id", item.relative->id},
                    {"key", ToText(item.relative->content).substr(0, 12)},
                    {"title", Title(item.relative->title)},
                    {"right_is", NameOf(item.relative->relation)}};
  return data;
}

json Items(const std::vector<KbDiffItem>& items, const Curves& left, const Curves& right, bool same) {
  json list = json::array();
  for (const KbDiffItem& item : items) {
    list.push_back(ItemData(item, left, right));
    if (same) list.back()["change"] = "same";
    // One sentence for all pages and texts.
    list.back()["say"] = same ? "" : SentenceOf(item, "A", "B");
  }
  return list;
}

json StepData(const std::optional<StoryStep>& step) {
  if (!step) return nullptr;
  return {{"event", IdText(step->event)}, {"at", SecondsText(step->time)}, {"say", step->sentence}};
}

json RunsData(const RunDiff& runs) {
  json settings = json::array();
  const auto text = [](const std::optional<std::string>& value) {
    return value ? json(Title(*value)) : json(nullptr);
  };
  for (const SettingDifference& setting : runs.settings)
    settings.push_back({Title(setting.name), text(setting.left), text(setting.right)});
  json files = json::array();
  for (const FileDifference& file : runs.files) {
    json lines = json::array();
    for (const LineDifference::Line& line : file.lines.lines)
      lines.push_back({line.left ? "A" : "B", line.number, Title(line.text)});
    files.push_back({{"name", Title(file.name)},
                     {"left", file.left},
                     {"right", file.right},
                     {"lines", std::move(lines)},
                     {"hidden", file.lines.hidden}});
  }
  json drives = json::array();
  const auto ending = [](const std::optional<DriveEnding>& drive) {
    return json{drive ? static_cast<int>(drive->outcome) : -1,
                drive && drive->outcome != Outcome::kOpen ? SecondsText(drive->until) : ""};
  };
  for (const DriveDifference& drive : runs.drives)
    drives.push_back({Title(drive.title), ending(drive.left), ending(drive.right)});
  json data = {{"settings", std::move(settings)},
               {"files", std::move(files)},
               {"drives", std::move(drives)},
               {"parting", nullptr}};
  if (runs.parting) {
    data["parting"] = {{"common", runs.parting->common},
                       {"left", StepData(runs.parting->left)},
                       {"right", StepData(runs.parting->right)}};
  }
  return data;
}

}  // namespace

json DiffData(const DiffPageSide& left, const DiffPageSide& right, const KbDiffResult& knowledge,
              const RunDiff& runs) {
  const Curves of_left(left);
  const Curves of_right(right);
  return {{"left", SideData(left)},
          {"right", SideData(right)},
          {"items", Items(knowledge.items, of_left, of_right, false)},
          {"same", Items(knowledge.same, of_left, of_right, true)},
          {"runs", RunsData(runs)}};
}

}  // namespace aerascope
