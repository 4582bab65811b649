#!/usr/bin/env python3
"""Checks the types of the report's scripts with TypeScript, which is not needed to build or to open a report.

    check.py FOLDER types.d.ts base.js ... main.js

The scripts share one scope in the page, so they are joined in FOLDER as the build joins them; what is found is told with
the name and line of the script it is in. Ends with status 77, after a reason, where tsc is not installed.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

OPTIONS = ["--noEmit", "--allowJs", "--checkJs", "--target", "es2022", "--lib", "es2022,dom,dom.iterable",
           "--moduleDetection", "force", "--skipLibCheck", "--strictBindCallApply", "--strictFunctionTypes",
           "--alwaysStrict", "--noImplicitThis", "--noFallthroughCasesInSwitch", "--noUnusedLocals",
           "--allowUnreachableCode", "false", "--pretty", "false"]


def main():
    folder, types, *scripts = map(Path, sys.argv[1:])
    if not shutil.which("tsc"):
        print("skipped: tsc is not installed (node-typescript)")
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    lines, origin = [], []
    for script in scripts:
        for number, line in enumerate(script.read_text().splitlines(), 1):
            lines.append(line)
            origin.append(f"{script.name}:{number}")
    joined = folder / "page.js"
    joined.write_text("\n".join(lines) + "\n")
    done = subprocess.run(["tsc", *OPTIONS, types, joined], capture_output=True, text=True, check=False)

    def place(match):
        return f"{origin[int(match[1]) - 1]}:{match[2]}"

    print(re.sub(r"^\S*page\.js\((\d+),(\d+)\)", place, done.stdout + done.stderr, flags=re.MULTILINE), end="")
    return 1 if done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
