"""Runs rows of plans through the built programs, remembers what they gave, and says what made it."""
# SPDX-License-Identifier: MIT
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time

import provenance
from codings import Command
from provenance import digest
from sequences import Sequences


def sizes_of_fields(lines):
    """Bytes of the fields that `explain` prints, summed over segments: {"basis_bits": 27338, ...}."""
    sizes = {}
    for line in lines:
        words = line.split()
        if len(words) > 2 and words[2].startswith("SEGM.payload."):
            name = words[2].removeprefix("SEGM.payload.")
            sizes[name] = sizes.get(name, 0) + int(words[1])
            if name == "basis_size":  # reel has all its bits in one field
                sizes["basis_bits"] = sizes.get("basis_bits", 0) + int(words[3])
    if "bits" in sizes:
        sizes["residual_bits"] = sizes.pop("bits") - sizes["basis_bits"]
    return sizes


class Bench:
    """The programs of one build and the sequences at hand. Figures are kept by row, programs and data in a folder, so
    that a run that was interrupted goes on where it was."""

    def __init__(self, root, build, data, cache):
        self.root, self.cache = root, cache
        self.command, self.lab = os.path.join(build, "meshreel"), os.path.join(build, "meshreel-lab")
        self.programs = digest(self.command, self.lab)
        self.about = json.loads(subprocess.check_output([self.lab, "about"], text=True))
        self.sequences = Sequences(Command(self.command), data, os.path.join(cache, "made"))
        self.seconds, self.fresh = 0.0, 0

    def missing(self, row):
        """Why a row cannot be measured here, or nothing."""
        if not self.sequences.find(row.sequence, row.made):
            return f"{row.sequence}: its data are not here"
        codec = row.settings.get("codec")
        if codec and codec not in self.about["codecs"]:
            return f"{codec}: this meshreel has no such codec"
        return None

    def figures(self, row):
        """What a row gives, measured now or remembered."""
        clip = self.sequences.find(row.sequence, row.made)
        asked = json.dumps([row.measure, row.settings, self.programs, self.sequences.checksums[row.sequence]])
        kept = os.path.join(self.cache, hashlib.sha256(asked.encode()).hexdigest() + ".json")
        if not os.path.exists(kept):
            self.measure(row, clip.motion, clip.mesh, kept)
        with open(kept, encoding="utf-8") as file:
            known = json.load(file)
        self.seconds += known["seconds"]
        return known["figures"]

    def measure(self, row, motion, mesh, kept):
        print(f"{row.measure} {row.sequence} {row.name or ''}", end=" ", file=sys.stderr, flush=True)
        start = time.monotonic()
        if row.measure == "encode":
            figures = self.encode(row.settings, motion, mesh)
        else:
            asked = json.dumps({"motion": motion, "mesh": mesh, **row.settings})
            figures = json.loads(self.run(self.lab, row.measure, asked))
        seconds = time.monotonic() - start
        print(f"{seconds:.1f} s", file=sys.stderr)
        self.fresh += 1
        os.makedirs(self.cache, exist_ok=True)
        with open(kept + ".part", "w", encoding="utf-8") as file:
            json.dump({"row": row.settings, "seconds": seconds, "figures": figures}, file)
        os.replace(kept + ".part", kept)

    def encode(self, settings, motion, mesh):
        """A file of the command, with the sizes of its parts."""
        options = [word for name, value in settings.items() for word in (f"--{name}", str(value))]
        with tempfile.TemporaryDirectory() as folder:
            reel = os.path.join(folder, "x.reel")
            figures = json.loads(self.run(self.command, "encode", motion, "--mesh", mesh, reel, "--order", "free", *options,
                                          "--json", "-q"))
            explained = json.loads(self.run(self.command, "explain", reel, "--json"))
            chunks = json.loads(self.run(self.command, "info", reel, "--json"))["chunks"]
        figures["connectivity_bytes"] = sum(chunk["size"] for chunk in chunks if chunk["type"] == "CONN")
        return {**figures, **{f"{name}_bytes": size for name, size in sizes_of_fields(explained["lines"]).items()}}

    def run(self, *words):
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(words)}\n{done.stderr}exit code {done.returncode}")
        return done.stdout

    def provenance(self):
        """Lines that say what made the figures."""
        lines = [f"commit {provenance.commit(self.root)}", f"compiler {self.about['compiler']}, flags{self.about['flags']}",
                 f"programs sha256 {self.programs[:16]}"]
        return lines + [f"{name} sha256 {sum_[:16]}" for name, sum_ in sorted(self.sequences.checksums.items())]
