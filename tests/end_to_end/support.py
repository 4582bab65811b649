"""What the end-to-end tests share: running the program, the episodes many of them look at, and reading them back."""

import base64
import contextlib
import functools
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
SCENARIOS = SOURCE / "assets" / "scenarios"
DEMO = SCENARIOS / "pick_and_place.toml"
SCRIPTED = SCENARIOS / "pick_and_place_scripted.toml"
WRONG_GRASP = SCENARIOS / "wrong_grasp.toml"

# A program that takes longer hangs. Sanitizers and busy machines are slow, so this is generous.
PATIENCE_S = 180 * int(os.environ.get("AERASCOPE_SLOWNESS", 1))

# Small pictures, few of them: what is tested does not depend on it.
CHEAP_FILM = ["--stills-per-second", "1", "--size", "320x180"]

# Here nothing that draws is installed, as far as the program can see.
NO_EGL = {"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent", "LIBGL_DRIVERS_PATH": "/nonexistent"}

_program = None
_hostile_episodes = None
_shared_folder = None


@contextlib.contextmanager
def use(program, hostile_episodes=None):
    """Sets the program under test, the one that writes hostile episodes, and the folder of shared episodes, which is
    removed at the end."""
    global _program, _hostile_episodes, _shared_folder
    with tempfile.TemporaryDirectory(prefix="aerascope-end-to-end-") as folder:
        _program, _hostile_episodes, _shared_folder = program, hostile_episodes, Path(folder)
        yield


def hostile_episodes():
    """The program that writes episodes with hostile texts into a folder; None if it was not named."""
    return _hostile_episodes


def shared_folder():
    """The folder of what several tests look at."""
    return _shared_folder


@dataclass
class Outcome:
    """How one call of the program ended."""

    command: str
    status: int
    out: str
    err: str

    def __str__(self):
        return f"{self.command}\nstatus {self.status}\n{self.out[-4000:]}\n{self.err[-4000:]}"


def environment(**changes):
    """This process's environment without what would change the program's behaviour, and with the changes."""
    kept = {name: value for name, value in os.environ.items() if name not in ("CI", "GTEST_OUTPUT")}
    return {**kept, **changes}


def call(*arguments, wrapper=(), cwd=None, env=None, **options):
    """Runs the program to its end and says how it went."""
    command = [*map(str, wrapper), str(_program), *map(str, arguments)]
    done = subprocess.run(command, cwd=cwd, env=environment(**(env or {})), stdin=subprocess.DEVNULL,
                          capture_output=True, timeout=PATIENCE_S, **options)
    shown = " ".join(["aerascope", *map(str, arguments)])
    return Outcome(shown, done.returncode, done.stdout.decode(), done.stderr.decode())


def start(*arguments, **options):
    """Starts the program without waiting."""
    return subprocess.Popen([str(_program), *map(str, arguments)], env=environment(), stdin=subprocess.DEVNULL,
                            **options)


def recorded(scenario, name, *arguments):
    """The path of an episode of this scenario, run in a folder of its own."""
    folder = _shared_folder / name
    folder.mkdir()
    outcome = call("run", scenario, "-o", folder / "run.episode", *arguments)
    if outcome.status == 2 or outcome.status < 0:
        raise AssertionError(f"the episode could not be made\n{outcome}")
    return folder / "run.episode"


# Episodes that several tests read; nobody changes them. Each is run once, when it is first asked for.
@functools.cache
def demo_episode():
    return recorded(DEMO, "demo")


@functools.cache
def second_demo_episode():
    return recorded(DEMO, "second_demo")


@functools.cache
def scripted_episode():
    return recorded(SCRIPTED, "scripted")


@functools.cache
def one_lesson_scripted_episode():
    return recorded(scenario_in(_shared_folder, SCRIPTED, without_second_lesson, "one_lesson_scripted"),
                    "one_lesson_scripted_run")


@functools.cache
def one_lesson_episode():
    return recorded(scenario_in(_shared_folder, DEMO, without_second_lesson, "one_lesson"), "one_lesson_run")


def scenario_in(folder, original, change=lambda text: text, name="scenario"):
    """Writes a changed copy of a scenario whose seed and world stay where they are; returns its path."""
    text = re.sub(r'^(replicode|model) = "(.+\.\w+)"', lambda match: f'{match[1]} = "{original.parent / match[2]}"',
                  original.read_text(), flags=re.MULTILINE)
    path = Path(folder) / f"{name}.toml"
    path.write_text(change(text))
    return path


def without_second_lesson(text):
    """A scenario whose teacher shows only frames 1 to 3, the lesson on the small cube."""
    changed, removed = re.subn(r"\[\[teacher\]\]\nframe = [456]\n(?:\w+ = .*\n)+", "", text)
    assert removed == 3, removed
    return changed


def replaced(old, new):
    """A change of a scenario: one text for another. The old one must be there."""

    def change(text):
        assert old in text, old
        return text.replace(old, new)

    return change


def events(episode, kind=None):
    """The events of an episode as the program exports them, in order."""
    outcome = call("events", episode, "--format", "ndjson", *(["--kind", kind] if kind else []))
    if outcome.status != 0:
        raise AssertionError(f"the events could not be read\n{outcome}")
    return [json.loads(line) for line in outcome.out.splitlines()]


def packed_data(html, block="report-data"):
    """A block of a report, unpacked from the page as its script does it."""
    found = re.search(rf'id="{block}"[^>]*data-packed="gzip"[^>]*>([^<]+)<', html)
    assert found, f"the page has no packed block {block}"
    return json.loads(gzip.decompress(base64.b64decode(found[1])))


def subject_detail(html, name):
    """What a report's inspector shows of one thing, by its id."""
    subjects = packed_data(html)["subjects"]
    number = subjects["id"].index(name)
    return packed_data(html, f"subjects-{number // subjects['block']}")[number % subjects["block"]]


def python_with(module):
    """A Python that has this module: this one, or Debian's own; None if neither does."""
    for python in dict.fromkeys([sys.executable, "/usr/bin/python3"]):
        if not shutil.which(python):
            continue
        if subprocess.run([python, "-c", f"import {module}"], capture_output=True, check=False).returncode == 0:
            return python
    return None


class EndToEndTest(unittest.TestCase):
    """A case with a folder of its own."""

    maxDiff = None

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="aerascope-case-")
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def run_program(self, *arguments, status=0, **options):
        """Runs the program in the case's folder; it must end with this status."""
        outcome = call(*arguments, cwd=self.folder, **options)
        self.assertEqual(outcome.status, status, outcome)
        return outcome

    def content(self):
        """Every file and folder in the case's folder, with its bytes."""
        return {str(path.relative_to(self.folder)): path.read_bytes() if path.is_file() else None
                for path in sorted(self.folder.rglob("*"))}

    def assert_refused(self, *arguments, says=(), **options):
        """The program refuses: one clear line, status 2, no output, and no file made, changed or removed."""
        before = self.content()
        outcome = self.run_program(*arguments, status=2, **options)
        self.assert_one_sentence(outcome.err, says)
        self.assertEqual(outcome.out, "", outcome)
        self.assert_unchanged(before)
        return outcome

    def assert_one_sentence(self, text, says=()):
        self.assertRegex(text, r"\Aaerascope: [^\n]+\n\Z")
        self.assertNotRegex(text, r"(?i)terminate called|exception|what\(\)|assert|0x[0-9a-f]{6,}")
        for words in says:
            self.assertIn(words, text)

    def assert_unchanged(self, before):
        after = self.content()
        self.assertEqual(sorted(after), sorted(before), "files appeared or vanished")
        for name, held in before.items():
            self.assertTrue(after[name] == held, f"{name} was changed")
