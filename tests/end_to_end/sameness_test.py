"""What is made twice from one episode has the same bytes: reports, sheets, every view, differences, in every form."""

import itertools
from concurrent.futures import ThreadPoolExecutor

from questions_test import draws
from support import (CHEAP_FILM, EndToEndTest, call, demo_episode, one_lesson_episode, one_lesson_scripted_episode,
                     scripted_episode, second_demo_episode)

VIEWS = {"graph": [], "analogy": [], "why": ["--of", "mdl_204"], "led-to": ["--of", "#1"], "curves": [], "lanes": [],
         "goals": []}
BEGINNINGS = {"svg": b"<svg", "png": b"\x89PNG\r\n", "html": b"<!doctype html>", "json": b"{", "text": b"",
              "markdown": b"# "}


class Sameness(EndToEndTest):
    def check(self, makers):
        """Each maker writes to the file it is given; called twice it has to write the same."""
        tasks = list(itertools.product(makers, "ab"))
        with ThreadPoolExecutor(2) as threads:
            outcomes = list(threads.map(lambda task: task[0][1](self.folder / f"{task[1]}.{task[0][0]}"), tasks))
        for (maker, _), outcome in zip(tasks, outcomes):
            self.assertIn(outcome.status, (0, 1), outcome)
            self.assertEqual(outcome.status, outcomes[tasks.index((maker, "a"))].status)
        for name, _ in makers:
            with self.subTest(name):
                first, second = ((self.folder / f"{which}.{name}").read_bytes() for which in "ab")
                beginning = BEGINNINGS[name.rsplit(".", 1)[-1]]
                self.assertIn(beginning, first[:100] if name.endswith("svg") else first[:len(beginning)])
                self.assertGreater(len(first), 500)
                self.assertTrue(first == second, "the two differ")

    @staticmethod
    def views(episode, more=()):
        asked = [(f"{what}.{form}", ["--what", what, *of]) for (what, of), form
                 in itertools.product({**VIEWS, **dict(more)}.items(), ("svg", "png"))]
        return [(name, lambda path, wanted=wanted: call("view", episode, *wanted, "--scale", "1", "-o", path))
                for name, wanted in asked]

    @staticmethod
    def differences(left, right):
        return [(f"difference.{style}", lambda path, style=style: call("diff", left, right, "--format", style, "-o", path))
                for style in ("html", "json", "markdown", "text")]

    def test_views_of_the_demo(self):
        self.check(self.views(demo_episode(), {"moment": ["--at", "9s"]} if draws() else {}))

    def test_views_of_a_scripted_run(self):
        self.check(self.views(scripted_episode()))

    def test_differences(self):
        self.check(self.differences(demo_episode(), one_lesson_episode()))

    def test_differences_of_scripted_runs(self):
        self.check(self.differences(scripted_episode(), one_lesson_scripted_episode()))

    def check_reports(self, episodes, *film):
        for name, episode in zip("ab", episodes):
            self.run_program("report", episode, "-o", f"{name}.html", "--png", f"{name}.png", *film)
        for suffix in ("html", "png"):
            first, second = ((self.folder / f"{name}.{suffix}").read_bytes() for name in "ab")
            self.assertTrue(first.startswith(BEGINNINGS[suffix]))
            self.assertTrue(first == second, f"the two {suffix} files differ")

    def test_reports_and_sheets_of_two_runs_of_the_demo(self):
        self.check_reports((demo_episode(), second_demo_episode()), *(CHEAP_FILM if draws() else ["--no-frames"]))

    def test_reports_and_sheets_of_a_scripted_run(self):
        self.check_reports((scripted_episode(), scripted_episode()))
