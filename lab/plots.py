"""Draws the curves of a plan as SVG: rate against each error, speed against rate; a panel a sequence."""
# SPDX-License-Identifier: MIT
import math
import os

from draw import COLOURS, STYLE, pyplot
from matplotlib import rc_context, ticker

MARKERS = "osD^vPX*<>p"  # one less than colours, so that no pair comes twice
PALETTE = [*COLOURS[1:], "#7f3b08", "#542788", "#1b7837", "#b2182b", "#878787", "#4d4d4d"]
ACROSS = 3


def styles(codings):
    """{name: colour, marker}; our own codecs' lines are whole, the peers' dashed, or dotted where the colours come again."""
    line = lambda i, coding: "-" if not coding.peer else "--" if i < len(PALETTE) else ":"
    return {coding.name: {"color": PALETTE[i % len(PALETTE)], "marker": MARKERS[i % len(MARKERS)], "linestyle": line(i, coding)}
            for i, coding in enumerate(codings)}


def plain(axis):
    """Numbers as people write them; 1, 2 and 5 of a decade where there are few decades."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if high < 200 * low else (1,)))
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
    axis.set_minor_formatter(ticker.NullFormatter())


def panels_of(sequences):
    down = math.ceil(len(sequences) / ACROSS)
    across = min(ACROSS, len(sequences))
    figure, panels = pyplot.subplots(down, across, figsize=(0.4 + 3.6 * across, 0.9 + 3.0 * down), squeeze=False)
    for panel in panels.flat[len(sequences):]:
        panel.set_visible(False)
    return figure, dict(zip(sequences, panels.flat))


def chart(rows, looks, x, y):
    """One panel a sequence; x and y: key of a row and its title. Both axes are logarithmic."""
    figure, panels = panels_of(list(dict.fromkeys(row["sequence"] for row in rows)))
    for sequence, panel in panels.items():
        for name, look in looks.items():
            points = sorted((row[x[0]], row[y[0]]) for row in rows
                            if (row["sequence"], row["coding"]) == (sequence, name) and row[x[0]] > 0 and row[y[0]] > 0)
            if points:
                panel.plot(*zip(*points), label=name, markersize=4, linewidth=1.3, **look)
        panel.set(title=sequence, xscale="log", yscale="log", xlabel=x[1], ylabel=y[1])
        plain(panel.xaxis)
        plain(panel.yaxis)
    handles = {label: handle for panel in panels.values() for handle, label in zip(*panel.get_legend_handles_labels())}
    width, height = figure.get_size_inches()
    columns = max(1, min(int(width / 2.5), len(handles)))
    below = 0.15 + 0.2 * math.ceil(len(handles) / columns)
    figure.set_size_inches(width, height + below)
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=columns, fontsize=9)
    figure.tight_layout(rect=(0, below / (height + below), 1, 1))
    return figure


def draw_all(folder, curves, outcome, only=None):
    """SVG files named after the plan and what stands upwards; only: just these."""
    os.makedirs(folder, exist_ok=True)
    rate, looks = ("bpfv", "bits per frame and vertex"), styles(curves.codings)
    wanted = {name: (rate, (name, f"{about['title']}, {about['unit']}".rstrip(", "))) for name, about in outcome.about.items()}
    wanted |= {name: (rate, (key, f"{name}, M vertices a processor second")) for name, key in (("decoding", "decode_mvs"), ("encoding", "encode_mvs"))}
    paths = []
    for name, (x, y) in wanted.items():
        if only and name not in only:
            continue
        with rc_context(STYLE):
            figure = chart(outcome.rows, looks, x, y)
            paths.append(os.path.join(folder, f"{curves.name}-{name}.svg"))
            figure.savefig(paths[-1], facecolor="white", metadata={"Date": None})
            pyplot.close(figure)
    return paths
