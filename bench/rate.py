#!/usr/bin/env python3
"""Encodes every real sequence at the errors of lab/plans/rates.toml, prints the rates beside what they must be, and keeps them.

The rate is that of the whole file without the original order (--order free); KG and STED are what `compare` measures on
the decoded PC2. Where the plan promises nothing, it is half of what RBFP with Cobra and Huffman takes at the same error.
"""
# SPDX-License-Identifier: MIT
import argparse
import csv
import math
import os
import sys
import tempfile

from command import ROOT, bpfv, declare, paths_of, run

sys.path.insert(0, os.path.join(ROOT, "lab"))
import plan  # noqa: E402
import releases  # noqa: E402

COLUMNS = ["sequence", "measure", "asked", "kg", "sted", "bytes", "bpfv", "must", "aim", "bases", "step"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    declare(parser)
    parser.add_argument("--codec", default="reel")
    parser.add_argument("--entropy", default="range", choices=("range", "huffman"))
    parser.add_argument("--effort", type=int, help="of the encoder; default: its own")
    parser.add_argument("--csv", help="write the table here too")
    parser.add_argument("--keep", action="store_true", help="put the rates into lab/results/rates.csv, under the newest release of the CHANGELOG")
    parser.add_argument("--check", action="store_true", help="exit with 1 where a file is larger than lab/results/rates.csv has it")
    parser.add_argument("sequences", nargs="*", help="default: all")
    return parser.parse_args()


class Sequence:
    def __init__(self, name, options, folder):
        self.options = options
        self.motion, self.mesh = paths_of(options.data, name)
        self.reel, self.decoded = os.path.join(folder, name + ".reel"), os.path.join(folder, name + ".pc2")

    def encode(self, settings, *how):
        asked = [word for name, value in settings.items() for word in (f"--{name}", value)]
        return run(self.options.command, "encode", self.motion, "--mesh", self.mesh, self.reel, "-y", *asked, *how)

    def measured(self):
        run(self.options.command, "decode", self.reel, self.decoded, "-y")
        found = run(self.options.command, "compare", self.motion, self.decoded, "--mesh", self.mesh, "--order", "free")
        os.remove(self.decoded)
        return found["metrics"]


def asked_of(row):
    """Measure and value."""
    return next((measure, row.settings[measure]) for measure in ("kg", "sted") if measure in row.settings)


def row_of(sequence, planned, options):
    if planned.promised:
        must, aim = planned.promised["must"], planned.promised["aim"]
    else:
        baseline = bpfv(sequence.encode(planned.settings, "--codec", "rbfp", "--entropy", "huffman"))
        must, aim = 0.5 * baseline, 0.35 * baseline
    effort = ["-e", options.effort] if options.effort else []
    figures = sequence.encode(planned.settings, "--codec", options.codec, "--entropy", options.entropy, *effort)
    found = sequence.measured()
    return dict(zip(COLUMNS, [planned.sequence, *asked_of(planned), round(found["kg"], 6), round(found["sted"], 6), figures["reel_bytes"],
                              round(bpfv(figures), 4), round(must, 4), round(aim, 4), figures["bases"],
                              figures["step"]])), figures["encode_seconds"]


def verdict(row):
    if row[row["measure"]] > row["asked"] * (1 + 1e-6):
        return "ERROR ABOVE WHAT WAS ASKED"
    return "aim met" if row["bpfv"] <= row["aim"] else "met" if row["bpfv"] <= row["must"] else "NOT MET"


def grown(rows, kept):
    """Files that are larger than the newest release's."""
    known = {(r["sequence"], r["measure"], float(r["asked"])): int(r["bytes"]) for r in kept if r["release"] == kept[0]["release"]}
    keys = [((r["sequence"], r["measure"], float(r["asked"])), r["bytes"]) for r in rows]
    return [f"{key}: {size} bytes, {known[key]} in lab/results/rates.csv" for key, size in keys if size > known.get(key, math.inf)]


def write_csv(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def measured_rows(options):
    """Each row of the plan, measured and printed."""
    rows, planned = [], plan.load(os.path.join(ROOT, "lab/plans/rates.toml"))
    with tempfile.TemporaryDirectory() as folder:
        for item in planned:
            if options.sequences and item.sequence not in options.sequences:
                continue
            if not paths_of(options.data, item.sequence):
                print(f"{item.sequence:<14}skipped, its data are not here")
                continue
            row, seconds = row_of(Sequence(item.sequence, options, folder), item, options)
            rows.append(row)
            print(f"{row['sequence']:<14}{row['measure'] + ' ' + str(row['asked']):<12}{row['kg']:>9.4f}{row['sted']:>9.5f}"
                  f"{row['bytes']:>9}{row['bpfv']:>9.4f}{row['must']:>8.3f}{row['aim']:>8.3f}{row['bases']:>5}{seconds:>8.1f}"
                  f"  {verdict(row)}", flush=True)
    return rows


def main():
    options = arguments()
    print(f"{'sequence':<14}{'at':<12}{'KG %':>9}{'STED':>9}{'bytes':>9}{'bpfv':>9}{'must':>8}{'aim':>8}{'K':>5}{'enc s':>8}")
    rows = measured_rows(options)
    complaints = grown(rows, releases.read("rates")) if options.check else []
    if options.csv:
        write_csv(options.csv, rows)
    if options.keep:
        releases.renew("rates", rows, ["sequence", "measure", "asked"])
    print("\n".join(complaints), end="\n" if complaints else "")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
