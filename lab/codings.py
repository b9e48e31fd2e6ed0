"""The codecs of meshreel and the peers behind one face: encode a clip, decode its files, each with its own processor seconds."""
# SPDX-License-Identifier: MIT
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types
from dataclasses import dataclass, field
from functools import cached_property

from clip import Clip
from provenance import digest

PEERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers")


class CodingError(Exception):
    """A coding that gave nothing; the sentence is the program's."""


@dataclass
class Files:
    """What an encoding left, and what it told."""
    paths: list
    seconds: float
    told: dict = field(default_factory=dict)

    @property
    def size(self):
        return sum(os.path.getsize(path) for path in self.paths)


def options_of(settings):
    """Options of the command: {"kg": 0.1, "fast-decode": true} is --kg 0.1 --fast-decode."""
    words = []
    for name, value in settings.items():
        words += [f"--{name}"] if value is True else [] if value is False else [f"--{name}", str(value)]
    return words


class Command:
    """The meshreel command of one build."""

    def __init__(self, path):
        self.path, self.identity = path, digest(path)[:16]

    def __call__(self, verb, *words):
        """What a verb prints as JSON."""
        done = subprocess.run([self.path, verb, *map(str, words), "--json", "-q", *(() if verb == "compare" else ("-y",))],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            raise CodingError(done.stderr.strip() or f"meshreel {verb}: exit code {done.returncode}")
        return json.loads(done.stdout)

    @cached_property
    def measuring(self):
        """What tells its measures from another build's: what they say of a small animation and its copy with noise. So a change of a
        codec does not make all peers be measured again."""
        with tempfile.TemporaryDirectory() as folder:
            clip, noisy = Clip("", f"{folder}/a.obj", f"{folder}/a.pc2"), f"{folder}/b.pc2"
            self("generate", "cloth", clip.motion, "--mesh", clip.mesh, "--vertices", 200, "--frames", 12)
            self("distort", clip.motion, "--mesh", clip.mesh, noisy, "noise-vertex-frame", "--amount", "0.5%")
            found = self("compare", clip.motion, noisy, "--mesh", clip.mesh)["metrics"]
        return hashlib.sha256(json.dumps(found, sort_keys=True).encode()).hexdigest()[:16]

    def making(self, points):
        """What tells its files from another build's: those of two small animations with these settings. So a change of a codec does not
        have all others measured again. One is relaxed at small errors, one is not."""
        whole = hashlib.sha256()
        with tempfile.TemporaryDirectory() as folder:
            for shape, vertices, frames in (("cloth", 300, 30), ("snake", 400, 40)):
                clip, reel = Clip("", f"{folder}/a.obj", f"{folder}/a.pc2"), f"{folder}/a.reel"
                self("generate", shape, clip.motion, "--mesh", clip.mesh, "--vertices", vertices, "--frames", frames)
                for point in points:
                    self("encode", clip.motion, "--mesh", clip.mesh, reel, *options_of(point))
                    whole.update(digest(reel).encode())
        return whole.hexdigest()[:16]

    def compare(self, clip, decoded, measures, order):
        """The values asked for, with their titles, units and directions."""
        found = self("compare", clip.motion, decoded, "--mesh", clip.mesh, "--metric", ",".join(measures), "--order", order)
        about = {value["name"]: value for value in found["values"]}
        return {name: {key: about[name][key] for key in ("value", "title", "unit", "better")} for name in measures}


class Codec:
    """A codec of meshreel."""
    counts = "the whole .reel file"
    lossless = False

    def __init__(self, command, points, fresh=False):
        """points: of its curve. fresh: what another build measured does not count, though it made the same files."""
        self.command, self.ends, self.fresh = command, (points[0], points[-1]), fresh

    @cached_property
    def identity(self):
        return self.command.identity if self.fresh else self.command.making(self.ends)

    def missing(self):
        return ""

    def encode(self, clip, point, folder):
        reel = os.path.join(folder, "x.reel")
        told = self.command("encode", clip.motion, "--mesh", clip.mesh, reel, *options_of(point))
        kept = {key: told[key] for key in ("bases", "step", "effort", "peak_memory_bytes")}
        return Files([reel], told["encode_processor_seconds"], {**kept, "program": self.command.identity})

    def decode(self, files, point, folder):
        back = os.path.join(folder, "x.pc2")
        threads = ["--threads", point["threads"]] if "threads" in point else []
        return back, self.command("decode", *files, back, *threads)["decode_processor_seconds"]


class PeerCodec:
    """A peer of lab/peers."""

    def __init__(self, peer):
        self.peer, self.counts, self.lossless = peer, peer.counts, peer.lossless
        self.missing, self.version = peer.missing, version_of(peer)
        self.identity = f"{peer.name} {self.version} {digest(*code_of(sys.modules[peer.encode.__module__]))[:16]}"

    def encode(self, clip, point, folder):
        run = self.peer.encode(clip, point, folder)
        return Files(list(run.files), run.seconds)

    def decode(self, files, _point, folder):
        back = os.path.join(folder, "back")
        os.makedirs(back, exist_ok=True)
        run = self.peer.decode(files, back)
        return next(path for path in run.files if str(path).endswith(".pc2")), run.seconds


def code_of(module):
    """The files that a peer is made of: its module, what that uses of lab/peers, and all programs there that are not Python."""
    found, open_ = set(), [module]
    while open_:
        one = open_.pop()
        found.add(one.__file__)
        used = [value if isinstance(value, types.ModuleType) else sys.modules.get(getattr(value, "__module__", None)) for value in vars(one).values()]
        open_ += [other for other in used if other and (getattr(other, "__file__", None) or "").startswith(PEERS) and other.__file__ not in found]
    return sorted(found | {os.path.join(PEERS, name) for name in os.listdir(PEERS) if name.endswith((".mjs", ".cpp", ".json"))})


def asked(*words):
    """The first line of what a command says; nothing where there is no such command."""
    if not shutil.which(words[0]):
        return ""
    said = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.strip()
    return said.splitlines()[0].strip(" *") if said else ""


def version_of(peer):
    """The peer's source, and what is found where it says that versions are asked for: dpkg -s, X --version, package.json."""
    found = [asked("dpkg-query", "-W", "-f", "${Package} ${Version}", name) for name in re.findall(r"dpkg -s ([\w.+-]+)", peer.source)]
    found += [asked(name, "--version") for name in re.findall(r"([\w.+-]+) --version", peer.source)]
    if "package.json" in peer.source:
        with open(os.path.join(PEERS, "package.json"), encoding="utf-8") as file:
            pinned = json.load(file).get("dependencies", {})
        found += [f"{name} {version}" for name, version in pinned.items() if name in peer.source]
    return ", ".join([peer.source.split(" (")[0], *filter(None, found)])


def peers_here():
    """All peers; none where numpy or the peers are not installed."""
    try:
        from peers import registry
    except ImportError:
        return ()
    return registry.PEERS
