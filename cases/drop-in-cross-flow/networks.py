#!/usr/bin/python3
"""Drops of springs in a uniform stream, the paper's way: what tension their constants stand for is calibrated in shear. Runs,
compares with Loth's curve, draws. See README.md."""
import json
import os
import subprocess
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import check  # noqa: E402
import common  # noqa: E402

SHEAR = CASE.parent / "drop-in-shear" / "literal.toml"
SHEAR_EDGE, BENDING = 250.0, 0.32                   # constants of that network: k_e, and k_b over k_e R^2
DRAG, F1, RADIUS = 100.0, 16 / 35, 0.5
FREQUENCY, MASS = 6, 0.022                          # 362 vertices: edges about as long as the spacings of the grid
WEBER = {2: 10, 1: 10, 4: 10, 0.5: 6, 0.25: 6}      # and the end of the run
MARKS = "<!-- networks: written by networks.py --update-readme -->", "<!-- end of networks -->"


def calibrate(arguments):
    """Tension over k_e: the drop in shear relaxes by the tension s as one of sigma = 4 s / (f1 c_d), which `calibrate` finds."""
    settings = {"body.drop.surface.frequency": FREQUENCY, "body.drop.mass_per_vertex": MASS}
    options = [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]
    command = [str(arguments.binary), "calibrate", str(SHEAR), *options, "--json", "--average-from", "10", "--out",
               str(arguments.out / "calibration")]
    found = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
    return found, found["surface_tension"] * F1 * DRAG / 4 / SHEAR_EDGE


def network(weber, ratio):
    """Constants of a network that stands for the tension 1 / We."""
    edge = 1 / weber / ratio
    return {"body.drop.surface.frequency": FREQUENCY, "body.drop.potentials.edge.stiffness": float(f"{edge:.4g}"),
            "body.drop.potentials.bending.stiffness": float(f"{BENDING * edge * RADIUS**2:.4g}"), "time.end": WEBER[weber]}


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.6), layout="constrained")
    weber = np.linspace(0, 4.2, 100)
    curve = np.array([check.loth(w) for w in weber])
    left.plot(weber, curve, "k", label="Loth (2008)")
    left.fill_between(weber, curve - check.BAND, curve + check.BAND, color="0.92", zorder=0)
    left.plot(weber[:40], 1 - check.SLOPE * weber[:40], "k:", lw=1, label="small We, no slip")
    left.plot([r.weber for r in results], [r.ratio for r in results], "D", color="#31a354", label="network of springs")
    left.set(xlim=(0, 4.2), ylim=(0.3, 1.02), xlabel="We", ylabel="$l_x / l_z$")
    left.legend(fontsize=8)
    for r in results:
        right.plot(r.time, r.ratios, color="#31a354", lw=0.9)
        right.text(r.time[-1] + 0.1, r.ratios[-1], f"{r.weber:g}", fontsize=7, va="center")
    right.set(xlim=(0, 10.8), ylim=(0.3, 1.02), xlabel="$t U / d$", ylabel="$l_x / l_z$")
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "drop-in-cross-flow-networks", quick="We = 2 alone")
    calibration, ratio = calibrate(arguments)
    results = []
    for weber in [2] if arguments.quick else WEBER:
        out = common.run(arguments, f"network-we{weber:g}", CASE / "network.toml", network(weber, ratio))
        results.append(check.Result("network", weber, out))
    results.sort(key=lambda r: r.weber)
    bounds = common.Bounds()
    for r in results:
        bounds.within(f"l_x / l_z at We = {r.weber:g}, network", r.ratio, round(check.loth(r.weber) - check.BAND, 3),
                      round(check.loth(r.weber) + check.BAND, 3))
    text = common.how_measured(results[0].report, "cases/drop-in-cross-flow/networks.py --update-readme")
    text += (f"\nCalibration in shear: k_e = {SHEAR_EDGE:g} there fits sigma = {calibration['surface_tension']:.3f} (Ca = {calibration['capillary_number']:.4f}, "
             f"residual {calibration['residual']:.1g}), so the tension s = sigma f1 c_d / 4 = {ratio:.4f} k_e.\n\n")
    constants = [network(r.weber, ratio) for r in results]
    rows = [r.row()[:1] + [r.row()[1], c["body.drop.potentials.edge.stiffness"], c["body.drop.potentials.bending.stiffness"]] + r.row()[2:]
            for r, c in zip(results, constants)]
    header = check.HEADER[:2] + ["k_e", "k_b"] + check.HEADER[2:]
    text += bounds.markdown() + "\n" + common.markdown_table(header, rows)
    (arguments.out / "results.md").write_text(text)
    picture = (CASE if arguments.update_readme else arguments.out) / "drop-in-cross-flow-networks.png"
    draw(results, picture)
    if arguments.update_readme:
        common.update_readme(CASE / "README.md", text, *MARKS)
    print(f"\n{text}\nFigure: {os.path.relpath(picture)}\n{'PASS' if bounds.passes else 'FAIL'}")
    return 0 if bounds.passes else 1


if __name__ == "__main__":
    sys.exit(main())
