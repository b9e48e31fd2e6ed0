"""Plans of measurements: reads lab/plans/NAME.toml into rows, each a flat table of settings for one measurement."""
# SPDX-License-Identifier: MIT
import tomllib
from dataclasses import dataclass, field

ROW_KEYS = {"measure", "common", "coding", "sequence"}
CURVE_KEYS = {"title", "anchor", "runs", "decodes", "measures", "peers"}  # what only a plan of curves has; lab/bench.py runs those
MEASURES = ["kg", "sted", "max_error_relative"]


@dataclass
class Row:
    """One measurement: what to measure, on which sequence, and what the thesis prints for it."""
    measure: str
    sequence: str
    settings: dict
    name: str = ""
    printed: dict = field(default_factory=dict)
    promised: dict = field(default_factory=dict)  # what must be reached
    made: dict = field(default_factory=dict)  # how the sequence is generated; empty: it is data


@dataclass(frozen=True)
class Coding:
    """One way to encode: a codec of meshreel with its options, or a peer; and the points of its curve, from coarse to fine."""
    name: str
    points: tuple  # dicts of all options of one file
    peer: str = ""
    build: str = ""  # the build folder of another meshreel than the one that is asked for


@dataclass(frozen=True)
class Curves:
    """What lab/bench.py runs: each coding on each sequence."""
    name: str
    title: str
    anchor: str      # the coding that others are told against
    runs: int        # how often each file is made, for the times
    measures: tuple  # values of `compare`
    sequences: dict  # name: how it is generated, or {} where it is data
    codings: tuple
    decodes: int = 1  # how often it is decoded each time, for times that are short


class PlanError(Exception):
    """A plan that makes no sense."""


def check_keys(plan):
    known = ROW_KEYS | CURVE_KEYS if plan.get("measure") == "curve" else ROW_KEYS
    unknown = set(plan) - known
    if unknown or "measure" not in plan or not plan.get("sequence"):
        raise PlanError(f"a plan needs measure and sequence, and has no {', '.join(sorted(unknown)) or 'such keys'}")


def rows_of(plan):
    """Each sequence (a table, or several) times each coding; what both say is the coding's, what neither says common's."""
    check_keys(plan)
    rows = []
    for sequence, tables in plan["sequence"].items():
        for table in tables if isinstance(tables, list) else [tables]:
            for coding in plan.get("coding", [{}]):
                settings = {**plan.get("common", {}), **table, **coding}
                name, besides = settings.pop("name", ""), {key: settings.pop(key, {}) for key in ("printed", "promised", "made")}
                rows.append(Row(plan["measure"], sequence, settings, name, **besides))
    return rows


def points_of(settings, name):
    """The settings of each file of a curve: ladder.KNOB lists them, several knobs side by side."""
    fixed = {knob: value for knob, value in settings.items() if knob not in ("ladder", "name", "build")}
    ladder = settings.get("ladder", {})
    if len({len(values) for values in ladder.values()}) > 1:
        raise PlanError(f"{name}: the knobs of a ladder need lists of one length")
    if not ladder:
        return (fixed,)
    return tuple({**fixed, **dict(zip(ladder, values))} for values in zip(*ladder.values()))


def curves_of(plan, name, peers=()):
    """A plan of curves. peers: all there are; the plan says which it takes, by name or ["all"]."""
    check_keys(plan)
    if plan["measure"] != "curve":
        raise PlanError(f"measure is {plan['measure']}; only a plan of curves can be run alone, make figures runs the others")
    tables = [{**plan.get("common", {}), **coding} for coding in plan.get("coding", [])]
    codings = [Coding(table.get("name", table.get("codec", "")), points_of(table, table.get("name")), build=table.get("build", ""))
               for table in tables]
    wanted, known = plan.get("peers", []), {peer.name: peer for peer in peers}
    for peer in known if wanted == ["all"] else wanted:
        if peer not in known:
            raise PlanError(f"{peer}: no such peer; there are {', '.join(known) or 'none'}")
        codings.append(Coding(known[peer].title, tuple(dict(point) for point in known[peer].ladder), peer))
    names = [coding.name for coding in codings]
    if "" in names or len(set(names)) < len(names) or not names:
        raise PlanError("every coding needs a name of its own")
    if plan.get("anchor", names[0]) not in names:
        raise PlanError(f"anchor {plan['anchor']}: no such coding")
    sequences = {sequence: table.get("made", {}) for sequence, table in plan["sequence"].items()}
    return Curves(name, plan.get("title", name), plan.get("anchor", names[0]), plan.get("runs", 3),
                  tuple(plan.get("measures", MEASURES)), sequences, tuple(codings), plan.get("decodes", 1))


def read(path):
    with open(path, "rb") as file:
        try:
            return tomllib.load(file)
        except tomllib.TOMLDecodeError as error:
            raise PlanError(f"{path}: {error}") from None


def load(path):
    try:
        return rows_of(read(path))
    except PlanError as error:
        raise PlanError(f"{path}: {error}") from None
