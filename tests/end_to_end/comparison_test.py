"""What one agent knows and another does not: diff, export and snapshot."""

import json
import re
import shutil
import subprocess

from support import (DEMO, SCENARIOS, SCRIPTED, EndToEndTest, call, demo_episode, one_lesson_episode,
                     one_lesson_scripted_episode, python_with, recorded, replaced, scenario_in, scripted_episode)

# What nobody learns who was not shown the wide grab on the large cube.
MISSING_MODELS = {
    ("causal_model", "grab_type_2 [X] makes X holding [Y]"),
    ("requirement_model", "grab_type_2 a large cube"),
    ("requirement_model", "grab_type_2 something large"),
    ("requirement_model", "release a large cube"),
    ("requirement_model", "release something large"),
}

# Reads a GraphML file and prints the graph in the form of `graph_of_json`.
READ_GRAPHML = """
import json, sys, networkx
graph = networkx.read_graphml(sys.argv[1])
print(json.dumps([graph.is_directed(), dict(graph.nodes(data=True)),
                  [[a, b, attributes] for a, b, attributes in graph.edges(data=True)]]))
"""


class Diff(EndToEndTest):
    def test_two_seeds_know_the_same(self):
        other = recorded(DEMO, "seed_9", "--seed", "9")
        outcome = self.run_program("diff", demo_episode(), other, status=0)
        self.assertRegex(outcome.out, r"\ANo difference: all 19 pieces of .* are the same\.\n\nThe seed is 1 in .* and 9 in .*\n")
        difference = json.loads(self.run_program("diff", demo_episode(), other, "--format", "json").out)
        self.assertEqual(difference["items"], [])
        self.assertEqual(len(difference["same_items"]), 19)
        self.assertEqual(difference["runs"]["settings"][0], {"name": "seed", "left": "1", "right": "9"})
        self.assertEqual({drive["left"].split(" at ")[0] for drive in difference["runs"]["drives"]}, {"reached"})

    def check_one_lesson(self, whole, less):
        """The difference to a run without the second lesson, in all formats."""
        difference = json.loads(self.run_program("diff", whole, less, "--format", "json", status=1).out)
        self.assertEqual((difference["added"], difference["removed"]), (0, len(MISSING_MODELS)))
        removed = [item for item in difference["items"] if item["change"] == "removed"]
        self.assertEqual({(item["kind"], item["title"]) for item in removed}, MISSING_MODELS)
        # Each with its composite state, condition by condition.
        for item in removed:
            self.assertEqual(bool(item["left"]["composite_state"]), item["kind"] == "requirement_model")
            self.assertTrue(any(part["part"] == "condition" for part in item["parts"]) or
                            item["kind"] == "causal_model")
        self.assertIn("scenario.toml", [file["name"] for file in difference["runs"]["files"]])
        self.assertRegex(difference["runs"]["parting"]["left"]["sentence"], "^The teacher commands move")
        self.assertEqual(len({item["content"] for item in removed}), len(removed))
        for item in removed:
            self.assertIsNone(item["right"])
            self.assertTrue(item["left"]["lines"])
        for item in difference["items"]:
            if item["change"] == "changed":
                self.assertNotEqual(item["left"]["evidence"], item["right"]["evidence"])

        for style in ("text", "markdown"):
            text = self.run_program("diff", whole, less, "--format", style, status=1).out
            plain = text.replace("\\", "")  # Markdown puts a backslash before what it would take for a mark.
            for _, title in MISSING_MODELS:
                self.assertIn(title, plain)
        headings = re.findall(r"(?m)^## (\w+): ", text)
        self.assertEqual(headings.count("removed"), difference["removed"])
        self.assertEqual(len(headings), len(difference["items"]))

    def test_without_the_second_lesson_what_is_missing_is_listed(self):
        self.check_one_lesson(demo_episode(), one_lesson_episode())

    def test_without_the_second_lesson_in_the_scripted_world(self):
        self.check_one_lesson(scripted_episode(), one_lesson_scripted_episode())

    def test_the_other_way_round_what_is_missing_was_added(self):
        there = json.loads(self.run_program("diff", scripted_episode(), one_lesson_scripted_episode(), "--format",
                                            "json", status=1).out)
        back = json.loads(self.run_program("diff", one_lesson_scripted_episode(), scripted_episode(), "--format",
                                           "json", status=1).out)
        self.assertEqual((back["added"], back["removed"], back["same"]),
                         (there["removed"], there["added"], there["same"]))

    def test_an_earlier_moment_of_the_same_run(self):
        difference = json.loads(self.run_program("diff", f"{demo_episode()}@7s", demo_episode(), "--format", "json",
                                                 status=1).out)
        added = [item for item in difference["items"] if item["change"] == "added"]
        self.assertEqual({item["right"]["origin"] for item in added}, {"analogy"})
        self.assertEqual(sum(item["kind"] == "requirement_model" for item in added), 4)
        self.assertEqual(difference["removed"], 0)

    def test_what_was_given_up_is_counted_apart_and_a_veto_says_not(self):
        episode = recorded(SCENARIOS / "hand_grab_sphere_learn.toml", "vetoes")
        sides = (f"{episode}@1s", episode)
        difference = json.loads(self.run_program("diff", *sides, "--format", "json", status=1).out)
        self.assertEqual((difference["added"], difference["given_up"]), (7, {"left": 0, "right": 6}))
        added = [item for item in difference["items"] if item["change"] == "added"]
        self.assertEqual(sum(item["right"]["state"] == "deleted" for item in added), 6)
        for style in ("text", "markdown"):
            text = self.run_program("diff", *sides, "--format", style, status=1).out.replace("\\", "")
            self.assertRegex(text, r"0 only in .*, 1 only in .* and 6 more that it gave up, ")
            self.assertEqual(text.count(", given up."), 6)
            self.assertEqual(text.count("not H holding []"), 7)

    def test_the_difference_can_go_to_a_file(self):
        outcome = self.run_program("diff", scripted_episode(), one_lesson_scripted_episode(), "-o", "d.txt", status=1)
        self.assertEqual(outcome.out, "")
        printed = self.run_program("diff", scripted_episode(), one_lesson_scripted_episode(), status=1).out
        self.assertEqual((self.folder / "d.txt").read_text(), printed)


def graph_of_json(graph):
    """Nodes and edges of the JSON export as GraphML is to hold them."""
    nodes = {}
    for node in graph["nodes"]:
        flat = dict(node)
        flat["label"] = flat.pop("title")
        flat["definition"] = "\n".join(flat.pop("lines"))
        evidence = flat.pop("evidence", None)
        if evidence:
            flat["evidence_positive"], flat["evidence_total"] = evidence["positive"], evidence["total"]
        nodes[flat.pop("id")] = flat
    edges = sorted((edge["from"], edge["to"], edge["kind"]) for edge in graph["edges"])
    return nodes, edges


class Export(EndToEndTest):
    def export(self, style, *more, episode=None):
        return self.run_program("export", episode or demo_episode(), "--format", style, *more).out

    def graph(self):
        return json.loads(self.export("json"))

    def test_json_has_every_piece_of_knowledge_once_and_no_loose_ends(self):
        graph = self.graph()
        kinds = [node["kind"] for node in graph["nodes"]]
        self.assertEqual({kind: kinds.count(kind) for kind in set(kinds)},
                         {"composite_state": 11, "causal_model": 4, "requirement_model": 9, "drive_model": 4})
        self.assertEqual(len({node["content"] for node in graph["nodes"]}), len(kinds))
        ids = {node["id"] for node in graph["nodes"]}
        self.assertEqual(len(ids), len(kinds))
        self.assertTrue(all({edge["from"], edge["to"]} <= ids for edge in graph["edges"]))
        # Every requirement model stands between the state it asks for and the causal model it enables.
        for node in graph["nodes"]:
            if node["kind"] == "requirement_model":
                with self.subTest(model=node["title"]):
                    self.assertEqual([edge["kind"] for edge in graph["edges"]
                                      if edge["to"] == node["id"] and edge["kind"] == "requires"], ["requires"])
                    self.assertEqual([edge["kind"] for edge in graph["edges"]
                                      if edge["from"] == node["id"] and edge["kind"] == "enables"], ["enables"])

    def test_dot_is_read_by_graphviz(self):
        dot = shutil.which("dot")
        if not dot:
            self.skipTest("Graphviz is not installed")
        done = subprocess.run([dot, "-Tcanon"], input=self.export("dot"), capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        graph = self.graph()
        for node in graph["nodes"]:
            self.assertRegex(done.stdout, rf'(?m)^\t{node["id"]}\t')
        self.assertEqual(done.stdout.count(" -> "), len(graph["edges"]))

    def test_graphml_read_by_networkx_is_the_graph_of_the_json(self):
        python = python_with("networkx")
        if not python:
            self.skipTest("networkx is not installed")
        self.export("graphml", "-o", "graph.graphml")
        done = subprocess.run([python, "-c", READ_GRAPHML, self.folder / "graph.graphml"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        directed, nodes, edges = json.loads(done.stdout)
        expected_nodes, expected_edges = graph_of_json(self.graph())
        self.assertTrue(directed)
        self.assertEqual(nodes, expected_nodes)
        self.assertEqual(sorted((a, b, attributes["kind"]) for a, b, attributes in edges), expected_edges)

    def test_an_earlier_moment_has_less(self):
        early = json.loads(self.export("json", "--at", "4s"))
        titles = [node["title"] for node in early["nodes"] if node["kind"] == "requirement_model"]
        self.assertEqual(sorted(titles), ["grab_type_1 a small cube", "move the hand", "release a small cube"])

    def test_an_exported_knowledge_base_can_be_the_seed_of_a_run(self):
        # An agent that is born with what another learned knows the same at its start and needs no teacher.
        for name, scenario, episode in (("scripted", SCRIPTED, scripted_episode()), ("demo", DEMO, demo_episode())):
            with self.subTest(scenario=name):
                seed = f"{name}.replicode"
                self.export("replicode", "-o", seed, episode=episode)

                def born_knowing(text, seed=seed):
                    text = re.sub(r'(?m)^replicode = ".*"', f'replicode = "{seed}"', text)
                    return re.sub(r'(?m)^model = "drive_hold_(\w+)"', self.drive_label(episode), text)

                born = scenario_in(self.folder, scenario, born_knowing, name)
                self.run_program("run", born, "-o", f"{name}.episode")
                # Evidence may be told with fewer digits, what is known may not differ.
                compared = call("diff", episode, f"{self.folder / name}.episode@0s", "--format", "json")
                self.assertIn(compared.status, (0, 1), compared)
                difference = json.loads(compared.out)
                self.assertEqual((difference["added"], difference["removed"]), (0, 0), difference["items"])

    def drive_label(self, episode):
        """How the exported seed calls each drive model: by its number."""
        graph = json.loads(self.export("json", episode=episode))
        drives = {re.search(r"run_hold_(\w+)", " ".join(node["lines"]))[1]: node["id"]
                  for node in graph["nodes"] if node["kind"] == "drive_model"}
        return lambda match: f'model = "{drives[match[1]]}"'

    def test_exports_have_the_same_bytes_every_time(self):
        for style in ("dot", "graphml", "json", "replicode"):
            with self.subTest(format=style):
                self.assertEqual(self.export(style), self.export(style))


class Snapshot(EndToEndTest):
    def accepted(self, episode, *more):
        self.run_program("snapshot", "accept", episode, "k.snapshot", *more)
        return (self.folder / "k.snapshot").read_text()

    def test_it_holds_on_a_run_with_another_seed(self):
        text = self.accepted(demo_episode())
        self.assertNotRegex(text, r"mdl_\d|cst_\d", "numbers of one run have no place in a snapshot")
        other = self.folder / "other.episode"
        self.run_program("run", DEMO, "-o", other, "--seed", "4")
        self.assertIn("holds", self.run_program("snapshot", "test", other, "k.snapshot").out)
        self.assertEqual((self.folder / "k.snapshot").read_text(), text)

    def test_it_names_the_model_that_is_missing_when_a_lesson_is_removed(self):
        for whole, less in ((demo_episode(), one_lesson_episode()),
                            (scripted_episode(), one_lesson_scripted_episode())):
            with self.subTest(whole=whole):
                self.accepted(whole)
                said = self.run_program("snapshot", "test", less, "k.snapshot", status=1).out
                self.assertIn('missing: requirement model "grab_type_2 a large cube"', said)
                self.assertIn('missing: requirement model "release something large"', said)
                self.assertEqual(len(re.findall("(?m)^missing: (?:causal|requirement) model ", said)),
                                 len(MISSING_MODELS))
                self.assertNotRegex(said, "(?m)^(?:new|added|unexpected): ")

    def test_it_fails_on_knowledge_that_was_not_expected(self):
        self.accepted(one_lesson_scripted_episode())
        said = self.run_program("snapshot", "test", scripted_episode(), "k.snapshot", status=1).out
        self.assertIn("grab_type_2 a large cube", said)
        self.assertNotIn("missing:", said)

    def test_with_evidence_counts_are_part_of_the_expectation(self):
        # One drive less: the same knowledge, less evidence.
        shorter = scenario_in(self.folder, SCRIPTED,
                              replaced('[[drives]]\ntitle = "hold cyl"\nmodel = "drive_hold_cyl"\n', ""))
        episode = self.folder / "shorter.episode"
        self.run_program("run", shorter, "-o", episode)
        self.accepted(scripted_episode())
        self.run_program("snapshot", "test", episode, "k.snapshot", status=0)
        self.accepted(scripted_episode(), "--evidence")
        self.run_program("snapshot", "test", scripted_episode(), "k.snapshot", status=0)
        self.run_program("snapshot", "test", episode, "k.snapshot", status=1)

    def test_nothing_is_accepted_in_continuous_integration(self):
        self.assert_refused("snapshot", "accept", scripted_episode(), "k.snapshot", env={"CI": "true"}, says=["CI"])
        self.accepted(one_lesson_scripted_episode())
        self.assert_refused("snapshot", "accept", scripted_episode(), "k.snapshot", env={"CI": "true"}, says=["CI"])

    def test_testing_works_in_continuous_integration(self):
        self.accepted(scripted_episode())
        self.run_program("snapshot", "test", scripted_episode(), "k.snapshot", env={"CI": "true"})

    def test_a_file_that_is_no_snapshot_is_not_overwritten(self):
        # `snapshot accept` took the place of whatever stood there.
        (self.folder / "thesis.txt").write_text("years of work")
        self.assert_refused("snapshot", "accept", scripted_episode(), "thesis.txt",
                            says=["thesis.txt", "another kind of file"])
        self.assertEqual((self.folder / "thesis.txt").read_text(), "years of work")
        (self.folder / "k.snapshot").touch()
        self.accepted(scripted_episode())
        self.accepted(one_lesson_scripted_episode())

    def test_a_missing_or_damaged_snapshot_is_trouble(self):
        self.assert_refused("snapshot", "test", scripted_episode(), "none.snapshot", says=["none.snapshot", "accept"])
        (self.folder / "k.snapshot").write_bytes(bytes(range(256)))
        self.assert_refused("snapshot", "test", scripted_episode(), "k.snapshot", says=["k.snapshot"])
