#include "viewer/layout/triad_layout.h"

#include <algorithm>
#include <set>
#include <utility>

namespace aerascope {
namespace {

constexpr int kRowGapFolded = 6;
constexpr int kRowGapOpen = 16;
constexpr int kNoteHeight = 26;          // the free line over a derived card of an open band
constexpr int kCardFoot = 8;             // under the last line of an open card
constexpr int kLaneStep = 10;            // between links of analogies of different depth
constexpr int kLanes = 3;                // deeper ones share the innermost
constexpr std::size_t kCentredRows = 8;  // a model's card stands beside the middle of at most so many rows

// A requirement model and what was derived from it, in order of creation.
struct RowTree {
  std::map<ModelId, std::vector<ModelId>> derived;
  std::vector<ModelId> roots;
};

struct Row {
  ModelId requirement;
  int depth = 0;  // steps of analogy from the row's root
};

// The model that a chain of requirements in the end speaks about.
ModelId BandModel(const KnowledgeBase& knowledge, ModelId requirement, std::map<ModelId, ModelId>& known) {
  std::vector<ModelId> chain;
  ModelId at = requirement;
  while (true) {
    if (const auto found = known.find(at); found != known.end()) {
      at = found->second;
      break;
    }
    const ModelRecord* record = knowledge.Find(at);
    if (record == nullptr || !IsRequirement(record->model)) break;
    if (std::find(chain.begin(), chain.end(), at) != chain.end() || chain.size() >= 64) break;  // a circle
    chain.push_back(at);
    at = TargetModel(record->model);
  }
  for (const ModelId id : chain) known[id] = at;
  return at;
}

std::vector<Row> InRowOrder(const RowTree& tree) {
  std::vector<Row> rows;
  std::vector<Row> pending;
  for (auto root = tree.roots.rbegin(); root != tree.roots.rend(); ++root) pending.push_back({*root, 0});
  while (!pending.empty()) {
    const Row row = pending.back();
    pending.pop_back();
    rows.push_back(row);
    const auto derived = tree.derived.find(row.requirement);
    if (derived == tree.derived.end()) continue;
    for (auto child = derived->second.rbegin(); child != derived->second.rend(); ++child) {
      pending.push_back({*child, row.depth + 1});
    }
  }
  return rows;
}

class Layouter {
 public:
  Layouter(const KnowledgeBase& knowledge, const TriadOptions& options)
      : knowledge_(knowledge), options_(options) {
    layout_.states = {options.left_margin, 0, options.state_width, 0};
    layout_.requirements = {layout_.states.right(), 0, options.ring_column_width, 0};
    layout_.models = {layout_.requirements.right(), 0, options.model_width, 0};
    layout_.width = layout_.models.right() + 1;
  }

  TriadLayout Run() {
    SortIntoBands();
    for (auto& [model, tree] : trees_) {
      const ModelRecord* record = knowledge_.Find(model);
      if (record != nullptr && KindOf(record->model) == ModelKind::kDrive && tree.roots.empty()) continue;
      AddCausalBand(model, tree);
    }
    AddDriveBand();
    AddOtherStates();
    return std::move(layout_);
  }

 private:
  // Every model that is not a requirement has a band, and so has every unknown model that is spoken about.
  void SortIntoBands() {
    std::map<ModelId, ModelId> band_of;
    for (const auto& [id, record] : knowledge_.models()) {
      const ModelId band = BandModel(knowledge_, id, band_of);
      band_of[id] = band;
      trees_[band];
    }
    for (const auto& [id, record] : knowledge_.models()) {
      if (!IsRequirement(record.model)) continue;
      const ModelId source = record.derived_from;
      RowTree& tree = trees_[band_of[id]];
      // A source is older; anything else would be a circle.
      if (source.valid() && source < id && band_of.contains(source) && band_of[source] == band_of[id] &&
          IsRequirement(knowledge_.Find(source)->model)) {
        tree.derived[source].push_back(id);
      } else {
        tree.roots.push_back(id);
      }
    }
  }

  int LinesOf(CompositeStateId id) const {
    const auto given = options_.lines.find(id);
    const CompositeStateRecord* record = knowledge_.Find(id);
    const int lines = given != options_.lines.end() ? given->second
                      : record != nullptr           ? static_cast<int>(record->state.components.size())
                                                    : 1;
    return std::clamp(lines, 1, std::max(1, options_.max_lines));
  }

  Card StateCard(const Model& requirement, std::size_t row) {
    const CompositeStateId state = RequiredState(requirement);
    if (!state.valid()) return {CardKind::kCondition, {}, requirement.id, row, 1};
    if (!shown_.insert(state).second) return {CardKind::kStateAgain, state, {}, row, 1};
    return {CardKind::kState, state, {}, row, LinesOf(state)};
  }

  void AddCausalBand(ModelId model, const RowTree& tree) {
    TriadBand band;
    band.kind = BandKind::kCausalModel;
    band.model = model;
    const bool known = knowledge_.Find(model) != nullptr;
    band.cards.push_back({known ? CardKind::kModel : CardKind::kUnknownModel, {}, model, 0, 2});
    std::vector<Row> rows = InRowOrder(tree);
    // A source stands before what is derived from it, so what is left out is never needed by what stays.
    if (rows.size() > options_.max_rows) {
      band.hidden_rows = rows.size() - options_.max_rows;
      for (std::size_t row = options_.max_rows; row < rows.size(); ++row) {
        left_out_.insert(RequiredState(knowledge_.Find(rows[row].requirement)->model));
      }
      rows.resize(options_.max_rows);
    }
    band.rows = rows.size();
    std::map<ModelId, std::size_t> ring_of;
    std::map<ModelId, std::size_t> state_of;
    std::vector<int> depths;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const ModelId id = rows[row].requirement;
      state_of[id] = band.cards.size();
      band.cards.push_back(StateCard(knowledge_.Find(id)->model, row));
      ring_of[id] = band.cards.size();
      band.cards.push_back({CardKind::kRequirement, {}, id, row, 1});
      depths.push_back(rows[row].depth);
    }
    for (const Row& row : rows) {
      const ModelRecord& record = *knowledge_.Find(row.requirement);
      band.edges.push_back({EdgeKind::kRequires, state_of[row.requirement], ring_of[row.requirement]});
      const auto above = ring_of.find(TargetModel(record.model));
      const bool on_requirement = above != ring_of.end() && above->first != row.requirement;
      band.edges.push_back(
          {EdgeKind::kEnables, ring_of[row.requirement], on_requirement ? above->second : 0});
      if (row.depth > 0) {
        band.edges.push_back({EdgeKind::kDerived, state_of[record.derived_from], state_of[row.requirement]});
      }
    }
    band.folded = PlaceCausal(band, depths, false);
    band.open = PlaceCausal(band, depths, true);
    layout_.bands.push_back(std::move(band));
  }

  int CardHeight(const Card& card, bool open) const {
    if (!open || card.kind == CardKind::kStateAgain || card.kind == CardKind::kCondition)
      return kFoldedCardHeight;
    return kCardHeadHeight + 6 + card.lines * kCardLineHeight + kCardFoot;
  }

  // Cards of a causal band are the model's, then state and ring of each row.
  BandForm PlaceCausal(const TriadBand& band, const std::vector<int>& depths, bool open) const {
    BandForm form;
    form.cards.resize(band.cards.size());
    const int ring = open ? kRingRadiusOpen : kRingRadiusFolded;
    int y = 0;
    for (std::size_t row = 0; row < band.rows; ++row) {
      if (row > 0) y += open ? (depths[row] > 0 ? kNoteHeight : kRowGapOpen) : kRowGapFolded;
      const std::size_t state = 1 + 2 * row;
      // The number of the ring stands under it when open.
      const int height = std::max(CardHeight(band.cards[state], open), open ? 2 * ring + 20 : 2 * ring);
      const int card_height = CardHeight(band.cards[state], open);
      form.cards[state] = {layout_.states.x, y + (height - card_height) / 2, layout_.states.width,
                           card_height};
      const int middle = form.cards[state].centre().y;
      form.cards[state + 1] = {layout_.requirements.centre().x - ring, middle - ring, 2 * ring, 2 * ring};
      y += height;
    }
    const int model_height = open ? kCardHeadHeight + 2 * kOpenModelSideHeight : 2 * kModelSideHeight;
    const int rows_height = y;
    form.height = std::max(rows_height, model_height);
    const int shift = (form.height - rows_height) / 2;
    for (std::size_t card = 1; card < form.cards.size(); ++card) form.cards[card].y += shift;
    const int model_y = band.rows <= kCentredRows ? (form.height - model_height) / 2 : 0;
    form.cards[0] = {layout_.models.x, model_y, layout_.models.width, model_height};
    PlaceEdges(band, depths, open, form);
    if (band.hidden_rows > 0) form.height += kHiddenRowsHeight;
    return form;
  }

  void PlaceEdges(const TriadBand& band, const std::vector<int>& depths, bool open, BandForm& form) const {
    form.notes.resize(band.edges.size());
    std::size_t arrivals = 0;
    for (const Edge& edge : band.edges) arrivals += edge.kind == EdgeKind::kEnables && edge.to == 0;
    std::size_t arrived = 0;
    for (std::size_t i = 0; i < band.edges.size(); ++i) {
      const Edge& edge = band.edges[i];
      const Rect& from = form.cards[edge.from];
      const Rect& to = form.cards[edge.to];
      EdgePath path;
      switch (edge.kind) {
        case EdgeKind::kRequires:
          path.points = {{from.right(), from.centre().y}, {to.x, to.centre().y}};
          path.mark = {(from.right() + to.x) / 2, from.centre().y};
          break;
        case EdgeKind::kEnables:
          path = edge.to == 0 ? ToModel(from, to, arrived++, arrivals) : ToRing(from, to);
          break;
        case EdgeKind::kDerived:
          path = Derived(from, to, depths[band.cards[edge.to].row]);
          if (open) form.notes[i] = {to.x, to.y - kNoteHeight, to.width, kNoteHeight};
          break;
      }
      form.edges.push_back(std::move(path));
    }
  }

  // Ports of a model's card are spread over its left side in order of the rows, so that links do not cross.
  static EdgePath ToModel(const Rect& ring, const Rect& model, std::size_t index, std::size_t count) {
    const int inner = model.height - 16;
    const int spread = std::min(inner, 14 * static_cast<int>(std::min<std::size_t>(count - 1, 100)));
    const int port =
        count < 2 ? model.centre().y
                  : model.centre().y - spread / 2 +
                        static_cast<int>(static_cast<long long>(spread) * static_cast<long long>(index) /
                                         static_cast<long long>(count - 1));
    const Point start{ring.right(), ring.centre().y};
    const Point end{model.x, port};
    const int reach = (end.x - start.x) / 2;
    return {true,
            {start, {start.x + reach, start.y}, {end.x - reach, end.y}, end},
            {start.x + reach, (start.y + end.y) / 2}};
  }

  // A requirement on a requirement: from ring to ring, bulging to the right.
  static EdgePath ToRing(const Rect& from, const Rect& to) {
    const Point start{from.right(), from.centre().y};
    const Point end{to.right(), to.centre().y};
    return {true,
            {start, {start.x + 24, start.y}, {end.x + 24, end.y}, end},
            {start.x + 18, (start.y + end.y) / 2}};
  }

  EdgePath Derived(const Rect& from, const Rect& to, int depth) const {
    const int lane = std::min(depth, kLanes) - 1;
    const int x = layout_.states.x - 8 - kLaneStep * (kLanes - 1 - lane);
    const Point start{from.x, from.centre().y};
    const Point end{to.x, to.centre().y};
    return {false, {start, {x, start.y}, {x, end.y}, end}, {x, end.y - to.height / 2 - kNoteHeight / 2}};
  }

  void AddDriveBand() {
    TriadBand band;
    band.kind = BandKind::kDriveModels;
    for (const auto& [id, record] : knowledge_.models()) {
      if (KindOf(record.model) != ModelKind::kDrive || !trees_[id].roots.empty()) continue;
      if (band.rows >= options_.max_rows) {
        ++band.hidden_rows;
        continue;
      }
      band.cards.push_back({CardKind::kModel, {}, id, band.rows++, 2});
    }
    PlaceList(std::move(band), layout_.models);
  }

  void AddOtherStates() {
    TriadBand band;
    band.kind = BandKind::kOtherStates;
    for (const auto& [id, record] : knowledge_.composite_states()) {
      if (shown_.contains(id) || left_out_.contains(id)) continue;
      if (band.rows >= options_.max_rows) {
        ++band.hidden_rows;
        continue;
      }
      band.cards.push_back({CardKind::kState, id, {}, band.rows++, LinesOf(id)});
    }
    PlaceList(std::move(band), layout_.states);
  }

  // Cards of one kind under each other, under the band's title.
  void PlaceList(TriadBand band, const Rect& column) {
    if (band.cards.empty()) return;
    for (const bool open : {false, true}) {
      BandForm& form = open ? band.open : band.folded;
      int y = kBandTitleHeight;
      for (const Card& card : band.cards) {
        int height = CardHeight(card, open);
        if (card.kind == CardKind::kModel) {
          height = open ? kCardHeadHeight + 2 * kOpenModelSideHeight : 2 * kModelSideHeight;
        }
        form.cards.push_back({column.x, y, column.width, height});
        y += height + (open ? kRowGapOpen : kRowGapFolded);
      }
      form.height = y - (open ? kRowGapOpen : kRowGapFolded);
      if (band.hidden_rows > 0) form.height += kHiddenRowsHeight;
    }
    layout_.bands.push_back(std::move(band));
  }

  const KnowledgeBase& knowledge_;
  const TriadOptions& options_;
  TriadLayout layout_;
  std::map<ModelId, RowTree> trees_;     // by the model of the band
  std::set<CompositeStateId> shown_;     // composite states that have a card
  std::set<CompositeStateId> left_out_;  // those of rows beyond the limit
};

}  // namespace

std::string_view BandTitle(BandKind kind) {
  switch (kind) {
    case BandKind::kCausalModel:
      return "";
    case BandKind::kDriveModels:
      return "What it is driven by";
    case BandKind::kOtherStates:
      return "Other composite states: given, or parts of those above";
  }
  return "";
}

TriadLayout LayOutTriads(const KnowledgeBase& final_knowledge, const TriadOptions& options) {
  return Layouter(final_knowledge, options).Run();
}

StackedBands StackBands(const TriadLayout& layout, const std::set<std::size_t>& open_bands) {
  StackedBands stacked;
  for (std::size_t band = 0; band < layout.bands.size(); ++band) {
    if (band > 0) stacked.height += kBandGap;
    stacked.tops.push_back(stacked.height);
    stacked.height +=
        open_bands.contains(band) ? layout.bands[band].open.height : layout.bands[band].folded.height;
  }
  return stacked;
}

}  // namespace aerascope
