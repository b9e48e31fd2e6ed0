#!/usr/bin/python3
"""What a .reel file means, as tests/golden/*.json has it.

SPDX-License-Identifier: MIT
"""

import json
import struct
import sys

import numpy

import attributes
import container
import decode
import levels
import reel


def digits(data):
    return f"{container.hash_of(data):016x}"


def words(numbers):
    return digits(struct.pack(f"<{len(numbers)}I", *numbers))


def of_triangles(triangles):
    return words([v for t in triangles for v in t])


def of_positions(positions):
    return digits(positions.astype("<f4").tobytes())


def of_attribute(a):
    width = attributes.WIDTHS[a.type]
    return {"name": a.name.decode(errors="replace"), "domain": attributes.DOMAINS[a.domain], "type": attributes.TYPES[a.type],
            "components": a.components, "normalized": bool(a.normalized), "value_count": a.count,
            "values": digits(b"".join(w.to_bytes(width, "little") for row in a.values for w in row)),
            "indices": None if a.indices is None else words(a.indices)}


def of_levels(file):
    """Of files in which each vertex has a trajectory of its own; the others' levels are the reader's business."""
    if file.codec != "reel" or file.V != file.W:
        return []
    top, (_, count, payload, at) = file.topology, file.segments[0]
    order, found = reel.order_of(container.Fields(payload, at, "SEGM"), top, count), []
    positions = decode.frames(file, relaxed=False) if len(order.counts()) > 1 else None
    for level in range(1, len(order.counts())):
        kept = set(levels.kept_of(order, level))
        vertices = [v for v, s in enumerate(top.surface_of) if s in kept]
        triangles = levels.coarse_triangles([tuple(top.surface_of[v] for v in t) for t in top.triangles], order.X,
                                            [top.surface_of[v] for v in vertices])
        found.append({"vertices": len(vertices), "triangle_count": len(triangles),
                      "triangles": of_triangles(triangles), "positions": of_positions(positions[:, vertices])})
    return found


def of(data, base=None):
    """@param base (V, triangles) of the base mesh, where the file needs one"""
    file = container.read(data, base)
    positions = decode.frames(file)
    meta = dict(file.meta or {"name": b"", "loop": 0, "up": 0, "metres_per_unit": 0.0, "fps": 0.0})
    meta["name"], meta["loop"] = meta["name"].decode(errors="replace"), bool(meta["loop"])
    return {"codec": file.codec, "order": ("keep", "free", "base")[file.order], "vertices": file.V,
            "coded_vertices": file.W, "triangle_count": file.T, "frames": file.F,
            "triangles": of_triangles(file.topology.triangles), "positions": of_positions(positions),
            "times": digits(numpy.array(file.times).astype("<f8").tobytes()), "meta": meta,
            "materials": [n.decode(errors="replace") for n in file.materials], "groups": [n.decode(errors="replace") for n in file.groups],
            "attributes": [of_attribute(a) for a in file.attributes],
            "assets": [{"name": a["name"].decode(errors="replace"), "mime_type": a["mime_type"].decode(errors="replace"), "size": len(a["data"]),
                        "bytes": digits(a["data"])} for a in file.assets],
            "levels": of_levels(file)}


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as stream:
        json.dump(of(stream.read()), sys.stdout, indent=1)
        print()
