#include "exporters/diff/diff.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

using Json = nlohmann::ordered_json;

// "3 only in A and 2 more that it gave up, 1 more general in B ...": kinds of which there are none are left
// out, but for the first two.
std::string TotalsOf(const KbDiffResult& difference, const DiffNames& names) {
  const std::size_t same = difference.same.size();
  if (difference.empty()) {
    return "No difference: all " + std::to_string(same) + " pieces of " + names.left + " and " + names.right +
           " are the same.";
  }
  const auto words = [&](KbChange change) -> std::string {
    switch (change) {
      case KbChange::kRemoved:
        return "only in " + names.left;
      case KbChange::kAdded:
        return "only in " + names.right;
      case KbChange::kGeneralised:
        return "more general in " + names.right;
      case KbChange::kSpecialised:
        return "more specific in " + names.right;
      case KbChange::kOtherValues:
        return "with other numbers";
      case KbChange::kChanged:
        return "with other evidence or state";
    }
    return {};
  };
  std::vector<std::string> totals;
  for (const KbChange change : kKbChanges) {
    const std::int64_t count = difference.Count(change);
    const bool always = change == KbChange::kRemoved || change == KbChange::kAdded;
    if (count == 0 && !always) continue;
    const std::int64_t given_up = always ? difference.CountGivenUp(change) : 0;
    totals.push_back(std::to_string(count - given_up) + " " + words(change));
    if (given_up > 0) totals.back() += " and " + std::to_string(given_up) + " more that it gave up";
  }
  return Join(totals, ", ") + ", " + std::to_string(same) + " the same.";
}

std::string_view SignOf(KbChange change) {
  switch (change) {
    case KbChange::kAdded:
      return "+";
    case KbChange::kRemoved:
      return "-";
    case KbChange::kGeneralised:
      return "<";
    case KbChange::kSpecialised:
      return ">";
    case KbChange::kOtherValues:
    case KbChange::kChanged:
      return "~";
  }
  return {};
}

// What a part says on either side, and whether both have it: "  ", "- ", "+ ", "~ ". The parts of an item on
// one side only are told without comparison.
std::vector<std::string> PartsOf(const KbDiffItem& item) {
  std::vector<std::string> lines;
  const bool both = item.left && item.right;
  for (const AlignedRow& row : item.rows) {
    // Guards explain something only where they differ.
    if (row.role == PartRole::kGuard && (!both || row.status == PartStatus::kSame)) continue;
    if (!both) {
      const std::string& text = item.left ? row.left : row.right;
      if (!text.empty()) lines.push_back(text);
    } else if (row.status == PartStatus::kLeftOnly) {
      lines.push_back("- " + row.left);
    } else if (row.status == PartStatus::kRightOnly) {
      lines.push_back("+ " + row.right);
    } else if (row.status == PartStatus::kOtherValue) {
      lines.push_back("~ " + row.left + " | " + row.right);
    } else {
      lines.push_back((item.change == KbChange::kChanged ? "" : "  ") + row.left);
    }
  }
  return lines;
}

std::string NumberedLine(const LineDifference::Line& line, const DiffNames& names) {
  return (line.left ? names.left : names.right) + ":" + std::to_string(line.number) + ": " +
         Printable(line.text);
}

// ---- JSON

Json JsonOf(const std::optional<KbDiffSide>& side, ModelGraphNodeKind kind) {
  if (!side) return nullptr;
  const auto or_null = [](const std::string& id) { return id.empty() ? Json(nullptr) : Json(id); };
  Json json = {{"id", side->id},
               {"content", ToText(side->content)},
               {"title", side->title},
               {"copies", side->copies},
               {"origin", EnumName(side->origin)}};
  json["derived_from"] = or_null(side->derived_from);
  if (kind != ModelGraphNodeKind::kCompositeState) {
    json["composite_state"] = or_null(side->state);
    json["model"] = or_null(side->target);
    json["confidence"] = side->evidence.rate();
    json["evidence"] = {{"positive", side->evidence.positive}, {"total", side->evidence.total}};
    json["strong"] = side->strong;
    json["state"] = EnumName(side->model_state);
  }
  json["lines"] = side->lines;
  return json;
}

Json JsonOf(const AlignedRow& row) {
  const auto or_null = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
  return {{"part", NameOf(row.role)},
          {"status", NameOf(row.status)},
          {"left", or_null(row.left)},
          {"right", or_null(row.right)}};
}

Json JsonOf(const KbDiffItem& item, const DiffNames& names) {
  Json json = {{"change", NameOf(item.change)},
               {"kind", NameOf(item.kind)},
               {"title", item.title},
               {"content", ToText(item.content)},
               {"sentence", SentenceOf(item, names.left, names.right)},
               {"aspects", item.aspects},
               {"left", JsonOf(item.left, item.kind)},
               {"right", JsonOf(item.right, item.kind)}};
  json["nearest"] = nullptr;
  if (item.relative) {
    json["nearest"] = {{"id", item.relative->id},
                       {"title", item.relative->title},
                       {"content", ToText(item.relative->content)},
                       {"right_is", NameOf(item.relative->relation)}};
  }
  json["parts"] = Json::array();
  for (const AlignedRow& row : item.rows) json["parts"].push_back(JsonOf(row));
  return json;
}

Json JsonOf(const std::optional<std::string>& text) {
  return text ? Json(*text) : Json(nullptr);
}

Json JsonOf(const std::optional<StoryStep>& step) {
  if (!step) return nullptr;
  return {{"event", step->event.value}, {"time_us", step->time.us}, {"sentence", step->sentence}};
}

// What programs read keeps its words, whatever people are told.
std::string StableEnding(const std::optional<DriveEnding>& ending) {
  const bool missed = ending && ending->outcome == Outcome::kFailed;
  return missed ? "failed at " + SecondsText(ending->until) : EndingText(ending);
}

Json JsonOf(const RunDiff& runs) {
  Json json = {
      {"settings", Json::array()}, {"files", Json::array()}, {"parting", nullptr}, {"drives", Json::array()}};
  for (const SettingDifference& setting : runs.settings)
    json["settings"].push_back(
        {{"name", setting.name}, {"left", JsonOf(setting.left)}, {"right", JsonOf(setting.right)}});
  for (const FileDifference& file : runs.files) {
    Json lines = Json::array();
    for (const LineDifference::Line& line : file.lines.lines)
      lines.push_back({{"side", line.left ? "left" : "right"}, {"number", line.number}, {"text", line.text}});
    json["files"].push_back({{"name", file.name},
                             {"left", file.left},
                             {"right", file.right},
                             {"lines", std::move(lines)},
                             {"lines_left_out", file.lines.hidden}});
  }
  if (runs.parting) {
    json["parting"] = {{"common_steps", runs.parting->common},
                       {"left", JsonOf(runs.parting->left)},
                       {"right", JsonOf(runs.parting->right)}};
  }
  for (const DriveDifference& drive : runs.drives)
    json["drives"].push_back(
        {{"title", drive.title}, {"left", StableEnding(drive.left)}, {"right", StableEnding(drive.right)}});
  return json;
}

DiffNames PrintableNames(const DiffNames& names) {
  return {Printable(names.left), Printable(names.right)};
}

}  // namespace

Status WriteDiffText(const DiffReport& report, std::ostream& out) {
  const DiffNames safe = PrintableNames(report.names);
  out << TotalsOf(report.knowledge, safe) << "\n";
  const std::vector<std::string> sentences = SentencesOf(report.runs, safe.left, safe.right);
  if (!sentences.empty()) out << "\n";
  for (const std::string& sentence : sentences) out << sentence << "\n";
  for (const FileDifference& file : report.runs.files) {
    if (file.lines.lines.empty()) continue;
    out << "\n" << Printable(file.name) << "\n";
    for (const LineDifference::Line& line : file.lines.lines)
      out << "    " << NumberedLine(line, safe) << "\n";
    if (file.lines.hidden > 0) out << "    and " << file.lines.hidden << " more\n";
  }
  for (const KbDiffItem& item : report.knowledge.items) {
    out << "\n" << SignOf(item.change) << " " << SentenceOf(item, safe.left, safe.right) << "\n";
    for (const std::string& line : PartsOf(item)) out << "    " << line << "\n";
  }
  out.flush();
  return StatusOf(out, "the difference");
}

Status WriteDiffMarkdown(const DiffReport& report, std::ostream& out) {
  const DiffNames safe = PrintableNames(report.names);
  out << "# Difference of knowledge\n\n" << MarkdownText(TotalsOf(report.knowledge, safe)) << "\n";
  const std::vector<std::string> sentences = SentencesOf(report.runs, safe.left, safe.right);
  if (!sentences.empty()) out << "\n";
  for (const std::string& sentence : sentences) out << "- " << MarkdownText(sentence) << "\n";
  for (const FileDifference& file : report.runs.files) {
    if (file.lines.lines.empty()) continue;
    out << "\n" << MarkdownText(Printable(file.name)) << "\n\n";
    for (const LineDifference::Line& line : file.lines.lines)
      out << "- " << MarkdownText(NumberedLine(line, safe)) << "\n";
    if (file.lines.hidden > 0) out << "- and " << file.lines.hidden << " more\n";
  }
  for (const KbDiffItem& item : report.knowledge.items) {
    const std::string_view state = WordsOf(item.state());
    out << "\n## " << MarkdownText(NameOf(item.change)) << ": " << MarkdownText(item.title)
        << (state.empty() ? "" : " (" + std::string(state) + ")") << "\n\n"
        << MarkdownText(SentenceOf(item, safe.left, safe.right)) << "\n\n";
    for (const std::string& line : PartsOf(item)) out << "- " << MarkdownText(line) << "\n";
  }
  out.flush();
  return StatusOf(out, "the difference");
}

Status WriteDiffJson(const DiffReport& report, std::ostream& out) {
  const KbDiffResult& difference = report.knowledge;
  Json json = {{"format", "aerascope difference"},
               {"version", 2},
               {"left", report.names.left},
               {"right", report.names.right}};
  for (const KbChange change : kKbChanges) json[std::string(NameOf(change))] = difference.Count(change);
  json["given_up"] = {{"left", difference.CountGivenUp(KbChange::kRemoved)},
                      {"right", difference.CountGivenUp(KbChange::kAdded)}};
  json["same"] = difference.same.size();
  json["runs"] = JsonOf(report.runs);
  json["items"] = Json::array();
  for (const KbDiffItem& item : difference.items) json["items"].push_back(JsonOf(item, report.names));
  // Only how each side calls what is the same.
  json["same_items"] = Json::array();
  for (const KbDiffItem& item : difference.same)
    json["same_items"].push_back({{"kind", NameOf(item.kind)},
                                  {"title", item.title},
                                  {"left", item.left->id},
                                  {"right", item.right->id}});
  out << json.dump(2, ' ', true, Json::error_handler_t::replace) << "\n";
  out.flush();
  return StatusOf(out, "the difference");
}

}  // namespace aerascope
