#!/usr/bin/env python3
"""Checks what must hold for every file of the repository.

    repository.py ROOT

Prints one line for each finding, `file:line: what is wrong`, and ends with status 1 if there was any. Checked are
  1. that no file holds a path of somebody's machine: a home directory or a folder for temporary or working files;
  2. that every link from a Markdown page to a file leads to one.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

# A path at the start of a word: "/home/..." is one, "https://example.org/home/..." is not.
MACHINE_PATH = re.compile(rb"(?<![\w.$})~-])/(?:(?:home|Users|root)/\w|(?:work|tmp)\b(?![\w-]))")
LINK = re.compile(r"\]\(([^)\s]+)\)")
NOT_OURS = {".git", "build", "out", "node_modules", "__pycache__"}


def files_of(root):
    """What Git tracks or would track; without Git, everything but the folders of build results."""
    try:
        command = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        # The ceiling keeps Git from finding another repository further up.
        environment = {**os.environ, "GIT_CEILING_DIRECTORIES": str(root.parent)}
        listed = subprocess.run(command, capture_output=True, check=True, env=environment).stdout
        return sorted(root / os.fsdecode(name) for name in set(listed.split(b"\0")) if name)
    except (OSError, subprocess.CalledProcessError):
        pass
    found = []
    for folder, folders, names in os.walk(root):
        folders[:] = set(folders) - NOT_OURS
        found += [Path(folder) / name for name in names]
    return sorted(found)


def findings_in(root):
    root = Path(root).resolve()
    findings = []
    for file in files_of(root):
        if not file.is_file():
            continue  # Tracked, and deleted in the working tree.
        path = file.relative_to(root).as_posix()
        content = file.read_bytes()
        for match in MACHINE_PATH.finditer(content):
            line = content.count(b"\n", 0, match.start()) + 1
            shown = re.match(rb"[\w/.-]+", content[match.start():]).group(0)[:60].decode()
            findings.append(f"{path}:{line}: the path {shown} exists on one machine only")
        if file.suffix == ".md":
            text = content.decode("utf-8")
            for match in LINK.finditer(text):
                target = match.group(1).split("#")[0]
                if target and not re.match(r"[a-z]+:", target) and not (file.parent / target).exists():
                    line = text.count("\n", 0, match.start()) + 1
                    findings.append(f"{path}:{line}: the link to {target} leads nowhere")
    return findings


if __name__ == "__main__":
    found = findings_in(sys.argv[1])
    print("\n".join(found) if found else "no machine paths, no broken links")
    sys.exit(1 if found else 0)
