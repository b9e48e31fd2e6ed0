"""Results kept by release: CSV files in lab/results whose first column is a heading of the CHANGELOG."""
# SPDX-License-Identifier: MIT
import csv
import os
import re

from options import ROOT

RESULTS = os.path.join(ROOT, "lab/results")


def releases(changelog=os.path.join(ROOT, "CHANGELOG.md")):
    """The releases, the newest first: "## Unreleased", "## 0.1.0 - 2026-11-23"."""
    with open(changelog, encoding="utf-8") as file:
        return re.findall(r"^## +\[?([\w.+-]+)", file.read(), re.M)


def read(name, folder=RESULTS):
    """The rows of a file, as text; none where there is no file. Lines of # say what made it."""
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def numbers(name):
    """The rows of a file with numbers where there are some."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    return [{key: value(text) for key, text in row.items()} for row in read(name)]


def renewed(old, new, known, key):
    """Rows of the newest release are replaced by the new ones of the same key; of other releases kept, where the CHANGELOG has them."""
    now = [{"release": known[0], **row} for row in new]
    same = lambda row: tuple(str(row[column]) for column in key)
    old_now = [row for row in old if row["release"] == known[0]]
    kept = {release: [row for row in old if row["release"] == release] for release in known[1:]}
    merged = {same(row): row for row in old_now} | {same(row): row for row in now}
    return [*merged.values(), *(row for rows in kept.values() for row in rows)]


def write(name, rows, folder=RESULTS):
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with open(os.path.join(folder, name + ".csv"), "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def renew(name, new, key):
    """Puts rows under the newest release."""
    write(name, renewed(read(name), new, releases(), key))
