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
RUNS += [(0.3, 6, 16, 16, 10.0)]
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


class Limits:
    """D and angle at one Ca without box, inertia and grid. The box: straight line in L^-3 at 8 cells a radius. Inertia: line
    from Re = 0.02 to 0.1. The grid: line in h^2 through the two finest. The last two in the box of 6 radii."""

    def __init__(self, results, capillary, what):
        def value(*rest):
            run = results.get((capillary, *rest))
            return getattr(run, what) if run else None

        boxes = [r[1] for r in results if r[0] == capillary and r[2:] == (8, 8, 10.0)]
        self.endless, self.slope = shear.limit([length**-3 for length in boxes], [value(length, 8, 8, 10.0) for length in boxes])
        self.grids = {cells: value(6, cells, cells, 10.0) for cells in (6, 8, 12, 16) if value(6, cells, cells, 10.0)}
        slow = value(6, 8, 8, 50.0)
        self.inertia = 1.25 * (self.grids[8] - slow) if slow else 0.0
        self.grid = self.grids[8] - self.fine() if len(self.grids) > 1 else 0.0

    def fine(self):
        """In the box of 6 radii at h -> 0."""
        (coarse, first), (finest, last) = list(self.grids.items())[-2:]
        return last + (last - first) / ((finest / coarse)**2 - 1)

    def at(self, cells):
        """In an endless box at Re = 0 with so many cells a radius."""
        return self.endless - self.inertia - (self.grids[8] - self.grids[cells])

    def all(self):
        return self.endless - self.inertia - self.grid

    def order(self):
        """Of convergence on 8, 12 and 16 cells: p of D = D0 + C h^p by bisection."""
        if 16 not in self.grids:
            return None
        steps = [self.grids[8] - self.grids[12], self.grids[12] - self.grids[16]]
        if steps[0] * steps[1] <= 0:
            return None

        def ratio(p):
            return (8**-p - 12**-p) / (12**-p - 16**-p)

        low, high = 0.1, 8.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if ratio(middle) < steps[0] / steps[1] else (low, middle)
        return low


def limits(results):
    return {ca: {what: Limits(results, ca, what) for what in ("d", "angle")} for ca in REFERENCE}


def limit_table(found):
    rows = []
    for ca, values in found.items():
        d, angle, (reference, reference_angle) = values["d"], values["angle"], REFERENCE[ca]
        rows.append([f"{ca:g}", f"{d.endless:.4f}", f"{d.slope:.1f} (L/R)^-3", f"{d.grid:+.4f}", f"{d.inertia:+.4f}", f"{d.all():.4f}",
                     f"{100 * (d.all() / reference - 1):+.1f} %", f"{angle.all():.1f}", f"{angle.all() - reference_angle:+.1f}"])
    return common.markdown_table(["Ca", "D, endless box, 8 cells", "box adds to D", "8 cells add", "Re = 0.1 adds", "D, all limits",
                                  "against BI", "angle, all limits", "against BI"], rows)


def grid_table(found):
    """D and angle in an endless box at Re = 0 on each grid."""
    rows = []
    for ca, values in found.items():
        d, angle, (reference, reference_angle) = values["d"], values["angle"], REFERENCE[ca]
        for cells in d.grids:
            rows.append([f"{ca:g}", f"1/{cells}", f"{d.at(cells):.4f}", f"{100 * (d.at(cells) / reference - 1):+.1f} %",
                         f"{angle.at(cells):.1f}", f"{angle.at(cells) - reference_angle:+.1f}", ""])
        order = d.order()
        rows.append([f"{ca:g}", "0", f"{d.all():.4f}", f"{100 * (d.all() / reference - 1):+.1f} %", f"{angle.all():.1f}",
                     f"{angle.all() - reference_angle:+.1f}", f"{order:.1f}" if order else ""])
    return common.markdown_table(["Ca", "h / R", "D, endless box, Re = 0", "against BI", "angle", "against BI", "order of D, from 8, 12, 16 cells"], rows)


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
        d, slope, end = values["d"].endless, values["d"].slope, values["d"].all()
        reference = REFERENCE[capillary][0]
        colour = "#08306b" if capillary == 0.1 else "#d95f0e"
        for run, s in results.items():
            if run[0] == capillary and run[4] == 10.0 and run[2] == run[3]:
                over_box.plot(run[1]**-3, s.d / reference, {6: "v", 8: "o", 12: "^", 16: "D"}[run[2]], color=colour)
        over_box.plot([0, 0.005], [d / reference, d * (1 + slope * 0.005) / reference], color=colour, lw=0.8, label=f"Ca = {capillary:g}")
        over_box.plot(0, end / reference, "*", color=colour, ms=10, clip_on=False)
    over_box.axhspan(1 - D_LIMIT / 100, 1 + D_LIMIT / 100, color="0.92", zorder=0)
    over_box.set(xlim=(0, 0.005), xlabel=r"$(R/L)^3$", ylabel="D over that of the boundary integral")
    over_box.plot([], [], "v", color="0.4", label="6 cells a radius")
    over_box.plot([], [], "o", color="0.4", label="8")
    over_box.plot([], [], "^", color="0.4", label="12")
    over_box.plot([], [], "D", color="0.4", label="16")
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
        d, angle, (reference, reference_angle) = values["d"], values["angle"], REFERENCE[capillary]
        for cells in [8] if arguments.quick else [n for n in d.grids if n >= 12]:
            where = f"{cells} cells a radius, endless box" + ("" if arguments.quick else ", Re = 0")
            bounds.near(f"D at Ca = {capillary:g}, {where}", d.at(cells), reference, D_LIMIT)
            bounds.within(f"angle at Ca = {capillary:g}, {where}", angle.at(cells), reference_angle - ANGLE_LIMIT, reference_angle + ANGLE_LIMIT,
                          " degrees")
        if not arguments.quick:
            bounds.near(f"D at Ca = {capillary:g}, endless box, Re = 0, h -> 0", d.all(), reference, D_LIMIT)
    text = bounds.markdown() + "\n" + limit_table(found) + "\n" + grid_table(found) + "\n" + results_table(results)
    text = common.how_measured(next(iter(results.values())).report, "cases/drop-two-way/check.py --update-readme") + "\n" + text
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
