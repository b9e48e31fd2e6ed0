"""The meshreel command as the benches run it: its figures, its processor time, the real sequences."""
# SPDX-License-Identifier: MIT
import json
import os
import resource
import subprocess
import sys

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def declare(parser):
    """The options that every bench has."""
    parser.add_argument("--command", default=os.path.join(ROOT, "build/meshreel"))
    parser.add_argument("--data", default=os.path.join(ROOT, "../shared/data"))


def timed(command, *options):
    """What the command says, and the processor seconds that it took (user): a busy machine does not stretch them."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([command, *map(str, options), "--json", "-q"], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, options))}: exit code {done.returncode}")
    return json.loads(done.stdout), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def run(command, *options):
    """What the command says."""
    return timed(command, *options)[0]


def print_table(columns, rows):
    """A table as Markdown, each row as soon as it is there."""
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns), flush=True)
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |", flush=True)


def generated(options, folder, shape, V, F):
    """A made sequence; its point cache and its mesh."""
    motion, mesh = os.path.join(folder, "m.pc2"), os.path.join(folder, "m.obj")
    run(options.command, "generate", shape, motion, "--mesh", mesh, "--vertices", V, "--frames", F, "-y")
    return motion, mesh


def paths_of(data, name):
    """The point cache and the mesh of a real sequence; None where it is not here."""
    motion, mesh = (os.path.join(data, name, file) for file in ("motion.pc2", "mesh.obj"))
    return (motion, mesh) if os.path.exists(motion) else None


def bpfv(figures):
    """Bits of the whole file a frame and vertex (9.1)."""
    return 8 * figures["reel_bytes"] / (figures["vertices"] * figures["frames"])
