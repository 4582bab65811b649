#!/usr/bin/env python3
"""Proves that the checks of this folder, and the summary of a test run, can fail: each case breaks a small tree."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent))
sys.dont_write_bytecode = True

import includes  # noqa: E402
import repository  # noqa: E402
import summary  # noqa: E402

PAGE = """# A small project

| folder | what lives there | may include | libraries |
|---|---|---|---|
| `engine/base` | basics | | |
| `engine/kb` | words | `engine/base` | |
| `engine/store` | files | `engine/kb` | SQLite |
| `engine/query` | answers | `engine/store` | |
| `viewer/draw` | pictures | `engine/query` | |
| `exporters` | text | `engine/query` | |
| `viewer/app` | the program | `viewer/draw`, `exporters` | |

| library | its headers | names that begin with |
|---|---|---|
| SQLite | `sqlite3.h` | `sqlite3_` |
| EGL | `EGL/` | `egl` |
"""
HEADER = "// A Thing is what this small header is about.\n#pragma once\n"


class TreeTest(unittest.TestCase):
    """A tree in which everything is right, until a case writes something else into it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name).resolve()
        self.write("docs/architecture.md", PAGE)
        for place in ("engine/base", "engine/kb", "engine/store", "engine/query", "viewer/draw", "exporters", "viewer/app"):
            self.write(f"{place}/thing.h", HEADER)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


class IncludesTest(TreeTest):
    def expect_agreement(self):
        self.assertEqual(includes.differences_in(self.root), [])

    def expect_difference(self, where, what):
        found = includes.differences_in(self.root)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(where + ":"), found)
        self.assertIn(what, found[0])

    def test_a_tree_that_keeps_the_rules_passes(self):
        self.write("engine/store/a.cpp", '#include "engine/store/thing.h"\n#include <sqlite3.h>\n#include <string>\n'
                                         '#include "engine/base/thing.h"\nint F() { return sqlite3_open(); }\n')
        self.write("viewer/app/a.cpp", '#include "exporters/thing.h"\n#include "viewer/draw/thing.h"\n')
        self.expect_agreement()

    def test_an_include_against_the_order(self):
        self.write("engine/base/a.cpp", '#include <string>\n#include "engine/kb/thing.h"\n')
        self.expect_difference("engine/base/a.cpp:2", "engine/base may not include engine/kb")

    def test_viewer_and_exporters(self):
        self.write("exporters/dot/a.cpp", '#include "viewer/draw/thing.h"\n')
        self.expect_difference("exporters/dot/a.cpp:1", "exporters may not include viewer/draw")

    def test_a_library_of_another_row(self):
        self.write("engine/query/a.cpp", "#include <sqlite3.h>\n")
        self.expect_difference("engine/query/a.cpp:1", "engine/query may not use SQLite")

    def test_a_library_by_its_names(self):
        self.write("viewer/draw/a.cpp", "\nint F() { return eglInitialize(0); }\n")
        self.expect_difference("viewer/draw/a.cpp:2", "may not use EGL (eglInitialize)")

    def test_a_library_nobody_listed(self):
        self.write("engine/kb/a.cpp", "#include <boost/any.hpp>\n")
        self.expect_difference("engine/kb/a.cpp:1", "belongs to no library")

    def test_an_include_that_is_not_from_the_root(self):
        self.write("engine/kb/a.cpp", '#include "thing.h"\n')
        self.expect_difference("engine/kb/a.cpp:1", "not written from the root")

    def test_our_header_as_a_system_header(self):
        self.write("engine/kb/a.cpp", "#include <engine/kb/thing.h>\n")
        self.expect_difference("engine/kb/a.cpp:1", 'is included with ""')

    def test_an_include_with_odd_spaces_is_seen(self):
        self.write("engine/base/a.cpp", '  #  include  "engine/kb/thing.h"\n')
        self.expect_difference("engine/base/a.cpp:1", "may not include")

    def test_comments_and_strings_are_not_code(self):
        self.write("engine/kb/a.cpp", '// #include "viewer/draw/thing.h"\n/*\n#include <sqlite3.h>\n*/\n'
                                      'const char* a = R"(\n#include <sqlite3.h>\n)";\n'
                                      'const char* b = "sqlite3_open eglInitialize"; int c = 1\'000;\n')
        self.expect_agreement()

    def test_code_after_a_digit_separator_is_still_code(self):
        self.write("engine/kb/a.cpp", "int a = 1'000; int b = sqlite3_open(); int c = 2'000;\n")
        self.expect_difference("engine/kb/a.cpp:1", "may not use SQLite")

    def test_a_folder_without_a_row(self):
        self.write("engine/magic/a.cpp", "int a;\n")
        self.expect_difference("engine/magic/a.cpp:1", "has no row")

    def test_a_row_without_a_folder(self):
        self.write("docs/architecture.md", PAGE.replace("| `exporters` |", "| `engine/gone` | x | | |\n| `exporters` |"))
        self.expect_difference("docs/architecture.md:10", "there is no folder engine/gone")

    def test_a_row_that_names_an_unknown_folder(self):
        self.write("docs/architecture.md", PAGE.replace("words | `engine/base`", "words | `engine/basis`"))
        self.expect_difference("docs/architecture.md:6", "engine/basis, which has no row")

    def test_a_cycle_in_the_table(self):
        self.write("docs/architecture.md", PAGE.replace("basics | |", "basics | `engine/kb` |"))
        found = includes.differences_in(self.root)
        self.assertTrue(any("engine/base reaches itself" in line for line in found), found)

    def test_a_table_that_lets_the_viewer_use_the_exporters(self):
        self.write("docs/architecture.md", PAGE.replace("pictures | `engine/query`", "pictures | `exporters`"))
        self.expect_difference("docs/architecture.md:9", "viewer/draw may not reach exporters")

    def test_a_page_without_the_table(self):
        self.write("docs/architecture.md", "# Nothing here\n")
        self.assertIn("expected the include table", includes.differences_in(self.root)[0])

    def test_a_header_without_pragma_once(self):
        self.write("engine/kb/b.h", "// A Thing is what this small header is about.\n")
        self.expect_difference("engine/kb/b.h:1", "#pragma once")

    def test_a_header_that_does_not_say_what_it_is(self):
        self.write("engine/kb/b.h", "#pragma once\n")
        self.expect_difference("engine/kb/b.h:1", "opens with a comment")

    def test_a_target_that_links_more_than_its_row(self):
        self.write("engine/kb/CMakeLists.txt",
                   "aerascope_library(engine/kb\n  SOURCES a.cpp\n  USES engine/base engine/store\n  EXTERNAL a::b)\n")
        self.expect_difference("engine/kb/CMakeLists.txt:1", "engine/kb may not link engine/store")

    def test_the_program_reports_and_fails(self):
        self.write("engine/base/a.cpp", '#include "engine/kb/thing.h"\n')
        run = subprocess.run([sys.executable, HERE / "includes.py", self.root], capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("engine/base/a.cpp:1:", run.stdout)


class RepositoryTest(TreeTest):
    def test_a_clean_tree_passes(self):
        self.write("README.md", "See [the page](docs/architecture.md#words), https://example.org/home/page and ~/home/x.\n")
        self.assertEqual(repository.findings_in(self.root), [])

    def test_machine_paths(self):
        for path in ("/".join(["", "home", "ada", "x"]), "/".join(["", "tmp"]), "/".join(["", "work", "main"])):
            with self.subTest(path):
                self.write("tests/a.cpp", f'\nopen("{path}");\n')
                found = repository.findings_in(self.root)
                self.assertEqual(found, [f"tests/a.cpp:2: the path {path} exists on one machine only"])

    def test_a_broken_link(self):
        self.write("README.md", "\n[gone](docs/gone.md)\n")
        self.assertEqual(repository.findings_in(self.root), ["README.md:2: the link to docs/gone.md leads nowhere"])

    def test_build_results_are_not_looked_at(self):
        self.write("build/release/a.txt", "/".join(["", "home", "ada", "x"]))
        self.assertEqual(repository.findings_in(self.root), [])


class SummaryTest(TreeTest):
    CTEST = '<testsuite><testcase name="{name}" status="{status}">{inside}</testcase></testsuite>'
    GTEST = """<testsuites><testsuite name="A">
      <testcase name="Passes" classname="A" status="run" result="completed"/>
      <testcase name="Skips" classname="A" status="run" result="skipped">
        <skipped message="a_test.cpp:3&#x0A;no EGL here"/></testcase>
      {more}</testsuite></testsuites>"""

    def cases(self, status, inside="", own=None):
        self.write("ctest.xml", self.CTEST.format(name="engine/a", status=status, inside=inside))
        if own is not None:
            self.write("engine/a.xml", own)
        return list(summary.all_cases(self.root))

    def test_cases_of_a_program_are_counted(self):
        failing = '<testcase name="Fails" classname="A" status="run"><failure message="x"/></testcase>'
        self.assertEqual(self.cases("fail", "<failure/>", self.GTEST.format(more=failing)),
                         [("engine/a A.Passes", "passed", ""), ("engine/a A.Skips", "skipped", "no EGL here"),
                          ("engine/a A.Fails", "failed", "")])

    def test_a_program_that_fails_outside_its_cases(self):
        outcomes = [outcome for _, outcome, _ in self.cases("fail", "<failure/>", self.GTEST.format(more=""))]
        self.assertEqual(outcomes, ["passed", "skipped", "failed"])

    def test_a_program_that_died_before_it_wrote(self):
        self.assertEqual(self.cases("fail", "<failure/>"), [("engine/a", "failed", "")])
        self.assertEqual(self.cases("fail", "<failure/>", "<testsuites><te"), [("engine/a", "failed", "")])

    def test_a_plain_test_that_is_skipped(self):
        inside = "<skipped/><system-out>looking\nno browser here\n</system-out>"
        self.assertEqual(self.cases("notrun", inside), [("engine/a", "skipped", "no browser here")])


if __name__ == "__main__":
    unittest.main()
