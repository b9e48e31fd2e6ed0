#!/usr/bin/env python3
"""Sequences at the ends of what is usual: prints a table of docs/benchmarks.md. Very many vertices, very many frames, and, with
--lossless or --kg, more positions than memory. Times are processor time (user) of the whole command."""
# SPDX-License-Identifier: MIT
import argparse
import os
import tempfile

from command import declare, generated, print_table, timed

SEQUENCES = [("wave", 100, 50_000, ("--kg", 0.1)), ("cloth", 2_000_000, 30, ("--kg", 0.1)),
             ("cloth", 150_000, 2400, ("--kg", 0.1)), ("cloth", 150_000, 2400, ("--lossless",))]

COLUMNS = ["shape", "V", "F", "quality", "positions MB", "reel MB", "encode s", "peak MB", "decode s", "peak MB"]


def row(options, folder, sequence):
    shape, V, F, quality = sequence
    motion, mesh = generated(options, folder, shape, V, F)
    reel, back = os.path.join(folder, "m.reel"), os.path.join(folder, "b.pc2")
    encoding, encode_s = timed(options.command, "encode", motion, reel, "--mesh", mesh, *quality, "-e", options.effort,
                               "--fps", 25, "-y")
    os.remove(motion)
    decoding, decode_s = timed(options.command, "decode", reel, back, "-y")
    return [shape, V, F, " ".join(map(str, quality)), f"{12 * V * F / 1e6:.0f}", f"{encoding['reel_bytes'] / 1e6:.2f}",
            f"{encode_s:.1f}", f"{encoding['peak_memory_bytes'] / 1e6:.0f}", f"{decode_s:.1f}",
            f"{decoding['peak_memory_bytes'] / 1e6:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    declare(parser)
    parser.add_argument("--effort", type=int, default=1)
    parser.add_argument("--most", type=float, default=1e12, help="leave out sequences of more vertices times frames")
    parser.add_argument("--folder", help="where the files go for a while: 9 GB for the largest")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        print_table(COLUMNS, (row(options, folder, of) for of in SEQUENCES if of[1] * of[2] <= options.most))


if __name__ == "__main__":
    main()
