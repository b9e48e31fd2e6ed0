#!/usr/bin/env python3
"""Hausdorff distance and RMS of two surfaces: processor time beside MeshLab's, for the same samples in the same run.

Two frames of 100 000 triangles; both directions; vertices, and as many samples of edges and of faces as --samples says.
One thread (MeshLab has no more), user time of whole commands, and less what the same command takes that only reads the
files: for MeshLab an empty script, for us a comparison of a frame with itself. The certified distance is timed too."""
# SPDX-License-Identifier: MIT
import argparse
import math
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile

from command import declare, timed

ROWS, COLUMNS = 226, 222
LEAST = 3.0
PARAMETERS = {"SaveSample": "false", "SampleVert": "true", "SampleEdge": "true", "SampleFauxEdge": "false", "SampleFace": "true"}


def write_bumpy_sphere(path, wave):
    """A sphere with a fine wave of that height; a binary PLY."""
    points, triangles = [], []
    for i in range(ROWS):
        down = math.pi * (i + 0.5) / ROWS
        for j in range(COLUMNS):
            around = 2 * math.pi * j / COLUMNS
            radius = 1 + 0.1 * math.sin(5 * down) * math.cos(4 * around) + wave * math.sin(37 * down + 3) * math.sin(41 * around)
            points.append([radius * x for x in (math.sin(down) * math.cos(around), math.sin(down) * math.sin(around), math.cos(down))])
    for i in range(ROWS - 1):
        for j in range(COLUMNS):
            a, b = i * COLUMNS + j, i * COLUMNS + (j + 1) % COLUMNS
            triangles += [(a, b, a + COLUMNS), (b, b + COLUMNS, a + COLUMNS)]
    with open(path, "wb") as file:
        file.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                   f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        file.write(b"".join(struct.pack("<3f", *p) for p in points))
        file.write(b"".join(struct.pack("<B3i", 3, *t) for t in triangles))
    return len(triangles)


def write_script(path, samples):
    """Both directions; without samples nothing at all."""
    with open(path, "w") as file:
        file.write("<!DOCTYPE FilterScript>\n<FilterScript>\n")
        for one, other in ((0, 1), (1, 0)) if samples else ():
            file.write('<filter name="Hausdorff Distance">\n')
            file.write(f'<Param type="RichMesh" name="SampledMesh" value="{one}"/><Param type="RichMesh" name="TargetMesh" value="{other}"/>\n')
            file.writelines(f'<Param type="RichBool" name="{name}" value="{value}"/>\n' for name, value in PARAMETERS.items())
            file.write(f'<Param type="RichInt" name="SampleNum" value="{samples}"/>\n')
            file.write('<Param type="RichAbsPerc" name="MaxDist" value="10" min="0" max="10"/></filter>\n')
        file.write("</FilterScript>\n")


def meshlab(folder, script):
    """User seconds, and for each direction samples, largest distance and RMS."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(["xvfb-run", "-a", "meshlabserver", "-i", "one.ply", "two.ply", "-s", script], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if done.returncode != 0:
        sys.exit("meshlabserver: " + done.stdout)
    found = {  # by the surface sampled: MeshLab says everything several times
        name: (int(count), float(largest), float(rms))
        for count, name, largest, rms in re.findall(r"Sampled (\d+) pts.*? on (\S+) .*?max ([\d.]+).*?RMS : ([\d.]+)", done.stdout, re.S)
    }
    return seconds, list(found.values())


def meshreel(options, folder, names, *more):
    one, two = (os.path.join(folder, name) for name in names)
    found, seconds = timed(options.command, "compare", one, two, "--metric", "hausdorff", "--threads", 1, *more)
    return seconds, {value["name"]: value["value"] for value in found["values"]}


def best(runs, work):
    return min((work() for _ in range(runs)), key=lambda result: result[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    declare(parser)
    parser.add_argument("--samples", type=int, default=1000000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    if not all(map(shutil.which, ("meshlabserver", "xvfb-run", "xauth"))):
        sys.exit("no meshlabserver with xvfb-run: tools/install.sh --with-meshlab")
    with tempfile.TemporaryDirectory() as folder:
        triangles = write_bumpy_sphere(os.path.join(folder, "one.ply"), 0.0)
        write_bumpy_sphere(os.path.join(folder, "two.ply"), 0.002)
        write_script(os.path.join(folder, "empty.mlx"), 0)
        write_script(os.path.join(folder, "full.mlx"), options.samples)
        theirs_reading = best(options.runs, lambda: meshlab(folder, "empty.mlx"))[0]
        theirs, found = best(options.runs, lambda: meshlab(folder, "full.mlx"))
        sampling = ("--set", f"hausdorff.sampling=1,hausdorff.samples={options.samples}")
        ours_reading = best(options.runs, lambda: meshreel(options, folder, ("one.ply", "one.ply")))[0]
        ours, values = best(options.runs, lambda: meshreel(options, folder, ("one.ply", "two.ply"), *sampling))
        exact, bounds = best(options.runs, lambda: meshreel(options, folder, ("one.ply", "two.ply"), "--set", "hausdorff.samples=1"))
    print(f"{triangles} triangles, {sum(count for count, _, _ in found)} samples of MeshLab's in both directions")
    print(f"largest  meshreel {values['hausdorff']:.6f}  MeshLab {max(row[1] for row in found):.6f}  "
          f"certified {bounds['hausdorff']:.9f} .. {bounds['hausdorff_upper']:.9f}")
    print(f"RMS      meshreel {values['surface_rms']:.6f}  MeshLab {max(row[2] for row in found):.6f} (of vertices and edges too)")
    print(f"seconds  meshreel {ours:.2f} - {ours_reading:.2f} for reading, MeshLab {theirs:.2f} - {theirs_reading:.2f}, "
          f"certified {exact:.2f} - {ours_reading:.2f}")
    ratio = (theirs - theirs_reading) / (ours - ours_reading)
    print(f"{ratio:.1f} times as fast as MeshLab (at least {LEAST:g}); whole commands {theirs / ours:.1f} times")
    if ratio < LEAST:
        sys.exit("too slow")


if __name__ == "__main__":
    main()
