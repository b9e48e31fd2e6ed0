"""Finds the sequences of a plan: data at hand, or made by `meshreel generate`."""
# SPDX-License-Identifier: MIT
import os

from clip import Clip
from codings import options_of
from provenance import digest


class Sequences:
    """Clips by name, and their checksums. data: a folder a sequence, with mesh.obj and motion.pc2. made: where what is generated is kept."""

    def __init__(self, command, data, made):
        self.command, self.data, self.made, self.clips, self.checksums = command, data, made, {}, {}

    def find(self, name, how):
        """The clip, or None where its data are not here. how: {} or {shape = "cloth", vertices = 2500, ...}."""
        if name not in self.clips and (clip := self.generated(name, how) if how else self.at_hand(name)):
            self.clips[name], self.checksums[name] = clip, digest(clip.mesh, clip.motion)
        return self.clips.get(name)

    def at_hand(self, name):
        mesh, motion = (os.path.join(self.data, name, file) for file in ("mesh.obj", "motion.pc2"))
        return Clip(name, mesh, motion) if os.path.exists(mesh) and os.path.exists(motion) else None

    def generated(self, name, how):
        folder = os.path.join(self.made, name.replace(" ", "_"))
        os.makedirs(folder, exist_ok=True)
        mesh, motion = (os.path.join(folder, file) for file in ("mesh.obj", "motion.pc2"))
        settings = {key: value for key, value in how.items() if key != "shape"}
        self.command("generate", how["shape"], motion, "--mesh", mesh, *options_of(settings))
        return Clip(name, mesh, motion)
