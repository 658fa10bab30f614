#!/usr/bin/python3
"""A red blood cell is stretched at both ends, against optical tweezers. See README.md."""
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

# J. P. Mills, L. Qie, M. Dao, C. T. Lim and S. Suresh, MCB 1, 169 (2004): force in pN; transverse and axial diameter, and the
# bounds of both, in micrometres.
MILLS = [(0.0, 7.740, 7.738, 7.113, 8.355, 7.160, 8.492), (15.987, 6.707, 9.155, 5.942, 7.451, 8.344, 9.995),
         (19.338, 6.489, 9.648, 5.864, 7.102, 8.695, 10.617), (30.754, 6.107, 10.029, 5.321, 6.836, 8.905, 11.160),
         (38.365, 5.944, 10.905, 5.093, 6.823, 9.718, 12.080), (47.245, 5.399, 11.341, 4.488, 6.472, 10.063, 12.753),
         (67.964, 4.963, 12.322, 3.874, 6.067, 10.898, 13.796)]
FIRM = {"body.cell.potentials.membrane": '{ law = "neo-hookean", shear = 5.3 }',
        "body.cell.potentials.total_area": "{ stiffness = 2e4 }"}


def runs(quick):
    """name: force, settings"""
    forces = [m[0] for m in MILLS]
    wanted = {f"{force:g}": (force, {}) for force in (forces[0], forces[3], forces[-1])}
    if not quick:
        wanted = {f"{force:g}": (force, {}) for force in forces}
        wanted["coarse"] = (forces[-1], {"body.cell.surface.frequency": 6, "body.cell.mass_per_vertex": 0.01 * 642 / 362,
                                         "body.cell.damping": 0.02 * 642 / 362})
        wanted["fine"] = (forces[-1], {"body.cell.surface.frequency": 12, "body.cell.mass_per_vertex": 0.01 * 642 / 1442,
                                       "body.cell.damping": 0.02 * 642 / 1442})
        wanted["ratio-5"] = (forces[-1], {"body.cell.potentials.membrane.ratio": 5})
        wanted["ratio-50"] = (forces[-1], {"body.cell.potentials.membrane.ratio": 50})
        wanted["neo-hookean"] = (forces[-1], FIRM)
        wanted["bending-4.8e-19"] = (forces[-1], {"body.cell.potentials.bending.stiffness": 0.554})
    return wanted


def measure(out):
    """Diameters along and across the pull, at the end and one output before; changes of volume and area."""
    import h5py

    files = sorted(out.glob("surfaces/cell_*.h5"))
    first, before, last = (h5py.File(files[n])["positions"][:] for n in (0, -2, -1))
    table = common.read_table(out / "bodies" / "cell.csv")

    def size(x, d):
        return x[:, d].max() - x[:, d].min()

    return {"axial": size(last, 0), "transverse": size(last, 1), "thickness": size(last, 2), "shape": last, "start": first,
            "moved": abs(last - first).max(), "unsteady": max(abs(size(last, d) - size(before, d)) for d in (0, 1)),
            "volume": table["volume"][-1] / table["volume"][0] - 1, "area": table["area"][-1] / table["area"][0] - 1,
            "seconds": common.wall_seconds(out)}


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.6), layout="constrained")
    data = np.array(MILLS)
    for column, low, high, colour, name in ((2, 5, 6, "#b2182b", "along"), (1, 3, 4, "#2166ac", "across")):
        off = [data[:, column] - data[:, low], data[:, high] - data[:, column]]
        left.errorbar(data[:, 0], data[:, column], yerr=off, fmt="o", color=colour, ms=4, lw=1, capsize=2, label=f"{name}, Mills et al.")
        ours = sorted((r["force"], r["axial" if column == 2 else "transverse"]) for r in results.values() if not r["settings"])
        left.plot(*zip(*ours), "-", color=colour, label=f"{name}, Pliant")
    left.set(xlabel="force (pN)", ylabel="diameter (um)", ylim=(2, 15))
    left.legend(fontsize=8)
    for r, colour, shift in ((results["0"], "#888888", 4), (results["67.964"], "#b2182b", -4)):
        right.plot(r["shape"][:, 0], r["shape"][:, 1] + shift, ".", color=colour, ms=3)
    right.set(xlabel="x (um)", ylabel="y, apart (um)", aspect="equal")
    figure.savefig(file, dpi=150)


def main():
    arguments = common.read_arguments(__doc__, "red-cell-stretch", quick="three forces, on one mesh: a minute")
    results = {}
    for name, (force, settings) in runs(arguments.quick).items():
        out = common.run(arguments, name, CASE / "case.toml",
                         {**settings, "body.cell.pull.right.force": [force, 0, 0], "body.cell.pull.left.force": [-force, 0, 0]})
        results[name] = {**measure(out), "force": force, "settings": settings}

    bounds = common.Bounds()
    bounds.at_most("largest move of a vertex of a cell that nobody pulls", results["0"]["moved"], 1e-9, " um")
    for force, transverse, axial, *limits in MILLS:
        r = results.get(f"{force:g}")
        if r is None:
            continue
        bounds.within(f"diameter along at {force:g} pN", r["axial"], *limits[2:], " um")
        bounds.within(f"diameter across at {force:g} pN", r["transverse"], *limits[:2], " um")
    bounds.at_most("change of a diameter in the last half of the time, largest of all runs", max(r["unsteady"] for r in results.values()),
                   1e-6, " um")
    bounds.at_most("change of the volume, largest of all runs", 100 * max(abs(r["volume"]) for r in results.values()), 0.1, " %")
    if not arguments.quick:
        for d in ("axial", "transverse"):
            bounds.near(f"{d} diameter at 68 pN on 1442 vertices, against 642", results["fine"][d], results["67.964"][d], 3)

    mills = {m[0]: m for m in MILLS}
    rows = [[name, f"{r['force']:.1f}", f"{r['axial']:.2f}", f"{mills[r['force']][2]:.2f}", f"{r['transverse']:.2f}",
             f"{mills[r['force']][1]:.2f}", f"{r['thickness']:.2f}", f"{100 * r['volume']:+.2f} %", f"{100 * r['area']:+.1f} %",
             f"{r['seconds']:.0f}"] for name, r in results.items()]
    text = bounds.markdown() + "\n\n" + common.markdown_table(
        ["run", "F (pN)", "along (um)", "Mills", "across (um)", "Mills", "thick (um)", "volume", "area", "wall (s)"], rows)
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
