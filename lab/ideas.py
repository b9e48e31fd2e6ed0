#!/usr/bin/python3
"""The ideas of the default codec, what each is worth by lab/results/ablation.csv, and pictures of that."""
# SPDX-License-Identifier: MIT
import glob
import math
import os
import re
from dataclasses import dataclass

import releases
from verdicts import mean_percent

PATCHES = os.path.join(releases.ROOT, "lab/ablation")
PICTURES = [os.path.join(releases.ROOT, "docs/figures", name) for name in ("ablation.svg", "ablation-narrow.svg")]
WHOLE = "reel"  # the coding that lacks nothing
NOTHING = 0.5   # percent: what is worth less on every sequence is worth nothing


@dataclass(frozen=True)
class Idea:
    """name: the patch's. idea: what the codec does. without: what the patched one does instead."""
    name: str
    idea: str
    without: str
    path: str


def read_one(path):
    with open(path, encoding="utf-8") as file:
        said = dict(line.rstrip("\n").split(": ", 1) for line in (file.readline(), file.readline()))
    return Idea(os.path.basename(path).removesuffix(".patch"), said["idea"], said["without"], path)


def read(folder=PATCHES):
    """{name: idea} of all patches."""
    return {idea.name: idea for idea in map(read_one, sorted(glob.glob(os.path.join(folder, "*.patch"))))}


def touched(idea):
    """The files that a patch changes."""
    with open(idea.path, encoding="utf-8") as file:
        return re.findall(r"^\+\+\+ b/(.+)$", file.read(), re.M)


def renewed(old, new):
    """What was measured now, and what of earlier runs it does not replace, with the whole codec of the commit that it is of."""
    measured = {(row["sequence"], row["coding"]) for row in new}
    kept = [row for row in old if row["coding"] != WHOLE and (row["sequence"], row["coding"]) not in measured]
    needed = {whole_of(row) for row in kept} - {whole_of(row) for row in new}
    return [*new, *kept, *(row for row in old if row["coding"] == WHOLE and whole_of(row) in needed)]


def whole_of(row):
    """What tells the whole codec's rows that a row is held against."""
    return row["sequence"], row["commit"]


def by_whole(rows):
    """[(an idea's row, the whole codec's rows of the same sequence and commit)], where there are any."""
    found = {}
    for row in rows:
        if row["coding"] == WHOLE:
            found.setdefault(whole_of(row), []).append(row)
    return [(row, found[whole_of(row)]) for row in rows if row["coding"] != WHOLE and whole_of(row) in found]


def rate_at(curve, measure, error):
    """The rate of a curve's rows at an error: straight lines in logarithms, the outermost prolonged."""
    points = sorted((math.log(row[measure]), math.log(row["bpfv"])) for row in curve)
    x = math.log(error)
    a, b = next((pair for pair in zip(points, points[1:]) if x <= pair[1][0]), points[-2:])
    return math.exp(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]))


def worth(rows, measure):
    """{(sequence, idea): percent that its file is larger without it than the whole codec's of the same error}."""
    return {(row["sequence"], row["coding"]): 100 * (row["bpfv"] / rate_at(whole, measure, row[measure]) - 1) for row, whole in by_whole(rows)}


def times(rows, which):
    """{(sequence, idea): percent that encoding or decoding takes longer without it}, of files of the same setting."""
    return {(row["sequence"], row["coding"]): 100 * (row[which] / same[which] - 1)
            for row, whole in by_whole(rows) for same in whole if same["setting"] == row["setting"]}


def mean(found, coding):
    """Of what was found of a coding, over the sequences."""
    return mean_percent(value for (_, name), value in found.items() if name == coding)


def sorted_ideas(rows):
    """Names, the most valuable at equal KG first."""
    found = worth(rows, "kg")
    return sorted({name for _, name in found}, key=lambda name: -mean(found, name))


def worth_little(rows):
    """[(name, percent, the sequence that needs it most)] of ideas worth less than NOTHING percent at equal KG in the mean over sequences."""
    found = worth(rows, "kg")
    most = lambda name: max((value, sequence) for (sequence, other), value in found.items() if other == name)
    return [(name, *most(name)) for name in sorted_ideas(rows) if mean(found, name) < NOTHING]


def main():
    from bars import Bars  # matplotlib's, which the tables do without
    rows = releases.numbers("ablation")
    found = {"at equal KG": worth(rows, "kg"), "at equal STED": worth(rows, "sted")}
    bars = Bars(found, list(dict.fromkeys(row["sequence"] for row in rows)), sorted_ideas(rows))
    bars.wide(PICTURES[0])
    bars.narrow(PICTURES[1])


if __name__ == "__main__":
    main()
