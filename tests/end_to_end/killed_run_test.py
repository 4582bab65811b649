"""Runs are killed with SIGKILL at random moments: each file opens, is a gapless beginning and says that it is cut
short."""

import json
import os
import random
import shutil
import signal
import sqlite3
import time
from contextlib import closing

from support import DEMO, PATIENCE_S, SCRIPTED, EndToEndTest, call, packed_data, recorded, scenario_in, start

# The same moments each time, as far as a machine allows; AERASCOPE_KILLS=500 tries more.
RANDOM_SEED = 20200115
SCRIPTED_KILLS = int(os.environ.get("AERASCOPE_KILLS", "50"))
MUJOCO_KILLS = 5

# A kill before the file is there or before anything was committed (events are stored every 50 ms) proves little; so
# many of the kills must have hit a run that was under way, and so many must have left events behind.
ENOUGH_HITS = 0.8
ENOUGH_WITH_EVENTS = 0.4


def with_many_drives(text):
    """A scenario whose five drives are asked for again and again, so that the run lasts long enough to be killed."""
    start_of_drives = text.index("[[drives]]")
    back = '\n[[drives]]\ntitle = "hold nothing"\nmodel = "drive_hold_nothing"\n\n'
    return text[:start_of_drives] + back.join([text[start_of_drives:]] * 60)


def committed_events(episode, folder):
    """How many events SQLite itself finds in a copy of the killed run's files, and the last one's number."""
    for path in episode.parent.glob(episode.name + "*"):
        shutil.copy(path, folder / path.name)
    with closing(sqlite3.connect(folder / episode.name)) as database:
        tables = [row[0] for row in database.execute(
            "SELECT name FROM sqlite_schema WHERE type = 'table' AND name IN "
            "(SELECT table_name FROM schema_column WHERE column_name = 'seq')")]
        rows = [row[0] for table in tables for row in database.execute(f'SELECT seq FROM "{table}"')]
    return len(rows), max(rows, default=0)


def log_of(episode):
    """The lines of the episode's log."""
    outcome = call("events", episode, "--format", "ndjson")
    assert outcome.status == 0, outcome
    return outcome.out.splitlines()


class KilledRun(EndToEndTest):
    def check_kills(self, scenario, kills):
        """Kills runs of the scenario after random numbers of lines of progress, and at random moments between them."""
        expected = log_of(recorded(scenario, self.id()))
        steps = sum('"kind":"CommandIssued"' in line for line in expected)
        chance = random.Random(RANDOM_SEED)
        lengths = []
        for number in range(kills):
            moment = chance.randrange(steps), chance.uniform(0, 0.02)
            with self.subTest(kill=number, after_commands=moment[0], and_seconds=moment[1]):
                length = self.check_one_kill(scenario, number, moment, expected)
                if length is not None:
                    lengths.append(length)
        self.assertGreaterEqual(len(lengths), ENOUGH_HITS * kills, "kills came before the file or after the end")
        self.assertGreaterEqual(sum(length > 0 for length in lengths), ENOUGH_WITH_EVENTS * kills, lengths)

    def check_one_kill(self, scenario, number, moment, expected):
        """The number of events that survived; nothing if the run was not under way."""
        folder = self.folder / str(number)
        copies = folder / "copies"
        copies.mkdir(parents=True)
        episode = folder / "killed.episode"
        commands, seconds = moment
        with start("run", scenario, "-o", episode, stdout=open(os.devnull, "wb"),
                   stderr=open(folder / "progress", "wb")) as run:
            deadline = time.monotonic() + PATIENCE_S
            while (folder / "progress").read_bytes().count(b"\n") < commands and run.poll() is None:
                self.assertLess(time.monotonic(), deadline, "the run hangs")
                time.sleep(0.001)
            time.sleep(seconds)
            run.kill()
            ended = run.wait(PATIENCE_S)
        if ended != -signal.SIGKILL or not episode.exists():
            return None

        committed, last = committed_events(episode, copies)
        self.assertEqual(committed, last, "the events that are in the file have gaps")
        log = log_of(episode)
        self.assertEqual(len(log), committed, "events that were committed are missing")
        self.assertTrue(log == expected[:committed], "the file is not a beginning of the whole run")
        if committed == len(expected):
            return None  # Killed in the last breath: everything is there.

        if number % 5 == 0:
            self.assertEqual(call("kb", episode).status, 0)
            verified = call("verify", episode)
            self.assertEqual(verified.status, 1, verified)
            self.assertIn("incomplete", verified.out)
        report = call("report", episode, "-o", folder / "report.html", "--no-frames")
        self.assertEqual(report.status, 0, report)
        self.assertIn("incomplete", report.err)
        warning = packed_data((folder / "report.html").read_text())["warning"]
        self.assertIn("incomplete", json.dumps(warning))
        if committed:
            self.assertRegex(json.dumps(warning), rf"\b{committed}\b")
        return committed

    def test_a_scripted_run_killed_at_random_moments_keeps_what_it_committed(self):
        self.check_kills(scenario_in(self.folder, SCRIPTED, with_many_drives), SCRIPTED_KILLS)

    def test_a_run_with_physics_killed_at_random_moments_keeps_what_it_committed(self):
        self.check_kills(DEMO, MUJOCO_KILLS)

    def test_a_killed_run_can_be_run_again_into_the_same_file(self):
        scenario = scenario_in(self.folder, SCRIPTED, with_many_drives)
        episode = self.folder / "again.episode"
        with start("run", scenario, "-o", episode, stdout=open(os.devnull, "wb"),
                   stderr=open(os.devnull, "wb")) as run:
            while not episode.exists() and run.poll() is None:
                time.sleep(0.001)
            time.sleep(0.02)
            run.kill()
        self.run_program("run", scenario, "-o", episode)
        self.assertEqual(sorted(path.name for path in self.folder.glob("again*")), ["again.episode"])
        self.assertRegex(self.run_program("verify", episode).out, r"(?m)^ok    \d+ events, complete$")
