"""Many random seeds at once. AERASCOPE_TRIALS=50 tries that many; five are the rule, for the sake of time."""

import os
import re

from support import DEMO, SCRIPTED, EndToEndTest, replaced, scenario_in, without_second_lesson


class Trials(EndToEndTest):
    def test_every_seed_reaches_every_drive(self):
        count = int(os.environ.get("AERASCOPE_TRIALS", "5"))
        table = self.run_program("trials", DEMO, "--seeds", count).out
        rows = re.findall(r"^ +(\d+)  (\d+) of (\d+) +(\d+) +(\d+)  (.+)$", table, flags=re.MULTILINE)
        self.assertEqual([int(row[0]) for row in rows], list(range(1, count + 1)), table)
        for seed, reached, drives, learned, refused, text in rows:
            with self.subTest(seed=seed):
                self.assertEqual((reached, drives), ("5", "5"), text)
                self.assertEqual((learned, refused), ("9", "0"), "9 requirement models, no command refused")
        self.assertRegex(table, rf"(?m)^ *{count} of {count}  all drives$")

    def test_the_first_seed_can_be_chosen(self):
        table = self.run_program("trials", DEMO, "--seeds", "1", "--first-seed", "77").out
        self.assertRegex(table, r"(?m)^ +77  5 of 5 ")

    def test_a_missed_drive_is_named_and_ends_with_status_1(self):
        scenario = scenario_in(self.folder, SCRIPTED, without_second_lesson)
        table = self.run_program("trials", scenario, "--seeds", "1", status=1).out
        self.assertRegex(table, r"hold s1 MISSED, .*hold s2, .*hold cyl MISSED")
        self.assertRegex(table, r"(?m)^ *0 of 1  hold s1$")
        self.assertRegex(table, r"(?m)^ *1 of 1  hold s2$")

    def test_the_scripted_world_reaches_every_drive_too(self):
        self.assertRegex(self.run_program("trials", SCRIPTED, "--seeds", "1").out, r"(?m)^ +1  5 of 5 ")

    def test_a_mistake_in_the_scenario_is_refused(self):
        scenario = scenario_in(self.folder, SCRIPTED, replaced("[[drives]]", "[[drive]]"))
        self.assert_refused("trials", scenario, "--seeds", "1", says=["drive"])
