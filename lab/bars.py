"""Bars of what ideas are worth: a row an idea and a panel a sequence, or, for narrow windows, a panel an idea and a row a sequence."""
# SPDX-License-Identifier: MIT
import math

from draw import COLOURS, STYLE
from matplotlib import pyplot, rc_context

MOST = 20  # percent: longer bars are cut off there, and say how long they are
INK, GROUND, GRID = "#1b1f24", "#ffffff", "#e4e4e4"
DARK = {INK: "#e8ebee", GROUND: "#14181d", GRID: "#333d47"}
LOOKS = {**STYLE, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": INK, "xtick.color": INK, "ytick.color": INK, "axes.titlesize": 9,
         "xtick.labelsize": 8, "ytick.labelsize": 9, "grid.color": GRID}
BAR_COLOURS = (COLOURS[1], COLOURS[5])


def with_dark_looks(path):
    """Has a picture follow the reader's choice of light or dark."""
    rules = "".join(f'[style*="fill: {light}"] {{ fill: {dark} !important; }} [style*="stroke: {light}"] {{ stroke: {dark} !important; }} '
                    for light, dark in DARK.items())
    style = f"<style>@media (prefers-color-scheme: dark) {{ {rules}}}</style>"
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("<defs>", style + "<defs>", 1))


class Bars:
    """found: {what: {(sequence, idea): percent}}."""

    def __init__(self, found, sequences, ideas):
        self.found, self.sequences, self.ideas = found, sequences, ideas

    def fill(self, panel, keys, digits):
        """Bars for (sequence, idea) pairs, from above; digits: their size in points."""
        for place, (values, colour) in enumerate(zip(self.found.values(), BAR_COLOURS)):
            at = [row + 0.4 * place - 0.2 for row in range(len(keys))]
            lengths = [values.get(key, 0.0) for key in keys]
            panel.barh(at, [max(min(length, MOST), -MOST / 4) for length in lengths], height=0.38, color=colour, label=list(self.found)[place])
            for y, length in zip(at, lengths):
                if length > MOST:
                    panel.annotate(f"{length:.0f}", (MOST, y), xytext=(-2, -0.5), textcoords="offset points", ha="right", va="center", fontsize=digits,
                                   color="#fefefe")
        measured = {key for values in self.found.values() for key in values}
        for row in (row for row, key in enumerate(keys) if key not in measured):
            panel.annotate("–", (1, row), va="center", fontsize=9)  # as in the tables: not measured
        panel.set(xlim=(-MOST / 4, MOST), xticks=(0, 10, 20), ylim=(len(keys) - 0.4, -0.6))
        panel.tick_params(axis="y", length=0)
        panel.axvline(0, color="#888888", linewidth=0.8)
        panel.grid(axis="y", visible=False)

    def finish(self, figure, panel, path):
        width, height = figure.get_size_inches()
        figure.legend(*panel.get_legend_handles_labels(), loc="lower center", ncol=2, fontsize=9, title="percent that files are larger without it",
                      title_fontsize=9)
        figure.tight_layout(w_pad=0.5, rect=(0, 0.5 / height, 1, 1))
        figure.savefig(path, facecolor=GROUND, metadata={"Date": None})
        pyplot.close(figure)
        with_dark_looks(path)

    def wide(self, path):
        with rc_context(LOOKS):
            figure, panels = pyplot.subplots(1, len(self.sequences), figsize=(1.6 + 0.85 * len(self.sequences), 1.2 + 0.3 * len(self.ideas)),
                                             sharey=True, squeeze=False)
            for panel, sequence in zip(panels[0], self.sequences):
                self.fill(panel, [(sequence, idea) for idea in self.ideas], 6.5)
                panel.set_title(sequence.replace(" ", "\n").replace("_", "\n"))
            panels[0][0].set_yticks(range(len(self.ideas)), self.ideas)
            self.finish(figure, panels[0][0], path)

    def narrow(self, path):
        rows = math.ceil(len(self.ideas) / 2)
        with rc_context(LOOKS):
            figure, panels = pyplot.subplots(rows, 2, figsize=(4.3, 0.6 + rows * (0.55 + 0.18 * len(self.sequences))), sharey=True, squeeze=False)
            for panel in panels.flat[len(self.ideas):]:
                panel.set_axis_off()
            for panel, idea in zip(panels.flat, self.ideas):
                self.fill(panel, [(sequence, idea) for sequence in self.sequences], 5)
                panel.set_title(idea)
            for panel in panels[:, 0]:
                panel.set_yticks(range(len(self.sequences)), [name.replace("_", " ") for name in self.sequences])
            self.finish(figure, panels[0][0], path)
