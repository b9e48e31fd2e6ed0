"""What a part of the report is made of: Markdown, rows for a CSV file, and directions of the thesis that hold or not."""
# SPDX-License-Identifier: MIT
import csv
from dataclasses import dataclass, field


@dataclass
class Direction:
    """Something the thesis says, whether it holds here, and the figures that show it."""
    says: str
    holds: bool
    shown: str


@dataclass
class Section:
    title: str
    text: list = field(default_factory=list)
    rows: list = field(default_factory=list)
    directions: list = field(default_factory=list)

    def say(self, *paragraphs):
        for paragraph in paragraphs:
            self.text += [paragraph, ""]

    def table(self, head, rows):
        self.text += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        self.text += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
        self.text.append("")

    def direction(self, says, holds, shown):
        self.directions.append(Direction(says, bool(holds), shown))


def write_csv(path, rows, provenance):
    """Rows of any keys under one head, after lines of # that say what made them."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in provenance)
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def listed(words):
    """a, b and c."""
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]
