// A loaded episode: ids, causes and effects, frames, and the knowledge at any moment.
#include "engine/query/run.h"

#include <gtest/gtest.h>

#include "engine/event/apply.h"
#include "engine/query/kb_diff.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

Run PaperRun(const PaperEpisodeOptions& options = {}) {
  return Run::FromEvents({{}, PaperEpisode(options), options.last_frame == 15, std::nullopt});
}

TEST(RunTest, IdsAreReadAsTheyAreWritten) {
  for (const char* text : {"#214", "fact_3", "goal_7", "pred_9", "cst_12", "mdl_14", "sim_4"}) {
    const Result<ObjectId> id = ParseObjectId(text);
    ASSERT_TRUE(id) << text;
    EXPECT_EQ(IdText(*id), text);
  }
  EXPECT_EQ(*ParseObjectId("214"), ObjectId{EventId{214}});
}

TEST(RunTest, WhatIsNoIdIsAnErrorThatHelps) {
  for (const char* text :
       {"", "mdl_", "mdl_0", "mdl_-1", "mdl_99999999999999999999", "mdl_1x", "\x1b[31m_3", "#", "_"}) {
    const Result<ObjectId> id = ParseObjectId(text);
    ASSERT_FALSE(id) << text;
    EXPECT_NE(id.error().message.find("expected an id such as mdl_14"), std::string::npos);
    EXPECT_EQ(id.error().message.find('\x1b'), std::string::npos);
  }
  EXPECT_NE(ParseObjectId("mld_14").error().message.find("did you mean mdl_14?"), std::string::npos);
}

TEST(RunTest, AnObjectThatIsNotThereNamesTheOneMeant) {
  const auto run = PaperRun();
  const ModelId model = run.final_knowledge().models().begin()->first;
  const std::string wrong_kind = "cst_" + std::to_string(model.value);
  const std::string message = run.FindObject(wrong_kind).error().message;
  EXPECT_TRUE(message.starts_with("there is no " + wrong_kind + " in this episode; the nearest is cst_"))
      << message;
  EXPECT_TRUE(message.ends_with(", and " + IdText(model) + " has that number")) << message;
  EXPECT_NE(run.FindObject("#100000").error().message.find("the nearest is #" +
                                                           std::to_string(run.events().size())),
            std::string::npos);
  EXPECT_TRUE(run.FindObject(IdText(model)));
}

TEST(RunTest, EveryObjectIsFoundByItsCreation) {
  const auto run = PaperRun();
  for (const auto& [id, record] : run.final_knowledge().models()) EXPECT_EQ(run.CreationOf(id), record.event);
  for (const auto& [id, record] : run.final_knowledge().composite_states())
    EXPECT_EQ(run.CreationOf(id), record.event);
  for (const EventId id : run.OfKind<PredictionMade>()) {
    EXPECT_EQ(run.CreationOf(run.FindBody<PredictionMade>(id)->prediction), id);
  }
  const EventId observed = run.OfKind<FactObserved>().front();
  EXPECT_EQ(*run.FindFact(run.FindBody<FactObserved>(observed)->fact_id),
            run.FindBody<FactObserved>(observed)->fact);
  EXPECT_FALSE(run.CreationOf(ModelId{100000}).valid());
  EXPECT_EQ(run.FindFact(FactId{100000}), nullptr);
}

TEST(RunTest, EffectsAreTheCausesTurnedRound) {
  const auto run = PaperRun();
  std::size_t edges = 0;
  for (const Event& event : run.events()) {
    for (const EventId cause : event.causes) {
      const auto effects = run.Effects(cause);
      EXPECT_EQ(std::count(effects.begin(), effects.end(), event.id), 1);
      ++edges;
    }
    EXPECT_TRUE(std::is_sorted(run.Effects(event.id).begin(), run.Effects(event.id).end()));
    edges -= run.Effects(event.id).size();
  }
  EXPECT_EQ(edges, 0u);
}

TEST(RunTest, FramesCoverTheRun) {
  const auto run = PaperRun();
  ASSERT_EQ(run.frames().size(), 15u);
  EXPECT_EQ(run.end(), Time{15'000'000});
  EXPECT_EQ(*run.FrameAt(Time{0}), 0u);
  EXPECT_EQ(*run.FrameAt(Time{6'999'999}), 6u);
  EXPECT_EQ(*run.FrameAt(Time{7'000'000}), 7u);
  EXPECT_EQ(*run.FrameAt(Time{-5}), 0u);
  EXPECT_EQ(*run.FrameAt(kForever), 14u);
  for (std::size_t i = 1; i < run.frames().size(); ++i) {
    EXPECT_EQ(run.frames()[i].first.value, run.frames()[i - 1].last.value + 1);
  }
  EXPECT_EQ(run.frames().back().last, run.events().back().id);
}

TEST(RunTest, TheKnowledgeAtAnyEventIsTheFoldUpToIt) {
  const auto run = PaperRun();
  KnowledgeBase folded;
  for (const Event& event : run.events()) {
    Apply(event, &folded);
    const KnowledgeBase asked = run.KnowledgeBaseAfter(event.id);
    ASSERT_TRUE(DiffKnowledge(folded, asked).empty());
    ASSERT_EQ(asked.facts().size(), folded.facts().size());
    ASSERT_EQ(asked.goals().size(), folded.goals().size());
    ASSERT_EQ(asked.now(), folded.now());
  }
  EXPECT_TRUE(run.KnowledgeBaseAfter(EventId{}).models().empty());
}

TEST(RunTest, AMomentIncludesAllThatHappenedAtIt) {
  const auto run = PaperRun();
  // Learned at one second sharp: not yet there just before.
  EXPECT_TRUE(run.KnowledgeBaseAt(Time{999'999}).models().empty());
  EXPECT_EQ(run.KnowledgeBaseAt(Time{1'000'000}).models().size(), 2u);
  EXPECT_TRUE(run.KnowledgeBaseAt(Time{-1}).symbols().empty());
  EXPECT_TRUE(DiffKnowledge(run.KnowledgeBaseAt(kForever), run.final_knowledge()).empty());
}

// Longer than the distance of checkpoints, and than all checkpoints together at the first distance.
TEST(RunTest, ALongRunIsRightAtEveryCheckpoint) {
  EpisodeFile file;
  const std::int64_t count = 70'000;
  Model model;
  model.id = {1};
  model.lhs = {true, MakeCommand(Term::Ontology("push"), {}), Term::Wildcard(), Term::Wildcard()};
  model.rhs = {true, MakeValue(Term::Entity("a"), Term::Ontology("b"), Term::Number(1)), Term::Wildcard(),
               Term::Wildcard()};
  for (std::int64_t i = 1; i <= count; ++i) {
    const double n = static_cast<double>(i);
    EventBody body = EvidenceUpdated{model.id, true, {n - 1, n}, {n, n + 1}, false, false};
    if (i == 1) body = ModelCreated{model, {0, 1}, false, Origin::kSeed, {}};
    file.events.push_back({{i}, {i * 10}, i, {}, {}, std::move(body)});
  }
  const auto run = aerascope::Run::FromEvents(std::move(file));
  for (const std::int64_t at :
       {2L, 1023L, 1024L, 1025L, 32'767L, 32'768L, 33'000L, 65'535L, 65'537L, 69'999L, 70'000L}) {
    EXPECT_EQ(run.KnowledgeBaseAfter(EventId{at}).Find(ModelId{1})->evidence.positive,
              static_cast<double>(at));
    EXPECT_EQ(run.KnowledgeBaseAt(Time{at * 10 + 5}).Find(ModelId{1})->evidence.positive,
              static_cast<double>(at));
  }
}

TEST(RunTest, AnEmptyRunAnswersToo) {
  const auto run = aerascope::Run::FromEvents({});
  EXPECT_EQ(run.title(), "Untitled episode");
  EXPECT_FALSE(run.FrameAt(Time{0}));
  EXPECT_EQ(run.ended(), nullptr);
  EXPECT_EQ(run.Find(EventId{1}), nullptr);
  EXPECT_TRUE(run.Effects(EventId{1}).empty());
  EXPECT_TRUE(run.KnowledgeBaseAt(kForever).models().empty());
  EXPECT_FALSE(run.FindObject("#1"));
}

TEST(RunTest, EventsBehindAGapAreLeftOut) {
  std::vector<Event> events = PaperEpisode();
  events.erase(events.begin() + 100);
  const auto run = aerascope::Run::FromEvents({{}, std::move(events), true, std::nullopt});
  EXPECT_EQ(run.events().size(), 100u);
  EXPECT_FALSE(run.complete());
}

TEST(RunTest, AFileThatIsNoEpisodeIsAnError) {
  EXPECT_FALSE(OpenRun("/nonexistent/run.episode"));
}

}  // namespace
}  // namespace aerascope
