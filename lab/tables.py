#!/usr/bin/env python3
"""Writes the tables of the README and of docs/benchmarks.md from lab/results; --check says which are stale.

A table stands between two comments that name it; the newest release is whatever heads the CHANGELOG."""
# SPDX-License-Identifier: MIT
import argparse
import math
import os
import re
import statistics
import sys

import ideas
import plan
import releases
import verdicts

ROOT = releases.ROOT
TARGETS = [("kg", "0.5", "KG 0.5 %"), ("kg", "0.1", "KG 0.1 %"), ("sted", "0.03", "STED 0.03")]
BEGIN, END = "<!-- made by lab/tables.py: {} -->\n", "<!-- end -->\n"
SPEEDS = {"sequence": "sequence", "V": "V", "F": "F", "K": "K", "encode": "encode", "decode": "decode", "copy": "copy", "product": "product",
          "encode_peak": "encode peak MB", "decode_peak": "decode peak MB", "pca_s": "PCA s", "pca_memory": "PCA memory / animation",
          "encode_share": "encode / (10 PCA + decode)"}
POSING = {"V": "V", "F": "F", "K": "K", "product_ms": "product ms", "gflops": "GFLOP/s", "all": "all %", "each": "each %", "one": "one %"}
OPENING = {"product_ms": "product ms", "bpfv": "bits a frame and vertex", "open_1": "one thread", "open_2": "two",
           "fast_more": "`--fast-decode`: more bits, %", "fast_open_1": "one thread", "fast_open_2": "two"}
SCALE = {"shape": "shape", "V": "V", "F": "F", "segments": "segments", "K": "K", "positions_mb": "positions MB", "bpfv": "bpfv",
         "encode_s": "encode s", "encode_ns": "ns a vertex and frame", "encode_peak": "peak MB", "decode_s": "decode s",
         "decode_ns": "ns a vertex and frame", "decode_peak": "peak MB"}


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]


def names_in(rows, key):
    """Of sequences or codings, in the order in which they come."""
    return list(dict.fromkeys(row[key] for row in rows))


def grid(corner, names, columns, cells):
    """A row a name, a column a column's name; cells: {(name, column): text}. Names without any cell are left out."""
    return markdown([corner, *columns], [[name, *(cells.get((name, column), "–") for column in columns)]
                                         for name in names if any(key[0] == name for key in cells)])


def of_newest(name):
    """The rows of the newest release that has any."""
    rows = releases.read(name)
    newest = next((release for release in releases.releases() if any(row["release"] == release for row in rows)), None)
    return [row for row in rows if row["release"] == newest]


def rates_by_key(rows):
    """{(release, sequence, measure, asked): bits a frame and vertex}."""
    return {(row["release"], row["sequence"], row["measure"], row["asked"]): float(row["bpfv"]) for row in rows}


def result_table(rows, known):
    """The README's: the newest release at every target, and one column for each earlier release."""
    rates, now, earlier = rates_by_key(rows), known[0], known[1:]
    head = ["sequence", *(title for _, _, title in TARGETS), "at KG 0.1 % of float32", *(f"{release}, KG 0.1 %" for release in earlier)]
    lines, number = [], lambda value: "" if value is None else f"{value:.3f}"
    for name in dict.fromkeys(row["sequence"] for row in rows if row["release"] == now):
        at = [rates[now, name, measure, asked] for measure, asked, _ in TARGETS]
        lines.append([name, *map(number, at), f"1 : {96 / at[1]:.0f}", *(number(rates.get((release, name, "kg", "0.1"))) for release in earlier)])
    return markdown(head, lines)


def with_results(rows, known=None):
    """The releases that have rows, the newest first."""
    return [release for release in known or releases.releases() if any(row["release"] == release for row in rows)]


def release_table(rows, known):
    """A row a sequence and target, a column a release."""
    rates = rates_by_key(rows)
    sequences = names_in(rows, "sequence")
    keys = sorted({(row["sequence"], row["measure"], row["asked"]) for row in rows}, key=lambda key: (sequences.index(key[0]), *key[1:]))
    cells = lambda key: [f"{rates[release, *key]:.4f}" if (release, *key) in rates else "" for release in known]
    return markdown(["sequence", "at", *known], [[key[0], f"{key[1].upper()} {key[2]}{' %' if key[1] == 'kg' else ''}", *cells(key)] for key in keys])


def speed_releases(rows, known):
    """Encoding and decoding, a column a release."""
    by = {(row["release"], row["sequence"]): row for row in rows}
    head = ["sequence", *(f"{what}, {release}" for what in ("encode", "decode") for release in known)]
    return markdown(head, [[name, *(by.get((release, name), {}).get(what, "") for what in ("encode", "decode") for release in known)]
                           for name in dict.fromkeys(name for _, name in by)])


def plain_table(rows, columns):
    return markdown(columns.values(), [[row[column] for column in columns] for row in rows])


def player_table(rows, columns, of):
    """The player's rows that have that column; what was asked for besides is told with the name."""
    mine = [row for row in rows if row[of]]
    names = [row["sequence"] + (f", `{row['options']}`" if row["options"] else "") for row in mine]
    return markdown(["sequence", *columns.values()], [[name, *(row[column] for column in columns)] for name, row in zip(names, mine)])


def measure_table(rows):
    code = lambda name: name if " " in name else f"`{name}`"
    return markdown(["", "ms", "passes"], [[code(row["measure"]), row["ms"], row["passes"]] for row in rows])


def signed(delta):
    if delta.percent is None:
        return "–"
    return f"{delta.percent:+.0f} %{'*' if delta.share < 0.5 else ''}"


def delta_table(name, measure):
    """Bjontegaard-delta rates of a plan's codings against its anchor."""
    rows, curves = releases.numbers(name), plan.read(os.path.join(ROOT, "lab/plans", name + ".toml"))
    found = verdicts.deltas(rows, measure, curves["anchor"])
    cells = {(coding, sequence): signed(delta) for (sequence, coding), delta in found.items()}
    for coding in {coding for coding, _ in cells}:
        mean = verdicts.mean_delta(delta for (_, other), delta in found.items() if other == coding)
        cells[coding, "mean"] = "–" if mean is None else f"{mean:+.0f} %"
    return grid(f"against {curves['anchor']}", names_in(rows, "coding"), [*names_in(rows, "sequence"), "mean"], cells)


def rate_table(name, measure, error, digits=3):
    """The rates of a plan's codings at one error."""
    rows = releases.numbers(name)
    found = {(coding, sequence): f"{rate:.{digits}f}" for (sequence, coding), (rate, *_) in verdicts.at_error(rows, measure, error).items()}
    return grid("", names_in(rows, "coding"), names_in(rows, "sequence"), found)


def exact_table(name):
    """The rates of what comes back bit for bit."""
    rows = [row for row in releases.numbers(name) if row["max_error_relative"] == 0]
    found = {(row["coding"], row["sequence"]): f"{row['bpfv']:.2f}" for row in rows}
    return grid("", names_in(rows, "coding"), names_in(rows, "sequence"), found)


def lossless_table(name):
    """The same of a plan that has nothing else, a sequence a row."""
    rows = releases.numbers(name)
    if wrong := [(row["coding"], row["sequence"]) for row in rows if row["max_error_relative"] != 0]:
        raise ValueError(f"not without loss: {wrong}")
    found = {(row["sequence"], row["coding"]): f"{row['bpfv']:.2f}" for row in rows}
    return grid("sequence", names_in(rows, "sequence"), names_in(rows, "coding"), found)


def speed_table(name, error):
    """How fast a plan's codings are at one KG error, or without loss: geometric means over the sequences on which they reach it."""
    rows = releases.numbers(name)
    found = {key: value[1:] for key, value in verdicts.at_error(rows, "kg", error).items()}
    found |= {(row["sequence"], row["coding"]): (row["encode_mvs"], row["decode_mvs"]) for row in rows if row["max_error_relative"] == 0}
    lines = []
    for coding in names_in(rows, "coding"):
        mine = [speeds for (_, name), speeds in found.items() if name == coding]
        if mine:
            means = (math.exp(statistics.fmean(math.log(speed) for speed in side)) for side in zip(*mine))
            lines.append([coding, *(f"{speed:.3g}" for speed in means), len(mine)])
    return markdown(["M vertices a processor second", "encode", "decode", "sequences"], lines)


def percent(value):
    return "–" if value is None else f"{value:+.1f}" if abs(value) < 100 else f"{value:+.0f}"


def idea_table():
    """A row an idea: what it is worth in the mean over sequences, in bits and in time."""
    rows, known = releases.numbers("ablation"), ideas.read()
    columns = {"bits at equal KG": ideas.worth(rows, "kg"), "at equal STED": ideas.worth(rows, "sted"),
               "encoding": ideas.times(rows, "encode_s"), "decoding": ideas.times(rows, "decode_s")}
    return markdown(["", "the idea", "without it", *columns],
                    [[name, known[name].idea, known[name].without, *(percent(ideas.mean(found, name)) for found in columns.values())]
                     for name in ideas.sorted_ideas(rows)])


def idea_sequences(what):
    """A row an idea, a column a sequence; what(rows): {(sequence, idea): percent}."""
    rows = releases.numbers("ablation")
    found = what(rows)
    cells = {(name, sequence): percent(value) for (sequence, name), value in found.items()}
    cells |= {(name, "mean"): percent(ideas.mean(found, name)) for name in ideas.sorted_ideas(rows)}
    return grid("%", ideas.sorted_ideas(rows), [*names_in(rows, "sequence"), "mean"], cells)


def idle_ideas():
    """The ideas that no sequence needs, and those that few do."""
    little = ideas.worth_little(releases.numbers("ablation"))
    nothing = [f"**{name}** ({most:+.1f} %, {sequence})" for name, most, sequence in little if most < ideas.NOTHING]
    others = [f"**{name}** ({most:+.1f} %, {sequence})" for name, most, sequence in little if most >= ideas.NOTHING]
    return [f"Less than {ideas.NOTHING} % at equal KG error on every sequence; where they are worth most: {', '.join(nothing) or 'none'}.", "",
            f"Less than that in the mean over sequences, but more on some: {', '.join(others) or 'none'}."]


def not_measured(name):
    """What a plan names and its results lack; nothing where they lack nothing."""
    wanted = plan.read(os.path.join(ROOT, "lab/plans", name + ".toml"))
    found = lacking(releases.read(name), [coding["name"] for coding in wanted["coding"]], wanted["sequence"])
    return [f"In the plan, but not measured yet: {'; '.join(found)}."] if found else []


def lacking(rows, codings, sequences):
    """Codings that there are nowhere, sequences without any; of what is there in part, the lesser part."""
    there = {(row["coding"], row["sequence"]) for row in rows}
    nowhere = [name for name in codings if not any((name, sequence) in there for sequence in sequences)]
    found, rest = list(nowhere), [name for name in codings if name not in nowhere]
    for sequence in sequences:
        done = [name for name in rest if (name, sequence) in there]
        undone = [name for name in rest if name not in done]
        if undone:
            found.append(sequence if not done else f"{', '.join(undone)} on {sequence}" if len(undone) < len(done) else
                         f"all but {', '.join(done)} on {sequence}")
    return found


def made_by(name):
    """What the head of a plan's CSV file says, as one paragraph."""
    with open(os.path.join(releases.RESULTS, name + ".csv"), encoding="utf-8") as file:
        words = [line.removeprefix("#").strip() for line in file if line.startswith("#")]
    told = lambda line: line.split(" ")[0] in ("plan", "commit", "compiler", "machine", "load") or " files by meshreel " in line or " files of commit " in line
    return ["Made by: " + "; ".join(filter(told, words)) + "."]


TABLES = {
    "README.md": {"results": lambda: result_table(rows := releases.read("rates"), with_results(rows))},
    "docs/benchmarks.md": {
        "rates": lambda: release_table(rows := releases.read("rates"), with_results(rows)),
        "everyone, KG": lambda: delta_table("everyone", "kg"),
        "everyone, STED": lambda: delta_table("everyone", "sted"),
        "everyone, largest error": lambda: delta_table("everyone", "max_error_relative"),
        "everyone at KG 0.1 %": lambda: rate_table("everyone", "kg", 0.1),
        "everyone, speeds": lambda: speed_table("everyone", 0.1),
        "everyone without loss": lambda: exact_table("everyone"),
        "everyone, made by": lambda: [*made_by("everyone"), "", *not_measured("everyone")],
        "codecs, KG": lambda: delta_table("codecs", "kg"),
        "codecs, STED": lambda: delta_table("codecs", "sted"),
        "codecs, made by": lambda: [*made_by("codecs"), "", *not_measured("codecs")],
        "speeds": lambda: plain_table(of_newest("speeds"), SPEEDS),
        "speeds by release": lambda: speed_releases(rows := releases.read("speeds"), with_results(rows)),
        "posing": lambda: player_table(of_newest("player"), POSING, "all"),
        "opening": lambda: player_table(of_newest("player"), OPENING, "open_1"),
        "measures": lambda: measure_table(of_newest("measures")),
        "scale": lambda: plain_table(of_newest("scale"), SCALE),
    },
    "docs/ablation.md": {
        "ideas": idea_table,
        "ideas worth nothing": idle_ideas,
        "ideas, KG": lambda: idea_sequences(lambda rows: ideas.worth(rows, "kg")),
        "ideas, STED": lambda: idea_sequences(lambda rows: ideas.worth(rows, "sted")),
        "ideas, encoding": lambda: idea_sequences(lambda rows: ideas.times(rows, "encode_s")),
        "ideas, decoding": lambda: idea_sequences(lambda rows: ideas.times(rows, "decode_s")),
        "ideas, made by": lambda: [*made_by("ablation"), "", *not_measured("ablation")],
    },
    "docs/peers.md": {
        "peers at KG 0.5 %": lambda: rate_table("peers", "kg", 0.5, digits=2),
        "peers, made by": lambda: made_by("peers"),
    },
    "src/meshreel/codecs/lossless.md": {
        "lossless": lambda: lossless_table("lossless"),
        "lossless, made by": lambda: made_by("lossless"),
    },
}


def filled(text, makers):
    """A page with each of its tables made anew; a table that the page names and nobody makes is an error."""
    def make(match):
        return BEGIN.format(match[1]) + "\n" + "\n".join(makers[match[1]]()) + "\n\n" + END
    return re.sub(re.escape(BEGIN).replace(r"\{\}", r"([^\n]+?)") + ".*?" + re.escape(END), make, text, flags=re.S)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="write nothing; exit with 1 where a page is stale")
    options, stale = parser.parse_args(), []
    for page, makers in TABLES.items():
        with open(os.path.join(ROOT, page), encoding="utf-8") as file:
            text = file.read()
        fresh = filled(text, makers)
        stale += [page] if fresh != text else []
        if not options.check:
            with open(os.path.join(ROOT, page), "w", encoding="utf-8") as file:
                file.write(fresh)
    if options.check and stale:
        sys.exit(f"stale: {', '.join(stale)}; lab/tables.py makes them")


if __name__ == "__main__":
    main()
