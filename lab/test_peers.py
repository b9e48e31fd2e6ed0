"""Tests of the peers: each gives back a made clip from its files only, in the order it was given, as near as it promises."""
# SPDX-License-Identifier: MIT
import os
import shutil
import subprocess
import tempfile
import unittest

try:
    import numpy
except ModuleNotFoundError as error:
    raise unittest.SkipTest("numpy is missing (Debian's python3-numpy)") from error

from clip import Clip
from peers.registry import PEERS, PeerError, find

HERE = os.path.dirname(os.path.abspath(__file__))
COMMAND = os.path.join(os.environ.get("MESHREEL_BUILD", os.path.join(HERE, "../build")), "meshreel")


def made_clip(folder, shape="walker", vertices=500, frames=12):
    mesh, motion = (os.path.join(folder, name) for name in ("mesh.obj", "motion.pc2"))
    subprocess.run([COMMAND, "generate", shape, motion, "--mesh-out", mesh, "--vertices", str(vertices), "--frames", str(frames), "-q"],
                   check=True)
    return Clip(shape, mesh, motion)


def sorted_corners(triangles):
    """Triangles as sets: a peer may turn them and write them in an order of its own, but not flip them."""
    turned = [tuple(numpy.roll(triangle, -int(numpy.argmin(triangle)))) for triangle in numpy.asarray(triangles)]
    return sorted(turned)


def round_trip(peer, clip, setting):
    """Bytes, positions and triangles: decoded in a folder of its own, from copies of the files that are counted."""
    with tempfile.TemporaryDirectory() as there, tempfile.TemporaryDirectory() as here, tempfile.TemporaryDirectory() as back:
        run = peer.encode(clip, setting, there)
        copies = [shutil.copy(path, here) for path in run.files]
        size = sum(os.path.getsize(path) for path in copies)
        shutil.rmtree(there)
        os.mkdir(there)
        out = peer.decode(copies, back)
        decoded = Clip(clip.name, clip.mesh, out.files[0])
        triangles = numpy.fromfile(os.path.join(back, "triangles.u32"), dtype="<u4").reshape(-1, 3)
        return size, numpy.array(decoded.positions), triangles


class Peers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.clip = made_clip(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def each(self, check, lossless=None):
        """A check for every peer of a kind; those that cannot run here are skipped by name."""
        for peer in PEERS:
            if lossless in (None, peer.lossless):
                with self.subTest(peer=peer.name):
                    if peer.missing():
                        self.skipTest(f"{peer.name}: {peer.missing()}")
                    check(peer)

    def test_names_are_told_apart_and_found(self):
        self.assertEqual([find(peer.name) for peer in PEERS], list(PEERS))
        self.assertRaises(PeerError, find, "nobody")

    def test_the_page_of_the_peers_has_them_all(self):
        with open(os.path.join(HERE, "../docs/peers.md"), encoding="utf-8") as file:
            page = file.read()
        self.assertEqual([peer.name for peer in PEERS if f"`{peer.name}`" not in page], [])

    def test_every_peer_gives_back_every_vertex_and_triangle_in_order(self):
        def check(peer):
            _, positions, triangles = round_trip(peer, self.clip, peer.ladder[-1])
            size = float(numpy.ptp(self.clip.positions.reshape(-1, 3), axis=0).max())
            self.assertLess(float(numpy.abs(positions - self.clip.positions).max()), 0.02 * size)
            self.assertEqual(sorted_corners(triangles), sorted_corners(self.clip.triangles))
        self.each(check)

    def test_files_that_were_cut_off_are_an_error(self):
        def check(peer):
            with tempfile.TemporaryDirectory() as there, tempfile.TemporaryDirectory() as back:
                run = peer.encode(self.clip, peer.ladder[0], there)
                os.truncate(run.files[0], os.path.getsize(run.files[0]) // 2)
                self.assertRaises(PeerError, peer.decode, run.files, back)
        self.each(check)

    def test_a_lossless_peer_gives_back_every_bit(self):
        def check(peer):
            _, positions, _ = round_trip(peer, self.clip, peer.ladder[0])
            self.assertEqual(positions.tobytes(), self.clip.positions.tobytes())
        self.each(check, lossless=True)

    def test_a_setting_keeps_what_it_promises_and_costs_more_the_finer_it_is(self):
        def check(peer):
            sizes = []
            for setting in peer.ladder[::max(1, len(peer.ladder) // 2)]:
                size, positions, _ = round_trip(peer, self.clip, setting)
                sizes.append(size)
                if peer.promise:
                    error = float(numpy.abs(positions.astype(float) - self.clip.positions).max())
                    self.assertLessEqual(error, peer.promise(self.clip, setting), setting)
            self.assertEqual(sizes, sorted(set(sizes)))
        self.each(check, lossless=False)


if __name__ == "__main__":
    unittest.main()
