#!/usr/bin/env python3
"""Makes an animation, encodes it, decodes it, measures what was lost, and prints one table: see ./demo --help."""
# SPDX-License-Identifier: MIT
import argparse
import json
import os
import subprocess
import sys

FPS = 25


def arguments():
    parser = argparse.ArgumentParser(prog="./demo", description="The whole road: generate, encode, decode, compare.")
    parser.add_argument("shape", nargs="?", default="cloth", help="what build/meshreel generate can make (default: cloth)")
    parser.add_argument("--vertices", type=int, default=5000)
    parser.add_argument("--frames", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--max-error", default="0.2%", help="largest error of any vertex (default: 0.2%% of the diagonal)")
    parser.add_argument("--out", default="demo-out", help="the folder to leave everything in (default: demo-out)")
    parser.add_argument("--command", default="build/meshreel", help=argparse.SUPPRESS)
    return parser.parse_args()


class Meshreel:
    """Runs verbs of the command; each gives its figures."""

    def __init__(self, command):
        self.command = os.path.abspath(command)

    def __call__(self, *verb_and_options):
        run = subprocess.run([self.command, *map(str, verb_and_options), "--json", "-q"], stdout=subprocess.PIPE, text=True)
        if run.returncode != 0:
            sys.exit(run.returncode)
        return json.loads(run.stdout)


def size(count):
    for unit, factor in (("MB", 1e6), ("kB", 1e3)):
        if count >= factor:
            return f"{count / factor:.2f} {unit}"
    return f"{count} bytes"


def table(rows):
    width = max(len(name) for name, _ in rows)
    value_width = max(len(value) for _, value in rows)
    print("-" * (width + value_width + 3))
    for name, value in rows:
        print(f"{name:<{width}}   {value:>{value_width}}")
    print("-" * (width + value_width + 3))


def main():
    options = arguments()
    meshreel = Meshreel(options.command)
    os.makedirs(options.out, exist_ok=True)
    mesh, original, reel, back, picture = (os.path.join(options.out, options.shape + ending) for ending in
                                           (".obj", ".pc2", ".reel", ".decoded.pc2", ".svg"))
    print(f"making {options.shape} ...", file=sys.stderr)
    made = meshreel("generate", options.shape, original, "--mesh", mesh, "--vertices", options.vertices,
                    "--frames", options.frames, "--fps", FPS, "--seed", options.seed, "-y")
    print("encoding ...", file=sys.stderr)
    encoded = meshreel("encode", original, "--mesh", mesh, "--fps", FPS, reel, "--max-error", options.max_error, "-y")
    decoded = meshreel("decode", reel, back, "-y")
    print("measuring ...", file=sys.stderr)
    compared = meshreel("compare", original, back, "--mesh", mesh, "--fps", FPS)
    meshreel("picture", original, reel, picture, "--mesh", mesh, "--fps", FPS, "--title",
             f"{options.shape}, {made['vertices']} vertices, {made['frames']} frames", "-y")
    metrics = compared["metrics"]
    values = made["frames"] * made["vertices"]
    table([("vertices V", str(made["vertices"])),
           ("triangles T", str(made["triangles"])),
           ("frames F", str(made["frames"])),
           ("original (float32 positions, triangles)", size(made["raw_bytes"])),
           ("encoded (the whole .reel file)", size(os.path.getsize(reel))),
           ("bits per frame and vertex", f"{8 * os.path.getsize(reel) / values:.3f}"),
           ("KG error", f"{metrics['kg']:.4f} %"),
           ("largest error, of the body diagonal", f"{metrics['max_error_relative']:.4f} %"),
           ("STED", f"{metrics['sted']:.6f}"),
           ("encoding", f"{encoded['encode_seconds']:.2f} s"),
           ("decoding", f"{decoded['decode_seconds']:.3f} s"),
           ("peak memory, encoding", size(encoded["peak_memory_bytes"])),
           ("peak memory, decoding", size(decoded["decode_peak_memory_bytes"]))])
    print(f"picture: {picture}   (original, decoded, and the error as colour; open it in a browser)")
    print(f"all files: {options.out}/")


if __name__ == "__main__":
    main()
