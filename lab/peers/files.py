"""The files around a peer: parts packed into one file, triangles and positions as a decoder gives them back."""
# SPDX-License-Identifier: MIT
import os
import struct

import numpy

from clip import write_pc2

from .peer import PeerError


def pack(path, parts):
    """Byte strings in one file: their number, their lengths, themselves."""
    with open(path, "wb") as file:
        file.write(struct.pack(f"<{len(parts) + 1}I", len(parts), *map(len, parts)))
        for part in parts:
            file.write(part)


def unpack(path):
    with open(path, "rb") as file:
        whole = file.read()
    count, = struct.unpack_from("<I", whole)
    lengths = struct.unpack_from(f"<{count}I", whole, 4)
    if 4 + 4 * count + sum(lengths) != len(whole):
        raise PeerError(f"{path}: {len(whole)} bytes, but its parts promise {4 + 4 * count + sum(lengths)}")
    parts, at = [], 4 + 4 * count
    for length in lengths:
        parts.append(whole[at:at + length])
        at += length
    return parts


def give_back(folder, positions, triangles):
    """What a decoder leaves: motion.pc2 [F x V x 3] and triangles.u32 [T x 3]. The list that a run returns."""
    motion = os.path.join(folder, "motion.pc2")
    write_pc2(motion, positions)
    numpy.ascontiguousarray(triangles, dtype="<u4").tofile(os.path.join(folder, "triangles.u32"))
    return [motion]
