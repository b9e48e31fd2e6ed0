#!/usr/bin/python3
"""What each idea of the default codec is worth: builds the command without one idea at a time, and runs them all beside it.

An idea is a patch of lab/ablation that takes it out; its first lines say what it is and what stands in its place. Renews
lab/results/ablation.csv and docs/figures/ablation.svg; lab/tables.py makes the tables of docs/ablation.md of them."""
# SPDX-License-Identifier: MIT
import argparse
import glob
import os
import shutil
import subprocess
import sys

import bench
import codings
import ideas
import plan
from journal import Journal
from race import Race
from section import write_csv
from sequences import Sequences

ROOT = bench.ROOT
NEEDED = ("CMakeLists.txt", "cmake", "src", "cli")  # what the command is built from


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--plan", default=os.path.join(ROOT, "lab/plans/ablation.toml"))
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), help="where meshreel is (default: build)")
    parser.add_argument("--data", default=os.path.join(ROOT, "../shared/data"), help="a folder a sequence (default: ../shared/data)")
    parser.add_argument("--cache", default=os.path.join(ROOT, ".cache/lab"), help="what was measured already (default: .cache/lab)")
    parser.add_argument("--jobs", default="2", help="of the compiler (default: 2)")
    parser.add_argument("--fresh", action="store_true", help="also measure anew what another build measured that makes the same files")
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


def main():
    options = arguments()
    os.environ["MESHREEL_BUILD"] = os.path.abspath(options.build)
    curves = plan.curves_of(plan.read(options.plan), "ablation")
    known, folder = ideas.read(), os.path.join(options.build, "ablation")
    workshop = Workshop(folder, options.jobs)
    for coding in curves.codings:
        if coding.build:
            print(f"without {coding.name}", file=sys.stderr, flush=True)
            workshop.make(known[coding.name], os.path.join(ROOT, coding.build))
    command = codings.Command(os.path.join(options.build, "meshreel"))
    race = Race(curves, command, Sequences(command, options.data, os.path.join(options.cache, "made")),
                Journal(os.path.join(options.cache, "journal.jsonl")))
    codecs = bench.codecs_of(curves, command, options.fresh)
    outcome = race.run(codecs)
    for why in outcome.skipped:
        print(f"skipped: {why}", file=sys.stderr)
    if not outcome.rows:
        return 1
    outcome.rows = [bench.rounded(row) for row in outcome.rows]
    head = [bench.said(curves, argparse.Namespace(points=None)), *bench.made_by(options, race, codecs)]
    write_csv(os.path.join(ROOT, "lab/results/ablation.csv"), outcome.rows, head)
    return subprocess.call([sys.executable, os.path.join(ROOT, "lab/ideas.py")])


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (plan.PlanError, codings.CodingError) as error:
        sys.exit(str(error))
