#include "exporters/diff/diff.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "engine/base/text.h"
#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

using Json = nlohmann::ordered_json;

std::string TotalsOf(const KbDiffResult& difference, const DiffNames& names) {
  if (difference.empty()) {
    return "No difference: all " + std::to_string(difference.same) + " pieces of " + names.left + " and " +
           names.right + " are the same.";
  }
  return std::to_string(difference.removed) + " only in " + names.left + ", " +
         std::to_string(difference.added) + " only in " + names.right + ", " +
         std::to_string(difference.changed) + " with other evidence or state, " +
         std::to_string(difference.same) + " the same.";
}

std::string_view SignOf(KbChange change) {
  switch (change) {
    case KbChange::kAdded:
      return "+";
    case KbChange::kRemoved:
      return "-";
    case KbChange::kChanged:
      return "~";
  }
  return {};
}

// What the item says; the sides of a changed one say the same.
const std::vector<std::string>& LinesOf(const KbDiffItem& item) {
  return item.left ? item.left->lines : item.right->lines;
}

Json JsonOf(const std::optional<KbDiffSide>& side, ModelGraphNodeKind kind) {
  if (!side) return nullptr;
  Json json = {{"id", side->id}, {"copies", side->copies}, {"origin", EnumName(side->origin)}};
  json["derived_from"] = side->derived_from.empty() ? Json(nullptr) : Json(side->derived_from);
  if (kind != ModelGraphNodeKind::kCompositeState) {
    json["confidence"] = side->evidence.rate();
    json["evidence"] = {{"positive", side->evidence.positive}, {"total", side->evidence.total}};
    json["strong"] = side->strong;
    json["state"] = EnumName(side->state);
  }
  json["lines"] = side->lines;
  return json;
}

Json JsonOf(const KbDiffItem& item, const DiffNames& names) {
  return {{"change", NameOf(item.change)},
          {"kind", NameOf(item.kind)},
          {"title", item.title},
          {"content", ToText(item.content)},
          {"sentence", SentenceOf(item, names.left, names.right)},
          {"aspects", item.aspects},
          {"left", JsonOf(item.left, item.kind)},
          {"right", JsonOf(item.right, item.kind)}};
}

DiffNames PrintableNames(const DiffNames& names) {
  return {Printable(names.left), Printable(names.right)};
}

}  // namespace

Status WriteDiffText(const KbDiffResult& difference, const DiffNames& names, std::ostream& out) {
  const DiffNames safe = PrintableNames(names);
  out << TotalsOf(difference, safe) << "\n";
  for (const KbDiffItem& item : difference.items) {
    out << "\n" << SignOf(item.change) << " " << SentenceOf(item, safe.left, safe.right) << "\n";
    for (const std::string& line : LinesOf(item)) out << "    " << line << "\n";
  }
  out.flush();
  return StatusOf(out, "the difference");
}

Status WriteDiffMarkdown(const KbDiffResult& difference, const DiffNames& names, std::ostream& out) {
  const DiffNames safe = PrintableNames(names);
  out << "# Difference of knowledge\n\n" << MarkdownText(TotalsOf(difference, safe)) << "\n";
  for (const KbDiffItem& item : difference.items) {
    out << "\n## " << MarkdownText(NameOf(item.change)) << ": " << MarkdownText(item.title) << "\n\n"
        << MarkdownText(SentenceOf(item, safe.left, safe.right)) << "\n\n";
    for (const std::string& line : LinesOf(item)) out << "- " << MarkdownText(line) << "\n";
  }
  out.flush();
  return StatusOf(out, "the difference");
}

Status WriteDiffJson(const KbDiffResult& difference, const DiffNames& names, std::ostream& out) {
  Json items = Json::array();
  for (const KbDiffItem& item : difference.items) items.push_back(JsonOf(item, names));
  const Json json = {{"format", "aerascope difference"},
                     {"version", 1},
                     {"left", names.left},
                     {"right", names.right},
                     {"added", difference.added},
                     {"removed", difference.removed},
                     {"changed", difference.changed},
                     {"same", difference.same},
                     {"items", std::move(items)}};
  out << json.dump(2, ' ', true, Json::error_handler_t::replace) << "\n";
  out.flush();
  return StatusOf(out, "the difference");
}

}  // namespace aerascope
