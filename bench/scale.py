#!/usr/bin/env python3
"""How the cost of encoding and decoding grows with V and with F, on generated sequences: prints the table of
docs/benchmarks.md. Times are processor time (user) of the whole command on one thread, input and output included; peaks are
of the whole process."""
# SPDX-License-Identifier: MIT
import argparse
import os
import tempfile

from command import declare, timed

GROWING_V = [("cloth", V, 30) for V in (10_000, 50_000, 100_000, 500_000)]
GROWING_F = [("walker", 2_500, F) for F in (250, 500, 1000, 2000)] + [("walker", 10_000, F) for F in (500, 1000, 2000)]


def row(command, sequence, effort, folder):
    shape, V, F = sequence
    mesh, motion, reel, back = (os.path.join(folder, name) for name in ("m.obj", "m.pc2", "m.reel", "b.pc2"))
    timed(command, "generate", shape, motion, "--mesh", mesh, "--vertices", V, "--frames", F, "-y")
    encoding, encode_s = timed(command, "encode", motion, reel, "--mesh", mesh, "--kg", 0.1, "-e", effort, "--threads", 1,
                             "--fps", 25, "-y")
    decoding, decode_s = timed(command, "decode", reel, back, "--threads", 1, "-y")
    information, _ = timed(command, "info", reel)
    segments = sum(chunk["type"] == "SEGM" for chunk in information["chunks"])
    for path in (mesh, motion, reel, back):
        os.remove(path)
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
    columns = ["shape", "V", "F", "segments", "K", "positions MB", "bpfv", "encode s", "ns a vertex and frame", "peak MB",
               "decode s", "ns a vertex and frame", "peak MB"]
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    with tempfile.TemporaryDirectory() as folder:
        for sequence in GROWING_V + GROWING_F:
            if sequence[1] * sequence[2] <= options.most:
                print("| " + " | ".join(map(str, row(options.command, sequence, options.effort, folder))) + " |", flush=True)


if __name__ == "__main__":
    main()
