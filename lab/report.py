"""Writes what a plan gave as one HTML file that needs no network: an interactive chart, tables, and what made them."""
# SPDX-License-Identifier: MIT
import html
import json
import os
import re

from verdicts import at_error, deltas, mean_delta

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page")
FIXED_AXES = [{"key": key, "title": title, "unit": unit} for key, title, unit in
              (("bpfv", "rate", "bits per frame and vertex"), ("bytes", "size", "bytes"),
               ("encode_mvs", "encoding", "M vertices a processor second"), ("decode_mvs", "decoding", "M vertices a processor second"))]
COMPARED_AT = {"kg": 0.1, "sted": 0.03}  # errors at which rates and speeds are set side by side


def facts(curves, outcome, codecs, made_by):
    """Everything that the page shows."""
    axes = FIXED_AXES[:1] + [{"key": name, **outcome.about[name]} for name in curves.measures] + FIXED_AXES[1:]
    codings = [{"name": coding.name, "peer": bool(coding.peer), "counts": codecs[coding.name].counts, "lossless": codecs[coding.name].lossless}
               for coding in curves.codings if any(row["coding"] == coding.name for row in outcome.rows)]
    return {"title": curves.title, "anchor": curves.anchor, "runs": curves.runs, "measures": list(curves.measures), "axes": axes,
            "codings": codings, "sequences": list(dict.fromkeys(row["sequence"] for row in outcome.rows)), "rows": outcome.rows,
            "skipped": outcome.skipped, "made_by": made_by}


def cell(text, kind=""):
    return f'<td class="{kind}">{html.escape(text)}</td>' if kind else f"<td>{html.escape(text)}</td>"


def table(head, rows):
    """Rows: a name and cells that are HTML already."""
    lines = ['<div class="wide"><table class="data"><thead><tr>', *(f'<th scope="col">{html.escape(word)}</th>' for word in head),
             "</tr></thead><tbody>"]
    lines += [f'<tr><th scope="row">{html.escape(name)}</th>{"".join(cells)}</tr>' for name, *cells in rows]
    return "".join([*lines, "</tbody></table></div>"])


def delta_cell(delta):
    if delta is None:
        return cell("", "none")
    if delta.percent is None:
        return f'<td class="none" title="{html.escape(delta.why)}">no overlap</td>' if "overlap" in delta.why else \
            f'<td class="none" title="{html.escape(delta.why)}">too few points</td>'
    star = "*" if delta.share < 0.5 else ""
    kind = "none" if abs(delta.percent) < 0.05 else "less" if delta.percent < 0 else "more"
    return (f'<td class="{kind}" title="over {100 * delta.share:.0f} % of the anchor\'s range">'
            f"{percent(delta.percent)}{star}</td>")


def percent(value):
    if abs(value) < 0.05:
        return "0.0 %"
    return (f"{value:+.1f} %" if abs(value) < 100 else f"{value:+,.0f} %").replace("-", "\u2212")


def delta_table(known, measure):
    """Rates against the anchor: a row a coding, a column a sequence; the mean first, as a narrow window shows no more."""
    found = deltas(known["rows"], measure, known["anchor"])
    rows = []
    for coding in known["codings"]:
        mine = {sequence: delta for (sequence, name), delta in found.items() if name == coding["name"]}
        if mine:
            mean = mean_delta(mine.values())
            rows.append([coding["name"], cell("" if mean is None else percent(mean), "mean"),
                         *(delta_cell(mine.get(sequence)) for sequence in known["sequences"])])
    return table(["against " + known["anchor"], "mean", *known["sequences"]], rows) if rows else ""


def delta_section(known):
    titles = {axis["key"]: axis["title"] for axis in known["axes"]}
    parts = ["<section><h2>Bjøntegaard-delta rates</h2>",
             f"<p>How many bits more (+) or fewer (−) than {html.escape(known['anchor'])} at the same error: the mean over all errors that both curves "
             "reach, of the logarithm of the rate, between the points by PCHIP, errors in dB (VCEG-M33). * less than half of the anchor's range; "
             "where curves do not overlap there is no number, and pointing at the cell says why.</p>"]
    for measure in known["measures"]:
        if body := delta_table(known, measure):
            parts += [f"<h3>{html.escape(titles[measure])}</h3>", body]
    return "".join([*parts, "</section>"])


def level_section(known):
    """Rates and decoding speeds where an error is the same."""
    parts = []
    for measure in [measure for measure in known["measures"] if measure in COMPARED_AT]:
        found = at_error(known["rows"], measure, COMPARED_AT[measure])
        about = next(axis for axis in known["axes"] if axis["key"] == measure)
        rows = [[coding["name"], *(rate_cell(found.get((sequence, coding["name"]))) for sequence in known["sequences"])]
                for coding in known["codings"] if any(name == coding["name"] for _, name in found)]
        if rows:
            parts += [f"<h2>At {html.escape(about['title'])} {COMPARED_AT[measure]:g} {html.escape(about['unit'] or '')}</h2>",
                      "<p>Bits per frame and vertex / decoding, million vertices a processor second; logarithms interpolated between the points around.</p>",
                      table(["", *known["sequences"]], rows)]
    return f"<section>{''.join(parts)}</section>"


def rate_cell(found):
    return cell(f"{found[0]:.3f} / {found[2]:.3g}") if found else cell("–", "none")


def lossless_section(known):
    names = [coding["name"] for coding in known["codings"]]
    exact = [row for row in known["rows"] if row.get("max_error_relative", row.get("kg", 1)) == 0]
    if not exact:
        return ""
    by = {(row["coding"], row["sequence"]): row for row in exact}
    rows = [[name, *(cell(f"{by[name, s]['bpfv']:.2f} / {by[name, s]['decode_mvs']:.3g}") if (name, s) in by else cell("–", "none")
                     for s in known["sequences"])] for name in names if any(row["coding"] == name for row in exact)]
    return ("<section><h2>Without loss</h2><p>Every float32 comes back bit for bit. Bits per frame and vertex / decoding, million vertices a "
            f"second; float32 takes 96.</p>{table(['', *known['sequences']], rows)}</section>")


def every_row(known):
    columns = [axis for axis in known["axes"] if axis["key"] != "bytes"]
    rows = [[row["sequence"], cell(row["coding"]), cell(row["setting"]), cell(f"{row['bytes']:,}"),
             *(cell(f"{row[axis['key']]:.4g}") if row[axis["key"]] is not None else cell("∞") for axis in columns)] for row in known["rows"]]
    head = ["sequence", "coding", "setting", "bytes", *(axis["title"] for axis in columns)]
    return f"<section><h2>Every file</h2><details><summary>{len(rows)} files</summary>{table(head, rows)}</details></section>"


def background(known):
    items = lambda words: "<ul>" + "".join(f"<li>{html.escape(word)}</li>" for word in words) + "</ul>"
    counts = table(["coding", "what its size counts"], [[coding["name"], cell(coding["counts"], "words")] for coding in known["codings"]])
    skipped = f"<h2>Not measured</h2>{items(known['skipped'])}" if known["skipped"] else ""
    median = f"the median of {known['runs']} runs in turn" if known["runs"] > 1 else "in one run"
    return (f"<section><h2>What is counted</h2>{counts}{skipped}<h2>Made by</h2>"
            f"<p>Sizes are of whole files; errors are measured on what was decoded; times are a program's own, what the processor worked for it at one "
            f"thread, {median}.</p>{items(known['made_by'])}</section>")


def part(name):
    with open(os.path.join(PAGE, name), encoding="utf-8") as file:
        return file.read()


def page(known):
    count = lambda key, word: f"{len(known[key])} {word}{'s' * (len(known[key]) != 1)}"
    lead = (f"{count('codings', 'coding')} on {count('sequences', 'sequence')}. Rate is the whole file's bits per frame and vertex; lower "
            "and further left is better.")
    tables = delta_section(known) + level_section(known) + lossless_section(known) + every_row(known) + background(known)
    pieces = {"title": html.escape(known["title"]), "lead": html.escape(lead), "css": part("report.css"), "js": part("report.js"), "tables": tables,
              "facts": json.dumps(known, separators=(",", ":")).replace("<", "\\u003c")}
    return re.sub(r"\{\{(\w+)\}\}", lambda match: pieces[match[1]], part("report.html"))


def write(path, known):
    with open(path, "w", encoding="utf-8") as file:
        file.write(page(known))
