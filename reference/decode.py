"""The frames of a .reel file, as docs/format.md says it.

SPDX-License-Identifier: MIT
"""

import numpy

import container
import lossless
import pca
import reel


def posed(codec, fields, topology, count, relaxed):
    """Positions of a segment's surface vertices, [F, W, 3] in float64, before they are rounded."""
    if codec == "lossless":
        return lossless.frames_of(fields, topology, count, lambda name, part: guessed(name, part, topology, count))
    return guessed(codec, fields, topology, count, relaxed)


def guessed(codec, fields, topology, count, relaxed=True):
    if codec == "reel":
        return pca.frames_of(*reel.open_payload(fields, topology, count, relaxed=relaxed))
    if codec == "coddyac" or codec in pca.PREDICTORS:
        return pca.frames_of(*pca.open_payload(fields, codec, topology, count))
    return fields.refuse("codec", f"{codec!r} is no codec that this reader knows")


def frames(file, relaxed=True):
    """Positions [F, V, 3] in float32; not relaxed: as levels of detail have them."""
    parts = []
    for _, count, payload, at in file.segments:
        fields = container.Fields(payload, at, "SEGM")
        with numpy.errstate(all="ignore"):
            parts.append(posed(file.codec, fields, file.topology, count, relaxed).astype(numpy.float32))
        if not numpy.isfinite(parts[-1]).all():
            fields.refuse("payload", "a position is not finite", 0)
    return numpy.concatenate(parts)[:, file.topology.surface_of, :]
