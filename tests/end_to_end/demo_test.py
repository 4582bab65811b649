"""The paper's pick and place in MuJoCo: what is learned, what is reached, and that it is the same every time."""

import re
import sqlite3
import xml.etree.ElementTree as xml
from contextlib import closing

from support import (CHEAP_FILM, DEMO, NO_EGL, WRONG_GRASP, EndToEndTest, call, demo_episode, events, recorded,
                     second_demo_episode)

# How far above where it stood a thing must be to count as held in the air, and how near to count as set down.
LIFTED_M = 0.05
SET_DOWN_M = 0.002

# The knowledge the paper expects: for each causal model the requirement models with what each asks for. `by analogy
# with` is the title of its source.
SMALL_CUBE = "C shape cube, at P; C size small, at P"
LARGE_CUBE = "C shape cube, at P; C size large, at P"
WITHOUT_SHAPE = "C shape cube, at P"
EXPECTED_KNOWLEDGE = {
    "move [H D] makes H at P0 + D.": [
        ("move the hand", "learned", "H hand at P", None),
    ],
    "grab_type_1 [H] makes H holding [C].": [
        ("grab_type_1 a small cube", "learned", f"H holding []; H hand at P; {SMALL_CUBE}", None),
        ("grab_type_1 something small", "by analogy with grab_type_1 a small cube",
         "H holding []; H hand at P; C size small, at P", WITHOUT_SHAPE),
    ],
    "grab_type_2 [H] makes H holding [C].": [
        ("grab_type_2 a large cube", "learned", f"H holding []; H hand at P; {LARGE_CUBE}", None),
        ("grab_type_2 something large", "by analogy with grab_type_2 a large cube",
         "H holding []; H hand at P; C size large, at P", WITHOUT_SHAPE),
    ],
    "release [H] makes H holding [].": [
        ("release a large cube", "learned", f"H holding [C]; H hand at P; {LARGE_CUBE}", None),
        ("release a small cube", "learned", f"H holding [C]; H hand at P; {SMALL_CUBE}", None),
        ("release something large", "by analogy with release a large cube",
         "H holding [C]; H hand at P; C size large, at P", WITHOUT_SHAPE),
        ("release something small", "by analogy with release a small cube",
         "H holding [C]; H hand at P; C size small, at P", WITHOUT_SHAPE),
    ],
}
EXPECTED_DRIVES = [
    "To satisfy run_hold_cyl, h holding [cyl] is wanted.",
    "To satisfy run_hold_nothing, h holding [] is wanted.",
    "To satisfy run_hold_s1, h holding [s1] is wanted.",
    "To satisfy run_hold_s2, h holding [s2] is wanted.",
]


def listed_knowledge(text):
    """What `kb` printed: (causal models with their requirement models, drives), in the form of the lists above."""
    titles = dict(re.findall(r"^ *(mdl_\d+)  (.+)$", text, flags=re.MULTILINE))
    causal, drives = [], []
    for block in re.split(r"\n(?= *mdl_\d+  )", "\n" + text):
        found = re.match(r" *mdl_\d+  (?P<title>.+)\n +(?P<kind>\w+) model, (?P<about>.+)"
                         r"(?:\n +if cst_\d+: (?P<needs>.+))?", block)
        if not found:
            continue
        if found["kind"] == "drive":
            drives.append(found["title"])
        elif found["kind"] == "causal":
            causal.append((found["title"], []))
        else:
            analogy = re.search(r"by analogy with (mdl_\d+)", found["about"])
            origin = f"by analogy with {titles[analogy[1]]}" if analogy else "learned"
            needs, _, without = found["needs"].partition("  (without: ")
            causal[-1][1].append((found["title"], origin, needs, without.rstrip(")") or None))
    drives += re.findall(r"^  mdl_\d+  (.+)$", text.partition("Drive models\n")[2], re.MULTILINE)
    return [(title, sorted(requirements)) for title, requirements in causal], sorted(drives)


def heights(episode):
    """[(time_us, {thing: height above the table in metres})] of every recorded state of a MuJoCo world."""
    with closing(sqlite3.connect(f"file:{episode}?mode=ro", uri=True)) as database:
        scene = database.execute("SELECT bytes FROM file WHERE name = 'world/scene.xml'").fetchone()[0]
    position, height_of = 0, {}  # Joints take their places in qpos in the order of the file.
    for body in xml.fromstring(scene).find("worldbody").iter("body"):
        for joint in [*body.findall("joint"), *body.findall("freejoint")]:
            kind = "free" if joint.tag == "freejoint" else joint.get("type", "hinge")
            if kind == "free":
                height_of[body.get("name")] = position + 2
            position += {"free": 7, "ball": 4}.get(kind, 1)
    states = [event["body"] for event in events(episode, "WorldStateRecorded")]
    assert all(len(state["qpos"]) == position for state in states)
    return [(state["at"], {name: state["qpos"][place] for name, place in height_of.items()}) for state in states]


class Knowledge(EndToEndTest):
    def test_kb_lists_exactly_what_the_paper_expects(self):
        text = self.run_program("kb", demo_episode()).out
        causal, drives = listed_knowledge(text)
        self.assertEqual(dict(causal), EXPECTED_KNOWLEDGE, text)
        self.assertEqual(len(causal), len(EXPECTED_KNOWLEDGE), "a causal model is listed twice")
        self.assertEqual(drives, EXPECTED_DRIVES)
        # H at P is a condition of the requirement model of move; the other two given ones stand alone.
        others = text.partition("Other composite states\n")[2].partition("Drive models\n")[0]
        self.assertEqual(re.findall(r"cst_\d+  (.+?)  \(given\)", others), ["C shape X, at P", "C size X, at P"])
        self.assertEqual(len(others.strip().splitlines()), 2, others)

    def test_nothing_is_known_before_the_first_lesson(self):
        causal, drives = listed_knowledge(self.run_program("kb", demo_episode(), "--at", "1s").out)
        self.assertEqual((causal, drives), ([], EXPECTED_DRIVES))

    def test_the_teacher_alone_taught_nothing_by_analogy(self):
        causal, _ = listed_knowledge(self.run_program("kb", demo_episode(), "--at", "7s").out)
        origins = [origin for _, requirements in causal for _, origin, _, _ in requirements]
        self.assertEqual(origins, ["learned"] * 5)

    def test_the_cylinder_needs_nothing_new(self):
        log = events(demo_episode())
        asked = next(event["id"] for event in log
                     if event["kind"] == "DriveInjected" and event["body"]["title"] == "hold cyl")
        made = [event for event in log[asked:] if event["kind"] in ("ModelCreated", "CompositeStateCreated")]
        self.assertEqual(made, [])

    def test_the_first_analogy_starts_at_three_quarters_and_one_success_lifts_it_to_seven_eighths(self):
        log = events(demo_episode())
        first = next(event["body"] for event in log
                     if event["kind"] == "AnalogyCompared" and event["body"]["verdict"] == "accepted")
        self.assertEqual((first["matched"], first["total"], first["psi"], first["confidence"]), (3, 4, 0.75, 0.75))
        self.assertAlmostEqual(first["jaccard"], 3 / 5)
        missed = [part["pattern"] for part in first["components"] if part["status"] != "matched"]
        self.assertEqual(len(missed), 1)
        self.assertIn("cube", missed[0])

        model = first["result_requirement"]
        steps = [event["body"] for event in log
                 if event["kind"] == "EvidenceUpdated" and event["body"]["model"] == model]
        self.assertEqual(steps[0]["before"], {"positive": 0.75, "total": 1.0})
        self.assertEqual(steps[0]["after"], {"positive": 1.75, "total": 2.0})  # 0.875
        self.assertTrue(steps[0]["success"])

    def test_every_rejected_comparison_is_logged_with_its_reason(self):
        compared = [event["body"] for event in events(demo_episode(), "AnalogyCompared")]
        accepted = [body for body in compared if body["verdict"] == "accepted"]
        self.assertEqual(len(accepted), 4)
        self.assertGreater(len(compared), len(accepted))
        for body in compared:
            self.assertEqual(len(body["components"]), body["total"])
            self.assertAlmostEqual(body["psi"], body["matched"] / body["total"])
            self.assertEqual(body["verdict"] == "accepted", body["result_requirement"] is not None)


class Outcomes(EndToEndTest):
    DRIVES = ["hold s1", "hold nothing", "hold s2", "hold nothing", "hold cyl"]

    def test_all_five_drives_are_reached(self):
        log = events(demo_episode())
        drives = [event["body"] for event in log if event["kind"] == "DriveInjected"]
        achieved = {event["body"]["goal"] for event in log if event["kind"] == "GoalAchieved"}
        self.assertEqual([drive["title"] for drive in drives], self.DRIVES)
        self.assertEqual([drive["title"] for drive in drives if drive["goal"] in achieved], self.DRIVES)
        self.assertEqual((log[-1]["kind"], log[-1]["body"]["drives_reached"], log[-1]["body"]["drives"]),
                         ("EpisodeEnded", 5, 5))

    def test_what_is_held_is_in_the_air_and_what_is_released_stands_again(self):
        states = heights(demo_episode())
        rest = states[0][1]
        self.assertEqual(sorted(rest), ["c1", "c2", "cyl", "s1", "s2"])
        log = events(demo_episode())
        goals = {event["body"]["goal"]: event["body"]["title"] for event in log if event["kind"] == "DriveInjected"}
        reached = [(event["time_us"], goals[event["body"]["goal"]]) for event in log
                   if event["kind"] == "GoalAchieved" and event["body"]["goal"] in goals]
        self.assertEqual([title for _, title in reached], self.DRIVES)
        for time, title in reached:
            now = [state for at, state in states if at <= time][-1]
            for thing in rest:
                with self.subTest(reached=title, thing=thing, time_us=time):
                    if title == f"hold {thing}":
                        self.assertGreater(now[thing], rest[thing] + LIFTED_M)
                    else:
                        self.assertAlmostEqual(now[thing], rest[thing], delta=SET_DOWN_M)

    def test_all_predictions_come_true(self):
        kinds = [event["kind"] for event in events(demo_episode())]
        self.assertEqual(kinds.count("PredictionFailed"), 0)
        self.assertEqual(kinds.count("CommandRefused"), 0)
        self.assertGreater(kinds.count("PredictionSucceeded"), 5)

    def test_physics_refuses_the_wrong_grasp_on_each_thing(self):
        episode = recorded(WRONG_GRASP, "wrong_grasp")
        log = events(episode)
        grabs = [event["body"]["command"] for event in log
                 if event["kind"] == "CommandIssued" and "grab" in event["body"]["command"]]
        self.assertEqual(len(grabs), 5)
        held = [event["body"]["fact"]["payload"] for event in log
                if event["kind"] == "FactObserved" and " holding " in event["body"]["fact"]["payload"]]
        self.assertGreater(len(held), 10)
        self.assertEqual(set(held), {"(mk.val @h holding [])"})
        states = heights(episode)
        for thing, rest in states[0][1].items():
            self.assertLess(max(state[thing] for _, state in states), rest + LIFTED_M / 2, thing)


class Sameness(EndToEndTest):
    def test_verify_passes(self):
        lines = self.run_program("verify", demo_episode()).out.splitlines()
        self.assertEqual([line[:4] for line in lines], ["ok  "] * 4)
        self.assertIn("replaying", lines[-1])

    def test_verify_notices_a_changed_event(self):
        changed = self.folder / "changed.episode"
        changed.write_bytes(demo_episode().read_bytes())
        with closing(sqlite3.connect(changed)) as database, database:
            database.execute('UPDATE "EvidenceUpdated" SET after_positive = after_positive + 1 WHERE seq = '
                             '(SELECT max(seq) FROM "EvidenceUpdated")')
        self.assertIn("FAIL", self.run_program("verify", changed, status=1).out)

    def test_two_runs_have_the_same_digest_and_the_same_bytes(self):
        first, second = demo_episode(), second_demo_episode()
        digests = [re.search(r"digest of the events (\w{32}), as stored", self.run_program("verify", path).out)[1]
                   for path in (first, second)]
        self.assertEqual(*digests)
        self.assertTrue(first.read_bytes() == second.read_bytes(), "the episode files differ")

    def test_another_seed_has_another_digest(self):
        other = self.folder / "run.episode"
        self.run_program("run", DEMO, "-o", other, "--seed", "2")
        self.assertFalse(other.read_bytes() == demo_episode().read_bytes())


class DemoCommand(EndToEndTest):
    def test_demo_says_where_its_three_files_are(self):
        # Without EGL, so that this test does not spend its time drawing.
        outcome = self.run_program("demo", "--out", "made/here", env=NO_EGL)
        named = dict(re.findall(r"^(episode|report|sheet) +(\S+)$", outcome.out, flags=re.MULTILINE))
        self.assertEqual(sorted(named), ["episode", "report", "sheet"], outcome)
        self.assertIn("5 of 5", outcome.out)
        self.assertEqual(sorted(self.content()), sorted(["made", "made/here", *named.values()]))
        self.assertTrue((self.folder / named["sheet"]).read_bytes().startswith(b"\x89PNG\r\n"))
        self.assertTrue((self.folder / named["episode"]).read_bytes() == demo_episode().read_bytes())

