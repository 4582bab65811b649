#!/usr/bin/env python3
"""Ends a test run: names what failed, counts why tests were skipped, and closes with one line of totals.

Reads the folder of results that `./aerascope test` made: ctest.xml, the JUnit file of CTest, and for a test
program built on GoogleTest its own <test name>.xml. Where that exists its cases are counted; any other test
counts as one. Ends with status 1 if something failed.
"""

import re
import sys
import xml.etree.ElementTree as xml
from collections import Counter
from pathlib import Path


def own_cases(path):
    """The (name, outcome, reason) of every case in a GoogleTest result file; None if it cannot be read."""
    try:
        root = xml.parse(path).getroot()
    except (OSError, xml.ParseError):
        return None  # Not a GoogleTest program, or it died before it wrote its results.
    cases = []
    for case in root.iter("testcase"):
        name = f'{case.get("classname", "")}.{case.get("name", "")}'
        skipped = case.find("skipped")
        if case.find("failure") is not None or case.find("error") is not None:
            cases.append((name, "failed", ""))
        elif skipped is not None:
            # GoogleTest puts "file:line" on the first line and the reason below it.
            lines = (skipped.get("message") or skipped.text or "").strip().splitlines()
            if len(lines) > 1 and re.search(r":\d+$", lines[0]):
                lines = lines[1:]
            cases.append((name, "skipped", " ".join(line.strip() for line in lines) or "no reason given"))
        elif case.get("status") == "notrun":
            cases.append((name, "skipped", "the case is switched off in its source"))
        else:
            cases.append((name, "passed", ""))
    return cases


def ctest_outcome(entry):
    """The (outcome, reason) CTest saw for one of its tests."""
    if entry.find("failure") is not None or entry.get("status") == "fail":
        return "failed", ""
    if entry.get("status") == "disabled":
        return "skipped", "the test is switched off in its CMakeLists.txt"
    if entry.find("skipped") is not None or entry.get("status") == "notrun":
        lines = [line.strip() for line in (entry.findtext("system-out") or "").splitlines() if line.strip()]
        return "skipped", lines[-1] if lines else "no reason given"
    return "passed", ""


def all_cases(folder):
    for entry in xml.parse(folder / "ctest.xml").getroot().iter("testcase"):
        test = entry.get("name")
        outcome, reason = ctest_outcome(entry)
        cases = own_cases(folder / f"{test}.xml")
        if not cases:
            yield test, outcome, reason
            continue
        for name, case_outcome, case_reason in cases:
            yield f"{test} {name}", case_outcome, case_reason
        # A program may fail outside its cases: a leak, a crash at the end, a time limit.
        if outcome == "failed" and all(case[1] != "failed" for case in cases):
            yield f"{test} (the program itself)", "failed", ""


def main():
    cases = sorted(all_cases(Path(sys.argv[1])))
    failed = [name for name, outcome, _ in cases if outcome == "failed"]
    reasons = Counter(reason for _, outcome, reason in cases if outcome == "skipped")
    passed = sum(outcome == "passed" for _, outcome, _ in cases)
    print()
    for name in failed:
        print(f"failed: {name}")
    for reason, count in sorted(reasons.items(), key=lambda item: (-item[1], item[0])):
        print(f"skipped {count}: {reason}")
    print(f"{passed} passed, {len(failed)} failed, {sum(reasons.values())} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
