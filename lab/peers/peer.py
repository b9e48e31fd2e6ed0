"""What a peer is, and what one run of it gives."""
# SPDX-License-Identifier: MIT
import time
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Callable


class PeerError(Exception):
    """A peer that cannot do what it was asked: broken output, input that it does not take."""


@dataclass(frozen=True)
class Run:
    """Files that came out (encode: the whole of what is counted; decode: one PC2 file), and the peer's own processor seconds."""
    files: list
    seconds: float


@dataclass(frozen=True)
class Peer:
    """Another way to store an animation. encode(clip, setting, folder) writes its files into the folder; decode(files, folder)
    reads nothing but those and writes motion.pc2, vertices in the clip's order, and triangles.u32 (see files.py)."""
    name: str
    title: str       # for legends
    source: str      # the package, and how its version is asked for
    counts: str      # one sentence: what the size counts
    ladder: tuple    # settings {knob: value}, from coarse to fine
    encode: Callable
    decode: Callable
    lossless: bool = False
    missing: Callable = field(default=lambda: "")  # why it cannot run here, or ""
    promise: Callable = None  # promise(clip, setting): no coordinate is off by more; None where a setting promises nothing


class Stopwatch:
    """Seconds that a processor works for this process between the files that were read and those that will be written: a busy
    machine does not stretch them."""

    def __init__(self):
        self.seconds = 0.0

    @contextmanager
    def running(self):
        start = time.process_time()
        yield
        self.seconds += time.process_time() - start
