#!/usr/bin/python3
"""Capsules in shear flow that feels them, against theory and published simulations: runs, compares, draws. See README.md."""
import csv
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import bodies_in_shear as shear  # noqa: E402
import common  # noqa: E402

VISCOSITY = 10.0
NETWORK_SLOPE = 2.1875                                # D / Ca_G of an equilateral network, small deformations
HUET = {0.0125: 0.0803, 0.05: 0.2626, 0.2: 0.4959}    # steady D at Ca_E
OTHERS = {0.0125: "0.083 (DB)", 0.05: "0.279 (DB), 0.261 (RP)", 0.2: "0.494 (DB), 0.500 (RP)"}
ENDS = {0.0125: 2, 0.05: 5, 0.2: 8}
NETWORK_LIMIT, MEMBRANE_LIMIT = 4, 5                  # per cent


def network(capillary, length=6, cells=8, bending=0.0, end=1.0):
    """Name, file, settings of a network of springs at Ca_G."""
    settings = {**shear.box(length, cells), "fluid.viscosity": VISCOSITY, "time.end": end, "body.capsule.surface.frequency": cells,
                "body.capsule.potentials.edge.stiffness": round(4 / 3**0.5 * VISCOSITY / capillary, 4)}
    if bending:
        settings["body.capsule.potentials.bending.stiffness"] = bending
    extra = (f"-bending{bending:g}" if bending else "") + (f"-t{end:g}" if end != 1 else "")
    return f"network-ca{capillary:g}-box{length}-cells{cells}{extra}", "network.toml", settings


def membrane(capillary, length=6, cells=8, viscosity=VISCOSITY):
    """The same of a neo-Hookean membrane at Ca_E; Re = 1 / viscosity."""
    settings = {**shear.box(length, cells), "fluid.viscosity": viscosity, "time.end": ENDS[capillary], "body.capsule.surface.frequency": cells,
                "body.capsule.potentials.membrane.shear": round(viscosity / (3 * capillary), 4),
                "output.surfaces.interval": ENDS[capillary] / 40}
    slow = f"-re{1 / viscosity:g}" if viscosity != VISCOSITY else ""
    return f"membrane-ca{capillary:g}-box{length}-cells{cells}{slow}", "case.toml", settings


NETWORKS = [("0.02", 6, 8, network(0.02)), ("0.02", 8, 8, network(0.02, 8)), ("0.02", 10, 8, network(0.02, 10)),
            ("0.02", 6, 12, network(0.02, cells=12)), ("0.01", 6, 8, network(0.01)),
            ("0.02", 6, 8, network(0.02, bending=0.2)), ("0.02", 6, 8, network(0.02, bending=1.0)),
            ("0.02", 6, 8, network(0.02, end=3.0)), ("0.02", 6, 8, network(0.02, bending=0.2, end=3.0))]
MEMBRANES = [(ca, length, cells, membrane(ca, length, cells)) for ca in HUET for length, cells in ((6, 8), (10, 8), (6, 12))
             if (ca, cells) != (0.0125, 12)]
MEMBRANES += [(ca, 6, 8, membrane(ca, viscosity=50.0)) for ca in HUET]


def is_quick(row):
    return row[2] == 8 and (row[0] in (0.2, "0.02"))


def execute(arguments, rows, last):
    results = {}
    for *_, (name, file, settings) in rows:
        out = common.run(arguments, name, CASE / file, settings)
        results[name] = shear.Steady(out, "capsule", last=last(settings["time.end"]))
    return results


def boxes_of(rows, results, capillary):
    """Runs at 8 cells a radius without bending: sizes of the boxes and results."""
    chosen = {row[1]: results[row[3][0]] for row in rows
              if row[0] == capillary and row[2] == 8 and row[3][0] in results and row[3][0].endswith("cells8")}
    return list(chosen), list(chosen.values())


def endless(sizes, runs):
    return shear.limit([length**-3 for length in sizes], [s.d for s in runs])


def endless_history(sizes, runs):
    """D over time in an endless box: the straight line in L^-3 at every time."""
    import numpy as np

    times = runs[0].time
    values = np.array([np.interp(times, s.time, s.taylor) for s in runs])
    return times, np.polyfit(np.array(sizes, float)**-3, values, 1)[1]


def creeping(membranes, capillary, times):
    """What Re -> 0 adds to D over time: a straight line through Re = 0.1 and 0.02 in the box of 6 radii."""
    import numpy as np

    fast, slow = (membranes[membrane(capillary, viscosity=v)[0]] for v in (10.0, 50.0))
    return 1.25 * (np.interp(times, slow.time, slow.taylor) - np.interp(times, fast.time, fast.taylor))


def creeping_history(membranes, capillary):
    """D over time in an endless box at Re = 0."""
    times, values = endless_history(*boxes_of(MEMBRANES, membranes, capillary))
    return times, values + creeping(membranes, capillary, times)


def published(name):
    table = common.read_table(CASE / "reference" / f"{name}.csv")
    return table["time"], table["D"]


def boundary_integral(capillary, law="neo-hookean"):
    """D of reference/boundary_integral.py: straight line in 1/vertices, as h^2, through its two finest meshes."""
    with open(CASE / "reference" / "boundary-integral.csv", newline="") as lines:
        found = [(1 / int(row["vertices"]), float(row["D"])) for row in csv.DictReader(lines)
                 if row["law"] == law and float(row["capillary"]) == capillary]
    (coarse, first), (fine, last) = sorted(found, reverse=True)[-2:]
    return last + (last - first) * fine / (coarse - fine)


def history_error(history, capillary):
    """Largest difference from Huet over time, over his steady D, per cent."""
    import numpy as np

    times, values = history
    reference = np.interp(times, *published(f"huet-ca{capillary:g}"))
    return 100 * abs(values - reference).max() / HUET[capillary]


def row_of(row, s, reference):
    *_, (name, _, settings) = row
    bending = settings.get("body.capsule.potentials.bending.stiffness", 0)
    viscosity = settings["fluid.viscosity"]
    nu_dt = s.report["time"] / s.steps * viscosity * row[2]**2
    return [row[0], row[1], row[2], 10 * settings["body.capsule.surface.frequency"]**2 + 2, f"{1 / viscosity:g}", f"{bending:g}" if bending else "-",
            f"{settings['time.end']:g}", f"{nu_dt:.1f}", f"{s.d:.4f}", f"{100 * (s.d / reference - 1):+.1f} %", f"{s.by_moments:.4f}",
            f"{s.angle:.1f}", f"{100 * s.change:.2f} %", f"{s.hinges:.2f}", s.steps, f"{s.minutes:.1f}"]


HEADER = ["box, a", "cells a radius", "vertices", "Re", "k_b", "end", "nu dt/h^2", "D", "against theory", "D by moments", "angle",
          "change of D at the end", "hinges", "steps", "minutes"]


def draw(networks, membranes, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained", width_ratios=(1.5, 1))
    for capillary, colour in ((0.0125, "#31a354"), (0.05, "#08519c"), (0.2, "#d95f0e")):
        if membrane(capillary)[0] not in membranes:
            continue
        left.plot(*creeping_history(membranes, capillary), color=colour, label=f"$Ca_E$ = {capillary:g}")
        left.plot(*published(f"boundary-integral-ca{capillary:g}"), color="k", lw=0.9, label="boundary integral" if capillary == 0.2 else None)
        left.plot(*published(f"huet-ca{capillary:g}"), color="k", ls="--", lw=0.9, label="Huet" if capillary == 0.2 else None)
        if capillary > 0.02:
            left.plot(*published(f"ramanujan-pozrikidis-ca{capillary:g}"), ".", color="0.4", ms=4,
                      label="Ramanujan and Pozrikidis" if capillary == 0.2 else None)
    left.plot(*published("doddi-bagchi-ca0.05"), "x", color="0.4", ms=5, label="Doddi and Bagchi")
    left.set(xlim=(0, 8), ylim=(0, 0.62), xlabel=r"$\gamma t$", ylabel="D, endless box, Re = 0")
    left.legend(ncols=2, fontsize=8, loc="center right", bbox_to_anchor=(1, 0.26), frameon=False)
    sizes, runs = boxes_of(NETWORKS, networks, "0.02")
    for length, s, colour in zip(sizes, runs, ("#9ecae1", "#4292c6", "#08306b")):
        right.plot(s.time, s.taylor / 0.02, color=colour, label=f"box {length} a")
    long = [n for n in networks if n.endswith("-t3")]
    for name in long:
        s = networks[name]
        right.plot(s.time, s.taylor / 0.02, color="#d95f0e", ls="--" if "bending" in name else "-", lw=0.9,
                   label="box 6 a, with bending" if "bending" in name else "box 6 a, to the end")
    right.axhline(NETWORK_SLOPE, color="k", ls=":", lw=0.8)
    right.axhspan(NETWORK_SLOPE * (1 - NETWORK_LIMIT / 100), NETWORK_SLOPE * (1 + NETWORK_LIMIT / 100), color="0.92", zorder=0)
    right.set(xlim=(0, 3), ylim=(1.6, 2.7), xlabel=r"$\gamma t$", ylabel=r"$D / Ca_G$, network of springs")
    right.legend(fontsize=8)
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "capsule-in-shear", quick="springs at Ca_G = 0.02 and neo-Hookean at Ca_E = 0.2, 8 cells a radius")
    chosen = [[row for row in rows if not arguments.quick or is_quick(row)] for rows in (NETWORKS, MEMBRANES)]
    networks = execute(arguments, chosen[0], lambda end: 0.5)
    membranes = execute(arguments, chosen[1], lambda end: end / 5)
    bounds = common.Bounds()
    d, slope = endless(*boxes_of(NETWORKS, networks, "0.02"))
    bounds.near("network: D / Ca_G at Ca_G = 0.02, endless box", d / 0.02, NETWORK_SLOPE, NETWORK_LIMIT)
    limits = [["springs, Ca_G = 0.02", f"{d:.4f}", f"{boundary_integral(0.02, 'springs'):.4f}", f"{0.02 * NETWORK_SLOPE:.4f} (theory)", f"{slope:.1f} (L/a)^-3", "-"]]
    for capillary, reference in HUET.items():
        if arguments.quick and capillary != 0.2:
            continue
        sizes, runs = boxes_of(MEMBRANES, membranes, capillary)
        _, slope = endless(sizes, runs)
        times, values = creeping_history(membranes, capillary)
        d = values[times > 0.8 * times[-1]].mean()
        bounds.near(f"neo-Hookean: D at Ca_E = {capillary:g}, endless box, Re = 0", d, reference, MEMBRANE_LIMIT)
        bounds.near(f"neo-Hookean: D at Ca_E = {capillary:g}, against the boundary integral", d, boundary_integral(capillary), MEMBRANE_LIMIT)
        error = history_error((times, values), capillary)
        bounds.at_most(f"neo-Hookean: largest difference from Huet over time, Ca_E = {capillary:g}", error, MEMBRANE_LIMIT, " % of D")
        limits.append([f"neo-Hookean, Ca_E = {capillary:g}", f"{d:.4f}", f"{boundary_integral(capillary):.4f}", f"{reference} (Huet), {OTHERS[capillary]}", f"{slope:.1f} (L/a)^-3",
                       f"{error:.1f} %"])
    text = common.how_measured(next(iter(networks.values())).report, "cases/capsule-in-shear/check.py --update-readme") + "\n"
    text += bounds.markdown() + "\n" + common.markdown_table(
        ["capsule", "D in an endless box (membranes: at Re = 0)", "boundary integral", "published", "box adds to D", "largest difference over time"], limits)
    text += "\nNetwork of springs:\n\n" + common.markdown_table(
        ["Ca_G"] + HEADER, [row_of(row, networks[row[3][0]], NETWORK_SLOPE * float(row[0])) for row in chosen[0]])
    text += "\nNeo-Hookean membrane:\n\n" + common.markdown_table(
        ["Ca_E"] + [h if h != "against theory" else "against Huet" for h in HEADER],
        [row_of(row, membranes[row[3][0]], HUET[row[0]]) for row in chosen[1]])
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(networks, membranes, picture))


if __name__ == "__main__":
    sys.exit(main())
