"""What a plan's rows say of one coding against another: Bjontegaard-delta rates, rates and speeds at one error."""
# SPDX-License-Identifier: MIT
import math
from dataclasses import dataclass

import bdrate


@dataclass(frozen=True)
class Delta:
    """The rate that a coding needs more than the anchor, percent; or why that cannot be said."""
    percent: float | None
    share: float = 0.0  # of the anchor's range of errors, in dB, that both reach
    why: str = ""


def curves(rows, measure):
    """{(sequence, coding): [(rate, error)]}."""
    found = {}
    for row in rows:
        if row.get(measure) not in (None, ""):
            found.setdefault((row["sequence"], row["coding"]), []).append((row["bpfv"], row[measure]))
    return found


def deltas(rows, measure, anchor):
    """{(sequence, coding): Delta} of everything but the anchor, where the anchor has a curve."""
    known, result = curves(rows, measure), {}
    for (sequence, coding), points in known.items():
        if coding == anchor or (sequence, anchor) not in known or all(error == 0 for _, error in points):
            continue
        try:
            result[sequence, coding] = Delta(*bdrate.bd_rate(known[sequence, anchor], points))
        except bdrate.NoDelta as error:
            result[sequence, coding] = Delta(None, why=str(error))
    return result


def mean_percent(values):
    """Of percentages of change, as factors: the mean of their logarithms; None where there are none."""
    known = [math.log1p(value / 100) for value in values]
    return 100 * math.expm1(sum(known) / len(known)) if known else None


def mean_delta(found):
    """The mean over sequences."""
    return mean_percent(delta.percent for delta in found if delta.percent is not None)


def at_error(rows, measure, error):
    """{(sequence, coding): (rate, encode Mv/s, decode Mv/s) at that error}: logarithms interpolated between the points around it."""
    result = {}
    by_curve = {}
    for row in rows:
        by_curve.setdefault((row["sequence"], row["coding"]), []).append(row)
    for key, points in by_curve.items():
        points = sorted((p for p in points if p.get(measure)), key=lambda row: row[measure])
        for a, b in zip(points, points[1:]):
            if a[measure] <= error <= b[measure] and a[measure] < b[measure]:
                t = math.log(error / a[measure]) / math.log(b[measure] / a[measure])
                mixed = lambda name: math.exp((1 - t) * math.log(a[name]) + t * math.log(b[name]))
                result[key] = tuple(mixed(name) for name in ("bpfv", "encode_mvs", "decode_mvs"))
                break
    return result
