// Events as text and bytes, and the laws their description must keep.
#include "engine/event/event.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <set>

#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"

namespace aerascope {
namespace {

TEST(EventSchema, KindsHaveNamesAndMeaningsOfTheirOwn) {
  std::set<std::string_view> names;
  ForEachKind([&]<class Body>() {
    EXPECT_TRUE(names.insert(Body::kName).second) << Body::kName;
    EXPECT_TRUE(Body::kMeaning.ends_with(".")) << Body::kName;
  });
  EXPECT_EQ(names.size(), kEventKinds);
}

TEST(EventSchema, FieldsHaveNamesAndMeaningsOfTheirOwn) {
  ForEachKind([&]<class Body>() {
    std::set<std::string_view> names;
    ForEachField<Body>([&](const auto& field) {
      EXPECT_TRUE(names.insert(field.name).second) << Body::kName << "." << field.name;
      EXPECT_FALSE(field.meaning.empty()) << Body::kName << "." << field.name;
    });
  });
}

TEST(EventSchema, KindsAreFoundByName) {
  std::size_t kind = 0;
  ForEachKind([&]<class Body>() {
    EXPECT_EQ(KindOfName(Body::kName), kind);
    EXPECT_EQ(KindName(EventBody(Body())), Body::kName);
    ++kind;
  });
  EXPECT_EQ(KindOfName("Nonsense"), kEventKinds);
  EXPECT_EQ(KindOfName(""), kEventKinds);
}

TEST(Causes, AreMissingOnlyFromWhatStandsForItself) {
  EXPECT_TRUE(MayBeUncaused(EpisodeStarted()));
  EXPECT_TRUE(MayBeUncaused(DriveInjected()));
  EXPECT_TRUE(MayBeUncaused(FactObserved{{1}, {}, FactSource::kSensor}));
  EXPECT_FALSE(MayBeUncaused(FactObserved{{1}, {}, FactSource::kExecuted}));
  EXPECT_FALSE(MayBeUncaused(FactObserved{{1}, {}, FactSource::kAbsence}));
  CommandIssued command;
  command.by = Commander::kTeacher;
  EXPECT_TRUE(MayBeUncaused(command));
  command.by = Commander::kAgent;
  EXPECT_FALSE(MayBeUncaused(command));
  CompositeStateCreated state;
  state.origin = Origin::kSeed;
  EXPECT_TRUE(MayBeUncaused(state));
  state.origin = Origin::kAnalogy;
  EXPECT_FALSE(MayBeUncaused(state));
  EXPECT_FALSE(MayBeUncaused(PredictionMade()));
  EXPECT_FALSE(MayBeUncaused(EvidenceUpdated()));
  EXPECT_FALSE(MayBeUncaused(GoalSet()));
}

TEST(EventText, NamesEveryFieldAndTheCauses) {
  Event event{{214}, {700'000}, 7, {}, {{200}, {12}}, PredictionMade{{31}, {5}, {{6}, {7}}, {}, {}}};
  std::get<PredictionMade>(event.body).target = {true, MakeValue(E("h"), O("position"), N(15)), Ms(800, 900),
                                                 0.75};
  EXPECT_EQ(ToText(event),
            "0.7s #214 PredictionMade prediction=pred_31 model=mdl_5 requirements=[mdl_6, mdl_7] input=- "
            "target=(mk.val h position 15) [0.8s, 0.9s) cfd 0.75 grounds=[] because #200 #12");
}

TEST(EventText, IsOneLineWhateverItHolds) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    const std::string text = ToText(AnyEvents(seed).AnyEvent(5));
    for (const char c : text) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20);
  }));
}

TEST(EventDigest, IsTheSameForTheSameEvents) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    const Event one = AnyEvents(seed).AnyEvent(9);
    const Event same = AnyEvents(seed).AnyEvent(9);
    RC_ASSERT(EncodeForDigest(one) == EncodeForDigest(same));
  }));
}

TEST(EventDigest, TellsAnyTwoDifferentEventsApart) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    AnyEvents any(seed);
    const std::size_t kind = static_cast<std::size_t>(any.Below(kEventKinds));
    const Event one = any.AnyEvent(9, kind);
    const Event other = any.AnyEvent(9, kind);
    RC_ASSERT((EncodeForDigest(one) == EncodeForDigest(other)) == SameContent(one, other));
  }));
}

TEST(EventDigest, SeesEveryCommonField) {
  const Event event{{5}, {7}, 3, {}, {{1}, {2}}, GoalFailed{{4}}};
  std::vector<Event> others(6, event);
  others[0].id = {6};
  others[1].time = {8};
  others[2].frame = 4;
  others[3].simulation = {1};
  others[4].causes = {{12}};
  others[5].body = DriveInjected{};
  for (const Event& other : others) EXPECT_NE(EncodeForDigest(event), EncodeForDigest(other));
}

// A confidence was once rounded to nine digits in the digest.
TEST(EventDigest, SeesTheLastBitOfANumber) {
  Event event{{1}, {}, 0, {}, {}, FactObserved{{1}, {true, N(1), {}, 0.1}, FactSource::kSensor}};
  Event other = event;
  std::get<FactObserved>(other.body).fact.confidence = std::nextafter(0.1, 1);
  EXPECT_NE(EncodeForDigest(event), EncodeForDigest(other));
}

TEST(EventDigest, DependsOnTheOrder) {
  AnyEvents any(3);
  const Event one = any.AnyEvent(1);
  const Event two = any.AnyEvent(2);
  EventDigest forward;
  forward.Add(one);
  forward.Add(two);
  EventDigest backward;
  backward.Add(two);
  backward.Add(one);
  EXPECT_NE(forward.Value(), backward.Value());
}

}  // namespace
}  // namespace aerascope
