#!/usr/bin/env python3
"""Encodes every real sequence without loss, beside fpzip, zfp, zstd and xz on the same float32; checks each file bit for bit."""
# SPDX-License-Identifier: MIT
import argparse
import os
import shutil
import subprocess
import sys
import tempfile

from command import declare, paths_of, run

SEQUENCES = ("bone", "chicken", "cloth", "cow", "crane", "dance", "dolphin", "flag", "horse_gallop", "snake", "walker")
HEADER = 32  # bytes before the positions of a PC2 file


def rivals(V, F):
    """Name and command of everything that codes a file of F V 3 float32; output on standard output."""
    flat, deep = ["-2", 3 * V, F], ["-3", 3, V, F]
    return {"zstd": [["zstd", "-19", "-q", "-c", "RAW"]], "xz": [["xz", "-c", "RAW"]],
            "fpzip": [["fpzip", "-q", "-i", "RAW", *layout] for layout in (flat, deep)],
            "zfp": [["zfp", "-q", "-f", "-i", "RAW", *layout, "-R", "-z", "-"] for layout in (flat, deep)]}


def size_of(command, raw):
    words = [raw if word == "RAW" else str(word) for word in command]
    return len(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout)


def measure(name, options, folder):
    motion, mesh = paths_of(options.data, name)
    reel, back = os.path.join(folder, "a.reel"), os.path.join(folder, "a.pc2")
    figures = run(options.command, "encode", motion, "--mesh", mesh, reel, "--lossless", "-y")
    decoding = run(options.command, "decode", reel, back, "-y")
    with open(motion, "rb") as file, open(back, "rb") as other:
        raw = file.read()[HEADER:]
        if other.read()[HEADER:] != raw:
            sys.exit(f"{name}: not every bit came back")
    free = run(options.command, "encode", motion, "--mesh", mesh, reel, "--lossless", "-y", "--order", "free")
    V, F = figures["vertices"], figures["frames"]
    raw_path = os.path.join(folder, "raw")
    with open(raw_path, "wb") as file:
        file.write(raw)
    sizes = {"ours": free["reel_bytes"], "order kept": figures["reel_bytes"]}
    for rival, commands in rivals(V, F).items():
        if shutil.which(rival):
            sizes[rival] = min(size_of(command, raw_path) for command in commands)
    rates = {key: 8 * size / (V * F) for key, size in sizes.items()}  # (9.1)
    return rates, figures["encode_seconds"], decoding["decode_seconds"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    declare(parser)
    parser.add_argument("sequences", nargs="*", help="default: all")
    options = parser.parse_args()
    columns = ("ours", "order kept", "fpzip", "zfp", "zstd", "xz")
    print("| sequence | " + " | ".join(columns) + " | encode s | decode s |\n|" + "---|" * (len(columns) + 3))
    beaten = True
    with tempfile.TemporaryDirectory() as folder:
        for name in options.sequences or SEQUENCES:
            if not paths_of(options.data, name):
                print(f"{name}: skipped, its data are not here")
                continue
            rates, encode_s, decode_s = measure(name, options, folder)
            cells = [f"{rates[c]:.2f}" if c in rates else "" for c in columns]
            print(f"| {name} | " + " | ".join(cells) + f" | {encode_s:.1f} | {decode_s:.1f} |", flush=True)
            beaten = beaten and all(rates["order kept"] < rates[c] for c in columns[2:] if c in rates)
    return 0 if beaten else 1


if __name__ == "__main__":
    sys.exit(main())
