#!/usr/bin/env python3
"""What it costs to look for a target: processor time of encoding with it, over that of encoding once with what was found.

One thread; whole commands, so that reading, verifying and writing count on both sides."""
# SPDX-License-Identifier: MIT
import argparse
import os
import sys
import tempfile

from command import bpfv, declare, paths_of, run, timed

SEQUENCES = ("dance", "chicken", "cow", "horse_gallop", "crane")
TARGETS = ("--kg 0.1", "--kg 0.5", "--sted 0.03", "--max-error 0.1%", "--max-error 0.2%", "--max-error 0.5%", "--psnr 60")
MEASURES = {"--kg": "kg", "--sted": "sted", "--max-error": "max_error_relative", "--psnr": "psnr"}
MOST = 4.0


def row(options, name, target, folder):
    motion, mesh = paths_of(options.data, name)
    encode = ["encode", motion, "--mesh", mesh, os.path.join(folder, "a.reel"), "--order", "free", "-y", "--threads", 1]
    found, search = min((timed(options.command, *encode, *target.split()) for _ in range(options.runs)), key=lambda r: r[1])
    once = ["--step", repr(found["step"]), "--bases", found["bases"]]
    one = min(timed(options.command, *encode, *once)[1] for _ in range(options.runs))
    return found, search, one


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    declare(parser)
    parser.add_argument("--target", action="append", help='such as "--kg 0.1"; may be repeated')
    parser.add_argument("--runs", type=int, default=2, help="the best of so many")
    parser.add_argument("sequences", nargs="*", help=f"default: {' '.join(SEQUENCES)}")
    options = parser.parse_args()
    worst = 0.0
    print("| sequence | target | reached | bpfv | K | search s | one encode s | ratio |\n|" + "---|" * 8)
    with tempfile.TemporaryDirectory() as folder:
        for name in options.sequences or SEQUENCES:
            if not paths_of(options.data, name):
                print(f"{name}: skipped, its data are not here", file=sys.stderr)
                continue
            for target in options.target or TARGETS:
                found, search, one = row(options, name, target, folder)
                worst = max(worst, search / one)
                print(f"| {name} | `{target}` | {found[MEASURES[target.split()[0]]]:.4f} | {bpfv(found):.4f} | {found['bases']} | "
                      f"{search:.2f} | {one:.2f} | {search / one:.1f}{' ABOVE' if search > MOST * one else ''} |", flush=True)
    print(f"\nthe dearest search: {worst:.1f} encodes (at most {MOST:g})")


if __name__ == "__main__":
    main()
