#!/usr/bin/env python3
"""Collects the comments // DEVIATES and the cited equations of src/ into docs/deviations.md: tools/deviations.py [--check]."""
# SPDX-License-Identifier: MIT
import os
import re
import sys
import tomllib
from collections import defaultdict

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
PAGE = os.path.join(ROOT, "docs/deviations.md")
COMMENT = re.compile(r"//+[/<!]*\s?(.*)")
DEVIATES = re.compile(r"DEVIATES\s*\(([^)]*)\):?\s*(.*)")
EQUATION = re.compile(r"\((\d)\.(\d{1,2})\)")
# "(8.4)-(8.7)" and "(8.4) to (8.7)" cite all between.
RANGE = re.compile(r"\((\d)\.(\d{1,2})\)\s*(?:-|to|\.\.)\s*\((\d)\.(\d{1,2})\)")


def sources():
    for folder, _, names in sorted(os.walk(os.path.join(ROOT, "src"))):
        for name in sorted(names):
            if name.endswith((".h", ".cpp", ".inl")):
                yield os.path.relpath(os.path.join(folder, name), ROOT)


def comments(path):
    """The comments of a file, one string a run of comment lines."""
    run = []
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        for line in file:
            match = COMMENT.search(line)
            if match and "DEVIATES" in match[1] and run:
                yield " ".join(run)
                run = []
            if match:
                run.append(match[1].strip())
            if run and (not match or not line.strip().startswith("//")):
                yield " ".join(run)
                run = []
    if run:
        yield " ".join(run)


def cited(comment):
    for match in RANGE.finditer(comment):
        if match[1] == match[3]:
            yield from ((int(match[1]), n) for n in range(int(match[2]), int(match[4]) + 1))
    yield from ((int(c), int(n)) for c, n in EQUATION.findall(comment))


def runs(chapter, numbers):
    """[1, 2, 3, 7] of chapter 5 as '(5.1) to (5.3)' and '(5.7)'."""
    first = last = numbers[0]
    for n in numbers[1:] + [None]:
        if n is not None and n == last + 1:
            last = n
            continue
        yield f"({chapter}.{first})" + (f" to ({chapter}.{last})" if last > first else "")
        first = last = n


def page():
    deviations, uses = [], defaultdict(set)
    for path in sources():
        for comment in comments(path):
            if match := DEVIATES.search(comment):
                deviations.append((match[1], match[2].strip(), path))
            for equation in cited(comment):
                uses[equation].add(path)
    with open(os.path.join(ROOT, "docs/equations.toml"), "rb") as file:
        chapters = tomllib.load(file)["chapters"]
    out = ["# Where the code differs from the thesis, and which equations it uses", "",
           "Made by `tools/deviations.py` from the comments in `src/`; do not edit.", "", "## Differences", "",
           "| where in the thesis | what we do and why | file |", "|---|---|---|"]
    order = lambda d: ([int(n) for n in re.findall(r"\d+", d[0])], d[2], d[1])
    out += [f"| {where} | {why.replace('|', chr(92) + '|')} | {path} |" for where, why, path in sorted(deviations, key=order)]
    out += ["", "## Equations and the files that cite them", "", "| equation | files |", "|---|---|"]
    out += [f"| ({c}.{n}) | {', '.join(sorted(uses[c, n]))} |" for c, n in sorted(uses)]
    out += ["", "## Equations that no line cites yet", ""]
    for chapter, count in chapters.items():
        rest = [n for n in range(1, count + 1) if (int(chapter), n) not in uses]
        if rest:
            out.append(f"- chapter {chapter}: {', '.join(runs(chapter, rest))}")
    return "\n".join(out) + "\n"


def main(argv):
    text = page()
    if "--check" in argv:
        fresh = os.path.exists(PAGE) and open(PAGE, encoding="utf-8").read() == text
        print("docs/deviations.md is fresh" if fresh else "docs/deviations.md is stale: run tools/deviations.py")
        return 0 if fresh else 1
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
