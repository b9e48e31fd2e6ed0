"""Runs a plan of curves: every file of every coding, several times in turn, so that a drift of the machine hits all alike."""
# SPDX-License-Identifier: MIT
import os
import shutil
import statistics
import sys
import tempfile
import time
from dataclasses import dataclass, field

from codings import CodingError
from journal import key_of


@dataclass
class Entrant:
    """One file to be made: a point of a coding's curve on a sequence."""
    clip: object
    coding: object  # plan.Coding
    codec: object   # codings.Codec or PeerCodec
    point: dict
    key: str


@dataclass
class Outcome:
    """What a plan gave."""
    rows: list = field(default_factory=list)     # dicts, one a file
    about: dict = field(default_factory=dict)    # measure: title, unit, better
    skipped: list = field(default_factory=list)  # sentences
    seconds: float = 0.0                         # of the work, with what was remembered
    loads: list = field(default_factory=list)    # of the machine, at each measurement
    programs: list = field(default_factory=list)  # the build of meshreel that made each row, where one did


def label(point):
    """A point's setting as people say it: kg 0.1."""
    hidden = ("codec", "order", "threads")
    return ", ".join(name if value is True else f"{name} {value:g}" if isinstance(value, float) else f"{name} {value}"
                     for name, value in point.items() if name not in hidden)


class Progress:
    """One line a file on a terminal; nothing elsewhere but every hundredth."""

    def __init__(self, total, stream=sys.stderr):
        self.total, self.done, self.fresh, self.stream = total, 0, 0, stream
        self.start, self.terminal = time.monotonic(), stream.isatty()

    def tell(self, entrant, turn, fresh):
        self.done += 1
        self.fresh += fresh
        left = (time.monotonic() - self.start) / max(self.fresh, 1) * (self.total - self.done)
        line = (f"[{self.done}/{self.total}] {entrant.clip.name}: {entrant.coding.name}, {label(entrant.point)}, "
                f"turn {turn + 1}; about {left / 60:.0f} min left")
        if self.terminal:
            print("\r\033[K" + line[:shutil.get_terminal_size().columns - 1], end="", file=self.stream, flush=True)
        elif self.done % 100 == 0:
            print(line, file=self.stream, flush=True)

    def close(self):
        if self.terminal:
            print(file=self.stream)


class Race:
    """A plan, the codecs that it names, the sequences at hand, and a journal of what is done."""

    def __init__(self, plan, command, sequences, journal):
        self.plan, self.command, self.sequences, self.journal = plan, command, sequences, journal
        self.outcome, self.lost = Outcome(), set()

    def entrants(self, codecs):
        """Every file that can be made here; why the others cannot is told once."""
        found = []
        for coding in self.plan.codings:
            if why := codecs[coding.name].missing():
                self.outcome.skipped.append(f"{coding.name}: {why}")
        for name, how in self.plan.sequences.items():
            clip = self.sequences.find(name, how)
            if not clip:
                self.outcome.skipped.append(f"{name}: its data are not here")
                continue
            for coding in self.plan.codings:
                codec = codecs[coding.name]
                if codec.missing():
                    continue
                found += [Entrant(clip, coding, codec, point, key_of(codec.identity, point, self.sequences.checksums[name]))
                          for point in coding.points]
        return found

    def run(self, codecs):
        entrants = self.entrants(codecs)
        progress = Progress(len(entrants) * self.plan.runs)
        for turn in range(self.plan.runs):
            for entrant in entrants:
                fresh = self.known(entrant, turn) is None and entrant.key not in self.lost
                if fresh:
                    self.measure(entrant, turn)
                progress.tell(entrant, turn, fresh)
        progress.close()
        self.outcome.rows = [self.row(entrant) for entrant in entrants if entrant.key not in self.lost]
        return self.outcome

    def turn_key(self, entrant, turn):
        """Times are of a turn, and of as many decodings; errors and sizes of the first."""
        return key_of(entrant.key, turn, self.plan.decodes, self.command.measuring if turn == 0 else "")

    def known(self, entrant, turn):
        """What is remembered, where it has all that this plan measures: another plan's turn is as good."""
        record = self.journal.get(self.turn_key(entrant, turn))
        return record if record and (turn > 0 or record["measures"].keys() >= set(self.plan.measures)) else None

    def measure(self, entrant, turn):
        start = time.monotonic()
        try:
            record = self.made(entrant, turn)
        except Exception as error:  # whatever a peer does wrong is the peer's; the run goes on and the report says it
            if turn == 0:
                self.lost.add(entrant.key)
            self.outcome.skipped.append(f"{entrant.clip.name}: {entrant.coding.name}, {label(entrant.point)}: "
                                        f"{error if isinstance(error, CodingError) else repr(error)}")
            return
        record |= {"wall_s": time.monotonic() - start, "load": os.getloadavg()[0]}
        self.journal.add(self.turn_key(entrant, turn), record)

    def made(self, entrant, turn):
        """A file made and read back, and, in the first turn, its errors: of the decoded positions, in the original order."""
        clip, point = entrant.clip, entrant.point
        with tempfile.TemporaryDirectory() as folder:
            files = entrant.codec.encode(clip, point, folder)
            decoded = [entrant.codec.decode(files.paths, point, folder) for _ in range(self.plan.decodes)]
            back, seconds = decoded[0][0], min(seconds for _, seconds in decoded)
            record = {"sequence": clip.name, "coding": entrant.coding.name, "point": point, "turn": turn, "bytes": files.size,
                      "encode_s": files.seconds, "decode_s": seconds, **files.told}
            if turn == 0:
                others = self.journal.get(self.turn_key(entrant, turn)).get("measures", {})  # another plan's, which looks for them here
                measures = sorted({*self.plan.measures, *others})
                record["measures"] = self.command.compare(clip, back, measures, point.get("order", "keep"))
            return record

    def row(self, entrant):
        """The medians of the times of all turns; the size and the errors of the first."""
        records = [record for turn in range(self.plan.runs) if (record := self.known(entrant, turn))]
        first, clip = records[0], entrant.clip
        self.outcome.seconds += sum(record["wall_s"] for record in records)
        self.outcome.loads += [record["load"] for record in records if "load" in record]
        if len({record["bytes"] for record in records}) > 1:
            self.outcome.skipped.append(f"{clip.name}: {entrant.coding.name}, {label(entrant.point)}: its size is not the same in every turn")
        measured = {name: first["measures"][name] for name in self.plan.measures}
        self.outcome.about |= {name: {key: found[key] for key in ("title", "unit", "better")} for name, found in measured.items()}
        self.outcome.programs += {record["program"] for record in records if "program" in record}
        samples = clip.V * clip.F
        encode_s, decode_s = (statistics.median(record[key] for record in records) for key in ("encode_s", "decode_s"))
        return {"sequence": clip.name, "coding": entrant.coding.name, "setting": label(entrant.point), "V": clip.V, "F": clip.F,
                "bytes": first["bytes"], "bpfv": 8 * first["bytes"] / samples,  # (9.1)
                **{name: found["value"] for name, found in measured.items()},
                "encode_s": encode_s, "decode_s": decode_s, "encode_mvs": 1e-6 * samples / max(encode_s, 1e-9),
                "decode_mvs": 1e-6 * samples / max(decode_s, 1e-9), "runs": len(records), "bases": first.get("bases", ""),
                "step": first.get("step", "")}
