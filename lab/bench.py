#!/usr/bin/python3
"""Runs one plan of curves: a CSV file with what made it, SVG curves, and a report in one HTML file. docs/lab.md tells all.

An interrupted run goes on where it was, by the same command."""
# SPDX-License-Identifier: MIT
import argparse
import dataclasses
import math
import os
import statistics
import sys
from collections import Counter

import codings
import plan
import provenance
import report
from journal import Journal
from options import ROOT, declare
from race import Race
from section import write_csv
from sequences import Sequences

KEPT = ("kg", "sted")  # the curves that docs/figures has


def declare_fresh(parser):
    parser.add_argument("--fresh", action="store_true", help="also measure anew what another build measured that makes the same files")


def arguments(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("plan", help="such as lab/plans/codecs.toml")
    declare(parser, "build", "data", "cache")
    parser.add_argument("--out", help="the folder of what comes out (default: build/lab/PLAN)")
    parser.add_argument("--only", help="sequences, by comma")
    parser.add_argument("--points", type=int, help="so many of each curve's points, for a first look")
    parser.add_argument("--runs", type=int, help="how often each file is made, for the times (default: as the plan says)")
    declare_fresh(parser)
    parser.add_argument("--keep", action="store_true", help="also renew lab/results/PLAN.csv and the curves in docs/figures")
    return parser.parse_args(words)


def some(points, count):
    """So many of them, evenly, the first and the last included."""
    if not count or count >= len(points):
        return points
    return tuple(points[round(i * (len(points) - 1) / max(count - 1, 1))] for i in range(count))


def chosen(words, known, what):
    """Names by comma, all of which there are; all that there are where there are no words."""
    names = words.split(",") if words else list(known)
    if unknown := set(names) - set(known):
        raise plan.PlanError(f"no such {what}: {', '.join(sorted(unknown))}")
    return names


def wanted(options):
    """The plan, less what the options leave out."""
    name = os.path.splitext(os.path.basename(options.plan))[0]
    whole = plan.curves_of(plan.read(options.plan), name, codings.peers_here())
    sequences = {name: whole.sequences[name] for name in chosen(options.only, whole.sequences, "sequence")}
    return dataclasses.replace(whole, runs=options.runs or whole.runs, sequences=sequences,
                               codings=tuple(dataclasses.replace(coding, points=some(coding.points, options.points))
                                             for coding in whole.codings))


def codecs_of(curves, command, fresh=False):
    """{coding's name: what encodes and decodes it}."""
    peers = {peer.name: peer for peer in codings.peers_here()}

    def codec_of(coding):
        if coding.peer:
            return codings.PeerCodec(peers[coding.peer])
        own = codings.Command(os.path.join(ROOT, coding.build, "meshreel")) if coding.build else command
        return codings.Codec(own, coding.points, fresh or bool(coding.build))

    return {coding.name: codec_of(coding) for coding in curves.codings}


def other_programs(race, codecs):
    """{build of meshreel: how many files} of files that another build than those asked for made."""
    asked = {codec.command.identity for codec in codecs.values() if isinstance(codec, codings.Codec)}
    return {program: count for program, count in Counter(race.outcome.programs).items() if program not in asked}


def made_by(options, race, codecs):
    curves, checksums, loads = race.plan, race.sequences.checksums, race.outcome.loads
    lines = [f"commit {provenance.commit(ROOT)}", f"compiler {provenance.build(options.build)}", f"machine {provenance.machine()}",
             f"load {statistics.median(loads or [math.nan]):.1f}, the median while measuring; times are the processor's, at one thread",
             f"meshreel sha256 {provenance.digest(os.path.join(options.build, 'meshreel'))[:16]}"]
    lines += [f"{coding.name}: meshreel of {coding.build}, sha256 {codecs[coding.name].command.identity}" for coding in curves.codings if coding.build]
    lines += [f"{count} files by meshreel sha256 {program}, which makes the same of small animations"
              for program, count in other_programs(race, codecs).items()]
    lines += [f"{codec.peer.name}: {codec.version}" for codec in codecs.values() if isinstance(codec, codings.PeerCodec)]
    return lines + [f"{name} sha256 {checksum[:16]}" for name, checksum in sorted(checksums.items())]


def head_of(curves, lines, points=None):
    """The head of a CSV file: the plan with what was left out of it, and what made the rows."""
    return [f"plan {curves.name}.toml, runs {curves.runs}" + (f", {points} points of each curve" if points else ""), *lines]


def rounded(row):
    """Six digits say all that a measurement says."""
    return {key: float(f"{value:.6g}") if isinstance(value, float) else value for key, value in row.items()}


def raced(options, curves):
    """Runs a plan: the race, whose rows are rounded, and its codecs."""
    command = codings.Command(os.path.join(options.build, "meshreel"))
    sequences = Sequences(command, options.data, os.path.join(options.cache, "made"))
    codecs = codecs_of(curves, command, options.fresh)
    race = Race(curves, command, sequences, Journal(os.path.join(options.cache, "journal.jsonl")))
    outcome = race.run(codecs)
    for why in outcome.skipped:
        print(f"skipped: {why}", file=sys.stderr)
    if not outcome.rows:
        sys.exit("nothing could be measured")
    outcome.rows = [rounded(row) for row in outcome.rows]
    return race, codecs


def draw(folder, curves, outcome, only=None):
    """SVG files by name; none, with a sentence, where matplotlib is missing."""
    try:
        from plots import draw_all
    except ImportError as error:
        outcome.skipped.append(f"the SVG curves: {error}; tools/install.sh --with-figures")
        return []
    return draw_all(folder, curves, outcome, only)


def main(words=None):
    options = arguments(words)
    os.environ |= {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}  # before NumPy: peers have one thread too
    os.environ["MESHREEL_BUILD"] = os.path.abspath(options.build)  # where peers that are programs of ours are
    curves = wanted(options)
    race, codecs = raced(options, curves)
    outcome, lines = race.outcome, made_by(options, race, codecs)
    head = head_of(curves, lines, options.points)
    out = options.out or os.path.join(options.build, "lab", curves.name)
    os.makedirs(out, exist_ok=True)
    write_csv(os.path.join(out, curves.name + ".csv"), outcome.rows, head)
    draw(out, curves, outcome)
    if options.keep:
        write_csv(os.path.join(ROOT, "lab/results", curves.name + ".csv"), outcome.rows, head)
        draw(os.path.join(ROOT, "docs/figures"), curves, outcome, KEPT)
    page = os.path.join(out, curves.name + ".html")
    report.write(page, report.facts(curves, outcome, codecs, lines))
    print(f"{page}: {len(outcome.rows)} files, {outcome.seconds / 60:.1f} minutes of work", file=sys.stderr)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (plan.PlanError, codings.CodingError) as error:
        sys.exit(str(error))
