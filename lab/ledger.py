#!/usr/bin/env python3
"""The ledger of exact sizes, lab/ledger.csv: no codec's files change unnoticed. See docs/lab.md.

Without --renew it compares, and exits with 1 where a size is another. A size that changes is renewed with a reason, which
stays in the ledger beside it."""
# SPDX-License-Identifier: MIT
import argparse
import csv
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import codings
import plan
import provenance
from options import ROOT, declare
from sequences import Sequences

LEDGER = os.path.join(ROOT, "lab/ledger.csv")
PLAN = os.path.join(ROOT, "lab/plans/ledger.toml")
ELSEWHERE = 0.005  # another libm or compiler rounds otherwise in the encoder: the share by which a size may differ there
NOTHING_HERE = 77  # exit code: no sequence was at hand


class LedgerError(Exception):
    """A renewal that would leave sizes of two machines in one ledger."""


@dataclass
class Ledger:
    """made: what encoded, in one line. sizes: {(sequence, coding): (bytes, reason)}."""
    made: str
    sizes: dict


def read(path):
    if not os.path.exists(path):
        return Ledger("", {})
    with open(path, newline="", encoding="utf-8") as file:
        made = file.readline().removeprefix("# ").strip()
        return Ledger(made, {(row["sequence"], row["coding"]): (int(row["bytes"]), row["reason"]) for row in csv.DictReader(file)})


def write(path, ledger):
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.write(f"# {ledger.made}\n")
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["sequence", "coding", "bytes", "reason"])
        rows.writerows([*key, *value] for key, value in ledger.sizes.items())


def complaints(ledger, found, made):
    """A sentence a size that is not the ledger's: exactly where the same compiler, C library and processor made both, else about."""
    same, lines = made == ledger.made, []
    for key, size in found.items():
        name = " ".join(key)
        if key not in ledger.sizes:
            lines.append(f"{name}: {size} bytes, not in the ledger")
            continue
        known = ledger.sizes[key][0]
        if abs(size - known) > (0 if same else ELSEWHERE * known):
            lines.append(f"{name}: {size} bytes, {known} in the ledger ({100 * (size / known - 1):+.2f} %)")
    return lines


def renewed(ledger, found, made, reason):
    """The ledger with what was found; a size that stays keeps its reason, sequences that are not at hand keep their sizes."""
    sizes = dict(ledger.sizes)
    if made != ledger.made and set(sizes) - set(found):
        raise LedgerError(f"the ledger was made by {ledger.made}, here is {made}, and not all of its sequences are at hand: renew it there")
    for key, size in found.items():
        if key not in sizes or sizes[key][0] != size:
            sizes[key] = (size, reason)
    order = list(dict.fromkeys([*found, *sizes]))
    return Ledger(made, {key: sizes[key] for key in sorted(order, key=lambda key: key[0])})


def encoded_size(command, clip, settings):
    with tempfile.TemporaryDirectory() as folder:
        return codings.Codec(command, [settings]).encode(clip, settings, folder).size


def measured(rows, command, sequences):
    """{(sequence, coding): bytes} of every row whose sequence is at hand, and the names of those that are not."""
    clips = {row.sequence: sequences.find(row.sequence, row.made) for row in rows}
    here = [row for row in rows if clips[row.sequence]]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        sizes = pool.map(lambda row: encoded_size(command, clips[row.sequence], row.settings), here)
        return {(row.sequence, row.name): size for row, size in zip(here, sizes)}, [name for name, clip in clips.items() if not clip]


def arguments(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    declare(parser, "build", "data")
    parser.add_argument("--sequences", choices=("made", "real", "all"), default="all")
    parser.add_argument("--ledger", default=LEDGER, help=argparse.SUPPRESS)
    parser.add_argument("--plan", default=PLAN, help=argparse.SUPPRESS)
    parser.add_argument("--renew", action="store_true", help="write what is found into the ledger")
    parser.add_argument("--reason", help="why the sizes change; --renew demands it")
    options = parser.parse_args(words)
    if options.renew and not (options.reason or "").strip():
        parser.error("--renew needs --reason: why do the sizes change?")
    return options


def main(words=None):
    options = arguments(words)
    command = codings.Command(os.path.join(options.build, "meshreel"))
    made = provenance.encoder(options.build)
    rows = [row for row in plan.load(options.plan) if options.sequences in ("all", "made" if row.made else "real")]
    with tempfile.TemporaryDirectory() as folder:
        found, missing = measured(rows, command, Sequences(command, options.data, folder))
    for name in missing:
        print(f"{name}: skipped, its data are not here")
    if not found:
        return NOTHING_HERE
    ledger = read(options.ledger)
    lines = complaints(ledger, found, made)
    print("\n".join(lines), end="\n" if lines else "")
    if options.renew:
        write(options.ledger, renewed(ledger, found, made, options.reason.strip()))
        print(f"{len(lines)} sizes renewed: {options.reason.strip()}")
        return 0
    if lines:
        print('meant so? lab/ledger.py --renew --reason "..."')
    elif made != ledger.made:
        print(f"{len(found)} sizes are the ledger's within {100 * ELSEWHERE:g} % (made here: {made}; there: {ledger.made})")
    else:
        print(f"{len(found)} sizes are the ledger's, exactly")
    return 1 if lines else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (LedgerError, plan.PlanError, codings.CodingError) as error:
        sys.exit(str(error))
