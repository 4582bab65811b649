// Snapshots: equal knowledge, equal bytes; a difference names what is missing, new or changed; tests never
// write.
#include "exporters/snapshot/snapshot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/any_event.h"
#include "tests/support/knowledge_edits.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

KnowledgeBase Paper(int last_frame = 15) {
  PaperEpisodeOptions options;
  options.last_frame = last_frame;
  return KnowledgeFrom(PaperEpisode(options));
}

class SnapshotFileTest : public ::testing::Test {
 protected:
  SnapshotFileTest() {
    folder_ = std::filesystem::temp_directory_path() / ("aerascope_snapshot_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~SnapshotFileTest() override { std::filesystem::remove_all(folder_); }

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string Read(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::vector<std::string> Files() const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) files.push_back(entry.path().filename().string());
    }
    return files;
  }

  std::filesystem::path folder_;
};

TEST(SnapshotTest, ReadsAsCanonicalText) {
  EXPECT_EQ(SnapshotText(Paper(2), {true}),
            "aerascope knowledge snapshot, version 1\n"
            "evidence: yes\n"
            "\n"
            "composite state C1 4c82a389455957f3\n"
            "  X hand at P\n"
            "  origin: seed\n"
            "\n"
            "composite state C2 ac20d3c1ac7a4df4\n"
            "  X shape S, at P\n"
            "  origin: seed\n"
            "\n"
            "composite state C3 3034f679a8d90e06\n"
            "  X size S, at P\n"
            "  origin: seed\n"
            "\n"
            "causal model M1 aba3de67a2c37ed9\n"
            "  if move [X V2]\n"
            "  then X at P\n"
            "  forward T5 := T + 1s\n"
            "  forward T6 := T2 + 1s\n"
            "  forward P := V + V2\n"
            "  backward T := T5 - 1s\n"
            "  backward T2 := T6 - 1s\n"
            "  backward V2 := P - V\n"
            "  origin: induction\n"
            "  confidence: 1 (1 of 1)\n"
            "\n"
            "requirement model M2 a5aadb9667f770bd\n"
            "  move the hand\n"
            "  if X hand at P\n"
            "  then move [X V] makes X at P + V\n"
            "  uses: C1 M1\n"
            "  origin: induction\n"
            "  confidence: 1 (1 of 1)\n");
}

TEST(SnapshotTest, NumbersOrderAndNamesPlayNoPart) {
  EXPECT_TRUE(rc::check([] {
    const KnowledgeBase knowledge = Paper(*rc::gen::inRange(1, 16));
    const KnowledgeBase same = Renumbered(knowledge, *rc::gen::arbitrary<std::uint64_t>());
    RC_ASSERT(SnapshotText(knowledge, {true}) == SnapshotText(same, {true}));
  }));
}

TEST(SnapshotTest, AMissingLessonIsNamedAndNothingElse) {
  // Without the analogies of frames 10 to 12; all aliases behind them move.
  const Result<SnapshotComparison> result =
      CompareSnapshots(SnapshotText(Paper(15)), SnapshotText(Paper(9)), "stored");
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->same());
  EXPECT_THAT(result->missing, Contains("requirement model \"grab_type_1 something small\""));
  EXPECT_THAT(result->missing, Contains("composite state \"X size small, at P; Y hand at P; Y holding []\""));
  EXPECT_EQ(result->missing.size(), 4u);
  EXPECT_THAT(result->added, IsEmpty());
  EXPECT_THAT(result->changed, IsEmpty());
  EXPECT_THAT(result->difference, HasSubstr("missing: requirement model \"grab_type_1 something small\"\n"));
}

TEST(SnapshotTest, NewKnowledgeIsNamed) {
  const SnapshotComparison result =
      *CompareSnapshots(SnapshotText(Paper(9)), SnapshotText(Paper(15)), "stored");
  EXPECT_THAT(result.missing, IsEmpty());
  EXPECT_EQ(result.added.size(), 4u);
}

TEST(SnapshotTest, EvidenceCountsOnlyWhereItIsAskedFor) {
  const KnowledgeBase paper = Paper();
  KnowledgeBase changed = paper;
  for (const auto& [id, record] : paper.models()) changed.SetEvidence(id, {1, 3}, false);
  EXPECT_TRUE(CompareSnapshots(SnapshotText(Paper()), SnapshotText(changed), "stored")->same());
  const SnapshotComparison result =
      *CompareSnapshots(SnapshotText(Paper(), {true}), SnapshotText(changed, {true}), "stored");
  EXPECT_EQ(result.changed.size(), 13u);
  EXPECT_THAT(result.difference,
              HasSubstr("-   confidence: 0.875 (1.75 of 2)\n+   confidence: 0.333333333 (1 of 3)\n"));
}

TEST(SnapshotTest, DeletedModelsAreNotKnowledge) {
  KnowledgeBase without = Paper();
  const ModelId last = without.models().rbegin()->first;
  without.SetState(last, ModelState::kDeleted);
  EXPECT_THAT(CompareSnapshots(SnapshotText(Paper()), SnapshotText(without), "stored")->missing,
              ElementsAre("requirement model \"release something small\""));
}

TEST(SnapshotTest, WhatIsNoSnapshotIsAnError) {
  for (const char* text : {"", "hello\n", "aerascope knowledge snapshot, version 2\n",
                           "aerascope knowledge snapshot, version 1\nevidence: maybe\n",
                           "aerascope knowledge snapshot, version 1\nevidence: no\n  lines first\n",
                           "aerascope knowledge snapshot, version 1\nevidence: no\n\nhead\n"}) {
    const Result<SnapshotComparison> result = CompareSnapshots(text, SnapshotText(Paper()), "s.snapshot");
    ASSERT_FALSE(result) << text;
    EXPECT_THAT(result.error().message, HasSubstr("s.snapshot:"));
  }
}

TEST(SnapshotTest, AnyKnowledgeIsItsOwnSnapshot) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    AnyEvents any(seed);
    std::vector<Event> events;
    for (std::int64_t i = 1; i <= 100; ++i) events.push_back(any.AnyEvent(i));
    const std::string text = SnapshotText(KnowledgeFrom(events), {true});
    const Result<SnapshotComparison> result = CompareSnapshots(text, text, "stored");
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(result->same()) << result->difference;
  }
}

TEST_F(SnapshotFileTest, AcceptedKnowledgePasses) {
  ASSERT_TRUE(AcceptSnapshot(Path("a/b/demo.snapshot"), Paper(), {true}));
  const Result<SnapshotComparison> result = TestSnapshot(Path("a/b/demo.snapshot"), Renumbered(Paper(), 7));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->same()) << result->difference;
  EXPECT_THAT(Files(), ElementsAre("demo.snapshot"));
}

TEST_F(SnapshotFileTest, TestingNeverWrites) {
  ASSERT_TRUE(AcceptSnapshot(Path("demo.snapshot"), Paper(9)));
  const std::string before = Read(Path("demo.snapshot"));
  EXPECT_FALSE(TestSnapshot(Path("demo.snapshot"), Paper(15))->same());
  EXPECT_FALSE(TestSnapshot(Path("other.snapshot"), Paper(15)));
  EXPECT_EQ(Read(Path("demo.snapshot")), before);
  EXPECT_THAT(Files(), ElementsAre("demo.snapshot"));
}

TEST_F(SnapshotFileTest, AcceptingAgainReplaces) {
  ASSERT_TRUE(AcceptSnapshot(Path("demo.snapshot"), Paper(9)));
  ASSERT_TRUE(AcceptSnapshot(Path("demo.snapshot"), Paper(15)));
  EXPECT_TRUE(TestSnapshot(Path("demo.snapshot"), Paper(15))->same());
}

TEST_F(SnapshotFileTest, TroubleIsASentenceAndLeavesNothing) {
  EXPECT_THAT(TestSnapshot(Path("none.snapshot"), Paper()).error().message, HasSubstr("none.snapshot"));
  std::filesystem::create_directories(folder_ / "folder.snapshot" / "inside");
  EXPECT_FALSE(AcceptSnapshot(Path("folder.snapshot"), Paper()));
  EXPECT_FALSE(TestSnapshot(Path("folder.snapshot"), Paper()));
  std::ofstream(Path("file")) << "x";
  EXPECT_FALSE(AcceptSnapshot(Path("file/demo.snapshot"), Paper()));
  EXPECT_THAT(Files(), ElementsAre("file"));
}

}  // namespace
}  // namespace aerascope
