"""Draws the report's figures as SVG."""
# SPDX-License-Identifier: MIT
import math
import os

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker  # noqa: E402: after the choice of what draws

STYLE = {"svg.fonttype": "none", "svg.hashsalt": "meshreel", "font.family": "sans-serif", "font.size": 10, "axes.spines.top": False,
         "axes.spines.right": False, "axes.grid": True, "grid.color": "#e4e4e4", "axes.axisbelow": True, "legend.frameon": False,
         "axes.titlesize": 11, "axes.titleweight": "bold"}
COLOURS = ["#444444", "#0072b2", "#009e73", "#d55e00", "#cc79a7", "#e69f00", "#56b4e9"]


def tripled(row, figures):
    """Figures 9.49 and 9.50: KG error by the vector whose step is tripled."""
    figure, panels = pyplot.subplots(1, 2, figsize=(9, 3.4), sharey=True)
    for panel, (name, title) in zip(panels, [("uniform", "9.49: uniform steps"), ("non_uniform", "9.50: non-uniform steps")]):
        curve = figures[name]
        panel.axhline(curve["before"], color=COLOURS[0], linewidth=1, linestyle="--")
        panel.plot(range(1, len(curve["after"]) + 1), curve["after"], color=COLOURS[1], marker="o", markersize=3)
        panel.set(title=title, xlabel="basis vector with a tripled step")
    panels[0].set(ylabel="KG error, %", ylim=(0, None))
    panels[1].annotate("no step tripled", (1, figures["uniform"]["before"]), xytext=(0, -12), textcoords="offset points", fontsize=9,
                       color=COLOURS[0])
    return figure


def parts(rows):
    """Figure 9.51: stacked bars of connectivity, coefficients and basis."""
    sequences = list(dict.fromkeys(row.sequence for row, _, _ in rows))
    figure, panels = pyplot.subplots(1, len(sequences), figsize=(9, 3.4), squeeze=False)
    for panel, sequence in zip(panels[0], sequences):
        mine = [(row.name, sizes) for row, sizes, _ in rows if row.sequence == sequence]
        below = [0.0] * len(mine)
        for part, (label, colour) in enumerate(zip(["connectivity", "coefficients", "basis"], COLOURS[:1] + COLOURS[1:4:2])):
            heights = [sizes[part] for _, sizes in mine]
            panel.bar([name for name, _ in mine], heights, bottom=below, color=colour, label=label, width=0.65)
            below = [a + b for a, b in zip(below, heights)]
        for bar, (_, sizes) in enumerate(mine):
            panel.annotate(f"{sum(sizes):.0f}", (bar, sum(sizes)), xytext=(0, 2), textcoords="offset points", ha="center", fontsize=8)
        panel.set(title=sequence)
        panel.grid(axis="x", visible=False)
        panel.tick_params(axis="x", length=0)
    panels[0][0].set(ylabel="kbit")
    panels[0][-1].legend(loc="upper right", fontsize=9)
    return figure


def hull(points):
    """The lower left of the convex hull of (rate, log error), by rate."""
    line = []
    for rate, error in sorted((rate, math.log(error)) for rate, error in points):
        if line and error >= line[-1][1]:
            continue
        while len(line) > 1 and (line[-1][1] - line[-2][1]) * (rate - line[-1][0]) >= (error - line[-1][1]) * (line[-1][0] - line[-2][0]):
            line.pop()
        line.append((rate, error))
    return [(rate, math.exp(error)) for rate, error in line]


def curves(by_sequence):
    """Rate and KG error of every coding, a panel a sequence."""
    figure, panels = pyplot.subplots(1, len(by_sequence), figsize=(9, 3.6), squeeze=False)
    for panel, (sequence, rows) in zip(panels[0], by_sequence.items()):
        for (row, figures), colour in zip(rows, COLOURS):
            samples = figures["vertices"] * figures["frames"]
            points = [(8 * point["bytes"] / samples, point["kg"]) for point in figures["points"]]
            panel.plot(*zip(*hull(points)), color=colour, label=row.name, linewidth=1.5, marker=".", markersize=4)
        panel.set(title=sequence, xlabel="bits per frame and vertex", yscale="log", xlim=(0, None))
        panel.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
        panel.yaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        panel.yaxis.set_minor_formatter(ticker.NullFormatter())
    panels[0][0].set(ylabel="KG error, %")
    panels[0][-1].legend(loc="upper right", fontsize=9)
    return figure


class Drawer:
    """Writes figures by name into a folder."""

    def __init__(self, folder):
        self.folder = folder
        os.makedirs(folder, exist_ok=True)

    def __call__(self, file, kind, *what):
        with matplotlib.rc_context(STYLE):
            figure = {"tripled": tripled, "parts": parts, "curves": curves}[kind](*what)
            figure.tight_layout()
            figure.savefig(os.path.join(self.folder, file + ".svg"), facecolor="white", metadata={"Date": None})
            pyplot.close(figure)
