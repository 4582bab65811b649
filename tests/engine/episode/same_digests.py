#!/usr/bin/env python3
"""The same scenarios give the same digests, whatever the compiler's optimisation: same_digests.py FOLDER PROGRAM...

Each program is print_digests, built differently. Ends with status 1 where two of them disagree, or where a program disagrees
with itself.
"""

import subprocess
import sys


def digests(program, folder):
    return subprocess.run([program, folder], check=True, capture_output=True, text=True).stdout.splitlines()


def main():
    folder, first, *others = sys.argv[1:]
    expected = digests(first, folder)
    print(f"{first}:", *expected, sep="\n  ")
    if len(expected) < 3:
        print("expected at least three scripted scenarios")
        return 1
    status = 0
    for program in [first, *others]:
        found = digests(program, folder)
        different = [f"{here}\n  instead of {there}" for here, there in zip(found, expected) if here != there]
        if different or len(found) != len(expected):
            print(f"{program} differs:", *different, sep="\n  ")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
