"""Plans of measurements: reads lab/plans/NAME.toml into rows, each a flat table of settings for one measurement."""
# SPDX-License-Identifier: MIT
import tomllib
from dataclasses import dataclass, field


@dataclass
class Row:
    """One measurement: what to measure, on which sequence, and what the thesis prints for it."""
    measure: str
    sequence: str
    settings: dict
    name: str = ""
    printed: dict = field(default_factory=dict)


class PlanError(Exception):
    """A plan that makes no sense."""


def rows_of(plan):
    """Each sequence (a table, or several) times each coding; what both say is the coding's, what neither says common's."""
    unknown = set(plan) - {"measure", "common", "coding", "sequence"}
    if unknown or "measure" not in plan or not plan.get("sequence"):
        raise PlanError(f"a plan needs measure and sequence, and has no {', '.join(sorted(unknown)) or 'such keys'}")
    rows = []
    for sequence, tables in plan["sequence"].items():
        for table in tables if isinstance(tables, list) else [tables]:
            for coding in plan.get("coding", [{}]):
                settings = {**plan.get("common", {}), **table, **coding}
                name, printed = settings.pop("name", ""), settings.pop("printed", {})
                rows.append(Row(plan["measure"], sequence, settings, name, printed))
    return rows


def load(path):
    with open(path, "rb") as file:
        try:
            return rows_of(tomllib.load(file))
        except (tomllib.TOMLDecodeError, PlanError) as error:
            raise PlanError(f"{path}: {error}") from None
