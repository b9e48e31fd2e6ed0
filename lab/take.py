#!/usr/bin/env python3
"""Puts what a bench printed into lab/results, under the newest release: lab/take.py speeds build-bench/speeds.csv

Kinds: speeds (bench_sequences --csv), player (bench_player), measures (bench_measures), scale (bench/scale.py)."""
# SPDX-License-Identifier: MIT
import argparse
import csv
import re
import sys

import releases

PLAYER = ["V", "F", "K", "product_ms", "gflops", "all", "each", "one", "bpfv", "open_1", "open_2", "fast_more", "fast_open_1", "fast_open_2"]
SPEEDS = {"sequence": "sequence", "V": "V", "F": "F", "K": "K", "encode": "encode MB/s", "decode": "decode MB/s", "copy": "memcpy MB/s",
          "product": "product MB/s", "encode_peak": "encode peak MB", "decode_peak": "decode peak MB", "pca_s": "PCA s",
          "pca_memory": "PCA memory / animation", "encode_share": "encode / (10 PCA + decode)"}
ROUNDED = {"encode": 1, "decode": 0, "copy": 0, "product": 0, "encode_peak": 0, "decode_peak": 0, "pca_s": 2, "pca_memory": 2, "encode_share": 2}
SCALE = ["shape", "V", "F", "segments", "K", "positions_mb", "bpfv", "encode_s", "encode_ns", "encode_peak", "decode_s", "decode_ns", "decode_peak"]


def speeds(lines, _options):
    return [{ours: f"{float(row[theirs]):.{ROUNDED[ours]}f}" if ours in ROUNDED else row[theirs] for ours, theirs in SPEEDS.items()}
            for row in csv.DictReader(lines)]


def player(lines, options):
    """Lines of a name and fourteen numbers."""
    rows = [line.split() for line in lines]
    return [{"sequence": words[0], "options": options, **dict(zip(PLAYER, (word.removeprefix("+") for word in words[1:])))}
            for words in rows if len(words) == 1 + len(PLAYER) and re.fullmatch(r"\d+", words[1])]


def measures(lines, _options):
    found = [re.match(r"  (\S.*?) +([\d.]+) ms +([\d.]+) x", line) for line in lines]
    return [{"measure": match[1], "ms": f"{float(match[2]):.3g}", "passes": f"{float(match[3]):.1f}"} for match in found if match]


def scale(lines, _options):
    """Lines of a Markdown table."""
    cells = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines if line.startswith("| ")]
    return [dict(zip(SCALE, row)) for row in cells[1:]]


KINDS = {"speeds": (speeds, ["sequence"]), "player": (player, ["sequence", "options"]), "measures": (measures, ["measure"]),
         "scale": (scale, ["shape", "V", "F"])}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("file", type=argparse.FileType(encoding="utf-8"))
    parser.add_argument("--options", default="", help='what the player was asked for besides, such as "--codec coddyac"')
    options = parser.parse_args()
    read, key = KINDS[options.kind]
    rows = read(options.file.read().splitlines(), options.options)
    if not rows:
        sys.exit(f"{options.file.name}: nothing in it that {options.kind} prints")
    releases.renew(options.kind, rows, key)


if __name__ == "__main__":
    main()
