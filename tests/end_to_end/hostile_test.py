"""Episodes from anyone: texts that try to be markup, to steer a terminal or to break a format stay texts."""

import functools
import json
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as xml

import support

# What a terminal acts on, and what turns the direction of text around. Line ends are ours.
UNPRINTABLE = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069]")
SHORT = [f"hostile_{turn}" for turn in range(5)]


@functools.cache
def episodes():
    """The folder of the hostile episodes, made once."""
    folder = support.shared_folder() / "hostile"
    folder.mkdir()
    subprocess.run([support.hostile_episodes(), folder], check=True, timeout=support.PATIENCE_S)
    return folder


class HostileTextTest(support.EndToEndTest):
    def setUp(self):
        super().setUp()
        if not support.hostile_episodes():
            self.skipTest("the program that writes hostile episodes was not named (--hostile)")

    def output(self, *arguments, statuses=(0,)):
        """What a command prints: text that a terminal only shows."""
        outcome = support.call(*arguments, cwd=self.folder)
        self.assertIn(outcome.status, statuses, outcome)
        for shown in (outcome.out, outcome.err):
            found = UNPRINTABLE.search(shown)
            self.assertIsNone(found, found and f"{arguments}: {shown[max(0, found.start() - 60):found.end() + 20]!r}")
        return outcome.out

    def test_what_is_printed_neither_steers_a_terminal_nor_turns_text_around(self):
        for name in SHORT:
            episode = episodes() / f"{name}.episode"
            with self.subTest(name):
                listed = self.output("events", episode)
                self.output("verify", episode, statuses=(0, 1))
                self.output("kb", episode)
                self.output("diff", f"{episode}@3s", episode, statuses=(1,))
                made = re.search(r"#(\d+) +ModelCreated", listed)
                self.output("why", episode, made[1] if made else "1")
                self.output("why", episode, "\x1b[31m<script>", statuses=(2,))

    def test_texts_are_in_the_json_as_they_were(self):
        titles, texts = set(), set()
        for name in SHORT:
            for line in self.output("events", episodes() / f"{name}.episode", "--format", "ndjson").splitlines():
                body = json.loads(line)["body"]
                if "parameters" in body:
                    titles.update(parameter[field] for parameter in body["parameters"] for field in ("name", "value"))
                texts.update(value for value in body.values() if isinstance(value, str))
        for text in ("<!-- not closed", "__proto__", "nul\0inside", "right\u202eto left\u202c, \u2066isolated\u2069, mark\u200f, zero\u200bwidth, \ufeffbom"):
            self.assertIn(text, titles | texts)

    def test_dot_is_read_by_graphviz(self):
        if not shutil.which("dot"):
            self.skipTest("Graphviz's dot is not installed")
        for name in SHORT:
            with self.subTest(name):
                text = self.output("export", episodes() / f"{name}.episode", "--format", "dot")
                done = subprocess.run(["dot", "-Tcanon"], input=text.encode(), capture_output=True, check=False)
                self.assertEqual((done.returncode, done.stderr.decode()), (0, ""))

    def test_graphml_is_well_formed_and_read_by_networkx(self):
        python = support.python_with("networkx")
        for name in SHORT:
            with self.subTest(name):
                path = self.folder / f"{name}.graphml"
                self.output("export", episodes() / f"{name}.episode", "--format", "graphml", "-o", path)
                graph = xml.parse(path).getroot()
                self.assertTrue(list(graph.iter("{http://graphml.graphdrawing.org/xmlns}node")))
                if shutil.which("xmllint"):
                    subprocess.run(["xmllint", "--noout", "--nonet", path], check=True)
                if python:
                    count = subprocess.run([python, "-c", "import networkx, sys; print(len(networkx.read_graphml(sys.argv[1])))",
                                            path], check=True, capture_output=True, text=True).stdout
                    self.assertGreater(int(count), 5)

    def test_json_is_read_by_python(self):
        for name in [*SHORT, "no_numbers"]:
            episode = episodes() / f"{name}.episode"
            with self.subTest(name):
                graph = json.loads(self.output("export", episode, "--format", "json"), parse_constant=self.fail)
                self.assertTrue(graph)
                json.loads(self.output("diff", f"{episode}@3s", episode, "--format", "json", statuses=(1,)),
                           parse_constant=self.fail)
                for line in self.output("events", episode, "--format", "ndjson").splitlines():
                    json.loads(line, parse_constant=self.fail)

    def test_markdown_holds_no_markup_of_the_episode(self):
        for name in SHORT:
            with self.subTest(name):
                episode = episodes() / f"{name}.episode"
                text = self.output("diff", f"{episode}@3s", episode, "--format", "markdown", statuses=(1,))
                outside_code = re.sub(r"(`+).+?\1", "", text)
                self.assertNotRegex(outside_code, r"<(script|img|svg|iframe|style|/title)")

    def test_replicode_refuses_names_it_cannot_say(self):
        for name in SHORT:
            with self.subTest(name):
                outcome = support.call("export", episodes() / f"{name}.episode", "--format", "replicode")
                self.assertEqual(outcome.status, 2, outcome)
                self.assert_one_sentence(outcome.err)
                self.assertIsNone(UNPRINTABLE.search(outcome.err), outcome.err)

    def test_sheets_are_pictures_and_reports_are_pages(self):
        for name in [*SHORT, "no_numbers", "endless"]:
            with self.subTest(name):
                episode = episodes() / f"{name}.episode"
                self.output("report", episode, "-o", "page.html", "--png", "sheet.png")
                self.assertTrue((self.folder / "page.html").read_text(encoding="utf-8").rstrip().endswith("</html>"))
                sheet = (self.folder / "sheet.png").read_bytes()
                self.assertTrue(sheet.startswith(b"\x89PNG\r\n\x1a\n") and b"IEND" in sheet[-12:])

    def draw(self, episode, what, name, *more):
        """A view as SVG, which must be well-formed, and as PNG; the text of the SVG."""
        for form in ("svg", "png"):
            outcome = support.call("view", episode, "--what", what, *more, "--scale", "0.5", "-o", f"{name}.{form}",
                                   cwd=self.folder)
            self.assertEqual(outcome.status, 0, outcome)
        picture = (self.folder / f"{name}.png").read_bytes()
        self.assertTrue(picture.startswith(b"\x89PNG\r\n\x1a\n") and b"IEND" in picture[-12:])
        root = xml.parse(self.folder / f"{name}.svg").getroot()
        # Only what draws: nothing that runs, loads or leads somewhere.
        kinds = {node.tag.rsplit("}", 1)[-1] for node in root.iter()}
        self.assertLessEqual(kinds, {"svg", "g", "rect", "path", "line", "circle", "text", "tspan", "title", "style", "defs",
                                     "marker", "polygon", "polyline", "image", "clipPath", "ellipse", "desc"})
        for node in root.iter():
            for attribute, value in node.attrib.items():
                self.assertNotRegex(attribute, r"(?i)^on")
                if attribute.endswith("href"):
                    self.assertRegex(value, r"^(#|data:image/)")
        shown = "".join(root.itertext())
        self.assertIsNone(UNPRINTABLE.search(shown.replace("\t", "")), what)
        return shown

    def test_every_view_is_well_formed_and_shows_texts_as_texts(self):
        told = ""
        for name in [*SHORT, "no_numbers", "endless"]:
            episode = episodes() / f"{name}.episode"
            made = support.events(episode, "ModelCreated")
            for what, more in (("graph", []), ("analogy", []), ("curves", []), ("lanes", []), ("goals", []),
                               ("why", ["--of", f"#{made[-1]['id']}"]), ("led-to", ["--of", "#1"])):
                with self.subTest(episode=name, what=what):
                    told += self.draw(episode, what, f"{name}_{what}", *more)
                    self.assertLess((self.folder / f"{name}_{what}.svg").stat().st_size, 3_000_000)
        for text in ("<script>window.pwned=1", "onerror=window.pwned=3", "<!-- not closed", "__proto__", "&lt;b&gt;"):
            self.assertIn(text, told)
        if shutil.which("xmllint"):
            drawn = sorted(self.folder.glob("*.svg"))
            done = subprocess.run(["xmllint", "--noout", "--nonet", *drawn], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_page_of_a_difference_holds_texts_as_data(self):
        pairs = [("hostile_0", "hostile_1"), ("hostile_2@3s", "hostile_2"), ("no_numbers", "hostile_3"),
                 ("endless", "hostile_4")]
        for left, right in pairs:
            with self.subTest(left=left, right=right):
                sides = [str(episodes() / one.replace("@", ".episode@")) if "@" in one else episodes() / f"{one}.episode"
                         for one in (left, right)]
                self.output("diff", *sides, "--format", "html", "-o", "page.html", statuses=(1,))
                page = (self.folder / "page.html").read_text(encoding="utf-8")
                self.assertTrue(page.rstrip().endswith("</html>"))
                self.assertNotIn("pwned", page)
                self.assertLess(len(page), 1_000_000)
                self.assertTrue(support.packed_data(page, "diff-data")["items"])

    def test_a_megabyte_of_text_is_told_shortened(self):
        episode = episodes() / "endless.episode"
        self.output("report", episode, "-o", "page.html")
        self.assertLess((self.folder / "page.html").stat().st_size, 5_000_000)
        for command in ("kb", "events"):
            with self.subTest(command):
                self.output(command, episode)

    def test_a_hostile_file_name_stays_a_name(self):
        name = '<img src=x onerror="window.pwned=1">&\x1b[31m\u202e.episode'
        shutil.copy(episodes() / "hostile_0.episode", self.folder / name)
        self.output("verify", name, statuses=(0, 1))
        self.output("report", name, "-o", "page.html")
        page = (self.folder / "page.html").read_text(encoding="utf-8")
        self.assertNotIn("onerror=\"window.pwned=1\"", page)
        self.output("diff", name, episodes() / "hostile_1.episode", "--format", "html", "-o", "diff.html", statuses=(1,))
        self.assertNotIn("onerror=\"window.pwned=1\"", (self.folder / "diff.html").read_text(encoding="utf-8"))
        self.output("kb", name + "_not_there", statuses=(2,))


if __name__ == "__main__":
    unittest.main()
