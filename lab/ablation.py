#!/usr/bin/python3
"""What each idea of the default codec is worth: builds the command without one idea at a time, and runs them all beside it.

An idea is a patch of lab/ablation that takes it out; its first lines say what it is and what stands in its place. Renews in
lab/results/ablation.csv what it measures, and docs/figures/ablation.svg; lab/tables.py makes the tables of docs/ablation.md of them."""
# SPDX-License-Identifier: MIT
import argparse
import dataclasses
import os
import shutil
import subprocess
import sys
from collections import Counter

import bench
import codings
import ideas
import plan
import provenance
import releases
from options import ROOT, declare
from section import write_csv

NEEDED = ("CMakeLists.txt", "cmake", "src", "cli")  # what the command is built from


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--plan", default=os.path.join(ROOT, "lab/plans/ablation.toml"))
    declare(parser, "build", "data", "cache")
    parser.add_argument("--only", help="sequences, by comma; results of the others stay")
    parser.add_argument("--ideas", help="likewise")
    parser.add_argument("--jobs", default="2", help="of the compiler (default: 2)")
    bench.declare_fresh(parser)
    return parser.parse_args()


class Workshop:
    """A copy of the sources, in which one idea after the other is taken out; its build folder is kept, so little is compiled anew."""

    def __init__(self, folder, jobs):
        self.source, self.build, self.jobs = os.path.join(folder, "source"), os.path.join(folder, "source/build"), jobs
        for path in subprocess.check_output(["git", "-C", ROOT, "ls-files", *NEEDED], text=True).split("\n"):
            if path and os.path.exists(os.path.join(ROOT, path)):
                self.renew(path)

    def renew(self, path):
        """Copies a file where it differs, so that what is the same stays compiled."""
        here, there = os.path.join(ROOT, path), os.path.join(self.source, path)
        os.makedirs(os.path.dirname(there), exist_ok=True)
        with open(here, "rb") as file:
            wanted = file.read()
        if not os.path.exists(there) or open(there, "rb").read() != wanted:
            with open(there, "wb") as file:
                file.write(wanted)

    def run(self, *words):
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(words)}\n{done.stdout}exit code {done.returncode}")

    def make(self, idea, target):
        """The command without an idea, in a folder of its own."""
        self.run("patch", "-d", self.source, "-p1", "-s", "--no-backup-if-mismatch", "-i", idea.path)
        try:
            self.run("cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DMESHREEL_BUILD_TESTS=OFF")
            self.run("cmake", "--build", self.build, "--target", "meshreel-cli", "-j", self.jobs)
        finally:
            for path in ideas.touched(idea):
                self.renew(path)
        os.makedirs(target, exist_ok=True)
        shutil.copy(os.path.join(self.build, "meshreel"), target)


def build_all(curves, options):
    """The commands that the plan names, each without its idea."""
    known, workshop = ideas.read(), Workshop(os.path.join(options.build, "ablation"), options.jobs)
    for coding in curves.codings:
        if coding.build:
            print(f"without {coding.name}", file=sys.stderr, flush=True)
            workshop.make(known[coding.name], os.path.join(ROOT, coding.build))


def wanted(whole, options):
    """The plan, less what the options leave out."""
    names = [ideas.WHOLE, *bench.chosen(options.ideas, ideas.read(), "idea")]
    sequences = {name: whole.sequences[name] for name in bench.chosen(options.only, whole.sequences, "sequence")}
    return dataclasses.replace(whole, sequences=sequences, codings=tuple(coding for coding in whole.codings if coding.name in names))


def keep(new, whole, lines):
    """Into lab/results, in the plan's order, with what earlier runs measured."""
    commit, names = provenance.commit(ROOT), [coding.name for coding in whole.codings]
    rows = ideas.renewed(releases.read("ablation"), [{**row, "commit": commit} for row in new])
    rows = [row for row in rows if row["sequence"] in whole.sequences and row["coding"] in names]
    rows.sort(key=lambda row: (list(whole.sequences).index(row["sequence"]), names.index(row["coding"]), row["commit"] != commit))
    earlier = Counter(row["commit"] for row in rows if row["commit"] != commit)
    lines = [*lines, *(f"{count} files of commit {name}" for name, count in earlier.items())]
    write_csv(os.path.join(releases.RESULTS, "ablation.csv"), rows, bench.head_of(whole, lines))


def main():
    options = arguments()
    whole = plan.curves_of(plan.read(options.plan), "ablation")
    curves = wanted(whole, options)
    build_all(curves, options)
    race, codecs = bench.raced(options, curves)
    keep(race.outcome.rows, whole, bench.made_by(options, race, codecs))
    return subprocess.call([sys.executable, os.path.join(ROOT, "lab/ideas.py")])


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (plan.PlanError, codings.CodingError) as error:
        sys.exit(str(error))
