"""Questions to a finished episode: why, events, kb, frame, report, doctor."""

import json
import re
import struct
import zlib

from support import (CHEAP_FILM, EndToEndTest, call, demo_episode, events, packed_data, scripted_episode)


def draws():
    """Whether this machine can draw at all."""
    return "\nok    frames" in call("doctor").out


def first_analogy():
    """The requirement model that the first accepted analogy made."""
    return next(event["body"]["result_requirement"] for event in events(demo_episode(), "AnalogyCompared")
                if event["body"]["verdict"] == "accepted")


def tree(text):
    """What `why` printed as [(depth, sentence, number of the event)]."""
    lines = []
    for line in text.splitlines():
        found = re.fullmatch(r"((?:[│├└─ ]{3})*)(\S.*)  #(\d+)(?: \((?:shown elsewhere|goes on)\))?", line)
        assert found, line
        lines.append((len(found[1]) // 3, found[2], int(found[3])))
    return lines


class Why(EndToEndTest):
    def test_an_analogy_goes_back_to_what_was_observed_and_to_the_drive(self):
        lines = tree(self.run_program("why", demo_episode(), first_analogy(), "--depth", "100").out)
        self.assertEqual(lines[0][0], 0)
        self.assertIn("By analogy: grab_type_2 something large", lines[0][1])
        log = events(demo_episode())
        kinds = {log[number - 1]["kind"] for _, _, number in lines}
        self.assertLessEqual({"ModelCreated", "AnalogyCompared", "CompositeStateCreated", "InductionStarted",
                              "IcstFound", "CommandIssued", "DriveInjected", "FactObserved"}, kinds)
        # Every branch ends with something that needs no cause.
        shown = {number for _, _, number in lines}
        ends = {log[number - 1]["kind"] for number in shown if not log[number - 1]["causes"]}
        self.assertLessEqual(ends, {"FactObserved", "CommandIssued", "DriveInjected", "CompositeStateCreated"})
        for number in shown:
            self.assertLessEqual(set(log[number - 1]["causes"]), shown, f"causes of #{number} are not shown")

    def test_each_line_is_a_cause_of_the_one_above(self):
        log = events(demo_episode())
        above = []
        for depth, _, number in tree(self.run_program("why", demo_episode(), first_analogy(), "--depth", "100").out):
            del above[depth:]
            if above:
                self.assertIn(number, log[above[-1] - 1]["causes"])
            above.append(number)

    def test_depth_limits_the_tree(self):
        lines = tree(self.run_program("why", demo_episode(), first_analogy(), "--depth", "1").out)
        self.assertEqual({depth for depth, _, _ in lines}, {0, 1})

    def test_what_an_analogy_led_to(self):
        text = self.run_program("why", demo_episode(), first_analogy(), "--led-to", "--depth", "100").out
        self.assertRegex(text, r"The agent commands grab_type_2 \[h\]\.")
        self.assertRegex(text, r"Came true: h holding \[s1\]\.")
        self.assertRegex(text, r"rises to 0\.875\.")

    def test_everything_with_a_number_can_be_asked_for(self):
        numbers = set(re.findall(r'"((?:mdl|cst|goal|pred|fact|sim)_\d+)"',
                                 self.run_program("events", scripted_episode(), "--format", "ndjson").out))
        for kind in ("mdl", "cst", "goal", "pred", "fact", "sim"):
            with self.subTest(kind=kind):
                number = min((n for n in numbers if n.startswith(kind)), key=lambda n: int(n.split("_")[1]))
                self.assertTrue(self.run_program("why", scripted_episode(), number).out)
        self.assertIn("#1", self.run_program("why", scripted_episode(), "#1").out)

    def test_what_does_not_exist(self):
        self.assert_refused("why", scripted_episode(), "mdl_99999", says=["mdl_99999", "the nearest is mdl_"])
        self.assert_refused("why", scripted_episode(), "#99999", says=["#99999"])
        self.assert_refused("why", scripted_episode(), "zork", says=["zork", "mdl_14"])


class Events(EndToEndTest):
    def test_the_log_has_no_gaps_and_causes_are_earlier(self):
        log = events(demo_episode())
        self.assertEqual([event["id"] for event in log], list(range(1, len(log) + 1)))
        self.assertEqual((log[0]["kind"], log[-1]["kind"]), ("EpisodeStarted", "EpisodeEnded"))
        # Physics runs through a frame after the frame's decisions were made, so its states have an order of their own.
        for of_physics in (True, False):
            times = [event["time_us"] for event in log if (event["kind"] == "WorldStateRecorded") == of_physics]
            self.assertEqual(times, sorted(times))
        for event in log:
            self.assertTrue(all(1 <= cause < event["id"] for cause in event["causes"]), event)

    def test_text_has_one_line_an_event(self):
        log = events(scripted_episode())
        lines = self.run_program("events", scripted_episode()).out.splitlines()
        self.assertEqual([(int(number), kind) for number, kind in
                          (re.match(r".*? #(\d+) +(\w+) ", line).groups() for line in lines)],
                         [(event["id"], event["kind"]) for event in log])

    def test_one_kind_and_a_stretch_of_time(self):
        log = events(demo_episode())
        out = self.run_program("events", demo_episode(), "--kind", "IcstFound", "--from", "3s", "--to", "5s",
                               "--format", "ndjson").out
        chosen = [json.loads(line) for line in out.splitlines()]
        self.assertEqual(chosen, [event for event in log if event["kind"] == "IcstFound"
                                  and 3_000_000 <= event["time_us"] <= 5_000_000])
        self.assertTrue(chosen)

    def test_an_unknown_kind(self):
        self.assert_refused("events", demo_episode(), "--kind", "AnalogyComparde",
                            says=["AnalogyComparde", "did you mean 'AnalogyCompared'?"])

    def test_a_moment_outside_of_the_run(self):
        for command in (["kb", "--at"], ["events", "--from"], ["events", "--to"]):
            for moment in ("99s", "-1s"):
                with self.subTest(command=command, moment=moment):
                    self.assert_refused(command[0], demo_episode(), f"{command[1]}={moment}",
                                        says=[moment, "from 0s to 16s"])
        self.assert_refused("kb", demo_episode(), "--at", "noon", says=["'noon'", "3.2s"])
        self.assert_refused("diff", f"{demo_episode()}@99s", demo_episode(), says=["99s"])


def png_size(data):
    """Width and height of a PNG file, after a look at every chunk's checksum."""
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    position, kinds = 8, []
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        body = data[position + 8:position + 8 + length]
        assert struct.unpack(">I", data[position + 8 + length:position + 12 + length])[0] == zlib.crc32(kind + body)
        kinds.append(kind)
        if kind == b"IHDR":
            size = struct.unpack(">II", body[:8])
        position += 12 + length
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND" and b"IDAT" in kinds
    return size


class Frame(EndToEndTest):
    def setUp(self):
        super().setUp()
        if not draws():
            self.skipTest("no EGL: nothing can be drawn on this machine")

    def frame(self, name, *more):
        self.run_program("frame", demo_episode(), "-o", name, *more)
        return (self.folder / name).read_bytes()

    def test_it_has_the_size_that_was_asked_for(self):
        for width, height in ((320, 180), (97, 61)):
            with self.subTest(width=width, height=height):
                self.assertEqual(png_size(self.frame("f.png", "--at", "3.2s", "--size", f"{width}x{height}")),
                                 (width, height))

    def test_moments_and_cameras_look_different_and_each_looks_the_same_twice(self):
        size = ["--size", "160x90"]
        pictures = [self.frame("f.png", "--at", "0s", *size), self.frame("f.png", "--at", "3s", *size),
                    self.frame("f.png", "--at", "3s", "--camera", "close", *size),
                    self.frame("f.png", "--at", "3s", "--camera", "free:90,-30,1.5", *size)]
        self.assertEqual(len(set(pictures)), len(pictures))
        self.assertTrue(pictures[0] == self.frame("again.png", "--at", "0s", *size))

    def test_what_cannot_be_drawn_is_refused(self):
        self.assert_refused("frame", demo_episode(), "-o", "f.png", "--at", "99s", says=["99s", "from 0s to 16s"])
        self.assert_refused("frame", demo_episode(), "-o", "f.png", "--size", "0x9", says=["0x9"])
        self.assert_refused("frame", demo_episode(), "-o", "f.png", "--size", "99999x99999", says=["99999x99999"])
        self.assert_refused("frame", demo_episode(), "-o", "f.png", "--size", "large", says=["large"])
        self.assert_refused("frame", demo_episode(), "-o", "f.png", "--camera", "none", says=["none", "overview"])
        self.assert_refused("frame", scripted_episode(), "-o", "f.png", says=["no scene"])


class Report(EndToEndTest):
    def test_it_is_one_file_that_asks_nothing_of_the_network(self):
        self.run_program("report", demo_episode(), "-o", "r.html", "--no-frames")
        html = (self.folder / "r.html").read_text()
        self.assertEqual(sorted(self.content()), ["r.html"])
        links = re.findall(r"""(?:src|href)\s*=\s*["']([^"'#]+)|url\(\s*["']?([^)"']+)|@import""", html)
        outside = [link for pair in links for link in pair if link and not link.startswith(("data:", "blob:"))]
        self.assertEqual(outside, [])
        self.assertLess(len(html), 1_000_000)

    def test_its_data_is_that_of_the_episode(self):
        self.run_program("report", demo_episode(), "-o", "r.html", "--no-frames")
        data = packed_data((self.folder / "r.html").read_text())
        self.assertEqual((data["title"], data["clock"]["end"], len(data["clock"]["frames"])),
                         ("Pick and place", 16_000_000, 16))
        self.assertFalse(data["warning"])
        self.assertEqual(data["log"]["count"], len(events(demo_episode())))
        for node in json.loads(self.run_program("export", demo_episode(), "--format", "json").out)["nodes"]:
            self.assertIn(f'"{node["id"]}"', json.dumps(data), node["title"])

    def test_a_film_has_stills_in_order(self):
        if not draws():
            self.skipTest("no EGL: nothing can be drawn on this machine")
        self.run_program("report", demo_episode(), "-o", "r.html", *CHEAP_FILM)
        film = packed_data((self.folder / "r.html").read_text())["film"]
        self.assertEqual((film["width"], film["height"]), (320, 180))
        self.assertGreaterEqual(len(film["stills"]), 16)

    def test_it_has_a_video_and_several_cameras(self):
        if not draws():
            self.skipTest("no EGL: nothing can be drawn on this machine")
        self.run_program("report", demo_episode(), "-o", "r.html", *CHEAP_FILM, "--video-fps", "4")
        html = (self.folder / "r.html").read_text()
        film = packed_data(html)["film"]
        self.assertEqual((film["video"]["pictures"], film["video"]["picture"]), (64, 250_000))
        self.assertEqual([view["id"] for view in film["views"]], ["side", "above", "at:h"])
        self.assertIn("media-src blob:", html)
        for view in film["views"]:
            self.assertEqual(len(view["stills"]), 16)
        # Everything that is an entity with a body can be outlined, the hand too.
        self.assertEqual(sorted(film["outlines"]["names"]), ["c1", "c2", "cyl", "h", "s1", "s2"])

    def test_video_and_cameras_can_be_chosen(self):
        if not draws():
            self.skipTest("no EGL: nothing can be drawn on this machine")
        self.run_program("report", demo_episode(), "-o", "r.html", *CHEAP_FILM, "--no-video", "--cameras", "close,above")
        film = packed_data((self.folder / "r.html").read_text())["film"]
        self.assertNotIn("video", film)
        self.assertEqual((film["camera"]["id"], [view["id"] for view in film["views"]]), ("close", ["above"]))
        for wrong, says in ((["--video-fps", "30"], "--video-fps"), (["--cameras", "film,flm"], "flm"),
                            (["--cameras", "film,film"], "twice"), (["--cameras", "at:moon"], "moon")):
            self.assert_refused("report", demo_episode(), "-o", "r.html", *wrong, says=[says])

    def test_a_scripted_world_has_a_report_without_a_film_that_says_why(self):
        outcome = self.run_program("report", scripted_episode(), "-o", "r.html", "--png", "r.png")
        self.assertIn("no scene", outcome.err)
        self.assertIn("no scene", packed_data((self.folder / "r.html").read_text())["film"]["note"])
        width, height = png_size((self.folder / "r.png").read_bytes())
        self.assertGreater(min(width, height), 500)

    def test_nothing_to_write_is_refused(self):
        self.assert_refused("report", scripted_episode(), says=["-o FILE.html", "--png"])


class View(EndToEndTest):
    def view(self, name, *more):
        self.run_program("view", demo_episode(), "-o", name, *more)
        return (self.folder / name).read_bytes()

    def test_the_papers_figure_three_is_one_command(self):
        figure = self.view("figure3.svg", "--what", "analogy").decode()
        for words in ("grab_type_2 something large", "ψ = 3/4 = 0.75", ">pruned<", "s1 shape sphere"):
            self.assertIn(words, figure)
        self.assertTrue(figure == self.view("again.svg", "--what", "analogy").decode())
        width, height = png_size(self.view("figure3.png", "--what", "analogy", "--scale", "1", "--dark"))
        self.assertEqual((f'width="{width}"' in figure, f'height="{height}"' in figure), (True, True))

    def test_what_cannot_be_drawn_is_refused(self):
        for more, says in ((["--what", "graf"], "graf"), (["--what", "why"], "--of"),
                           (["--what", "graph", "--of", "mdl_99999"], "mdl_99999"),
                           (["--what", "graph", "--of", "#3"], "#3"), (["--what", "analogy", "--of", "mdl_15"], "mdl_15"),
                           (["--what", "goals", "--of", "mdl_204"], "--of is for graph, analogy"),
                           (["--what", "lanes", "--depth", "2"], "--depth is for why, led-to"),
                           (["--what", "why", "--of", "mdl_204", "--depth", "0"], "--depth"),
                           (["--what", "lanes", "--at", "1s"], "--at is for graph, moment"),
                           (["--what", "graph", "--camera", "side"], "--camera is for moment"),
                           (["--what", "graph", "--at", "99s"], "99s"), (["--what", "lanes", "--scale", "0"], "--scale")):
            self.assert_refused("view", demo_episode(), "-o", "v.svg", *more, says=[says])
        self.assert_refused("view", demo_episode(), "-o", "v.pdf", "--what", "lanes", says=["v.pdf", ".svg", ".png"])
        self.assert_refused("view", scripted_episode(), "-o", "v.svg", "--what", "moment", says=["no scene"])


class Doctor(EndToEndTest):
    def test_it_names_each_ability_and_whether_it_is_there(self):
        outcome = call("doctor")
        lines = outcome.out.splitlines()
        self.assertRegex(lines[0], r"^aerascope \d+\.\d+\.\d+$")
        self.assertEqual([re.match(r"(ok  |FAIL)  (\w+) ", line)[2] for line in lines[1:]],
                         ["frames", "fonts", "sheets", "assets"])
        self.assertEqual(outcome.status, 1 if any(line.startswith("FAIL") for line in lines) else 0)

    def test_the_version(self):
        self.assertEqual(self.run_program("--version").out, call("doctor").out.splitlines()[0] + "\n")
