#!/usr/bin/python3
"""The second decoder agrees with the first on every golden file, bit for bit.

SPDX-License-Identifier: MIT
"""

import json
import sys
import unittest
from pathlib import Path

import numpy

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import container  # noqa: E402
import levels  # noqa: E402
import meaning  # noqa: E402
import reel  # noqa: E402
from coding import Damaged  # noqa: E402

GOLDEN = HERE.parent / "tests" / "golden"


def mesh_of(name):
    file = container.read((GOLDEN / f"{name}.reel").read_bytes())
    return file.V, file.topology.triangles


class GoldenFiles(unittest.TestCase):
    """A test a file, made below."""


class Levels(unittest.TestCase):
    def test_a_payload_that_ends_with_a_level_gives_that_level_bit_for_bit(self):
        file = container.read((GOLDEN / "reel_v1_levels_cloth.reel").read_bytes())
        _, count, payload, at = file.segments[0]
        fields = container.Fields(payload, at, "SEGM")
        whole = reel.Payload(container.Fields(payload, at, "SEGM"), count, file.W)
        C = numpy.array(reel.open_payload(fields, file.topology, count)[2])
        order = reel.order_of(container.Fields(payload, at, "SEGM"), file.topology, count)
        for keep, end in enumerate(whole.level_ends[:-1], 1):
            cut = payload[:len(payload) - len(whole.level_bits) + end]
            part = reel.open_payload(container.Fields(cut, at, "SEGM"), file.topology, count, keep)
            kept = levels.kept_of(order, len(whole.level_ends) - keep)
            self.assertEqual(part[2][kept].tobytes(), C[kept].tobytes())


class Damage(unittest.TestCase):
    def test_every_truncation_of_a_small_file_names_byte_and_field(self):
        data = (GOLDEN / "reel_v1_keep_tetrahedron.reel").read_bytes()
        for size in range(len(data)):
            with self.assertRaisesRegex(Damaged, r"^byte \d+: \S+: "):
                container.read(data[:size])

    def test_every_flipped_bit_of_a_small_file_is_noticed(self):
        data = (GOLDEN / "reel_v1_keep_tetrahedron.reel").read_bytes()
        for bit in range(8 * len(data)):
            flipped = bytearray(data)
            flipped[bit // 8] ^= 1 << bit % 8
            with self.assertRaises(Damaged):
                container.read(bytes(flipped))


def same_as_golden(name):
    def test(self):
        expected = json.loads((GOLDEN / f"{name}.json").read_text())
        base = mesh_of(expected.pop("base")) if "base" in expected else None
        found = meaning.of((GOLDEN / f"{name}.reel").read_bytes(), base)
        if expected["vertices"] != expected["coded_vertices"]:
            expected["levels"] = []
        self.assertEqual(found, expected)
    return test


for path in sorted(GOLDEN.glob("*.reel")):
    setattr(GoldenFiles, f"test_{path.stem}_means_what_the_first_decoder_says", same_as_golden(path.stem))

if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    print(f"{outcome.testsRun} tests, {len(outcome.failures) + len(outcome.errors)} failed")
    sys.exit(not outcome.wasSuccessful())
