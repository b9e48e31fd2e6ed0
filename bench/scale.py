#!/usr/bin/env python3
"""How the cost of encoding and decoding grows with V and with F, on generated sequences: prints the table of
docs/benchmarks.md. Times are processor time (user) of the whole command on one thread, input and output included; peaks are
of the whole process."""
# SPDX-License-Identifier: MIT
import argparse
import os
import tempfile

from command import declare, generated, print_table, run, timed

GROWING_V = [("cloth", V, 30) for V in (10_000, 50_000, 100_000, 500_000)]
GROWING_F = [("walker", 2_500, F) for F in (250, 500, 1000, 2000)] + [("walker", 10_000, F) for F in (500, 1000, 2000)]

COLUMNS = ["shape", "V", "F", "segments", "K", "positions MB", "bpfv", "encode s", "ns a vertex and frame", "peak MB",
           "decode s", "ns a vertex and frame", "peak MB"]


def row(options, folder, sequence):
    shape, V, F = sequence
    motion, mesh = generated(options, folder, shape, V, F)
    reel, back = os.path.join(folder, "m.reel"), os.path.join(folder, "b.pc2")
    encoding, encode_s = timed(options.command, "encode", motion, reel, "--mesh", mesh, "--kg", 0.1, "-e", options.effort,
                               "--threads", 1, "--fps", 25, "-y")
    decoding, decode_s = timed(options.command, "decode", reel, back, "--threads", 1, "-y")
    segments = sum(chunk["type"] == "SEGM" for chunk in run(options.command, "info", reel)["chunks"])
    each = 1e9 / (V * F)
    return [shape, V, F, segments, encoding["bases"], f"{12 * V * F / 1e6:.0f}", f"{encoding['bpfv']:.3f}", f"{encode_s:.1f}",
            f"{encode_s * each:.0f}", f"{encoding['peak_memory_bytes'] / 1e6:.0f}", f"{decode_s:.1f}", f"{decode_s * each:.0f}",
            f"{decoding['peak_memory_bytes'] / 1e6:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    declare(parser)
    parser.add_argument("--effort", type=int, default=2)
    parser.add_argument("--most", type=float, default=1e9, help="leave out sequences of more vertices times frames")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        print_table(COLUMNS, (row(options, folder, of) for of in GROWING_V + GROWING_F if of[1] * of[2] <= options.most))


if __name__ == "__main__":
    main()
