"""The parts of the report about the basis: table 8.2, table 9.2, figures 9.49 and 9.50, figure 9.51."""
# SPDX-License-Identifier: MIT
from section import Section, listed

ORDERS = range(1, 5)


def table_8_2(results):
    section = Section("Table 8.2: eigenvalues of the chicken sequence")
    for row, figures in results:
        printed, ours, total = row.printed, figures["eigenvalues"], figures["sum"]
        scale = printed["sum"] / total
        lines = [(i + 1, big, small, f"{value * scale:.1f}", f"{100 * value / total:.2f}") for i, (big, small, value) in
                 enumerate(zip(printed["eigenvalues"], printed["percent"], ours))]
        rest = total - sum(ours)
        lines.append((f"remaining {figures['all'] - len(ours)}", printed["remaining"], "0.12", f"{rest * scale:.1f}",
                      f"{100 * rest / total:.2f}"))
        lines.append(("sum", printed["sum"], "100", f"{total * scale:.1f}", "100"))
        section.table(["order", "thesis", "%", f"here x {scale:.4f}", "%"], lines)
        worst = max(abs(value * scale / big - 1) for value, big in zip(ours, printed["eigenvalues"]))
        section.say(f"Ours are the sums of squared coefficients over all {figures['vertices']} vertices, in the units of the "
                    f"file at hand. One factor, {scale:.4f}, the square of {scale ** 0.5:.4f}, takes all of them to the thesis' "
                    f"within {100 * worst:.2f} %: the thesis' copy of the sequence is in other units.")
        section.direction("The first twenty of the chicken's 1200 eigenvalues hold 99.88 % of the variance (table 8.2)",
                          abs(100 * (1 - rest / total) - 99.88) < 0.005, f"{100 * (1 - rest / total):.2f} %")
        section.rows += [{"sequence": row.sequence, "order": i + 1, "eigenvalue": value, "percent": 100 * value / total,
                          "printed_eigenvalue": big, "printed_percent": small} for i, (big, small, value) in
                         enumerate(zip(printed["eigenvalues"], printed["percent"], ours))]
    return section


def lowest(figures, names):
    return min(figures[name]["entropy"] for name in names)


def table_9_2(results):
    section = Section("Table 9.2: entropies of the basis' residuals")
    shared, own, cobra = ([f"{kind}{i}" for i in ORDERS] for kind in ("lpc", "own_lpc", "cob"))
    names = shared + cobra
    lines, off = [], []
    for row, figures in results:
        lines.append([f"{row.sequence}, {row.settings['bases']}", "thesis"] + [f"{row.printed[name]:.2f}" for name in names])
        lines.append(["", "here"] + [f"{figures[name]['entropy']:.2f}" for name in names])
        off += [abs(figures[name]["entropy"] - row.printed[name]) for name in names if name != "cob1"]
        section.rows.append({"sequence": row.sequence, "bases": row.settings["bases"], "kg": figures["kg"],
                             **{name: figures[name]["entropy"] for name in names + own},
                             **{f"squares_{name}": figures[name]["squares"] for name in names + own},
                             **{f"printed_{name}": row.printed[name] for name in ["kg"] + names}})
    if not results:
        return section
    section.table(["sequence, K", ""] + [name.upper() if "lpc" in name else name.capitalize() for name in names], lines)
    section.say(
        "Bits a residual, all basis vectors in one histogram, non-uniform steps. The thesis does not print the step: ours is the "
        "one that leaves Cob1 its entropy, so that column agrees by construction and the other seven are measured. They differ "
        f"by {sum(off) / len(off):.3f} bits on average, {max(off):.2f} at most.",
        "Its column *KG* is not ours to repeat: at steps as fine as these the basis adds nothing to the error of leaving vectors "
        "out (" + listed(f"{row.sequence} {row.settings['bases']}: {figures['kg']:.2f} % for {row.printed['kg']:.2f} %"
                         for row, figures in results) + "); the rest of the thesis' error is that of its coefficients.",
        "The thesis' LPC has one set of weights for the whole basis: so these entropies come out, and so `--basis lpc1` .. `lpc4` "
        "works. With weights of its own for each vector, as Karni and Gotsman have them, LPC is better:")
    section.table(["sequence, K", *(f"own LPC{i}" for i in ORDERS), "best Cob", "lower"],
                  [[f"{row.sequence}, {row.settings['bases']}", *(f"{figures[name]['entropy']:.2f}" for name in own),
                    f"{lowest(figures, cobra):.2f}", "Cobra" if lowest(figures, cobra) < lowest(figures, own) else "LPC"]
                   for row, figures in results])
    directions_of_9_2(section, results)
    return section


def directions_of_9_2(section, results):
    of = lambda names: [lowest(figures, names) for _, figures in results]
    best, lpc = of(["cob2", "cob3"]), of([f"lpc{i}" for i in ORDERS])
    section.direction("Cob2 or Cob3 leaves less than any LPC (table 9.2)", all(a < b for a, b in zip(best, lpc)),
                      f"in {sum(a < b for a, b in zip(best, lpc))} of {len(best)} rows, by {min(b - a for a, b in zip(best, lpc)):.2f} "
                      f"to {max(b - a for a, b in zip(best, lpc)):.2f} bits; with weights a vector LPC wins in "
                      f"{sum(a > b for a, b in zip(best, of([f'own_lpc{i}' for i in ORDERS])))}")
    squares = [[figures[f"{kind}{i}"]["squares"] for i in ORDERS] for _, figures in results for kind in ("lpc", "cob")]
    falls = all(a > b for row in squares[::2] for a, b in zip(row, row[1:]))
    above = all(a < b for lpc_row, cob_row in zip(squares[::2], squares[1::2]) for a, b in zip(lpc_row, cob_row))
    section.direction("The sum of squared residuals falls with the order of LPC, and Cobra's is larger than that of the LPC of "
                      "the same order (9.4)", falls and above, "in every row" if falls and above else "not in every row")


def figure_9_49(results, draw):
    section = Section("Figures 9.49 and 9.50: one step tripled")
    for row, figures in results:
        draw("figure-9-49-50", "tripled", row, figures)
        grows = {name: [after / figures[name]["before"] for after in figures[name]["after"]]
                 for name in ("uniform", "non_uniform")}
        section.text += ["![The KG error where the step of one basis vector is tripled](figures/figure-9-49-50.svg)", ""]
        uniform, balanced = grows["uniform"], grows["non_uniform"]
        size = (3 * figures["frames"]) ** -0.5  # root mean square of a unit vector's values
        section.say(f"The KG error of the {row.sequence} at {row.settings['bases']} basis vectors with exact coefficients, where the "
                    f"step of one vector is three times what it was; before, it is {row.settings['kg']} %, of which "
                    f"{figures['kg_of_exact_basis']:.2f} % are the vectors left out. The thesis says neither how many vectors nor how fine "
                    "the steps were, and prints the curves only; so we take fifty and the error that table 9.2 has for them. "
                    f"With uniform steps the first vector takes the error to {uniform[0]:.2f} times its value, the tenth to "
                    f"{uniform[9]:.3f} times, the last to {uniform[-1]:.5f} times. With non-uniform steps every vector does "
                    f"between {min(balanced):.3f} and {max(balanced):.3f} times; least at the end, where the step comes near the values' own "
                    f"size ({figures['non_uniform']['steps'][-1]:.3f} of {size:.3f}) and a coarser one can do no more than lose them.")
        harm = lambda curve: [value ** 2 - 1 for value in curve]
        spread = lambda curve: max(harm(curve)) / min(harm(curve))
        section.direction("Uniform steps are unbalanced: tripling the first is radical, tripling the tenth does nothing (figure 9.49)",
                          uniform[0] - 1 > 100 * (uniform[9] - 1), f"{uniform[0]:.2f} and {uniform[9]:.3f} times the error")
        section.direction("Non-uniform steps are balanced: tripling any does roughly the same (figure 9.50)", spread(balanced) < 10,
                          f"the largest growth of the squared error is {spread(balanced):.1f} times the least; "
                          f"with uniform steps {spread(uniform):.0f} times")
        section.rows += [{"sequence": row.sequence, "bases": row.settings["bases"], "kg_before": row.settings["kg"], "tripled": i + 1,
                          "kg_uniform": figures["uniform"]["after"][i], "kg_non_uniform": figures["non_uniform"]["after"][i]}
                         for i in range(len(uniform))]
    return section


def figure_9_51(results, draw):
    section = Section("Figure 9.51: what the basis takes")
    if not results:
        return section
    bits = lambda figures, part: 8 * figures[part] / 1000
    parts = [(row, [bits(figures, part) for part in ("connectivity_bytes", "residual_bits_bytes", "basis_bits_bytes")], figures)
             for row, figures in results]
    draw("figure-9-51", "parts", parts)
    section.text += ["![Connectivity, coefficients and basis at a KG error of 0.3 %](figures/figure-9-51.svg)", ""]
    section.say("At a KG error of 0.3 %, by Coddyac and Huffman; the encoder chooses the number of vectors and the steps for the "
                "smallest file. The thesis' direct coding has 8 bytes a value, ours 4 (float32): its bars would have twice the basis.")
    section.table(["sequence", "basis", "K", "connectivity kbit", "coefficients kbit", "basis kbit", "bits a value", "bpfv"],
                  [[row.sequence, row.name, figures["bases"], *(f"{part:.1f}" for part in sizes),
                    f"{1000 * sizes[2] / (3 * figures['frames'] * (figures['bases'] + 1)):.2f}", f"{figures['bpfv']:.3f}"]
                   for row, sizes, figures in parts])
    basis = {(row.sequence, row.name): sizes[2] for row, sizes, _ in parts}
    of = lambda name, other: [basis[s, name] / basis[s, other] for s in dict.fromkeys(row.sequence for row, _, _ in parts)]
    direct, uniform = of("Cobra", "direct"), of("Cobra", "Amjoun")
    section.direction("Cobra is far below direct coding of the basis (9.4, figure 9.51)", max(direct) < 0.5,
                      f"{100 * min(direct):.0f} to {100 * max(direct):.0f} % of float32, half of that of 8 bytes a value; "
                      f"{100 * min(uniform):.0f} to {100 * max(uniform):.0f} % of Amjoun's uniform steps")
    section.rows += [{"sequence": row.sequence, "basis": row.name, "bases": figures["bases"], "kg": figures["kg"],
                      "connectivity_kbit": sizes[0], "coefficients_kbit": sizes[1], "basis_kbit": sizes[2], "bpfv": figures["bpfv"]}
                     for row, sizes, figures in parts]
    return section
