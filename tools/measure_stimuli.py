#!/usr/bin/env python3
"""Measures every stimulus of a study: tools/measure_stimuli.py stimuli.csv [--meshreel COMMAND] > scores.csv

stimuli.csv has the columns dataset, stimulus, original, distorted, MOS (files relative to it). The output has dataset, stimulus, MOS and a column
for each number that `meshreel compare --json` gives: what `meshreel study correlate` reads. See docs/subjective.md."""
# SPDX-License-Identifier: MIT
import argparse
import csv
import json
import pathlib
import subprocess
import sys


def cells(metrics):
    """null (infinite) becomes an empty cell."""
    return {name: "" if value is None else repr(value) for name, value in metrics.items()}


def measure(row, folder, options):
    command = [options.meshreel, "compare", str(folder / row["original"]), str(folder / row["distorted"]), "--json"]
    done = subprocess.run(command + options.more, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{row['stimulus']}: {done.stderr.strip()}")
    return cells(json.loads(done.stdout)["metrics"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("stimuli")
    parser.add_argument("--meshreel", default="meshreel", help="the command")
    parser.add_argument("more", nargs="*", help="further options of compare, after --: -- --mesh mesh.obj")
    options = parser.parse_args()
    with open(options.stimuli, newline="", encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file))
    needed = {"stimulus", "original", "distorted", "MOS"}
    if not rows or not needed <= rows[0].keys():
        sys.exit(f"{options.stimuli}: columns needed: {', '.join(sorted(needed))}")
    folder = pathlib.Path(options.stimuli).parent
    measured = [measure(row, folder, options) for row in rows]
    names = list(dict.fromkeys(name for one in measured for name in one))
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["dataset", "stimulus", "MOS", *names])
    for row, one in zip(rows, measured):
        writer.writerow([row.get("dataset") or "all", row["stimulus"], row["MOS"], *(one.get(name, "") for name in names)])


if __name__ == "__main__":
    main()
