#include "viewer/page/graph_data.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/base/text.h"
#include "viewer/layout/triad_layout.h"

namespace aerascope {
namespace {

using nlohmann::json;

json RectData(const Rect& rect) {
  return {rect.x, rect.y, rect.width, rect.height};
}

json FormData(const BandForm& form) {
  json cards = json::array();
  for (const Rect& rect : form.cards) cards.push_back(RectData(rect));
  json edges = json::array();
  for (std::size_t i = 0; i < form.edges.size(); ++i) {
    const EdgePath& path = form.edges[i];
    json points = json::array();
    for (const Point& point : path.points) points.push_back({point.x, point.y});
    edges.push_back({{"cubic", path.cubic}, {"points", points}, {"mark", {path.mark.x, path.mark.y}}});
  }
  json notes = json::array();
  for (const Rect& rect : form.notes) notes.push_back(RectData(rect));
  return {{"height", form.height}, {"cards", cards}, {"edges", edges}, {"notes", notes}};
}

class GraphAuthor {
 public:
  explicit GraphAuthor(const ReportContext& context) : context_(context), knowledge_(context.knowledge) {
    NoteDecided<PredictionSucceeded>(true);
    NoteDecided<PredictionFailed>(false);
    for (auto& [model, list] : decided_)
      std::stable_sort(list.begin(), list.end(),
                       [](const Decided& a, const Decided& b) { return a.time < b.time; });
  }

  json Write() const {
    TriadOptions options;
    for (const auto& [id, record] : knowledge_.composite_states())
      options.lines[id] = static_cast<int>(ConditionsWithPruned(knowledge_, id).size());
    const TriadLayout layout = LayOutTriads(knowledge_, options);
    json bands = json::array();
    for (const TriadBand& band : layout.bands) bands.push_back(BandData(band));
    return {{"width", layout.width},
            {"columns", {layout.states.x, layout.requirements.x, layout.models.x}},
            {"ring_column", {layout.requirements.x, layout.requirements.width}},
            {"band_gap", kBandGap},
            {"head_height", kCardHeadHeight},
            {"line_height", kCardLineHeight},
            {"title_height", kBandTitleHeight},
            {"hidden_height", kHiddenRowsHeight},
            {"bands", bands}};
  }

 private:
  struct Decided {
    Time time;
    bool right = false;
  };
  // In earnest, silent ones too: they count as evidence like the others.
  template <class Outcome>
  void NoteDecided(bool right) {
    const Run& run = context_.run;
    for (const EventId id : run.OfKind<Outcome>()) {
      const Event& event = *run.Find(id);
      const PredictionId prediction = run.FindBody<Outcome>(id)->prediction;
      const auto* made = run.FindBody<PredictionMade>(run.CreationOf(prediction));
      if (made != nullptr && !event.simulation.valid()) decided_[made->model].push_back({event.time, right});
    }
  }

  json BandData(const TriadBand& band) const {
    json cards = json::array();
    for (const Card& card : band.cards) cards.push_back(CardData(band, card));
    json edges = json::array();
    for (const Edge& edge : band.edges) edges.push_back(EdgeData(band, edge));
    return {{"title", std::string(BandTitle(band.kind))},
            {"cards", cards},
            {"edges", edges},
            {"hidden", band.hidden_rows},
            {"folded", FormData(band.folded)},
            {"open", FormData(band.open)}};
  }

  // The requirement model that shares the row of a state's card.
  ModelId RequirementOfRow(const TriadBand& band, std::size_t row) const {
    for (const Card& card : band.cards)
      if (card.kind == CardKind::kRequirement && card.row == row) return card.model;
    return {};
  }

  json CardData(const TriadBand& band, const Card& card) const {
    switch (card.kind) {
      case CardKind::kState:
      case CardKind::kStateAgain:
        return StateCard(band, card);
      case CardKind::kCondition:
        return ConditionCard(card);
      case CardKind::kRequirement:
        return RequirementCard(card);
      case CardKind::kModel:
        return ModelCard(card);
      case CardKind::kUnknownModel:
        return {{"kind", "unknown"}, {"subject", ""}, {"id", IdText(card.model)}, {"born", 0}};
    }
    return {};
  }

  static std::string OriginWord(Origin origin) {
    switch (origin) {
      case Origin::kSeed:
        return "given";
      case Origin::kAnalogy:
        return "made";
      case Origin::kInduction:
      case Origin::kPredictionFailure:
      case Origin::kGoalSuccess:
        return "learned";
    }
    return "learned";
  }

  void AddLife(json& data, Origin origin, Time created) const {
    data["born"] = created.us;
    data["origin"] = OriginWord(origin);
    data["mark"] = MarkOf(origin);
  }

  json StateCard(const TriadBand& band, const Card& card) const {
    const CompositeStateRecord* record = knowledge_.Find(card.state);
    const ModelId requirement = RequirementOfRow(band, card.row);
    json lines = json::array();
    json brief = json::array();
    const ModelRecord* model = knowledge_.Find(requirement);
    for (const Condition& condition : model ? ConditionsOfRequirement(knowledge_, model->model)
                                            : ConditionsWithPruned(knowledge_, card.state)) {
      lines.push_back({{"cells", {condition.subject, condition.relation, condition.value}},
                       {"text", condition.text},
                       {"vars", condition.variables},
                       {"cut", condition.pruned}});
      if (!condition.brief.empty())
        brief.push_back(
            {{"text", condition.brief}, {"vars", condition.variables}, {"cut", condition.pruned}});
    }
    json data = {{"kind", card.kind == CardKind::kState ? "state" : "again"},
                 {"id", IdText(card.state)},
                 {"subject", requirement.valid() ? IdText(requirement) : context_.SubjectOf(card.state)},
                 {"lines", lines},
                 {"brief", brief},
                 {"room", card.lines}};
    AddLife(data, record->origin, record->created);
    if (model) {
      // A state that was there before its requirement stands in this row since the requirement came.
      AddLife(data, model->origin, model->created);
      if (const auto deleted = context_.DeletedAt(requirement)) data["gone"] = deleted->us;
    }
    return data;
  }

  json ConditionCard(const Card& card) const {
    const ModelRecord* record = knowledge_.Find(card.model);
    const ModelLines lines = LinesOf(knowledge_, record->model);
    const json line = {{"text", lines.lhs}, {"vars", lines.variables}, {"cut", false}};
    json data = {{"kind", "condition"}, {"id", ""},        {"subject", IdText(card.model)},
                 {"lines", {line}},     {"brief", {line}}, {"room", card.lines}};
    AddLife(data, record->origin, record->created);
    if (const auto deleted = context_.DeletedAt(card.model)) data["gone"] = deleted->us;
    return data;
  }

  json RequirementCard(const Card& card) const {
    const ModelRecord* record = knowledge_.Find(card.model);
    json data = {{"kind", "requirement"},
                 {"id", IdText(card.model)},
                 {"subject", IdText(card.model)},
                 {"strong", KindOf(record->model) == ModelKind::kStrongRequirement}};
    AddLife(data, record->origin, record->created);
    if (const auto deleted = context_.DeletedAt(card.model)) data["gone"] = deleted->us;
    return data;
  }

  json ModelCard(const Card& card) const {
    const ModelRecord* record = knowledge_.Find(card.model);
    const ModelLines lines = LinesOf(knowledge_, record->model);
    // When each was decided, and how many were right by then.
    json outcomes = json::array();
    if (const auto found = decided_.find(card.model); found != decided_.end()) {
      std::int64_t right = 0;
      for (const Decided& decided : found->second) {
        right += decided.right ? 1 : 0;
        outcomes.push_back({decided.time.us, right});
      }
    }
    json data = {{"kind", "model"},     {"id", IdText(card.model)}, {"subject", IdText(card.model)},
                 {"lhs", lines.lhs},    {"rhs", lines.rhs},         {"vars", lines.variables},
                 {"outcomes", outcomes}};
    AddLife(data, record->origin, record->created);
    if (const auto deleted = context_.DeletedAt(card.model)) data["gone"] = deleted->us;
    return data;
  }

  json EdgeData(const TriadBand& band, const Edge& edge) const {
    json data = {{"from", edge.from}, {"to", edge.to}};
    switch (edge.kind) {
      case EdgeKind::kRequires:
        data["kind"] = "requires";
        break;
      case EdgeKind::kEnables:
        data["kind"] = "enables";
        break;
      case EdgeKind::kDerived:
        data["kind"] = "derived";
        data["text"] = DerivedText(RequirementOfRow(band, band.cards[edge.to].row));
        break;
    }
    return data;
  }

  std::string DerivedText(ModelId requirement) const {
    const auto found = context_.comparison_of.find(requirement);
    if (found == context_.comparison_of.end()) return "by analogy";
    const auto* compared = context_.run.FindBody<AnalogyCompared>(found->second);
    const std::string object = Printable(ObjectOf(*compared));
    return "by analogy: " + std::to_string(compared->matched + compared->achievable) + " of " +
           std::to_string(compared->total) + " conditions hold" +
           (compared->achievable > 0 ? " or can be met" : "") + (object.empty() ? "" : " for " + object);
  }

  const ReportContext& context_;
  const KnowledgeBase& knowledge_;
  std::map<ModelId, std::vector<Decided>> decided_;  // its predictions, by when they were decided
};

}  // namespace

json GraphData(const ReportContext& context) {
  return GraphAuthor(context).Write();
}

}  // namespace aerascope
