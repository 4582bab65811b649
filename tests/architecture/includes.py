#!/usr/bin/env python3
"""Compares the source tree with the include table of docs/architecture.md.

    includes.py ROOT

Prints one line for each difference, `file:line: what is wrong`, and ends with status 1 if there was any. The page is
the truth; this program knows only how to read it. Checked are
  1. every #include of engine, viewer and exporters, and every USES of their CMake targets, against the table;
  2. that a library appears, by header or by name, only in rows that name it;
  3. the table itself: every folder has a row and every row a folder, no cycles, and the engine, the viewer and the
     exporters are kept apart;
  4. that a header opens with a comment and has `#pragma once`.
"""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

PAGE = "docs/architecture.md"
TOPS = ("engine", "viewer", "exporters")
PROGRAM = "viewer/app"  # The one folder that joins viewer and exporters.
SOURCES = (".h", ".hpp", ".c", ".cc", ".cpp")


@dataclass
class Row:
    line: int
    may_include: set
    libraries: set
    reach: set = field(default_factory=set)  # may_include, and what those rows allow in turn


@dataclass
class Library:
    headers: list
    name_prefixes: list


def table_rows(page, *titles):
    """The (line number, cells by title) of each row of the first table with these titles."""
    columns = None
    for number, line in enumerate(page.splitlines(), 1):
        if not line.startswith("|"):
            if columns:
                return
            continue
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if columns is None:
            if set(titles) <= set(cells):
                columns = cells
        elif not set(line) <= set("|-: "):
            yield number, dict(zip(columns, cells))


def code_spans(cell):
    return re.findall(r"`([^`]+)`", cell)


def read_table(page, differences):
    rows, libraries = {}, {}
    for _, cells in table_rows(page, "library", "its headers", "names that begin with"):
        libraries[cells["library"]] = Library(
            code_spans(cells["its headers"]), code_spans(cells["names that begin with"])
        )
    for line, cells in table_rows(page, "folder", "may include", "libraries"):
        used = {name.strip() for name in cells["libraries"].split(",") if name.strip()}
        for name in sorted(used - libraries.keys()):
            differences.append(f"{PAGE}:{line}: the library {name} is missing in the table of libraries")
        rows[code_spans(cells["folder"])[0]] = Row(line, set(code_spans(cells["may include"])), used)
    if not rows or not libraries:
        differences.append(f"{PAGE}:1: expected the include table and the table of libraries, found {len(rows)} and "
                           f"{len(libraries)} rows")
    for folder, row in rows.items():
        for named in sorted(row.may_include - rows.keys()):
            differences.append(f"{PAGE}:{row.line}: {folder} names {named}, which has no row")
        row.reach = reach(folder, rows)
    return rows, libraries


def reach(folder, rows):
    found, open_ends = set(), [folder]
    while open_ends:
        for named in rows[open_ends.pop()].may_include & rows.keys():
            if named not in found:
                found.add(named)
                open_ends.append(named)
    return found


def check_table(root, rows, differences):
    for folder, row in rows.items():
        where = f"{PAGE}:{row.line}:"
        if not (root / folder).is_dir():
            differences.append(f"{where} there is no folder {folder}")
        if folder in row.reach:
            differences.append(f"{where} {folder} reaches itself, so the folders have no order")
        top = folder.split("/")[0]
        forbidden = {"engine": {"viewer", "exporters"}, "viewer": {"exporters"}, "exporters": {"viewer"}}.get(top, set())
        if folder == PROGRAM:
            forbidden = set()
        for other in sorted(row.reach):
            if other.split("/")[0] in forbidden or other == PROGRAM:
                differences.append(f"{where} {folder} may not reach {other}")


def without_comments(text, keep_strings):
    """The same lines with comments, raw strings and (if asked) other strings blanked out."""

    def blank(match):
        token = match.group(0)
        if token.startswith('"') and keep_strings:
            return token
        return re.sub(r"[^\n]", " ", token)

    pattern = r'//[^\n]*|/\*.*?\*/|R"([^()\s\\]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Za-z_])\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, blank, text, flags=re.DOTALL)


def row_of(path, rows):
    """The longest row that is a folder above this path."""
    above = [folder for folder in rows if path.startswith(folder + "/")]
    return max(above, key=len, default=None)


def library_of(header, libraries):
    for name, library in libraries.items():
        for known in library.headers:
            if header == known or (known.endswith("/") and header.startswith(known)):
                return name
    return None


def check_include(folder, kind, target, rows, libraries):
    """What is wrong with this include of a file of `folder`; None if nothing."""
    if target.split("/")[0] in TOPS:
        owner = row_of(target, rows)
        if kind == "<":
            return f'our own header {target} is included with "", not with <>'
        if owner is None:
            return f"{target} is in no folder of the include table"
        if owner != folder and owner not in rows[folder].reach:
            return f"{folder} may not include {owner} ({target})"
        return None
    name = library_of(target, libraries)
    if name is not None:
        if name not in rows[folder].libraries:
            return f"{folder} may not use {name} (<{target}>)"
        return None
    if kind == '"':
        return f'"{target}" is not written from the root of the repository'
    if re.fullmatch(r"[a-z_0-9]+", target):
        return None  # The C++ standard library.
    return f"<{target}> belongs to no library of the table in {PAGE}, nor to the C++ standard library"


def check_source(path, folder, text, rows, libraries, differences):
    code = without_comments(text, keep_strings=True)
    for match in re.finditer(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', code, re.MULTILINE):
        wrong = check_include(folder, match.group(1), match.group(2).strip(), rows, libraries)
        if wrong:
            differences.append(f"{path}:{code.count(chr(10), 0, match.start()) + 1}: {wrong}")
    bare = without_comments(text, keep_strings=False)
    for name, library in libraries.items():
        if name in rows[folder].libraries or not library.name_prefixes:
            continue
        prefixes = "|".join(map(re.escape, library.name_prefixes))
        # A call or a type: the prefix, then more of a name. `egl` alone must go on with a capital letter.
        for match in re.finditer(rf"(?<![\w\"</.])(?:{prefixes})(?:(?<=_)\w|[A-Z0-9])\w*", bare):
            line = bare.count("\n", 0, match.start()) + 1
            if not bare.splitlines()[line - 1].lstrip().startswith("#"):
                differences.append(f"{path}:{line}: {folder} may not use {name} ({match.group(0)})")
    if path.endswith((".h", ".hpp")):
        if not re.match(r"//\s*\S.{15,}", text):
            differences.append(f"{path}:1: a header opens with a comment that says what it is")
        if not re.search(r"^#pragma once$", code, re.MULTILINE):
            differences.append(f"{path}:1: a header has #pragma once")


def check_target(path, folder, text, rows, differences):
    """The USES of every aerascope_library in a CMakeLists.txt."""
    text = re.sub(r"#[^\n]*", "", text)
    for match in re.finditer(r"aerascope_library\(\s*(\S+)([^)]*)\)", text):
        used = re.search(r"\bUSES\b(.*?)(?:\bEXTERNAL\b|\bSOURCES\b|$)", match.group(2), re.DOTALL)
        line = text.count("\n", 0, match.start()) + 1
        for target in used.group(1).split() if used else []:
            owner = row_of(target + "/", rows)
            if owner is None or (owner != folder and owner not in rows[folder].reach):
                differences.append(f"{path}:{line}: {folder} may not link {target}")


def differences_in(root):
    root = Path(root)
    differences = []
    rows, libraries = read_table((root / PAGE).read_text(encoding="utf-8"), differences)
    check_table(root, rows, differences)
    for file in sorted(file for top in TOPS for file in (root / top).rglob("*") if file.is_file()):
        path = file.relative_to(root).as_posix()
        if file.suffix not in SOURCES and file.name != "CMakeLists.txt":
            continue
        folder = row_of(path, rows)
        if folder is None:
            differences.append(f"{path}:1: its folder has no row in the include table of {PAGE}")
            continue
        text = file.read_text(encoding="utf-8")
        if file.name == "CMakeLists.txt":
            check_target(path, folder, text, rows, differences)
        else:
            check_source(path, folder, text, rows, libraries, differences)
    return differences


if __name__ == "__main__":
    found = differences_in(sys.argv[1])
    print("\n".join(found) if found else f"the code agrees with {PAGE}")
    sys.exit(1 if found else 0)
