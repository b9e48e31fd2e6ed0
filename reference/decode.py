"""decode.py FILE: what a .reel file holds, as docs/format.md says it.

SPDX-License-Identifier: MIT
"""

import sys

import numpy

import container
import pca
import reel


def frames(file):
    """Positions [F, V, 3] in float32."""
    parts = []
    for first, count, payload, at in file.segments:
        fields = container.Fields(payload, at, "SEGM")
        if file.codec in ("coddyac", "na", "lsp", "rbfp"):
            posed = pca.frames_of(*pca.open_payload(fields, file.codec, file.topology, count))
        elif file.codec == "reel":
            posed = pca.frames_of(*reel.open_payload(fields, file.topology, count))
        else:
            raise container.Damaged(21, "HEAD.codec", f"{file.codec!r} is not known")
        parts.append(posed.astype(numpy.float32))
    return numpy.concatenate(parts)[:, file.topology.surface_of, :]


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as stream:
        file = container.read(stream.read())
    positions = frames(file)
    print(f"{container.hash_of(positions.astype('<f4').tobytes()):016x}")
