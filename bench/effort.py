#!/usr/bin/env python3
"""Encodes animations at every effort and writes the table of docs/effort.md: see --help.

Generated animations, so that anyone can make the table; real sequences where the folder of --data has them. Times are
processor seconds of one thread, the best of several.
"""
# SPDX-License-Identifier: MIT
import argparse
import os
import sys
import tempfile

from command import ROOT, declare, paths_of, timed

GENERATED = {"generated cloth": ["cloth", "--vertices", "4000", "--frames", "150"],
             "generated swimmer": ["swimmer", "--vertices", "4000", "--frames", "150"]}
REAL = ["dance", "cow"]
PAGE = os.path.join(ROOT, "docs/effort.md")
BEGIN, END = "<!-- made by bench/effort.py: begin -->\n", "<!-- end -->\n"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    declare(parser)
    parser.add_argument("--kg", default="0.1")
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--write", action="store_true", help="put the table into docs/effort.md")
    return parser.parse_args()


def measured(options, folder, motion, how):
    reel, back = os.path.join(folder, "a.reel"), os.path.join(folder, "b.pc2")
    encode = ["encode", *motion, reel, "-y", "--order", "free", "--kg", options.kg, "--threads", "1", *how]
    encodes = [timed(options.command, *encode) for _ in range(options.runs)]
    decodes = [timed(options.command, "decode", reel, back, "-y", "--threads", "1")[1] for _ in range(options.runs)]
    return encodes[0][0]["bpfv"], min(seconds for _, seconds in encodes), min(decodes)


def sources(options, folder):
    for name, words in GENERATED.items():
        path = os.path.join(folder, words[0])
        timed(options.command, "generate", words[0], path + ".pc2", "--mesh", path + ".obj", *words[1:])
        yield name, [path + ".pc2", "--mesh", path + ".obj"]
    for name in REAL:
        if paths := paths_of(options.data, name):
            yield name, [paths[0], "--mesh", paths[1]]


def main():
    options = arguments()
    text = ""
    with tempfile.TemporaryDirectory() as folder:
        for name, motion in sources(options, folder):
            text += f"\n{name} | bits a frame and vertex | encoding, s | decoding, s\n---|---|---|---\n"
            for how in [["-e", str(effort)] for effort in range(1, 10)] + [["--fast-decode"]]:
                rate, encoding, decoding = measured(options, folder, motion, how)
                text += f"`{' '.join(how)}` | {rate:.4f} | {encoding:.2f} | {decoding:.2f}\n"
                print(text.splitlines()[-1], flush=True)
    if options.write:
        with open(PAGE, encoding="utf-8") as file:
            page = file.read()
        head, rest = page.split(BEGIN)
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write(head + BEGIN + text + "\n" + END + rest.split(END)[1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
