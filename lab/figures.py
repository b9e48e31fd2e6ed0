#!/usr/bin/python3
"""Runs the plans in lab/plans and writes docs/thesis-figures.md, its figures and lab/results: make figures, or see --help."""
# SPDX-License-Identifier: MIT
import argparse
import os
import sys

import basis_sections
import codec_sections
from runner import Bench
from draw import Drawer
from options import ROOT, declare
from plan import load
from section import write_csv

# In the report's order: a plan, and what makes a section of its results. True: it draws.
SECTIONS = [("table_8_2", basis_sections.table_8_2, False), ("table_9_2", basis_sections.table_9_2, False),
            ("figure_9_49", basis_sections.figure_9_49, True), ("figure_9_51", basis_sections.figure_9_51, True),
            ("table_9_3", codec_sections.table_9_3, True), ("table_9_4", codec_sections.table_9_4, False)]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    declare(parser, "build", "data", "cache")
    parser.add_argument("--out", default=ROOT, help="the root that docs/ and lab/results/ are written in (default: here)")
    return parser.parse_args()


def measured(bench, plan):
    """The rows that can be measured, with their figures; and why the others cannot."""
    results, skipped = [], []
    for row in load(os.path.join(ROOT, "lab/plans", plan + ".toml")):
        why = bench.missing(row)
        if why is None:
            results.append((row, bench.figures(row)))
        elif why not in skipped:
            skipped.append(why)
    return results, skipped


def page(sections, bench):
    lines = ["# The thesis' tables and figures, measured", "",
             "Made by `make figures` from the plans in `lab/plans`; do not edit. Every figure also stands in `lab/results`, a CSV file a plan "
             "that says what made it. *Thesis* is what L. Váša's *Methods for size reduction of dynamic meshes* (2008) prints, *here* is "
             "what this code does. The sequences are not ours to publish; one that is not at hand is skipped.", "",
             "Made by: " + "; ".join(bench.provenance()) + f". All of it takes {bench.seconds / 60:.0f} minutes on two cores.", "",
             "## Does what the thesis says hold?", "", "| the thesis says | holds | shown by |", "|---|---|---|"]
    for section, _ in sections:
        lines += [f"| {d.says} | {'✓' if d.holds else '**no**'} | {d.shown} |" for d in section.directions]
    for section, skipped in sections:
        lines += ["", f"## {section.title}", ""] + section.text
        if skipped:
            lines += ["Skipped: " + "; ".join(skipped) + ".", ""]
        if lines[-1] == "":
            lines.pop()
    return "\n".join(lines) + "\n"


def main():
    options = arguments()
    bench = Bench(ROOT, options.build, options.data, options.cache)
    drawer = Drawer(os.path.join(options.out, "docs/figures"))
    os.makedirs(os.path.join(options.out, "lab/results"), exist_ok=True)
    sections = []
    for plan, make, draws in SECTIONS:
        results, skipped = measured(bench, plan)
        section = make(results, drawer) if draws else make(results)
        for why in skipped:
            print(f"{plan}: skipped {why}", file=sys.stderr)
        if section.rows:
            write_csv(os.path.join(options.out, "lab/results", plan + ".csv"), section.rows,
                      [f"plan lab/plans/{plan}.toml"] + bench.provenance())
        sections.append((section, skipped))
    with open(os.path.join(options.out, "docs/thesis-figures.md"), "w", encoding="utf-8") as file:
        file.write(page(sections, bench))
    print(f"docs/thesis-figures.md: {bench.fresh} rows measured, the rest remembered; all take {bench.seconds:.0f} s", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
