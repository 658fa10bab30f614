#!/usr/bin/python3
"""A drop in shear flow that feels it, against a boundary-integral solution: runs, compares, draws. See README.md."""
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import bodies_in_shear as shear  # noqa: E402
import common  # noqa: E402

# Ca: D (largest and least radius), angle; unbounded Stokes flow, boundary.csv
REFERENCE = {0.1: (0.1097, 38.7), 0.3: (0.3446, 25.9)}
TIMES = {0.1: 3, 0.3: 10}
D_LIMIT, ANGLE_LIMIT = 4, 2  # per cent, degrees


def settings(capillary, length, cells, frequency=8, viscosity=10.0):
    return {**shear.box(length, cells), "fluid.viscosity": viscosity,
            "body.drop.surface.frequency": frequency, "body.drop.potentials.surface_tension.sigma": round(viscosity / capillary, 6),
            "time.end": TIMES[capillary], "output.surfaces.interval": TIMES[capillary] / 20}


# Ca, box in radii, cells a radius, frequency of the mesh, viscosity (1/Re)
RUNS = [(ca, *rest) for ca in (0.1, 0.3)
        for rest in ((6, 8, 8, 10.0), (8, 8, 8, 10.0), (10, 8, 8, 10.0), (6, 6, 6, 10.0), (6, 12, 12, 10.0))]
RUNS += [(0.1, 6, 8, 8, 2.0), (0.1, 6, 8, 8, 50.0), (0.3, 6, 8, 8, 2.0), (0.3, 6, 8, 8, 50.0), (0.1, 6, 8, 12, 10.0)]
QUICK = [r for r in RUNS if r[1:] == (6, 8, 8, 10.0) or r[1:] == (8, 8, 8, 10.0)]


def name_of(run):
    capillary, length, cells, frequency, viscosity = run
    return f"ca{capillary:g}-box{length}-cells{cells}-f{frequency}-re{1 / viscosity:g}"


def results_table(results):
    rows = []
    for (capillary, length, cells, frequency, viscosity), s in results.items():
        reference, angle = REFERENCE[capillary]
        nu_dt = s.report["time"] / s.steps * viscosity * cells**2
        rows.append([f"{capillary:g}", length, cells, 10 * frequency**2 + 2, f"{1 / viscosity:g}", f"{nu_dt:.1f}", f"{s.d:.4f}",
                     f"{100 * (s.d / reference - 1):+.1f} %", f"{s.by_moments:.4f}", f"{s.angle:.1f}", f"{s.angle - angle:+.1f}",
                     f"{100 * s.change:.2f} %", s.steps, f"{s.minutes:.1f}"])
    return common.markdown_table(["Ca", "box, R", "cells a radius", "vertices", "Re", "nu dt/h^2", "D", "against BI", "D by moments",
                                  "angle", "against BI", "change of D at the end", "steps", "minutes"], rows)


def limits(results):
    """For each Ca, D and angle at 8 cells a radius in an endless box (straight line in L^-3), and what is added to them by
    the grid of 8 cells (line in h^2 from 12 to 8) and by Re = 0.1 (line from 0.02 to 0.1), both in the box of 6 radii."""
    found = {}
    for capillary in REFERENCE:
        boxes = [(r[1], s) for r, s in results.items() if r[0] == capillary and r[2:] == (8, 8, 10.0)]
        cubes = [length**-3 for length, _ in boxes]
        base, fine, slow = (results.get((capillary, 6, *rest)) for rest in ((8, 8, 10.0), (12, 12, 10.0), (8, 8, 50.0)))
        values = {}
        for what in ("d", "angle"):
            limit, slope = shear.limit(cubes, [getattr(s, what) for _, s in boxes])
            values[what] = {"limit": limit, "slope": slope, "finer": limit, "grid": 0.0, "re": 0.0}
            if fine and slow:
                change = getattr(base, what) - getattr(fine, what)
                inertia = 1.25 * (getattr(base, what) - getattr(slow, what))
                values[what] |= {"finer": limit - change - inertia, "grid": change * 9 / 5, "re": inertia}
        found[capillary] = values
    return found


def limit_table(found):
    rows = []
    for ca, values in found.items():
        d, angle, (reference, reference_angle) = values["d"], values["angle"], REFERENCE[ca]
        end, end_angle = d["limit"] - d["grid"] - d["re"], angle["limit"] - angle["grid"] - angle["re"]
        rows.append([f"{ca:g}", f"{d['limit']:.4f}", f"{d['slope']:.1f} (L/R)^-3", f"{d['grid']:+.4f}", f"{d['re']:+.4f}", f"{d['finer']:.4f}",
                     f"{end:.4f}", f"{100 * (end / reference - 1):+.1f} %", f"{end_angle:.1f}", f"{end_angle - reference_angle:+.1f}"])
    return common.markdown_table(["Ca", "D, endless box, 8 cells", "box adds to D", "8 cells add", "Re = 0.1 adds", "D, 12 cells, endless box, Re = 0",
                                  "D, also h -> 0", "against BI", "angle, all limits", "against BI"], rows)


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (over_time, over_box) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    colours = {6: "#9ecae1", 8: "#4292c6", 10: "#08306b"}
    for run, s in results.items():
        if run[2:] == (8, 8, 10.0):
            over_time.plot(*s.history, color=colours[run[1]], label=f"box {run[1]} R" if run[0] == 0.1 else None)
    for capillary, (d, _) in REFERENCE.items():
        over_time.axhline(d, color="k", lw=0.8, ls=":")
        over_time.text(9.9, d + 0.008, f"Ca = {capillary:g}", ha="right")
    over_time.set(xlim=(0, 10), ylim=(0, 0.42), xlabel=r"$\gamma t$", ylabel="D by moments")
    over_time.legend(loc="center right", bbox_to_anchor=(1, 0.55))
    for capillary, values in limits(results).items():
        d, slope = values["d"]["limit"], values["d"]["slope"]
        end = d - values["d"]["grid"] - values["d"]["re"]
        reference = REFERENCE[capillary][0]
        colour = "#08306b" if capillary == 0.1 else "#d95f0e"
        for run, s in results.items():
            if run[0] == capillary and run[4] == 10.0 and run[2] == run[3]:
                over_box.plot(run[1]**-3, s.d / reference, {6: "v", 8: "o", 12: "^"}[run[2]], color=colour)
        over_box.plot([0, 0.005], [d / reference, d * (1 + slope * 0.005) / reference], color=colour, lw=0.8, label=f"Ca = {capillary:g}")
        over_box.plot(0, end / reference, "*", color=colour, ms=10, clip_on=False)
    over_box.axhspan(1 - D_LIMIT / 100, 1 + D_LIMIT / 100, color="0.92", zorder=0)
    over_box.set(xlim=(0, 0.005), xlabel=r"$(R/L)^3$", ylabel="D over that of the boundary integral")
    over_box.plot([], [], "v", color="0.4", label="6 cells a radius")
    over_box.plot([], [], "o", color="0.4", label="8")
    over_box.plot([], [], "^", color="0.4", label="12")
    over_box.plot([], [], "*", color="0.4", ms=10, label="no box, no inertia, fine grid")
    over_box.legend(fontsize=8)
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "drop-two-way", quick="boxes of 6 and 8 radii with 8 cells a radius")
    results = {}
    for run in QUICK if arguments.quick else RUNS:
        out = common.run(arguments, name_of(run), CASE / "case.toml", settings(*run))
        results[run] = shear.Steady(out, "drop", last=TIMES[run[0]] / 6)
    found = limits(results)
    bounds = common.Bounds()
    for capillary, values in found.items():
        reference, reference_angle = REFERENCE[capillary]
        where = "8 cells" if arguments.quick else "12 cells, Re = 0"
        bounds.near(f"D at Ca = {capillary:g}, endless box, {where}", values["d"]["finer"], reference, D_LIMIT)
        bounds.within(f"angle at Ca = {capillary:g}, endless box, {where}", values["angle"]["finer"], reference_angle - ANGLE_LIMIT,
                      reference_angle + ANGLE_LIMIT, " degrees")
        if not arguments.quick:
            d = values["d"]
            bounds.near(f"D at Ca = {capillary:g}, endless box, Re = 0, h -> 0", d["limit"] - d["grid"] - d["re"], reference, D_LIMIT)
    text = bounds.markdown() + "\n" + limit_table(found) + "\n" + results_table(results)
    text = common.how_measured(next(iter(results.values())).report, "cases/drop-two-way/check.py --update-readme") + "\n" + text
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
