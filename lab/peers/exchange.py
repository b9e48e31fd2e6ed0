"""Numbers to and from a peer's program: counts V, F, T, then the triangles, then F x V x 3 levels, 32 bits each."""
# SPDX-License-Identifier: MIT
import os
import shutil
import subprocess
import tempfile

import numpy

from .peer import PeerError

HERE = os.path.dirname(os.path.abspath(__file__))


def built(name):
    """A program of the lab's build."""
    return os.path.join(os.environ.get("MESHREEL_BUILD", os.path.join(HERE, "../../build")), name)


def missing_program(name):
    if os.access(built(name), os.X_OK):
        return ""
    return f"{name} is not built (tools/install.sh --with-peers, then cmake with -DMESHREEL_BUILD_LAB=ON)"


def missing_package(name):
    if not shutil.which("node"):
        return "node is not installed (tools/install.sh --with-peers)"
    if not os.path.isdir(os.path.join(HERE, "node_modules", name)):
        return f"npm's {name} is not installed (tools/install.sh --with-peers)"
    return ""


def script(name, *words):
    return ["node", os.path.join(HERE, name), *words]


def run(*command):
    """What a program prints: the codec's own seconds."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise PeerError(f"{' '.join(command[:3])}: {done.stderr.strip() or f'exit code {done.returncode}'}")
    return float(done.stdout)


def feed(command, target, triangles, levels):
    """Has a program write a file from triangles [T x 3] and levels [F x V x 3]; its seconds."""
    F, V, _ = levels.shape
    with tempfile.NamedTemporaryFile() as raw:
        for numbers in ((V, F, len(triangles)), triangles, levels):
            raw.write(numpy.ascontiguousarray(numbers, dtype="<i4").tobytes())
        raw.flush()
        return run(*command, raw.name, target)


def fetch(command, source, dtype="<i4"):
    """Triangles, numbers [F x V x 3] of a type of 32 bits, and seconds of a program that reads a file."""
    with tempfile.NamedTemporaryFile() as raw:
        seconds = run(*command, source, raw.name)
        numbers = numpy.fromfile(raw.name, dtype="<i4")
    V, F, T = numbers[:3]
    if len(numbers) != 3 + 3 * T + 3 * F * V:
        raise PeerError(f"{command[0]} gave {len(numbers)} numbers for {F} frames of {V} vertices and {T} triangles")
    return numbers[3:3 + 3 * T].reshape(T, 3), numbers[3 + 3 * T:].view(dtype).reshape(F, V, 3), seconds
