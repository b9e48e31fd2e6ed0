#!/usr/bin/env python3
"""Sequences at the ends of what is usual: prints a table of docs/benchmarks.md. Very many vertices, very many frames, and, with
--lossless or --kg, more positions than memory. Times are processor time (user) of the whole command."""
# SPDX-License-Identifier: MIT
import argparse
import os
import tempfile

from command import declare, timed

SEQUENCES = [("wave", 100, 50_000, ("--kg", 0.1)), ("cloth", 2_000_000, 30, ("--kg", 0.1)),
             ("cloth", 150_000, 2400, ("--kg", 0.1)), ("cloth", 150_000, 2400, ("--lossless",))]


def row(command, sequence, effort, folder):
    shape, V, F, quality = sequence
    mesh, motion, reel, back = (os.path.join(folder, name) for name in ("m.obj", "m.pc2", "m.reel", "b.pc2"))
    timed(command, "generate", shape, motion, "--mesh", mesh, "--vertices", V, "--frames", F, "-y")
    encoding, encode_s = timed(command, "encode", motion, reel, "--mesh", mesh, *quality, "-e", effort, "--fps", 25, "-y")
    os.remove(motion)
    decoding, decode_s = timed(command, "decode", reel, back, "-y")
    for path in (mesh, reel, back):
        os.remove(path)
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
    columns = ["shape", "V", "F", "quality", "positions MB", "reel MB", "encode s", "peak MB", "decode s", "peak MB"]
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns))
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        for sequence in SEQUENCES:
            if sequence[1] * sequence[2] <= options.most:
                print("| " + " | ".join(map(str, row(options.command, sequence, options.effort, folder))) + " |", flush=True)


if __name__ == "__main__":
    main()
