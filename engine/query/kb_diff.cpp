#include "engine/query/kb_diff.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>

#include "engine/query/without_numbers.h"
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
    CompositeStateId state;
    ModelId model;

    auto Key() const {
      // Evidence by its bits: an order for whatever a file may hold, infinities and the like included.
      return std::tuple(side.model_state, side.origin, side.strong,
                        std::bit_cast<std::uint64_t>(side.evidence.positive),
                        std::bit_cast<std::uint64_t>(side.evidence.total), source);
    }
  };
  std::vector<Copy> copies;  // ordered by what they say, not by number
  PieceForm form;

  const KbDiffSide& side() const { return copies.front().side; }
};

using Entries = std::map<Hash128, Entry>;

class Side {
 public:
  explicit Side(const KnowledgeBase& knowledge) : knowledge_(knowledge) {
    for (const auto& [id, record] : knowledge.models()) {
      if (!IsRequirement(record.model)) continue;
      if (const CompositeStateRecord* state = knowledge.Find(RequiredState(record.model)))
        told_.insert(state->canonical.hash);
    }
  }

  // The pieces of this side. A composite state is no piece of its own where a requirement model of either
  // side tells it.
  Entries Collect(const Side& other) {
    const ModelGraph graph = MakeModelGraph(knowledge_, DeletedModels::kInclude);
    for (const ModelGraphNode& node : graph.nodes) {
      if (node.is_model() || !(told_.contains(node.content) || other.told_.contains(node.content))) Add(node);
    }
    for (auto& [content, entry] : entries_) {
      std::stable_sort(entry.copies.begin(), entry.copies.end(),
                       [](const auto& a, const auto& b) { return a.Key() < b.Key(); });
      const Entry::Copy& first = entry.copies.front();
      entry.copies.front().side.copies = entry.copies.size();
      entry.form = first.model.valid() ? FormOf(knowledge_, *knowledge_.Find(first.model))
                                       : FormOf(knowledge_, *knowledge_.Find(first.state));
    }
    return std::move(entries_);
  }

 private:
  void Add(const ModelGraphNode& node) {
    Entry& entry = entries_[node.content];
    entry.kind = node.kind;
    if (entry.copies.empty()) entry.title = TitleOfNode(node);
    Entry::Copy copy;
    copy.state = node.state;
    copy.model = node.model;
    copy.side.id = node.id;
    copy.side.content = node.content;
    copy.side.title = entry.title;
    copy.side.lines = node.lines;
    copy.side.evidence = node.evidence;
    copy.side.strong = node.strong;
    copy.side.model_state = node.model_state;
    copy.side.origin = node.origin;
    if (node.is_model()) NoteParts(knowledge_.Find(node.model)->model, &copy.side);
    NoteSource(node, &copy);
    entry.copies.push_back(std::move(copy));
  }

  // The other two of a triad.
  void NoteParts(const Model& model, KbDiffSide* side) const {
    side->delay = DelayOf(model).value_or(Duration{});
    if (const CompositeStateRecord* state = knowledge_.Find(RequiredState(model)))
      side->state = IdText(state->state.id);
    if (const ModelRecord* target = knowledge_.Find(TargetModel(model)))
      side->target = IdText(target->model.id);
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
    std::vector<std::string> names = CanonicalNames(knowledge_, record);
    const auto words = [&](const Term& payload) {
      return PayloadWords(knowledge_, payload, names, Writing::kCanonical);
    };
    const std::string lhs = words(record.model.lhs.payload);
    Term rhs = record.model.rhs.payload;
    WriteFormulas(knowledge_, record.model.lhs.payload, &rhs, &names);
    return lhs + (record.model.rhs.positive ? " makes " : " ends ") + words(rhs);
  }

  const KnowledgeBase& knowledge_;
  std::set<Hash128> told_;  // contents of composite states that requirement models ask for
  Entries entries_;
};

std::uint64_t Bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}

// What differs between the copies on both sides, which are compared one by one. Of pieces with different
// contents, where they come from differs anyway.
std::vector<std::string> AspectsOf(const Entry& left, const Entry& right) {
  const bool pair = left.side().content != right.side().content;
  if (left.copies.size() != right.copies.size()) return {"copies"};
  const auto differs = [&](auto&& value_of) {
    return !std::equal(
        left.copies.begin(), left.copies.end(), right.copies.begin(),
        [&](const Entry::Copy& a, const Entry::Copy& b) { return value_of(a) == value_of(b); });
  };
  using Copy = const Entry::Copy&;
  std::vector<std::string> aspects;
  // By their bits, so that what is no number is the same as itself.
  if (differs([](Copy copy) { return Bits(copy.side.evidence.rate()); })) {
    aspects.push_back("confidence");
  } else if (differs([](Copy copy) {
               return std::pair(Bits(copy.side.evidence.positive), Bits(copy.side.evidence.total));
             })) {
    aspects.push_back("evidence");
  }
  if (differs([](Copy copy) { return copy.side.strong; })) aspects.push_back("strength");
  if (differs([](Copy copy) { return copy.side.model_state; })) aspects.push_back("state");
  if (!pair && differs([](Copy copy) { return copy.side.origin; })) aspects.push_back("origin");
  if (!pair && differs([](Copy copy) { return copy.source; })) aspects.push_back("derivation");
  return aspects;
}

KbDiffItem ItemOf(const Entry* left, const Entry* right) {
  const Entry& any = left ? *left : *right;
  KbDiffItem item;
  item.change = !left ? KbChange::kAdded : !right ? KbChange::kRemoved : KbChange::kChanged;
  item.kind = any.kind;
  item.content = any.side().content;
  item.title = any.title;
  if (left) item.left = left->side();
  if (right) item.right = right->side();
  if (left && right) item.aspects = AspectsOf(*left, *right);
  return item;
}

bool ReadsInOrder(const KbDiffItem& a, const KbDiffItem& b) {
  // Of a pair what is smaller decides, so that the order is the same from either side.
  const auto key = [](const KbDiffItem& item) {
    const KbDiffSide& left = item.left ? *item.left : *item.right;
    const KbDiffSide& right = item.right ? *item.right : *item.left;
    return std::tuple(item.kind, std::min(left.title, right.title), std::min(left.content, right.content));
  };
  return key(a) < key(b);
}

class Comparison {
 public:
  Comparison(const KnowledgeBase& left, const KnowledgeBase& right) : bases_{&left, &right} {
    Side a(left);
    Side b(right);
    entries_[0] = a.Collect(b);
    entries_[1] = b.Collect(a);
  }

  KbDiffResult Compare() {
    AddEqual();
    FindAlone();
    if (!alone_[0].empty() || !alone_[1].empty()) {
      MakeGroups();
      AddPairs();
      for (const std::size_t side : {0u, 1u}) AddAlone(side);
    }
    std::sort(result_.items.begin(), result_.items.end(), ReadsInOrder);
    std::sort(result_.same.begin(), result_.same.end(), ReadsInOrder);
    return std::move(result_);
  }

 private:
  // Pieces of which one may be another form of the other: of one kind, about one model but for its numbers.
  using GroupKey = std::pair<ModelGraphNodeKind, Hash128>;
  using Groups = std::map<GroupKey, std::vector<const Entry*>>;

  // Two pieces, one of each side.
  struct Candidate {
    const Entry* left = nullptr;
    const Entry* right = nullptr;
    Alignment alignment;

    // Better ones first; the last part makes the order the same from either side.
    auto Key() const {
      const Hash128& a = left->side().content;
      const Hash128& b = right->side().content;
      const bool comparable = alignment.relation != PieceRelation::kOverlapping;
      return std::tuple(!comparable, alignment.left_only + alignment.right_only, -alignment.shared,
                        std::min(a, b), std::max(a, b));
    }
  };

  void AddEqual() {
    for (const auto& [content, entry] : entries_[0]) {
      const auto other = entries_[1].find(content);
      if (other == entries_[1].end()) continue;
      KbDiffItem item = ItemOf(&entry, &other->second);
      item.rows = Align(entry.form, other->second.form).rows;
      (item.aspects.empty() ? result_.same : result_.items).push_back(std::move(item));
    }
  }

  void FindAlone() {
    for (const std::size_t side : {0u, 1u}) {
      for (const auto& [content, entry] : entries_[side])
        if (!entries_[1 - side].contains(content)) alone_[side].insert(&entry);
    }
  }

  void MakeGroups() {
    for (const std::size_t side : {0u, 1u}) {
      const WithoutNumbers rules(*bases_[side]);
      for (const auto& [content, entry] : entries_[side]) {
        const Entry::Copy& first = entry.copies.front();
        GroupKey key{entry.kind, {}};
        if (first.model.valid()) {
          const Model& model = bases_[side]->Find(first.model)->model;
          key.second = rules.HashOf(IsRequirement(model) ? TargetModel(model) : first.model);
        }
        groups_[side][key].push_back(&entry);
      }
    }
  }

  void AddPairs() {
    std::vector<Candidate> candidates;
    for (const auto& [key, left] : groups_[0]) {
      const auto right = groups_[1].find(key);
      if (right == groups_[1].end()) continue;
      for (const Entry* a : left) {
        if (!alone_[0].contains(a)) continue;
        for (const Entry* b : right->second) {
          if (!alone_[1].contains(b)) continue;
          const std::size_t smaller = std::min(a->form.shapes.size(), b->form.shapes.size());
          if (CommonShapes(a->form, b->form) < smaller) continue;
          Candidate candidate{a, b, Align(a->form, b->form)};
          if (MakesPair(candidate.alignment)) candidates.push_back(std::move(candidate));
        }
      }
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.Key() < b.Key(); });
    for (Candidate& candidate : candidates) {
      if (!alone_[0].contains(candidate.left) || !alone_[1].contains(candidate.right)) continue;
      alone_[0].erase(candidate.left);
      alone_[1].erase(candidate.right);
      KbDiffItem item = ItemOf(candidate.left, candidate.right);
      item.change = ChangeOf(candidate.alignment.relation);
      item.rows = std::move(candidate.alignment.rows);
      result_.items.push_back(std::move(item));
    }
  }

  static bool MakesPair(const Alignment& alignment) {
    switch (alignment.relation) {
      case PieceRelation::kSame:
      case PieceRelation::kOtherValues:
        return true;
      case PieceRelation::kGeneralised:
      case PieceRelation::kSpecialised:
        return alignment.shared > 0;
      case PieceRelation::kOverlapping:
      case PieceRelation::kUnrelated:
        return false;
    }
    return false;
  }

  static KbChange ChangeOf(PieceRelation relation) {
    if (relation == PieceRelation::kGeneralised) return KbChange::kGeneralised;
    if (relation == PieceRelation::kSpecialised) return KbChange::kSpecialised;
    return KbChange::kOtherValues;
  }

  void AddAlone(std::size_t side) {
    for (const auto& [key, entries] : groups_[side]) {
      for (const Entry* entry : entries) {
        if (!alone_[side].contains(entry)) continue;
        KbDiffItem item = side == 0 ? ItemOf(entry, nullptr) : ItemOf(nullptr, entry);
        std::optional<Candidate> nearest = Nearest(*entry, side, key);
        if (nearest) {
          const Entry& other = side == 0 ? *nearest->right : *nearest->left;
          item.relative = {nearest->alignment.relation, other.side().id, other.title, other.side().content};
          item.rows = std::move(nearest->alignment.rows);
        } else {
          item.rows = RowsOf(entry->form, side == 0 ? PartStatus::kLeftOnly : PartStatus::kRightOnly);
        }
        result_.items.push_back(std::move(item));
      }
    }
  }

  // Of the few that have most in common by their shapes, the one that is closest.
  std::optional<Candidate> Nearest(const Entry& entry, std::size_t side, const GroupKey& key) const {
    const auto group = groups_[1 - side].find(key);
    if (group == groups_[1 - side].end()) return std::nullopt;
    constexpr std::size_t kFew = 8;
    std::vector<std::pair<std::size_t, const Entry*>> likely;
    for (const Entry* other : group->second)
      likely.emplace_back(CommonShapes(entry.form, other->form), other);
    const auto better = [](const auto& a, const auto& b) {
      return std::pair(b.first, a.second->side().content) < std::pair(a.first, b.second->side().content);
    };
    const auto end = likely.begin() + static_cast<std::ptrdiff_t>(std::min(kFew, likely.size()));
    std::partial_sort(likely.begin(), end, likely.end(), better);
    std::optional<Candidate> nearest;
    for (auto it = likely.begin(); it != end; ++it) {
      const Entry& other = *it->second;
      Candidate candidate = side == 0 ? Candidate{&entry, &other, Align(entry.form, other.form)}
                                      : Candidate{&other, &entry, Align(other.form, entry.form)};
      if (candidate.alignment.relation == PieceRelation::kUnrelated || candidate.alignment.shared == 0)
        continue;
      if (!nearest || candidate.Key() < nearest->Key()) nearest = std::move(candidate);
    }
    return nearest;
  }

  const KnowledgeBase* bases_[2];
  Entries entries_[2];
  Groups groups_[2];
  std::set<const Entry*> alone_[2];  // no order is taken from it
  KbDiffResult result_;
};

}  // namespace

KbDiffResult DiffKnowledge(const KnowledgeBase& left, const KnowledgeBase& right) {
  return Comparison(left, right).Compare();
}

KbDiffResult Exchanged(KbDiffResult difference) {
  for (std::vector<KbDiffItem>* items : {&difference.items, &difference.same}) {
    for (KbDiffItem& item : *items) {
      std::swap(item.left, item.right);
      item.change = Exchanged(item.change);
      if (item.relative) item.relative->relation = Exchanged(item.relative->relation);
      item.rows = Exchanged(std::move(item.rows));
      const KbDiffSide& first = item.left ? *item.left : *item.right;
      item.title = first.title;
      item.content = first.content;
    }
  }
  return difference;
}

KbChange Exchanged(KbChange change) {
  switch (change) {
    case KbChange::kAdded:
      return KbChange::kRemoved;
    case KbChange::kRemoved:
      return KbChange::kAdded;
    case KbChange::kGeneralised:
      return KbChange::kSpecialised;
    case KbChange::kSpecialised:
      return KbChange::kGeneralised;
    case KbChange::kOtherValues:
    case KbChange::kChanged:
      return change;
  }
  return change;
}

bool KbDiffItem::has_aspect(std::string_view aspect) const {
  return std::find(aspects.begin(), aspects.end(), aspect) != aspects.end();
}

ModelState KbDiffItem::state() const {
  const ModelState first = left ? left->model_state : right->model_state;
  return !left || !right || left->model_state == right->model_state ? first : ModelState::kActive;
}

std::int64_t KbDiffResult::CountGivenUp(KbChange change) const {
  return std::count_if(items.begin(), items.end(), [&](const KbDiffItem& item) {
    return item.change == change && item.state() == ModelState::kDeleted;
  });
}

std::int64_t KbDiffResult::Count(KbChange change) const {
  return std::count_if(items.begin(), items.end(),
                       [&](const KbDiffItem& item) { return item.change == change; });
}

}  // namespace aerascope
