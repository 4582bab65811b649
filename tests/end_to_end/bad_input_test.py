"""Bad input and trouble outside: one clear sentence on standard error, status 2, and nothing half written."""

import os
import resource
import shutil
import sqlite3
import subprocess
from contextlib import closing

from support import (DEMO, NO_EGL, PATIENCE_S, SCENARIOS, SCRIPTED, EndToEndTest, call, demo_episode, packed_data,
                     replaced, scenario_in, scripted_episode, start)

SEED = SCENARIOS / "pick_and_place.replicode"


def own_mounts():
    """What to put before a command so that it may mount; nothing where this system does not let us."""
    for wrapper in (["unshare", "--mount"], ["unshare", "--user", "--map-root-user", "--mount"]):
        try:
            mount = ["mount", "-t", "tmpfs", "tmpfs", "/mnt"]
            tried = subprocess.run([*wrapper, *mount], capture_output=True, check=False)
        except OSError:
            return None
        if tried.returncode == 0:
            return wrapper
    return None


class BadScenario(EndToEndTest):
    def run_scenario(self, scenario, says):
        """Running it is refused; an episode that is there already stays as it is."""
        old = self.folder / "old.episode"
        shutil.copy(scripted_episode(), old)
        self.assert_refused("run", scenario, "-o", "new.episode", says=says)
        self.assert_refused("run", scenario, "-o", old, says=says)

    def test_an_unknown_key(self):
        scenario = scenario_in(self.folder, SCRIPTED, replaced("sampling_period_ms", "samplng_period_ms"))
        self.run_scenario(scenario, ["scenario.toml:9:1", "'samplng_period_ms'", "did you mean 'sampling_period_ms'?"])

    def test_a_value_of_the_wrong_kind(self):
        scenario = scenario_in(self.folder, SCRIPTED, replaced("sampling_period_ms = 100", 'sampling_period_ms = "x"'))
        self.run_scenario(scenario, ["scenario.toml:9:", "sampling_period_ms"])

    def test_a_file_that_is_not_toml(self):
        scenario = scenario_in(self.folder, SCRIPTED, replaced("[seed]", "[seed"))
        self.run_scenario(scenario, ["scenario.toml:"])

    def test_a_file_of_random_bytes(self):
        (self.folder / "noise.toml").write_bytes(bytes(range(256)) * 8)
        self.run_scenario("noise.toml", ["noise.toml"])

    def test_no_such_scenario(self):
        self.run_scenario("nowhere.toml", ["nowhere.toml", "no such file"])

    def test_a_folder_as_scenario(self):
        (self.folder / "folder.toml").mkdir()
        self.run_scenario("folder.toml", ["folder.toml"])

    def test_a_missing_world(self):
        scenario = scenario_in(self.folder, DEMO, replaced("scene.xml", "nowhere.xml"))
        self.run_scenario(scenario, ["scenario.toml:17:", "nowhere.xml"])

    def test_a_missing_seed(self):
        scenario = scenario_in(self.folder, SCRIPTED, replaced("pick_and_place.replicode", "nowhere.replicode"))
        self.run_scenario(scenario, ["nowhere.replicode"])

    def test_a_drive_model_that_the_seed_does_not_have(self):
        scenario = scenario_in(self.folder, SCRIPTED, replaced("drive_hold_cyl", "drive_hold_cone"))
        self.run_scenario(scenario, ["drive_hold_cone"])

    def test_a_body_that_the_world_does_not_have(self):
        scenario = scenario_in(self.folder, DEMO, replaced('body = "cyl"', 'body = "cone"'))
        self.run_scenario(scenario, ["cone"])

    def mjcf(self, change):
        """A scenario whose world is a changed copy of the demo's."""
        world = SCENARIOS.parent / "worlds" / "tabletop"
        shutil.copytree(world, self.folder / "world")
        scene = self.folder / "world" / "scene.xml"
        scene.write_text(change(scene.read_text()))
        return scenario_in(self.folder, DEMO, replaced(str(SCENARIOS / "../worlds/tabletop"), "world"))

    def test_an_mjcf_with_an_unknown_attribute(self):
        scenario = self.mjcf(replaced('<joint name="arm_yaw"', '<joint typ="hinge" name="arm_yaw"'))
        lines = (self.folder / "world" / "scene.xml").read_text().splitlines()
        line = next(number for number, text in enumerate(lines, 1) if "typ=" in text)
        self.run_scenario(scenario, ["world/scene.xml", "'typ'", f"line {line}"])

    def test_an_mjcf_that_is_not_xml(self):
        self.run_scenario(self.mjcf(lambda text: text[:2000]), ["world/scene.xml"])

    def test_an_mjcf_with_a_missing_mesh(self):
        self.run_scenario(self.mjcf(replaced("forearm_trim.obj", "nowhere.obj")), ["nowhere.obj"])

    def test_an_mjcf_with_a_damaged_mesh(self):
        scenario = self.mjcf(lambda text: text)
        (self.folder / "world" / "meshes" / "forearm.obj").write_bytes(b"\0\1\2 no mesh")
        self.run_scenario(scenario, ["forearm.obj"])

    def replicode(self, change):
        (self.folder / "seed.replicode").write_text(change(SEED.read_text()))
        return scenario_in(self.folder, SCRIPTED, replaced(str(SEED), "seed.replicode"))

    def test_a_replicode_syntax_error(self):
        # The position is that of the mistake: the second column of a line put in as the fifth.
        def broken(text):
            lines = text.splitlines()
            return "\n".join([*lines[:4], " )", *lines[4:]]) + "\n"

        self.run_scenario(self.replicode(broken), ["seed.replicode:5:2"])

    def test_a_replicode_file_that_ends_too_early(self):
        self.run_scenario(self.replicode(lambda text: text[:text.rindex("(fact") + 8]), ["seed.replicode:"])

    def test_replicode_that_is_not_known(self):
        self.run_scenario(self.replicode(lambda text: text + "\nx:(pgm [] []) |[]\n"), ["seed.replicode:", "pgm"])


class BadCommandLine(EndToEndTest):
    def test_an_unknown_command(self):
        self.assert_refused("rnu", says=["'rnu'", "did you mean 'run'?", "aerascope --help"])
        self.assert_refused("repotr", "x.episode", says=["did you mean 'report'?"])
        self.assert_refused("xyzzyplugh", says=["'xyzzyplugh'"])

    def test_an_option_that_is_misspelt(self):
        self.assert_refused("run", "x.toml", "--otput", "y.episode", says=["'--otput'", "did you mean '--output'?", "aerascope run --help"])
        self.assert_refused("report", "x.episode", "--sieze=3x3", says=["'--sieze'", "did you mean '--size'?"])
        self.assert_refused("kb", "x.episode", "--plugh", says=["there is no option '--plugh'"])

    def test_an_episode_where_a_scenario_is_expected(self):
        self.assert_refused("run", scripted_episode(), "-o", "new.episode",
                            says=["expected a scenario", "found an episode", "aerascope report"])

    def test_no_command(self):
        self.assert_refused(says=["aerascope --help"])

    def test_an_unknown_option(self):
        self.assert_refused("run", SCRIPTED, "-o", "x.episode", "--sed", "1", says=["--sed", "aerascope run --help"])

    def test_a_missing_argument(self):
        self.assert_refused("run", says=["scenario", "aerascope run --help"])

    def test_an_unknown_format(self):
        self.assert_refused("export", scripted_episode(), "--format", "pdf", says=["pdf", "graphml"])

    def test_a_random_seed_that_is_none(self):
        # -1 and numbers of more than 64 bits were taken for the largest seed.
        for seed in ("-1", "99999999999999999999", "1.5", "x", ""):
            with self.subTest(seed=seed):
                self.assert_refused("run", SCRIPTED, "-o", "x.episode", f"--seed={seed}", says=["--seed"])
                self.assert_refused("trials", SCRIPTED, f"--first-seed={seed}", says=["--first-seed"])

    def test_moments_between_which_nothing_can_lie(self):
        # Nothing was printed, with status 0.
        self.assert_refused("events", scripted_episode(), "--from", "1s", "--to", "0.5s", says=["--from 1s", "--to 0.5s", "earlier"])
        at_one = self.run_program("events", scripted_episode(), "--from", "1s", "--to", "1s").out
        self.assertRegex(at_one, r"\A1 s ")

    def test_a_moment_that_is_empty(self):
        # It was taken for the end.
        episode = scripted_episode()
        for command in (["kb", episode], ["frame", episode, "-o", "f.png"], ["view", episode, "--what", "graph", "-o", "v.svg"],
                        ["export", episode, "--format", "dot"], ["snapshot", "test", episode, "x.snap"]):
            with self.subTest(command=command[0]):
                self.assert_refused(*command, "--at", "", says=["empty", "3.2s"])
                self.assert_refused(*command, "--at=", says=["--at"])
        self.assert_refused("diff", f"{episode}@", episode, says=["empty", "3.2s"])
        for end in ("--from", "--to"):
            self.assert_refused("events", episode, end, "", says=["empty", "3.2s"])
        self.assert_refused("view", episode, "--what", "why", "--of", "", "-o", "v.svg", says=["mdl_14"])

    def test_help_is_there_for_every_command(self):
        for command in ("demo", "run", "trials", "report", "frame", "view", "kb", "events", "why", "diff", "export", "snapshot",
                        "verify", "doctor"):
            with self.subTest(command=command):
                self.assertIn("--help", self.run_program(command, "--help").out)


class BadEpisode(EndToEndTest):
    COMMANDS = [["kb"], ["events"], ["verify"], ["why", "mdl_1"], ["report", "-o", "r.html", "--png", "r.png"],
                ["frame", "-o", "f.png"], ["view", "--what", "lanes", "-o", "v.svg"], ["export", "--format", "dot", "-o", "x.dot"],
                ["snapshot", "test", "k.snapshot"], ["snapshot", "accept", "k.snapshot"]]

    def refused_everywhere(self, says):
        """Every command that reads episodes refuses bad.episode."""
        for command in self.COMMANDS:
            with self.subTest(command=command):
                place = 2 if command[0] == "snapshot" else 1
                self.assert_refused(*command[:place], "bad.episode", *command[place:], says=["bad.episode", *says])
        with self.subTest(command="diff"):
            self.assert_refused("diff", scripted_episode(), "bad.episode", says=["bad.episode", *says])
            self.assert_refused("diff", "bad.episode", scripted_episode(), "--format", "html", "-o", "d.html",
                                says=["bad.episode", *says])

    def changed_copy(self, statement):
        shutil.copy(scripted_episode(), self.folder / "bad.episode")
        with closing(sqlite3.connect(self.folder / "bad.episode")) as database, database:
            database.execute(statement)

    def test_a_text_file(self):
        (self.folder / "bad.episode").write_text("This is not an episode.\n" * 100)
        self.refused_everywhere(["another kind of file"])

    def test_an_empty_file(self):
        (self.folder / "bad.episode").touch()
        self.refused_everywhere(["an empty file"])

    def test_no_file(self):
        self.refused_everywhere(["no such file"])

    def test_a_folder(self):
        (self.folder / "bad.episode").mkdir()
        self.refused_everywhere(["not a file"])

    def test_another_database(self):
        with closing(sqlite3.connect(self.folder / "bad.episode")) as database, database:
            database.execute("CREATE TABLE person (name TEXT)")
        self.refused_everywhere(["another SQLite database"])

    def test_a_truncated_episode(self):
        whole = scripted_episode().read_bytes()
        for length in (1000, len(whole) // 3, len(whole) - 1):
            (self.folder / "bad.episode").write_bytes(whole[:length])
            with self.subTest(length=length):
                self.assert_refused("kb", "bad.episode", says=["bad.episode"])
        (self.folder / "bad.episode").write_bytes(whole[:len(whole) // 2])
        self.refused_everywhere([f"it should have {len(whole)} bytes and has {len(whole) // 2}"])

    def test_an_episode_of_a_newer_version(self):
        self.changed_copy("PRAGMA user_version = 99")
        self.refused_everywhere(["newer", "version 99"])

    def test_an_episode_with_a_missing_table(self):
        self.changed_copy('DROP TABLE "content"')
        self.refused_everywhere([])

    def test_an_episode_with_overwritten_bytes(self):
        # Whatever the damage, the program ends by itself and says something; some damage is only seen by verify.
        whole = bytearray(scripted_episode().read_bytes())
        for place in range(4096, len(whole) - 4096, len(whole) // 12):
            damaged = whole.copy()
            damaged[place:place + 2048] = b"\xa5" * 2048
            (self.folder / "bad.episode").write_bytes(damaged)
            with self.subTest(place=place):
                outcome = call("verify", self.folder / "bad.episode")
                self.assertIn(outcome.status, (0, 1, 2), outcome)
                if outcome.status == 2:
                    self.assert_one_sentence(outcome.err, ["bad.episode"])
                compared = call("diff", self.folder / "bad.episode", scripted_episode(), "--format", "html", "-o",
                                self.folder / "d.html")
                self.assertIn(compared.status, (0, 1, 2), compared)


class BadOutput(EndToEndTest):
    """Every command that writes a file, with an output that cannot be written."""

    def writers(self, where):
        """The commands, each writing to `where`."""
        return [["run", SCRIPTED, "-o", where], ["report", scripted_episode(), "--no-frames", "-o", where],
                ["report", scripted_episode(), "--no-frames", "--png", where],
                ["frame", demo_episode(), "--size", "64x48", "-o", where],
                ["view", scripted_episode(), "--what", "lanes", "-o", where],
                ["export", scripted_episode(), "--format", "json", "-o", where],
                ["diff", scripted_episode(), scripted_episode(), "-o", where],
                ["diff", scripted_episode(), scripted_episode(), "--format", "html", "-o", where]]

    def test_a_missing_folder(self):
        for command in self.writers("missing/out"):
            with self.subTest(command=command[0]):
                self.assert_refused(*command, says=["missing/out"])

    def test_a_folder_in_its_place(self):
        (self.folder / "out").mkdir()
        for command in [*self.writers("out"), ["snapshot", "accept", scripted_episode(), "out"]]:
            with self.subTest(command=command[0]):
                self.assert_refused(*command, says=["out"])

    def test_a_file_where_a_folder_should_be(self):
        (self.folder / "file").touch()
        for command in [*self.writers("file/out"), ["demo", "--out", "file"],
                        ["snapshot", "accept", scripted_episode(), "file/out"]]:
            with self.subTest(command=command[0]):
                self.assert_refused(*command, says=["file"])

    def test_a_file_that_is_no_episode_is_not_overwritten_by_a_run(self):
        (self.folder / "thesis.txt").write_text("years of work")
        self.assert_refused("run", SCRIPTED, "-o", "thesis.txt", says=["thesis.txt", "another kind of file"])

    def test_an_episode_is_not_overwritten_by_a_report_or_an_export(self):
        # `report X -o X` replaced the episode by its report.
        shutil.copy(scripted_episode(), self.folder / "out")
        for command in [*self.writers("out")[1:], ["snapshot", "accept", scripted_episode(), "out"]]:
            with self.subTest(command=command[0]):
                self.assert_refused(*command, says=["out"])

    def test_report_and_sheet_in_one_file(self):
        self.assert_refused("report", scripted_episode(), "--no-frames", "-o", "out", "--png", "out", says=["out"])

    def test_an_output_without_a_name(self):
        for command in self.writers("")[3:]:
            with self.subTest(command=command[0]):
                self.assert_refused(*command)

    def test_a_reader_that_has_seen_enough_is_no_trouble(self):
        for command in (["events", demo_episode(), "--format", "ndjson"], ["kb", demo_episode()]):
            with self.subTest(command=command[0]):
                with start(*command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
                    program.stdout.close()
                    said = program.stderr.read()
                self.assertEqual((program.returncode, said), (0, b""))

    def test_two_outputs_are_both_written_or_neither(self):
        self.assert_refused("report", scripted_episode(), "--no-frames", "-o", "good.html", "--png", "missing/bad.png",
                            says=["missing/bad.png"])

    def test_standard_output_that_is_full(self):
        for command in (["kb", scripted_episode()], ["events", scripted_episode()],
                        ["export", scripted_episode(), "--format", "dot"]):
            with self.subTest(command=command[0]), open("/dev/full", "wb") as full:
                with start(*command, stdout=full, stderr=subprocess.PIPE) as program:
                    said = program.communicate(timeout=PATIENCE_S)[1].decode()
                self.assertEqual(program.returncode, 2)
                self.assert_one_sentence(said, ["No space left on device"])

    def test_a_reader_that_has_seen_enough(self):
        for command in (["kb", scripted_episode()], ["why", scripted_episode(), "#200"], ["events", scripted_episode()]):
            with self.subTest(command=command[0]), start(*command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
                program.stdout.close()
                self.assertEqual(program.stderr.read().decode(), "")
                self.assertEqual(program.wait(PATIENCE_S), 0)

    def mounted(self, options, command):
        """Runs a command in a folder `disk` that is a file system of its own; then prints what is on it."""
        wrapper = own_mounts()
        if wrapper is None:
            self.skipTest("this system lets tests mount nothing")
        (self.folder / "disk").mkdir(exist_ok=True)
        script = ('folder=$1; options=$2; shift 2; mount -t tmpfs tmpfs "$folder" && '
                  '{ [ ! -f old ] || cp old "$folder/old"; } && mount -o "remount,$options" "$folder"; '
                  '"$@"; status=$?; ls -A "$folder" >&3; [ ! -f old ] || cmp old "$folder/old" >&3; exit $status')
        listing = self.folder / "listing"
        with open(listing, "wb") as out:
            done = call(*command, cwd=self.folder, pass_fds=(out.fileno(),),
                        wrapper=[*wrapper, "bash", "-c", script.replace(">&3", f">&{out.fileno()}"), "bash", "disk",
                                 options])
        return done, listing.read_text().split()

    def test_a_full_disk(self):
        # One page: room for a name, but for none of these files.
        for command in self.writers("disk/out"):
            if command[0] in ("diff", "frame"):
                continue  # Their files are smaller than that.
            with self.subTest(command=command[0]):
                outcome, left = self.mounted("size=4k", command)
                self.assertEqual((outcome.status, left), (2, []), outcome)
                # What came before may be progress; the error is the last line.
                error = outcome.err.splitlines()[-1]
                self.assertRegex(error, "^aerascope: cannot write disk/out: (the disk is full|No space left on device)")
                self.assertEqual(outcome.err.count("aerascope: "), 1, outcome)

    def test_a_disk_that_fills_up_during_a_run(self):
        for size in ("100k", "300k", "700k"):
            with self.subTest(size=size):
                outcome, left = self.mounted(f"size={size}", ["run", SCRIPTED, "-o", "disk/out"])
                self.assertEqual((outcome.status, left), (2, []), outcome)
                self.assertIn("disk/out: the disk is full", outcome.err.splitlines()[-1])

    def test_a_full_disk_leaves_an_earlier_report_as_it_was(self):
        (self.folder / "old").write_bytes(b"earlier" * 500)
        outcome, left = self.mounted("size=8k", ["report", scripted_episode(), "--no-frames", "-o", "disk/old"])
        self.assertEqual((outcome.status, left), (2, ["old"]), outcome)

    def test_a_file_system_that_may_only_be_read(self):
        for command in self.writers("disk/out"):
            with self.subTest(command=command[0]):
                outcome, left = self.mounted("ro", command)
                self.assertEqual((outcome.status, left), (2, []), outcome)
                self.assert_one_sentence(outcome.err, ["disk/out", "Read-only file system"])

    def test_a_folder_that_may_only_be_read(self):
        if os.geteuid() == 0:
            self.skipTest("root may write everywhere")
        (self.folder / "locked").mkdir(mode=0o555)
        for command in self.writers("locked/out"):
            with self.subTest(command=command[0]):
                self.assert_refused(*command, says=["locked/out", "Permission denied"])

    def test_a_limit_on_the_size_of_files(self):
        # The signal that comes with it is ignored, as nohup and Python do; writing then fails.
        def limited(size):
            return {"restore_signals": False,
                    "preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))}

        for size in (0, 20_000, 300_000):
            with self.subTest(size=size):
                before = self.content()
                outcome = self.run_program("run", SCRIPTED, "-o", "out", status=2, **limited(size))
                self.assertIn("cannot write out: File too large", outcome.err.splitlines()[-1])
                self.assert_unchanged(before)
        self.assert_refused("export", scripted_episode(), "--format", "json", "-o", "out", says=["File too large"],
                            **limited(1000))

    def test_a_run_that_fails_leaves_the_earlier_episode_as_it_was(self):
        shutil.copy(demo_episode(), self.folder / "out")
        before = self.content()
        self.run_program("run", SCRIPTED, "-o", "out", status=2, restore_signals=False,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000)))
        self.assert_unchanged(before)


class NoEgl(EndToEndTest):
    def test_a_report_is_made_without_frames_and_says_so(self):
        outcome = self.run_program("report", demo_episode(), "-o", "r.html", "--png", "r.png", env=NO_EGL)
        self.assertIn("frames cannot be drawn", outcome.err)
        film = packed_data((self.folder / "r.html").read_text())["film"]
        self.assertEqual(film["stills"], [])
        self.assertIn("frames cannot be drawn", film["note"])
        self.assertTrue((self.folder / "r.png").read_bytes().startswith(b"\x89PNG\r\n"))

    def test_a_single_frame_is_refused(self):
        self.assert_refused("frame", demo_episode(), "-o", "f.png", env=NO_EGL,
                            says=["frames cannot be drawn", "install"])

    def test_doctor_says_what_to_install(self):
        outcome = self.run_program("doctor", status=1, env=NO_EGL)
        self.assertRegex(outcome.out, r"(?m)^FAIL  frames .*install the packages .*libegl")
