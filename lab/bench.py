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
from race import Race
from section import write_csv
from sequences import Sequences

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

KEPT = ("kg", "sted")  # the curves that docs/figures has


def arguments(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("plan", help="such as lab/plans/codecs.toml")
    parser.add_argument("--build", default=os.path.join(ROOT, "build"), help="where meshreel is (default: build)")
    parser.add_argument("--data", default=os.path.join(ROOT, "../shared/data"), help="a folder a sequence (default: ../shared/data)")
    parser.add_argument("--cache", default=os.path.join(ROOT, ".cache/lab"), help="what was measured already (default: .cache/lab)")
    parser.add_argument("--out", help="the folder of what comes out (default: build/lab/PLAN)")
    parser.add_argument("--only", help="sequences, by comma")
    parser.add_argument("--points", type=int, help="so many of each curve's points, for a first look")
    parser.add_argument("--runs", type=int, help="how often each file is made, for the times (default: as the plan says)")
    parser.add_argument("--fresh", action="store_true", help="also measure anew what another build of meshreel measured that makes the same files")
    parser.add_argument("--keep", action="store_true", help="also renew lab/results/PLAN.csv and the curves in docs/figures")
    return parser.parse_args(words)


def some(points, count):
    """So many of them, evenly, the first and the last included."""
    if not count or count >= len(points):
        return points
    return tuple(points[round(i * (len(points) - 1) / max(count - 1, 1))] for i in range(count))


def wanted(options):
    """The plan, less what the options leave out."""
    name = os.path.splitext(os.path.basename(options.plan))[0]
    whole = plan.curves_of(plan.read(options.plan), name, codings.peers_here())
    only = options.only.split(",") if options.only else list(whole.sequences)
    if unknown := set(only) - set(whole.sequences):
        raise plan.PlanError(f"no such sequence: {', '.join(sorted(unknown))}")
    return dataclasses.replace(whole, runs=options.runs or whole.runs, sequences={name: whole.sequences[name] for name in only},
                               codings=tuple(dataclasses.replace(coding, points=some(coding.points, options.points))
                                             for coding in whole.codings))


def codecs_of(curves, command, fresh=False):
    """{coding's name: what encodes and decodes it}."""
    peers = {peer.name: peer for peer in codings.peers_here()}
    of_build = lambda build: codings.Command(os.path.join(ROOT, build, "meshreel")) if build else command
    return {coding.name: codings.PeerCodec(peers[coding.peer]) if coding.peer else codings.Codec(of_build(coding.build), coding.points, fresh or bool(coding.build))
            for coding in curves.codings}


def made_by(options, race, codecs):
    curves, checksums, loads = race.plan, race.sequences.checksums, race.outcome.loads
    lines = [f"commit {provenance.commit(ROOT)}", f"compiler {provenance.build(options.build)}", f"machine {provenance.machine()}",
             f"load {statistics.median(loads or [math.nan]):.1f}, the median while measuring; times are the processor's, at one thread",
             f"meshreel sha256 {provenance.digest(os.path.join(options.build, 'meshreel'))[:16]}"]
    lines += [f"{coding.name}: meshreel of {coding.build}, sha256 {codecs[coding.name].command.identity}" for coding in curves.codings if coding.build]
    others = Counter(race.outcome.programs) - Counter({codec.command.identity: len(race.outcome.programs) for codec in codecs.values() if isinstance(codec, codings.Codec)})
    lines += [f"{count} files by meshreel sha256 {program}, which makes the same of small animations" for program, count in others.items()]
    lines += [f"{codec.peer.name}: {codec.version}" for codec in codecs.values() if isinstance(codec, codings.PeerCodec)]
    return lines + [f"{name} sha256 {checksum[:16]}" for name, checksum in sorted(checksums.items())]


def said(curves, options):
    """The plan, and what was left out of it."""
    return f"plan {curves.name}.toml, runs {curves.runs}" + (f", {options.points} points of each curve" if options.points else "")


def rounded(row):
    """Six digits say all that a measurement says."""
    return {key: float(f"{value:.6g}") if isinstance(value, float) else value for key, value in row.items()}


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
    out = options.out or os.path.join(options.build, "lab", curves.name)
    os.makedirs(out, exist_ok=True)
    command = codings.Command(os.path.join(options.build, "meshreel"))
    sequences = Sequences(command, options.data, os.path.join(options.cache, "made"))
    codecs = codecs_of(curves, command, options.fresh)
    race = Race(curves, command, sequences, Journal(os.path.join(options.cache, "journal.jsonl")))
    outcome = race.run(codecs)
    for why in outcome.skipped:
        print(f"skipped: {why}", file=sys.stderr)
    if not outcome.rows:
        print("nothing could be measured", file=sys.stderr)
        return 1
    outcome.rows = [rounded(row) for row in outcome.rows]
    lines = made_by(options, race, codecs)
    head = [said(curves, options)] + lines
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
