#include "exporters/snapshot/snapshot.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>

#include "engine/base/text.h"
#include "engine/query/model_graph.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

constexpr std::string_view kTitle = "aerascope knowledge snapshot, version 1";
constexpr std::string_view kTitleOfAnyVersion = "aerascope knowledge snapshot, version ";
static_assert(kTitle.starts_with(kTitleOfAnyVersion));
constexpr std::string_view kEvidenceYes = "evidence: yes";
constexpr std::string_view kEvidenceNo = "evidence: no";
constexpr std::size_t kHashDigits = 16;

std::string ShortHash(Hash128 hash) {
  return ToText(hash).substr(0, kHashDigits);
}

std::string_view KindWords(ModelGraphNodeKind kind) {
  switch (kind) {
    case ModelGraphNodeKind::kCompositeState:
      return "composite state";
    case ModelGraphNodeKind::kCausalModel:
      return "causal model";
    case ModelGraphNodeKind::kRequirementModel:
      return "requirement model";
    case ModelGraphNodeKind::kStrongRequirementModel:
      return "strong requirement model";
    case ModelGraphNodeKind::kReuseModel:
      return "reuse model";
    case ModelGraphNodeKind::kDriveModel:
      return "drive model";
  }
  return {};
}

// One item while the text is made.
struct Item {
  ModelGraphNodeKind kind = ModelGraphNodeKind::kCompositeState;
  Hash128 content;
  std::vector<std::string> lines;
  std::vector<Hash128> refers_to;  // in order of the lines "uses"
  std::optional<Hash128> source;
  Origin origin = Origin::kSeed;
  Evidence evidence;
  bool strong = false;
  ModelState state = ModelState::kActive;
  std::size_t copies = 1;
  std::string alias;

  bool is_model() const { return kind != ModelGraphNodeKind::kCompositeState; }
  auto Key() const {
    return std::tuple(kind, lines, content, state, origin, strong,
                      std::bit_cast<std::uint64_t>(evidence.positive),
                      std::bit_cast<std::uint64_t>(evidence.total), source);
  }
};

class Maker {
 public:
  Maker(const KnowledgeBase& knowledge, const SnapshotOptions& options)
      : knowledge_(knowledge), options_(options) {}

  std::string Make() {
    const ModelGraph graph = MakeModelGraph(knowledge_);
    for (const ModelGraphNode& node : graph.nodes) items_.push_back(ItemOf(node));
    std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) { return a.Key() < b.Key(); });
    CountCopies();
    NameItems();
    std::string text =
        std::string(kTitle) + "\n" + std::string(options_.evidence ? kEvidenceYes : kEvidenceNo) + "\n";
    for (const Item& item : items_) text += Block(item);
    return text;
  }

 private:
  Item ItemOf(const ModelGraphNode& node) const {
    Item item;
    item.kind = node.kind;
    item.content = node.content;
    item.origin = node.origin;
    item.evidence = options_.evidence ? node.evidence : Evidence{};
    item.strong = options_.evidence && node.strong;
    item.state = node.model_state;
    if (node.is_model())
      Describe(*knowledge_.Find(node.model), &item);
    else
      Describe(*knowledge_.Find(node.state), &item);
    return item;
  }

  void Describe(const CompositeStateRecord& record, Item* item) const {
    for (const Condition& condition : CanonicalConditions(knowledge_, record))
      item->lines.push_back(condition.text);
    const std::vector<std::string> names = CanonicalNames(knowledge_, record);
    for (const Guard& guard : record.state.guards) item->lines.push_back("where " + GuardText(guard, names));
    for (const int component : record.canonical.components) {
      Refer(record.state.components[static_cast<std::size_t>(component)].payload, item);
    }
    if (const CompositeStateRecord* source = knowledge_.Find(record.derived_from))
      item->source = source->canonical.hash;
  }

  void Describe(const ModelRecord& record, Item* item) const {
    const Model& model = record.model;
    const std::vector<std::string> names = CanonicalNames(knowledge_, record);
    const auto side = [&](const FactPattern& pattern) {
      return (pattern.positive ? "" : "not ") +
             PayloadWords(knowledge_, pattern.payload, names, Writing::kCanonical);
    };
    if (IsRequirement(model)) item->lines.push_back(TitleOf(knowledge_, model.id));
    item->lines.push_back("if " + side(model.lhs));
    item->lines.push_back("then " + side(model.rhs));
    for (const Guard& guard : model.forward) item->lines.push_back("forward " + GuardText(guard, names));
    for (const Guard& guard : model.backward) item->lines.push_back("backward " + GuardText(guard, names));
    Refer(model.lhs.payload, item);
    Refer(model.rhs.payload, item);
    if (const ModelRecord* source = knowledge_.Find(record.derived_from))
      item->source = source->canonical.hash;
  }

  static std::string GuardText(const Guard& guard, const std::vector<std::string>& names) {
    if (!guard.target) return ValueText(guard.expression, names);
    return ValueText(Term::Variable(*guard.target), names) + " := " + ValueText(guard.expression, names);
  }

  void Refer(const Term& payload, Item* item) const {
    ForEachTerm(payload, [&](const Term& term) {
      if (term.is(TermKind::kCompositeState)) {
        const CompositeStateRecord* nested = knowledge_.Find(term.composite_state());
        if (nested) item->refers_to.push_back(nested->canonical.hash);
      }
      if (term.is(TermKind::kModel)) {
        const ModelRecord* nested = knowledge_.Find(term.model());
        if (nested) item->refers_to.push_back(nested->canonical.hash);
      }
    });
  }

  // Items that agree in everything become one.
  void CountCopies() {
    std::vector<Item> distinct;
    for (Item& item : items_) {
      if (!distinct.empty() && distinct.back().Key() == item.Key())
        ++distinct.back().copies;
      else
        distinct.push_back(std::move(item));
    }
    items_ = std::move(distinct);
  }

  void NameItems() {
    std::size_t states = 0;
    std::size_t models = 0;
    for (Item& item : items_) {
      item.alias = item.is_model() ? "M" + std::to_string(++models) : "C" + std::to_string(++states);
      aliases_.try_emplace(item.content, item.alias);
    }
  }

  // What is not in the snapshot itself (a deleted model) goes by its hash.
  std::string AliasOf(Hash128 content) const {
    const auto it = aliases_.find(content);
    return it == aliases_.end() ? ShortHash(content) : it->second;
  }

  std::string Block(const Item& item) const {
    std::string text =
        "\n" + std::string(KindWords(item.kind)) + " " + item.alias + " " + ShortHash(item.content) + "\n";
    for (const std::string& line : item.lines) text += "  " + line + "\n";
    if (!item.refers_to.empty()) {
      text += "  uses:";
      for (const Hash128 content : item.refers_to) text += " " + AliasOf(content);
      text += "\n";
    }
    if (item.source) text += "  derived from: " + AliasOf(*item.source) + "\n";
    text += "  origin: " + std::string(EnumName(item.origin)) + "\n";
    if (item.is_model() && item.state != ModelState::kActive)
      text += "  state: " + std::string(EnumName(item.state)) + "\n";
    if (item.is_model() && options_.evidence) {
      text += "  confidence: " + FormatNumber(item.evidence.rate(), 9) + " (" +
              FormatNumber(item.evidence.positive, 9) + " of " + FormatNumber(item.evidence.total, 9) + ")" +
              (item.strong ? ", confirmed" : "") + "\n";
    }
    if (item.copies > 1) text += "  copies: " + std::to_string(item.copies) + "\n";
    return text;
  }

  const KnowledgeBase& knowledge_;
  SnapshotOptions options_;
  std::vector<Item> items_;
  std::map<Hash128, std::string> aliases_;
};

// -------------------------------------------------------------------------------------------------------
// comparing

struct Block {
  std::string kind;
  std::string alias;
  std::string hash;
  std::vector<std::string> lines;       // as written
  std::vector<std::string> comparable;  // with hashes for aliases

  // What it is called in sentences: a requirement model by its title, anything else by what it says.
  std::string Words() const {
    std::vector<std::string> said;
    for (const std::string& line : lines) {
      const bool about_it =
          line.starts_with("uses: ") || line.starts_with("derived from: ") || line.starts_with("origin: ");
      if (about_it || line.starts_with("forward ")) break;
      said.push_back(line);
      if (kind.ends_with("requirement model")) break;
    }
    return kind + " \"" + Join(said, "; ") + "\"";
  }
};

std::string_view TakeLine(std::string_view* text) {
  const std::size_t end = text->find('\n');
  std::string_view line = text->substr(0, end);
  text->remove_prefix(end == std::string_view::npos ? text->size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// "requirement model M3 0123456789abcdef"
std::optional<Block> HeadOf(std::string_view line) {
  const std::size_t hash = line.rfind(' ');
  if (hash == std::string_view::npos || hash == 0) return std::nullopt;
  const std::size_t alias = line.rfind(' ', hash - 1);
  if (alias == std::string_view::npos) return std::nullopt;
  return Block{std::string(line.substr(0, alias)),
               std::string(line.substr(alias + 1, hash - alias - 1)),
               std::string(line.substr(hash + 1)),
               {},
               {}};
}

// Lines that name other items, with their hashes in place of aliases.
std::string Comparable(const std::string& line, const std::map<std::string, std::string>& hash_of) {
  if (!line.starts_with("uses: ") && !line.starts_with("derived from: ")) return line;
  std::string result;
  std::string word;
  const auto finish = [&] {
    const auto it = hash_of.find(word);
    result += it == hash_of.end() ? word : it->second;
    word.clear();
  };
  for (const char c : line) {
    if (c != ' ') {
      word += c;
      continue;
    }
    finish();
    result += c;
  }
  finish();
  return result;
}

struct Snapshot {
  bool evidence = false;
  std::vector<Block> blocks;
};

Result<Snapshot> Read(std::string_view text, const std::string& name) {
  Snapshot snapshot;
  const auto fail = [&](int line, const std::string& what) { return ErrorAt({name, line, 1}, what); };
  const std::string_view title = TakeLine(&text);
  if (title != kTitle) {
    return fail(1, "expected \"" + std::string(kTitle) + "\", found \"" + Printable(title.substr(0, 60)) +
                       "\"; name a file that `aerascope snapshot accept` made");
  }
  const std::string_view evidence = TakeLine(&text);
  if (evidence != kEvidenceYes && evidence != kEvidenceNo) {
    return fail(2, "expected \"evidence: yes\" or \"evidence: no\", found \"" +
                       Printable(evidence.substr(0, 60)) + "\"");
  }
  snapshot.evidence = evidence == kEvidenceYes;
  for (int number = 3; !text.empty(); ++number) {
    const std::string_view line = TakeLine(&text);
    if (line.empty()) continue;
    if (line.starts_with("  ")) {
      if (snapshot.blocks.empty()) return fail(number, "expected the head of an item before its lines");
      snapshot.blocks.back().lines.emplace_back(line.substr(2));
      continue;
    }
    std::optional<Block> block = HeadOf(line);
    if (!block) {
      return fail(number,
                  "expected a kind, an alias and a hash, found \"" + Printable(line.substr(0, 60)) + "\"");
    }
    snapshot.blocks.push_back(std::move(*block));
  }
  std::map<std::string, std::string> hash_of;
  for (const Block& block : snapshot.blocks) hash_of[block.alias] = block.hash;
  for (Block& block : snapshot.blocks) {
    for (const std::string& line : block.lines) block.comparable.push_back(Comparable(line, hash_of));
  }
  return snapshot;
}

// Of each content the blocks in order; several only where knowledge has copies with other evidence.
std::map<std::string, std::vector<const Block*>> ByHash(const Snapshot& snapshot) {
  std::map<std::string, std::vector<const Block*>> by_hash;
  for (const Block& block : snapshot.blocks) by_hash[block.hash].push_back(&block);
  return by_hash;
}

std::string Whole(const Block& block, std::string_view sign) {
  std::string text = std::string(sign) + " " + block.kind + " " + block.alias + " " + block.hash + "\n";
  for (const std::string& line : block.lines) text += std::string(sign) + "   " + Printable(line) + "\n";
  return text;
}

// The lines only one of two blocks has.
std::string Differing(const Block& stored, const Block& actual) {
  std::string text = "~ " + stored.Words() + "\n";
  const auto only = [&](const Block& one, const Block& other, std::string_view sign) {
    for (std::size_t i = 0; i < one.comparable.size(); ++i) {
      if (std::find(other.comparable.begin(), other.comparable.end(), one.comparable[i]) ==
          other.comparable.end()) {
        text += std::string(sign) + "   " + Printable(one.lines[i]) + "\n";
      }
    }
  };
  only(stored, actual, "-");
  only(actual, stored, "+");
  return text;
}

SnapshotComparison Compare(const Snapshot& stored, const Snapshot& actual) {
  SnapshotComparison result;
  const auto in_stored = ByHash(stored);
  const auto in_actual = ByHash(actual);
  std::string missing;
  std::string added;
  std::string changed;
  const auto at = [](const auto& by_hash, const std::string& hash, std::size_t i) -> const Block* {
    const auto it = by_hash.find(hash);
    return it != by_hash.end() && i < it->second.size() ? it->second[i] : nullptr;
  };
  std::map<std::string, std::size_t> seen;
  for (const Block& block : stored.blocks) {
    const Block* other = at(in_actual, block.hash, seen[block.hash]++);
    if (!other) {
      result.missing.push_back(block.Words());
      missing += Whole(block, "-");
    } else if (block.comparable != other->comparable || block.kind != other->kind) {
      result.changed.push_back(block.Words());
      changed += Differing(block, *other);
    }
  }
  seen.clear();
  for (const Block& block : actual.blocks) {
    if (at(in_stored, block.hash, seen[block.hash]++)) continue;
    result.added.push_back(block.Words());
    added += Whole(block, "+");
  }
  const auto sentences = [&](const char* what, const std::vector<std::string>& items) {
    for (const std::string& item : items) result.difference += std::string(what) + Printable(item) + "\n";
  };
  sentences("missing: ", result.missing);
  sentences("new: ", result.added);
  sentences("changed: ", result.changed);
  for (const std::string* details : {&missing, &added, &changed}) {
    if (!details->empty()) result.difference += "\n" + *details;
  }
  return result;
}

}  // namespace

std::string SnapshotText(const KnowledgeBase& knowledge, const SnapshotOptions& options) {
  return Maker(knowledge, options).Make();
}

Result<SnapshotComparison> CompareSnapshots(std::string_view stored, std::string_view actual,
                                            const std::string& stored_name) {
  const Result<Snapshot> expected = Read(stored, stored_name);
  if (!expected) return expected.error();
  const Result<Snapshot> found = Read(actual, "the knowledge of this run");
  if (!found) return found.error();
  if (expected->evidence != found->evidence) {
    return Error{stored_name + " was made with \"" +
                 std::string(expected->evidence ? kEvidenceYes : kEvidenceNo) +
                 "\" and is compared with a snapshot made otherwise; make both the same way"};
  }
  return Compare(*expected, *found);
}

bool IsSnapshot(std::string_view text) {
  return TakeLine(&text).starts_with(kTitleOfAnyVersion);
}

Result<bool> SnapshotHasEvidence(std::string_view stored, const std::string& stored_name) {
  const Result<Snapshot> snapshot = Read(stored, stored_name);
  if (!snapshot) return snapshot.error();
  return snapshot->evidence;
}

}  // namespace aerascope
