"""A GLB file with one mesh, morph targets and one animation of their weights: what gltfpack is given."""
# SPDX-License-Identifier: MIT
import json
import struct

import numpy

FLOAT, UNSIGNED = 5126, 5125


class Writer:
    """The binary chunk and its accessors."""

    def __init__(self):
        self.bytes, self.views, self.accessors = bytearray(), [], []

    def add(self, array, kind, component, bounds=False):
        accessor = {"bufferView": len(self.views), "componentType": component, "count": len(array), "type": kind}
        if bounds:
            accessor |= {"min": numpy.atleast_1d(array.min(axis=0)).tolist(), "max": numpy.atleast_1d(array.max(axis=0)).tolist()}
        raw = numpy.ascontiguousarray(array).tobytes()
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(raw)})
        self.accessors.append(accessor)
        self.bytes += raw
        return len(self.accessors) - 1


def build(triangles, base, targets, weights, fps=30.0):
    """base [V x 3], targets [K x V x 3], weights [F x K]; a vertex keeps its number in the attribute _ID."""
    out = Writer()
    base, targets, weights = (numpy.asarray(array, dtype="<f4") for array in (base, targets, weights))
    attributes = {"POSITION": out.add(base, "VEC3", FLOAT, bounds=True),
                  "_ID": out.add(numpy.arange(len(base), dtype="<u4"), "SCALAR", UNSIGNED)}
    morphs = [{"POSITION": out.add(target, "VEC3", FLOAT, bounds=True)} for target in targets]
    indices = out.add(numpy.asarray(triangles, dtype="<u4").reshape(-1), "SCALAR", UNSIGNED)
    sampler = {"input": out.add((numpy.arange(len(weights)) / fps).astype("<f4"), "SCALAR", FLOAT, bounds=True),
               "output": out.add(weights.reshape(-1), "SCALAR", FLOAT), "interpolation": "LINEAR"}
    primitive = {"attributes": attributes, "indices": indices, "targets": morphs}
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive], "weights": [0.0] * len(targets)}],
        "animations": [{"samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}],
        "accessors": out.accessors, "bufferViews": out.views, "buffers": [{"byteLength": len(out.bytes)}]}
    return container(json.dumps(document, separators=(",", ":")).encode(), bytes(out.bytes))


def container(text, binary):
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
