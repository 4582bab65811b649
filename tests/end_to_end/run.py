#!/usr/bin/env python3
"""Runs the end-to-end tests against a built program.

    python3 run.py --program build/release/viewer/app/aerascope [--hostile PROGRAM] [-k WORD]...

--hostile names the program that writes episodes with hostile texts (tests/support); without it their cases are skipped.

-k keeps the cases whose name contains a word. With GTEST_OUTPUT=xml:PATH in the environment the outcome of every case
is also written to PATH as GoogleTest writes it, so that tests/summary.py counts them. Ends with status 1 if one failed.
"""

import argparse
import os
import sys
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import support

TOPICS = ["demo_test", "trials_test", "killed_run_test", "bad_input_test", "comparison_test", "questions_test",
          "scenarios_test", "sameness_test", "hostile_test"]


class CountedResult(unittest.TextTestResult):
    """Remembers the outcome of every case, in the order of running."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.outcomes = {}  # name of the case -> (outcome, text)
        self.seconds = {}
        self._started = 0.0

    def startTest(self, test):
        super().startTest(test)
        self._started = time.monotonic()
        self._note(test, "passed", "")

    def stopTest(self, test):
        super().stopTest(test)
        self.seconds[test.id()] = time.monotonic() - self._started

    def addFailure(self, test, error):
        super().addFailure(test, error)
        self._note(test, "failed", self._exc_info_to_string(error, test))

    def addError(self, test, error):
        super().addError(test, error)
        self._note(test, "failed", self._exc_info_to_string(error, test))

    def addSubTest(self, test, subtest, error):
        super().addSubTest(test, subtest, error)
        if error is not None:
            self._note(test, "failed", f"{subtest}\n{self._exc_info_to_string(error, test)}")

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self._note(test, "skipped", reason)

    def addUnexpectedSuccess(self, test):
        super().addUnexpectedSuccess(test)
        self._note(test, "failed", "passed, but is marked as an expected failure")

    def _note(self, test, outcome, text):
        known = self.outcomes.get(test.id())
        if known and known[0] == "failed":
            outcome, text = "failed", f"{known[1]}\n{text}"  # More than one part of a case may fail.
        self.outcomes[test.id()] = (outcome, text)


def write_results(path, result):
    """Writes what GoogleTest would: a testcase element a case, with failure or skipped inside."""
    root = xml.Element("testsuites", name="end_to_end", tests=str(len(result.outcomes)))
    suites = {}
    for name, (outcome, text) in result.outcomes.items():
        suite_name, _, case_name = name.rpartition(".")
        if suite_name not in suites:
            suites[suite_name] = xml.SubElement(root, "testsuite", name=suite_name)
        case = xml.SubElement(suites[suite_name], "testcase", name=case_name, classname=suite_name, status="run",
                              time=f"{result.seconds.get(name, 0):.3f}")
        if outcome == "failed":
            xml.SubElement(case, "failure", message=text)
        elif outcome == "skipped":
            xml.SubElement(case, "skipped", message=text)
    path.parent.mkdir(parents=True, exist_ok=True)
    xml.indent(root)
    xml.ElementTree(root).write(path, encoding="UTF-8", xml_declaration=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=Path, help="the built aerascope")
    parser.add_argument("--hostile", type=Path, help="the built program that writes episodes with hostile texts")
    parser.add_argument("-k", dest="words", action="append", default=[], help="only cases whose name contains this")
    arguments = parser.parse_args()
    if not os.access(arguments.program, os.X_OK):
        parser.error(f"expected a program at {arguments.program}, found none")

    loader = unittest.TestLoader()
    if arguments.words:
        loader.testNamePatterns = [f"*{word}*" for word in arguments.words]
    with support.use(arguments.program.resolve(), arguments.hostile and arguments.hostile.resolve()):
        suite = loader.loadTestsFromNames(TOPICS)
        result = unittest.TextTestRunner(verbosity=2, resultclass=CountedResult).run(suite)
    kind, _, path = os.environ.get("GTEST_OUTPUT", "").partition(":")
    if kind == "xml" and path:
        write_results(Path(path), result)
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
