#include "exporters/kb/knowledge_text.h"

#include <ostream>
#include <set>

#include "engine/base/text.h"
#include "engine/query/kb_diff.h"
#include "engine/query/model_graph.h"
#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

std::string Count(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string OriginText(Origin origin, const std::string& source, Time created) {
  switch (origin) {
    case Origin::kSeed:
      return "given";
    case Origin::kAnalogy:
      return "by analogy" + (source.empty() ? "" : " with " + source) + " at " + SecondsText(created);
    case Origin::kInduction:
      return "learned at " + SecondsText(created);
    case Origin::kPredictionFailure:
      return "learned from a failed prediction at " + SecondsText(created);
    case Origin::kGoalSuccess:
      return "learned from an unexpected success at " + SecondsText(created);
  }
  return {};
}

std::string StatusText(const ModelRecord& record) {
  std::string text = "confidence " + FormatConfidence(record.evidence.rate()) + " (" +
                     FormatNumber(record.evidence.positive, 6) + " of " +
                     FormatNumber(record.evidence.total, 6) + ")";
  if (record.strong) text += ", confirmed";
  if (record.state != ModelState::kActive) text += ", " + std::string(WordsOf(record.state));
  const std::string source = record.derived_from.valid() ? IdText(record.derived_from) : "";
  return text + ", " + OriginText(record.origin, source, record.created);
}

class Writer {
 public:
  Writer(const KnowledgeBase& knowledge, std::ostream& out)
      : knowledge_(knowledge), graph_(MakeModelGraph(knowledge, DeletedModels::kInclude)), out_(out) {}

  void Write() {
    std::size_t pieces = 0;
    std::size_t given_up = 0;
    std::size_t models = 0;
    for (const TriadGroup& group : graph_.groups) {
      for (const Triad& triad : group.triads) ++(IsGivenUp(triad.requirement) ? given_up : pieces);
      models += IsDrive(group) || IsGivenUp(group.causal_model) ? 0 : 1;
    }
    out_ << "Knowledge at " << SecondsText(knowledge_.now()) << ": "
         << Count(pieces, "piece of knowledge", "pieces of knowledge") << " about "
         << Count(models, "model", "models") << ", "
         << Count(knowledge_.composite_states().size(), "composite state", "composite states");
    if (given_up > 0) {
      out_ << "; " << Count(given_up, "piece was given up and is", "pieces were given up and are")
           << " not counted";
    }
    out_ << ".\n";
    if (pieces + given_up + models > 0) {
      out_ << "In brackets: right how often, of how often. What it was learned from counts as the first; by "
              "analogy the first counts as much as the confidence it was made with. Confirmed models are "
              "counted anew.\n";
    }
    for (const TriadGroup& group : graph_.groups) {
      if (!IsDrive(group)) WriteGroup(group);
    }
    WriteOtherStates();
    WriteDrives();
  }

 private:
  bool IsDrive(const TriadGroup& group) const {
    const ModelRecord* record = knowledge_.Find(group.causal_model);
    return record && KindOf(record->model) == ModelKind::kDrive && group.triads.empty();
  }

  bool IsGivenUp(ModelId id) const {
    const ModelRecord* record = knowledge_.Find(id);
    return record != nullptr && record->state == ModelState::kDeleted;
  }

  void WriteGroup(const TriadGroup& group) {
    const ModelRecord* record = knowledge_.Find(group.causal_model);
    out_ << "\n" << IdText(group.causal_model) << "  ";
    if (record) {
      std::string explanation = ExplanationOf(knowledge_, group.causal_model);
      out_ << explanation << "\n    " << ToText(KindOf(record->model)) << ", " << StatusText(*record) << "\n";
    } else {
      out_ << "(unknown model)\n";
    }
    for (const Triad& triad : group.triads) WriteTriad(triad);
  }

  void WriteTriad(const Triad& triad) {
    const ModelRecord& record = *knowledge_.Find(triad.requirement);
    out_ << "  " << IdText(triad.requirement) << "  " << TitleOf(knowledge_, triad.requirement) << "\n      "
         << ToText(KindOf(record.model)) << ", " << StatusText(record) << "\n";
    if (!triad.state.valid()) {
      out_ << "      if " << LinesOf(knowledge_, record.model).lhs << "\n";
      return;
    }
    WriteConditions(triad.state, record.model);
  }

  void WriteConditions(CompositeStateId id, const Model& requirement) {
    const Duration delay = DelayOf(requirement).value_or(Duration{});
    shown_.insert(id);
    out_ << "      if ";
    if (delay > Duration{}) out_ << "it held " << SecondsText(Time{delay.us}) << " before: ";
    out_ << IdText(id) << ":";
    std::vector<std::string> pruned;
    std::vector<std::string> texts;
    for (const Condition& condition : ConditionsOfRequirement(knowledge_, requirement)) {
      (condition.pruned ? pruned : texts).push_back(condition.text);
    }
    out_ << " " << Join(texts, "; ");
    if (!pruned.empty()) out_ << "  (without: " << Join(pruned, "; ") << ")";
    out_ << "\n";
  }

  void WriteOtherStates() {
    bool first = true;
    for (const auto& [id, record] : knowledge_.composite_states()) {
      if (shown_.contains(id)) continue;
      if (first) out_ << "\nOther composite states\n";
      first = false;
      std::vector<std::string> texts;
      for (const Condition& condition : ConditionsOf(knowledge_, record.state))
        texts.push_back(condition.text);
      const std::string source = record.derived_from.valid() ? IdText(record.derived_from) : "";
      out_ << "  " << IdText(id) << "  " << Join(texts, "; ") << "  ("
           << OriginText(record.origin, source, record.created) << ")\n";
    }
  }

  void WriteDrives() {
    bool first = true;
    for (const TriadGroup& group : graph_.groups) {
      if (!IsDrive(group)) continue;
      if (first) out_ << "\nDrive models\n";
      first = false;
      out_ << "  " << IdText(group.causal_model) << "  " << ExplanationOf(knowledge_, group.causal_model)
           << "\n";
    }
  }

  const KnowledgeBase& knowledge_;
  ModelGraph graph_;
  std::ostream& out_;
  std::set<CompositeStateId> shown_;
};

}  // namespace

Status WriteKnowledgeText(const KnowledgeBase& knowledge, std::ostream& out) {
  Writer(knowledge, out).Write();
  out.flush();
  return StatusOf(out, "the knowledge base");
}

}  // namespace aerascope
