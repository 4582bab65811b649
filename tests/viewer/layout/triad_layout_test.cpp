#include "viewer/layout/triad_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "engine/event/apply.h"
#include "tests/support/paper_episode.h"
#include "tests/support/slowness.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;

KnowledgeBase PaperKnowledge() {
  KnowledgeBase knowledge;
  for (const Event& event : PaperEpisode()) Apply(event, &knowledge);
  return knowledge;
}

FactPattern Pattern(Term payload) {
  return {true, std::move(payload), Term::Variable(0), Term::Variable(1)};
}

CompositeStateRecord State(std::int64_t id, int components, std::int64_t source = 0) {
  CompositeStateRecord record;
  record.state.id = {id};
  for (int i = 0; i < components; ++i) {
    record.state.components.push_back(Pattern(MakeValue(
        Term::Entity("o" + std::to_string(id)), Term::Ontology("a" + std::to_string(i)), Term::Number(i))));
  }
  record.derived_from = {source};
  return record;
}

ModelRecord Causal(std::int64_t id) {
  ModelRecord record;
  record.model.id = {id};
  record.model.lhs = Pattern(MakeCommand(Term::Ontology("do" + std::to_string(id)), {}));
  record.model.rhs = Pattern(MakeValue(Term::Entity("h"), Term::Ontology("x"), Term::Number(1)));
  return record;
}

ModelRecord Requirement(std::int64_t id, std::int64_t state, std::int64_t target, std::int64_t source = 0) {
  ModelRecord record;
  record.model.id = {id};
  record.model.lhs = Pattern(MakeIcst({state}, {}, {}));
  record.model.rhs = Pattern(MakeImdl({target}, {}, {}));
  record.derived_from = {source};
  return record;
}

// Knowledge of any shape: several states a model, shared states, chains of analogies, requirements on
// requirements, unknown targets, states nothing asks for.
KnowledgeBase RandomKnowledge(unsigned seed, int pieces) {
  std::mt19937 random(seed);
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  KnowledgeBase knowledge;
  std::vector<std::int64_t> states, causal, requirements;
  std::map<std::int64_t, std::int64_t> target_of;
  for (std::int64_t id = 1; id <= pieces; ++id) {
    switch (below(6)) {
      case 0:
        knowledge.AddModel(Causal(id));
        causal.push_back(id);
        break;
      case 1:
      case 2: {
        const std::int64_t source = !states.empty() && below(2) == 0 ? states[below(states.size())] : 0;
        knowledge.AddCompositeState(State(id, 1 + static_cast<int>(below(20)), source));
        states.push_back(id);
        break;
      }
      default: {
        const std::int64_t state = states.empty() ? 900'000 : states[below(states.size())];
        std::int64_t target = causal.empty() || below(20) == 0 ? 800'000 : causal[below(causal.size())];
        std::int64_t source = 0;
        if (!requirements.empty() && below(8) == 0) target = requirements[below(requirements.size())];
        if (!requirements.empty() && below(3) == 0) {
          source = requirements[below(requirements.size())];
          target = target_of[source];
        }
        knowledge.AddModel(Requirement(id, state, target, source));
        target_of[id] = target;
        requirements.push_back(id);
      }
    }
  }
  return knowledge;
}

void ExpectNoOverlaps(const TriadLayout& layout, bool open) {
  for (const TriadBand& band : layout.bands) {
    const BandForm& form = open ? band.open : band.folded;
    ASSERT_EQ(form.cards.size(), band.cards.size());
    ASSERT_EQ(form.edges.size(), band.edges.size());
    for (std::size_t i = 0; i < form.cards.size(); ++i) {
      const Rect& card = form.cards[i];
      EXPECT_GE(card.x, 0);
      EXPECT_GE(card.y, 0);
      EXPECT_LE(card.right(), layout.width);
      EXPECT_LE(card.bottom(), form.height);
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(Overlap(card, form.cards[j])) << i << " and " << j;
      for (const Rect& note : form.notes) EXPECT_FALSE(Overlap(card, note));
    }
  }
}

// What is at the ends of an edge touches the edge.
void ExpectEdgesMeetTheirCards(const TriadBand& band, const BandForm& form) {
  for (std::size_t i = 0; i < band.edges.size(); ++i) {
    const Rect& from = form.cards[band.edges[i].from];
    const Rect& to = form.cards[band.edges[i].to];
    const Point start = form.edges[i].points.front();
    const Point end = form.edges[i].points.back();
    EXPECT_TRUE(start.x == from.x || start.x == from.right());
    EXPECT_TRUE(end.x == to.x || end.x == to.right());
    EXPECT_GE(start.y, from.y);
    EXPECT_LE(start.y, from.bottom());
    EXPECT_GE(end.y, to.y);
    EXPECT_LE(end.y, to.bottom());
  }
}

TEST(TriadLayout, ThePapersKnowledgeHasOneBandACausalModelInOrderOfCreation) {
  const KnowledgeBase knowledge = PaperKnowledge();

  const TriadLayout layout = LayOutTriads(knowledge);

  std::vector<std::string> commands;
  for (const TriadBand& band : layout.bands) {
    if (band.kind == BandKind::kCausalModel) {
      commands.push_back(knowledge.Find(band.model)->model.lhs.payload[0].name());
    }
  }
  EXPECT_THAT(commands, ElementsAre("move", "grab_type_1", "release", "grab_type_2"));
  EXPECT_EQ(layout.bands.back().kind, BandKind::kOtherStates);
  EXPECT_EQ(layout.bands.back().cards.size(), 2u)
      << "S3 and S4 are parts of others; S0 is what move requires";
}

TEST(TriadLayout, WhatWasDerivedStandsDirectlyUnderItsSource) {
  const KnowledgeBase knowledge = PaperKnowledge();

  const TriadLayout layout = LayOutTriads(knowledge);

  int derived = 0;
  for (const TriadBand& band : layout.bands) {
    for (const Edge& edge : band.edges) {
      if (edge.kind != EdgeKind::kDerived) continue;
      ++derived;
      EXPECT_EQ(band.cards[edge.to].row, band.cards[edge.from].row + 1);
      EXPECT_EQ(knowledge.Find(band.cards[edge.to].state)->derived_from, band.cards[edge.from].state);
      EXPECT_EQ(band.folded.cards[edge.to].x, band.folded.cards[edge.from].x);
    }
  }
  EXPECT_EQ(derived, 4);
}

TEST(TriadLayout, OpenCardsHaveRoomForTheirLines) {
  TriadOptions options;
  const KnowledgeBase knowledge = PaperKnowledge();
  const TriadLayout plain = LayOutTriads(knowledge, options);
  const CompositeStateId state = plain.bands[1].cards[1].state;
  options.lines[state] = plain.bands[1].cards[1].lines + 3;

  const TriadLayout roomy = LayOutTriads(knowledge, options);

  EXPECT_EQ(roomy.bands[1].open.cards[1].height, plain.bands[1].open.cards[1].height + 3 * kCardLineHeight);
  EXPECT_EQ(roomy.bands[1].folded.cards[1], plain.bands[1].folded.cards[1]);
}

TEST(TriadLayout, AStateAskedForTwiceHasOneCardAndAReference) {
  KnowledgeBase knowledge;
  knowledge.AddCompositeState(State(1, 2));
  knowledge.AddModel(Causal(2));
  knowledge.AddModel(Causal(3));
  knowledge.AddModel(Requirement(4, 1, 2));
  knowledge.AddModel(Requirement(5, 1, 3));

  const TriadLayout layout = LayOutTriads(knowledge);

  ASSERT_EQ(layout.bands.size(), 2u);
  EXPECT_EQ(layout.bands[0].cards[1].kind, CardKind::kState);
  EXPECT_EQ(layout.bands[1].cards[1].kind, CardKind::kStateAgain);
}

TEST(TriadLayout, ARequirementOnARequirementStandsInTheSameBandAndPointsAtItsRing) {
  KnowledgeBase knowledge;
  knowledge.AddCompositeState(State(1, 2));
  knowledge.AddCompositeState(State(2, 2));
  knowledge.AddModel(Causal(3));
  knowledge.AddModel(Requirement(4, 1, 3));
  knowledge.AddModel(Requirement(5, 2, 4));

  const TriadLayout layout = LayOutTriads(knowledge);

  ASSERT_EQ(layout.bands.size(), 1u);
  const auto on_ring =
      std::find_if(layout.bands[0].edges.begin(), layout.bands[0].edges.end(), [&](const Edge& edge) {
        return edge.kind == EdgeKind::kEnables &&
               layout.bands[0].cards[edge.to].kind == CardKind::kRequirement;
      });
  ASSERT_NE(on_ring, layout.bands[0].edges.end());
  EXPECT_EQ(layout.bands[0].cards[on_ring->to].model, ModelId{4});
}

TEST(TriadLayout, RequirementsInACircleAreStillLaidOut) {
  KnowledgeBase knowledge;
  knowledge.AddCompositeState(State(1, 2));
  knowledge.AddModel(Requirement(2, 1, 3));
  knowledge.AddModel(Requirement(3, 1, 2));

  const TriadLayout layout = LayOutTriads(knowledge);

  ExpectNoOverlaps(layout, false);
  ExpectNoOverlaps(layout, true);
}

TEST(TriadLayout, AnEmptyKnowledgeBaseHasNoBands) {
  EXPECT_TRUE(LayOutTriads(KnowledgeBase{}).bands.empty());
  EXPECT_EQ(StackBands(LayOutTriads(KnowledgeBase{}), {}).height, 0);
}

TEST(TriadLayout, EverythingHasExactlyOneCardWhateverTheKnowledge) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const KnowledgeBase knowledge = RandomKnowledge(seed, 5 + static_cast<int>(seed));

    const TriadLayout layout = LayOutTriads(knowledge);

    std::map<CompositeStateId, int> states;
    std::map<ModelId, int> rings;
    std::map<ModelId, int> models;
    for (const TriadBand& band : layout.bands) {
      for (const Card& card : band.cards) {
        if (card.kind == CardKind::kState) ++states[card.state];
        if (card.kind == CardKind::kRequirement) ++rings[card.model];
        if (card.kind == CardKind::kModel) ++models[card.model];
      }
    }
    for (const auto& [id, record] : knowledge.composite_states()) EXPECT_EQ(states[id], 1);
    for (const auto& [id, record] : knowledge.models()) {
      EXPECT_EQ(IsRequirement(record.model) ? rings[id] : models[id], 1);
    }
    ExpectNoOverlaps(layout, false);
    ExpectNoOverlaps(layout, true);
    for (const TriadBand& band : layout.bands) {
      ExpectEdgesMeetTheirCards(band, band.folded);
      ExpectEdgesMeetTheirCards(band, band.open);
    }
  }
}

TEST(TriadLayout, TheOrderOfAddingDoesNotMatter) {
  KnowledgeBase forward, backward;
  const std::vector<ModelRecord> models = {Causal(1), Causal(2), Requirement(5, 3, 1),
                                           Requirement(6, 4, 1, 5)};
  const std::vector<CompositeStateRecord> states = {State(3, 4), State(4, 3, 3)};
  for (const auto& state : states) forward.AddCompositeState(state);
  for (const auto& model : models) forward.AddModel(model);
  for (auto model = models.rbegin(); model != models.rend(); ++model) backward.AddModel(*model);
  for (auto state = states.rbegin(); state != states.rend(); ++state) backward.AddCompositeState(*state);

  const TriadLayout a = LayOutTriads(forward);
  const TriadLayout b = LayOutTriads(backward);

  ASSERT_EQ(a.bands.size(), b.bands.size());
  for (std::size_t i = 0; i < a.bands.size(); ++i) {
    EXPECT_EQ(a.bands[i].model, b.bands[i].model);
    EXPECT_EQ(a.bands[i].folded.cards, b.bands[i].folded.cards);
    EXPECT_EQ(a.bands[i].open.cards, b.bands[i].open.cards);
  }
}

TEST(TriadLayout, NothingMovesWhenBandsBelowGrow) {
  KnowledgeBase small, large;
  for (KnowledgeBase* knowledge : {&small, &large}) {
    knowledge->AddModel(Causal(1));
    knowledge->AddModel(Causal(2));
    knowledge->AddCompositeState(State(3, 4));
    knowledge->AddModel(Requirement(4, 3, 1));
  }
  large.AddCompositeState(State(5, 4));
  large.AddModel(Requirement(6, 5, 2));

  EXPECT_EQ(LayOutTriads(small).bands[0].open.cards, LayOutTriads(large).bands[0].open.cards);
}

TEST(TriadLayout, OpeningABandMovesOnlyTheBandsBelowIt) {
  const TriadLayout layout = LayOutTriads(PaperKnowledge());
  const StackedBands folded = StackBands(layout, {});

  const StackedBands opened = StackBands(layout, {1});

  const int growth = layout.bands[1].open.height - layout.bands[1].folded.height;
  EXPECT_GT(growth, 0);
  for (std::size_t band = 0; band < layout.bands.size(); ++band) {
    EXPECT_EQ(opened.tops[band], folded.tops[band] + (band > 1 ? growth : 0));
  }
  EXPECT_EQ(opened.height, folded.height + growth);
}

TEST(TriadLayout, PortsOfAModelFollowTheOrderOfTheRows) {
  KnowledgeBase knowledge;
  knowledge.AddModel(Causal(1));
  for (std::int64_t row = 0; row < 30; ++row) {
    knowledge.AddCompositeState(State(2 + 2 * row, 3));
    knowledge.AddModel(Requirement(3 + 2 * row, 2 + 2 * row, 1));
  }

  const TriadLayout layout = LayOutTriads(knowledge);

  int last = -1;
  for (std::size_t i = 0; i < layout.bands[0].edges.size(); ++i) {
    if (layout.bands[0].edges[i].kind != EdgeKind::kEnables) continue;
    const int port = layout.bands[0].folded.edges[i].points.back().y;
    EXPECT_GE(port, last);
    last = port;
  }
}

TEST(TriadLayout, ThousandsOfTriadsTakeNoTime) {
  KnowledgeBase knowledge;
  std::int64_t id = 0;
  for (int model = 0; model < 20; ++model) {
    const std::int64_t causal = ++id;
    knowledge.AddModel(Causal(causal));
    for (int row = 0; row < 250; ++row) {
      const std::int64_t state = ++id;
      knowledge.AddCompositeState(State(state, 4));
      knowledge.AddModel(Requirement(++id, state, causal));
    }
  }

  const auto start = std::chrono::steady_clock::now();
  const TriadLayout layout = LayOutTriads(knowledge);
  const auto took = std::chrono::steady_clock::now() - start;

  EXPECT_EQ(layout.bands.size(), 20u);
  EXPECT_LT(took, std::chrono::seconds(2) * Slowness())
      << "5000 triads; a quadratic layout would take far longer";
}

}  // namespace
}  // namespace aerascope
