#!/usr/bin/python3
"""The spin of a neutrally buoyant sphere in plane Couette flow: runs, compares, draws. See README.md."""
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

# name: cells a radius, Re = gamma a^2 / nu, settings
RUNS = {
    "6": (6, 0.1, {}),
    "10": (10, 0.1, {"box.cells": "[80,80,80]", "output.history.every": 4}),
    "6-small-step": (6, 0.1, {"time.step": 0.000833, "time.end": 1, "output.history.every": 12}),
    "6-re-1": (6, 1.0, {"fluid.viscosity": 1, "time.end": 10}),
}
QUICK = ["6", "6-re-1"]
LIMIT = 3  # per cent


def lin_peery_schowalter(reynolds):
    """Small-Re law of Lin, Peery and Schowalter (1970)."""
    return 0.5 * (1 - 0.1538 * reynolds**1.5)


def results_table(results):
    rows = []
    for name, (body, report) in results.items():
        cells, reynolds, _ = RUNS[name]
        spin = body["omega_y"][-1]
        case = report["case"]
        size = 8 / case["box"]["cells"][0]
        rows.append([cells, f"{reynolds:g}", f"{case['time']['step'] * case['fluid']['viscosity'] / size**2:.2g}",
                     f"{spin:.4f}", f"{200 * spin - 100:+.2f} %", f"{lin_peery_schowalter(reynolds):.4f}",
                     f"{body['slip_rms'][-1]:.4f}", f"{abs(body['x']).max() + abs(body['z']).max():.0e}",
                     report["steps"], f"{report['wall_seconds'] / 60:.1f}"])
    return common.markdown_table(["cells a radius", "Re", "nu dt / dx^2", "spin / gamma", "against 1/2", "small-Re law", "slip, rms",
                         "drift, radii", "steps", "minutes"], rows)


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, axis = plt.subplots(figsize=(6.5, 3.8), layout="constrained")
    for name, colour, style in (("6", "#6baed6", "-"), ("10", "#08306b", "--"), ("6-re-1", "#d95f0e", "-")):
        if name in results:
            body, (cells, reynolds, _) = results[name][0], RUNS[name]
            viscous = body["time"] / reynolds
            axis.plot(viscous, body["omega_y"], color=colour, ls=style, label=f"Re = {reynolds:g}, {cells} cells a radius")
    axis.axhline(0.5, color="k", lw=0.8, ls=":")
    axis.axhspan(0.5 * (1 - LIMIT / 100), 0.5 * (1 + LIMIT / 100), color="0.92", zorder=0)
    axis.set(xlim=(0, 10), ylim=(0.3, 0.65), xlabel=r"time, $a^2/\nu$", ylabel=r"spin, $\gamma$")
    axis.legend()
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "sphere-in-shear")
    results = {}
    for name, (_, _, settings) in RUNS.items():
        if not arguments.quick or name in QUICK:
            out = common.run(arguments, name, CASE / "case.toml", settings)
            results[name] = common.read_table(out / "bodies" / "sphere.csv"), common.report(out)
    bounds = common.Bounds()
    for name, (body, _) in results.items():
        cells, reynolds, _ = RUNS[name]
        if reynolds <= 0.1:
            bounds.near(f"spin / gamma, {cells} cells a radius, run {name}", body["omega_y"][-1], 0.5, LIMIT)
    text = bounds.markdown() + "\n\n" + results_table(results)
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
