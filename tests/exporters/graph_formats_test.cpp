// The model graph in formats of other programs, read back by those programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/base/text.h"
#include "engine/replicode/reader.h"
#include "exporters/dot/dot.h"
#include "exporters/escape/escape.h"
#include "exporters/graphml/graphml.h"
#include "exporters/json/json.h"
#include "exporters/replicode/replicode.h"
#include "tests/support/any_event.h"
#include "tests/support/knowledge_edits.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;

ModelGraph PaperGraph() {
  return MakeModelGraph(KnowledgeFrom(PaperEpisode()));
}

// A graph whose every text is an attempt to break out of its place.
ModelGraph HostileGraph() {
  ModelGraph graph = PaperGraph();
  const std::vector<std::string> texts = {"\"];evil [label=\"",
                                          "a\\",
                                          "</data><node id=\"x\"/>",
                                          "]]>",
                                          "&amp;",
                                          std::string("nul\0x", 5),
                                          "\x01\x1f",
                                          "\xff\xfe",
                                          "\xef\xbf\xbf",
                                          "line\nbreak",
                                          "\xe2\x80\xae"
                                          "rtl",
                                          "<!--",
                                          "'"};
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    graph.nodes[i].title = texts[i % texts.size()];
    graph.nodes[i].lines = {texts[(i + 1) % texts.size()], texts[(i + 2) % texts.size()]};
  }
  return graph;
}

class Folder {
 public:
  Folder() {
    path_ = std::filesystem::temp_directory_path() / ("aerascope_formats_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

bool Runs(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

template <class Write>
std::string TextOf(Write&& write) {
  std::ostringstream out;
  EXPECT_TRUE(write(out));
  return out.str();
}

TEST(DotTest, GraphvizReadsIt) {
  if (!Runs("dot -V")) GTEST_SKIP() << "dot is not installed (package graphviz)";
  const Folder folder;
  for (const ModelGraph& graph : {PaperGraph(), HostileGraph(), ModelGraph{}}) {
    const std::string path =
        folder.Write("graph.dot", TextOf([&](auto& out) { return WriteDot(graph, out); }));
    EXPECT_TRUE(Runs("dot -Tcanon " + path));
    const std::string nodes =
        "test $(dot -Tplain " + path + " | grep -c ^node) -eq " + std::to_string(graph.nodes.size());
    EXPECT_TRUE(graph.nodes.empty() || Runs(nodes));
  }
}

TEST(DotTest, NamesAreQuoted) {
  EXPECT_EQ(DotQuoted("a\"b\\"), "\"a\\\"b\\\\\"");
  EXPECT_EQ(DotQuoted("a\nb"), "\"a\\lb\"");
  EXPECT_EQ(DotQuoted(std::string("\0", 1)), "\"\\\\x00\"");
}

TEST(GraphmlTest, NetworkxReadsTheSameGraph) {
  if (!Runs("python3 -c 'import networkx'"))
    GTEST_SKIP() << "networkx is not installed (package python3-networkx)";
  const Folder folder;
  const std::string reader = folder.Write("compare.py", R"(
import json, sys, networkx
graph = networkx.read_graphml(sys.argv[1])
expected = json.load(open(sys.argv[2]))
assert set(graph.nodes) == {n["id"] for n in expected["nodes"]}
for node in expected["nodes"]:
    data = graph.nodes[node["id"]]
    assert data["kind"] == node["kind"], data
    assert data["label"] == node["label"], (data["label"], node["label"])
    assert data["definition"] == node["definition"], data
    assert data["created_us"] == node["created_us"]
    assert data["content"] == node["content"]
    assert data["origin"] == node["origin"]
    assert ("confidence" in data) == ("confidence" in node)
    if "confidence" in node:
        assert data["confidence"] == node["confidence"]
        assert data["evidence_positive"] == node["evidence"]["positive"]
        assert data["strong"] is node["strong"]
        assert data["state"] == node["state"]
edges = sorted((a, b, d["kind"]) for a, b, d in graph.edges(data=True))
assert edges == sorted((e["from"], e["to"], e["kind"]) for e in expected["edges"])
)");
  for (const ModelGraph& graph : {PaperGraph(), HostileGraph()}) {
    // What is expected is written by the JSON exporter; texts as GraphML shows them, that is printable.
    nlohmann::json expected =
        nlohmann::json::parse(TextOf([&](auto& out) { return WriteModelGraphJson(graph, out); }));
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      std::string label;
      std::string definition;
      const auto visible = [](const std::string& text) {
        std::string lines;
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);)
          lines += (lines.empty() ? "" : "\n") + Printable(line);
        const std::size_t bad = lines.find("\xef\xbf\xbf");
        if (bad != std::string::npos) lines.replace(bad, 3, "\\u{ffff}");
        return lines;
      };
      expected["nodes"][i]["label"] = visible(graph.nodes[i].title);
      expected["nodes"][i]["definition"] = visible(Join(graph.nodes[i].lines, "\n"));
    }
    const std::string graphml =
        folder.Write("graph.graphml", TextOf([&](auto& out) { return WriteGraphml(graph, out); }));
    const std::string json = folder.Write("graph.json", expected.dump());
    EXPECT_EQ(std::system(("python3 " + reader + " " + graphml + " " + json).c_str()), 0);
  }
}

TEST(GraphmlTest, NamesItsSchemaAndTypes) {
  const std::string text = TextOf([&](auto& out) { return WriteGraphml(PaperGraph(), out); });
  EXPECT_THAT(text, HasSubstr("xmlns=\"http://graphml.graphdrawing.org/xmlns\""));
  EXPECT_THAT(text, HasSubstr("xsi:schemaLocation="));
  EXPECT_THAT(
      text,
      HasSubstr("<key id=\"node_confidence\" for=\"node\" attr.name=\"confidence\" attr.type=\"double\"/>"));
}

TEST(ModelGraphJsonTest, IsStableAndComplete) {
  const ModelGraph graph = PaperGraph();
  const std::string text = TextOf([&](auto& out) { return WriteModelGraphJson(graph, out); });
  EXPECT_EQ(text, TextOf([&](auto& out) { return WriteModelGraphJson(PaperGraph(), out); }));
  const nlohmann::json json = nlohmann::json::parse(text);
  EXPECT_EQ(json["nodes"].size(), graph.nodes.size());
  EXPECT_EQ(json["edges"].size(), graph.edges.size());
  EXPECT_EQ(json["groups"].size(), 4u);
  EXPECT_EQ(json["groups"][1]["triads"][1]["generation"], 1);
  EXPECT_TRUE(
      nlohmann::json::accept(TextOf([&](auto& out) { return WriteModelGraphJson(HostileGraph(), out); })));
}

TEST(GraphFormatsTest, AnyKnowledgeIsWritten) {
  const Folder folder;
  const bool has_dot = Runs("dot -V");
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    AnyEvents any(seed);
    std::vector<Event> events;
    for (std::int64_t i = 1; i <= 100; ++i) events.push_back(any.AnyEvent(i));
    const ModelGraph graph = MakeModelGraph(KnowledgeFrom(events), DeletedModels::kInclude);
    EXPECT_TRUE(nlohmann::json::accept(TextOf([&](auto& out) { return WriteModelGraphJson(graph, out); })));
    const std::string dot = folder.Write("any.dot", TextOf([&](auto& out) { return WriteDot(graph, out); }));
    if (has_dot) {
      EXPECT_TRUE(Runs("dot -Tcanon " + dot)) << seed;
    }
    TextOf([&](auto& out) { return WriteGraphml(graph, out); });
  }
}

TEST(ReplicodeExportTest, ReadsBackToTheSameModels) {
  const KnowledgeBase knowledge = KnowledgeFrom(PaperEpisode());
  const std::string text = TextOf([&](auto& out) { return WriteKnowledgeAsReplicode(knowledge, out); });
  ReplicodeOptions options;
  options.sampling_period = Seconds(1);
  const Result<SeedKnowledge> seed = ReadReplicode(text, "export", options);
  ASSERT_TRUE(seed) << seed.error().message;
  // The seed's composite states and models are in one numbering, each before what refers to it.
  std::map<std::int64_t, std::function<void(KnowledgeBase*)>> steps;
  for (const SeedCompositeState& s : seed->composite_states) {
    steps[s.state.id.value] = [&s](KnowledgeBase* kb) {
      kb->AddCompositeState({s.state, Origin::kSeed, {}, {}, {}, {}});
    };
  }
  for (const SeedModel& m : seed->models) {
    steps[m.model.id.value] = [&m](KnowledgeBase* kb) {
      kb->AddModel({m.model, Origin::kSeed, {}, {}, {}, m.evidence, m.strong, ModelState::kActive, {}});
    };
  }
  KnowledgeBase read;
  for (const auto& [number, add] : steps) add(&read);
  EXPECT_EQ(read.models().size(), knowledge.models().size());
  EXPECT_EQ(read.composite_states().size(), knowledge.composite_states().size());
  for (const auto& [id, record] : knowledge.models()) {
    EXPECT_TRUE(read.FindModel(record.canonical.hash).valid()) << ToText(record.model);
  }
}

}  // namespace
}  // namespace aerascope
