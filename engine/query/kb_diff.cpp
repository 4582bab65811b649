#include "engine/query/kb_diff.h"

#include <algorithm>
#include <bit>
#include <map>
#include <tuple>

#include "engine/base/text.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

// Everything with one content on one side, most often one item.
struct Entry {
  ModelGraphNodeKind kind = ModelGraphNodeKind::kCompositeState;
  std::string title;
  struct Copy {
    KbDiffSide side;
    Hash128 source;  // content of what it was derived from

    auto Key() const {
      // Evidence by its bits: an order for whatever a file may hold, infinities and the like included.
      return std::tuple(side.state, side.origin, side.strong,
                        std::bit_cast<std::uint64_t>(side.evidence.positive),
                        std::bit_cast<std::uint64_t>(side.evidence.total), source);
    }
  };
  std::vector<Copy> copies;  // ordered by what they say, not by number
};

using Entries = std::map<Hash128, Entry>;

class Side {
 public:
  explicit Side(const KnowledgeBase& knowledge) : knowledge_(knowledge) {}

  Entries Collect() {
    const ModelGraph graph = MakeModelGraph(knowledge_, DeletedModels::kInclude);
    for (const ModelGraphNode& node : graph.nodes) Add(node);
    for (auto& [content, entry] : entries_) {
      std::stable_sort(entry.copies.begin(), entry.copies.end(),
                       [](const auto& a, const auto& b) { return a.Key() < b.Key(); });
      entry.copies.front().side.copies = entry.copies.size();
    }
    return std::move(entries_);
  }

 private:
  void Add(const ModelGraphNode& node) {
    Entry& entry = entries_[node.content];
    entry.kind = node.kind;
    if (entry.copies.empty()) entry.title = TitleOfNode(node);
    Entry::Copy copy;
    copy.side.id = node.id;
    copy.side.lines = node.lines;
    copy.side.evidence = node.evidence;
    copy.side.strong = node.strong;
    copy.side.state = node.model_state;
    copy.side.origin = node.origin;
    NoteSource(node, &copy);
    entry.copies.push_back(std::move(copy));
  }

  void NoteSource(const ModelGraphNode& node, Entry::Copy* copy) {
    if (node.is_model()) {
      const ModelRecord* source = knowledge_.Find(knowledge_.Find(node.model)->derived_from);
      if (!source) return;
      copy->source = source->canonical.hash;
      copy->side.derived_from = IdText(source->model.id);
    } else {
      const CompositeStateRecord* source = knowledge_.Find(knowledge_.Find(node.state)->derived_from);
      if (!source) return;
      copy->source = source->canonical.hash;
      copy->side.derived_from = IdText(source->state.id);
    }
  }

  // Words that do not depend on given names: titles of requirement models hold none, the others get canonical
  // ones.
  std::string TitleOfNode(const ModelGraphNode& node) const {
    if (!node.is_model()) return OneLine(CanonicalConditions(knowledge_, *knowledge_.Find(node.state)));
    const ModelRecord& record = *knowledge_.Find(node.model);
    if (IsRequirement(record.model)) return TitleOf(knowledge_, node.model);
    const std::vector<std::string> names = CanonicalNames(knowledge_, record);
    const auto words = [&](const Term& payload) {
      return PayloadWords(knowledge_, payload, names, Writing::kCanonical);
    };
    return words(record.model.lhs.payload) + (record.model.rhs.positive ? " makes " : " ends ") +
           words(record.model.rhs.payload);
  }

  const KnowledgeBase& knowledge_;
  Entries entries_;
};

// What differs between the copies on both sides, which are compared one by one.
std::vector<std::string> AspectsOf(const Entry& left, const Entry& right) {
  if (left.copies.size() != right.copies.size()) return {"copies"};
  const auto differs = [&](auto&& value_of) {
    return !std::equal(
        left.copies.begin(), left.copies.end(), right.copies.begin(),
        [&](const Entry::Copy& a, const Entry::Copy& b) { return value_of(a) == value_of(b); });
  };
  using Copy = const Entry::Copy&;
  std::vector<std::string> aspects;
  if (differs([](Copy copy) { return copy.side.evidence; })) {
    aspects.push_back(differs([](Copy copy) { return copy.side.evidence.rate(); }) ? "confidence"
                                                                                   : "evidence");
  }
  if (differs([](Copy copy) { return copy.side.strong; })) aspects.push_back("strength");
  if (differs([](Copy copy) { return copy.side.state; })) aspects.push_back("state");
  if (differs([](Copy copy) { return copy.side.origin; })) aspects.push_back("origin");
  if (differs([](Copy copy) { return copy.source; })) aspects.push_back("derivation");
  return aspects;
}

KbDiffItem ItemOf(const Hash128& content, const Entry* left, const Entry* right) {
  const Entry& any = left ? *left : *right;
  KbDiffItem item;
  item.change = !left ? KbChange::kAdded : !right ? KbChange::kRemoved : KbChange::kChanged;
  item.kind = any.kind;
  item.content = content;
  item.title = any.title;
  if (left) item.left = left->copies.front().side;
  if (right) item.right = right->copies.front().side;
  if (left && right) item.aspects = AspectsOf(*left, *right);
  return item;
}

std::string_view KindWords(ModelGraphNodeKind kind) {
  switch (kind) {
    case ModelGraphNodeKind::kCompositeState:
      return "the composite state";
    case ModelGraphNodeKind::kCausalModel:
      return "the causal model";
    case ModelGraphNodeKind::kRequirementModel:
      return "the requirement model";
    case ModelGraphNodeKind::kStrongRequirementModel:
      return "the strong requirement model";
    case ModelGraphNodeKind::kReuseModel:
      return "the reuse model";
    case ModelGraphNodeKind::kDriveModel:
      return "the drive model";
  }
  return {};
}

std::string EvidenceText(const Evidence& evidence) {
  return FormatConfidence(evidence.rate()) + " (" + FormatNumber(evidence.positive, 6) + " of " +
         FormatNumber(evidence.total, 6) + ")";
}

std::string AspectText(const std::string& aspect, const KbDiffSide& left, const KbDiffSide& right) {
  const auto from_to = [&](const std::string& a, const std::string& b) {
    return aspect + " " + a + " and " + b;
  };
  if (aspect == "confidence" || aspect == "evidence")
    return from_to(EvidenceText(left.evidence), EvidenceText(right.evidence));
  if (aspect == "strength")
    return from_to(left.strong ? "confirmed" : "open", right.strong ? "confirmed" : "open");
  if (aspect == "state")
    return from_to(std::string(EnumName(left.state)), std::string(EnumName(right.state)));
  if (aspect == "origin")
    return from_to(std::string(EnumName(left.origin)), std::string(EnumName(right.origin)));
  if (aspect == "copies") return from_to(std::to_string(left.copies), std::to_string(right.copies));
  const auto source = [](const KbDiffSide& side) {
    return side.derived_from.empty() ? std::string("from nothing") : "from " + side.derived_from;
  };
  return from_to(source(left), source(right));
}

}  // namespace

std::string_view NameOf(KbChange change) {
  switch (change) {
    case KbChange::kAdded:
      return "added";
    case KbChange::kRemoved:
      return "removed";
    case KbChange::kChanged:
      return "changed";
  }
  return {};
}

KbDiffResult DiffKnowledge(const KnowledgeBase& left, const KnowledgeBase& right) {
  const Entries a = Side(left).Collect();
  const Entries b = Side(right).Collect();
  KbDiffResult result;
  for (const auto& [content, entry] : a) {
    const auto other = b.find(content);
    if (other == b.end()) {
      result.items.push_back(ItemOf(content, &entry, nullptr));
      ++result.removed;
      continue;
    }
    KbDiffItem item = ItemOf(content, &entry, &other->second);
    if (item.aspects.empty()) {
      ++result.same;
    } else {
      result.items.push_back(std::move(item));
      ++result.changed;
    }
  }
  for (const auto& [content, entry] : b) {
    if (a.contains(content)) continue;
    result.items.push_back(ItemOf(content, nullptr, &entry));
    ++result.added;
  }
  std::sort(result.items.begin(), result.items.end(), [](const KbDiffItem& x, const KbDiffItem& y) {
    return std::tie(x.kind, x.title, x.content) < std::tie(y.kind, y.title, y.content);
  });
  return result;
}

KbDiffResult Exchanged(KbDiffResult difference) {
  std::swap(difference.added, difference.removed);
  for (KbDiffItem& item : difference.items) {
    std::swap(item.left, item.right);
    if (item.change == KbChange::kAdded)
      item.change = KbChange::kRemoved;
    else if (item.change == KbChange::kRemoved)
      item.change = KbChange::kAdded;
  }
  return difference;
}

std::string SentenceOf(const KbDiffItem& item, const std::string& left_name, const std::string& right_name) {
  const std::string what = std::string(KindWords(item.kind)) + " \"" + item.title + "\"";
  if (!item.left) return "Only " + right_name + " has " + what + " (" + item.right->id + ").";
  if (!item.right) return "Only " + left_name + " has " + what + " (" + item.left->id + ").";
  std::vector<std::string> aspects;
  for (const std::string& aspect : item.aspects)
    aspects.push_back(AspectText(aspect, *item.left, *item.right));
  return "Both have " + what + " (" + item.left->id + ", " + item.right->id + "), with " +
         Join(aspects, "; ") + ".";
}

}  // namespace aerascope
