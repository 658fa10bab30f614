#!/usr/bin/python3
"""A prolate spheroid in plane Couette flow against the orbit of Jeffery (1922): runs, compares, draws. See README.md."""
import math
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

RATIO = 2
PERIOD = 2 * math.pi * (RATIO + 1 / RATIO)
FORGOTTEN = 0.2  # time after which the start from rest is forgotten: 4 a^2 / nu
START = 0.5  # the orbits are compared from here on
LIMIT = 4  # per cent
# name: cells in a shorter semi-axis, settings
RUNS = {
    "4-0.005": (4, {"time.step": 0.005, "output.history.every": 4}),
    "4-0.0025": (4, {"output.history.every": 8}),
    "4-0.00125": (4, {"time.step": 0.00125, "output.history.every": 16}),
    "6-0.00175": (6, {"box.cells": "[96,72,96]", "time.step": 0.00175, "output.history.every": 12}),
    "6-0.00125": (6, {"box.cells": "[96,72,96]", "time.step": 0.00125, "time.end": 4.35, "output.history.every": 16}),
}
QUICK = ["4-0.00125"]
FINEST = "6-0.00125"


def jeffery(time, angle):
    """Angle from the gradient towards the flow, a time after it was `angle`; in units of the shear rate."""
    import numpy as np

    phase = np.arctan2(np.sin(angle) / RATIO, np.cos(angle)) + np.asarray(time) * 2 * math.pi / PERIOD
    return np.unwrap(np.arctan2(RATIO * np.sin(phase), np.cos(phase)))


def measure(out):
    import numpy as np

    body = common.read_table(out / "bodies" / "spheroid.csv")
    time, rate = body["time"], body["omega_y"]
    angle = 2 * np.unwrap(np.arctan2(body["q_y"], body["q_w"]), period=math.pi)
    quarters = angle / (math.pi / 2)
    turns = np.arange(math.ceil(np.interp(FORGOTTEN, time, quarters)), quarters[-1]) * math.pi / 2
    if len(turns) < 2:
        sys.exit(f"check.py: {out}: the spheroid has not made a quarter turn from an axis: raise time.end")
    passed = np.interp(turns, angle, time)
    period = 2 * math.pi * (passed[-1] - passed[0]) / (turns[-1] - turns[0])
    at = int(np.searchsorted(time, START))
    deviation = np.degrees(angle[at:] - jeffery(time[at:] - time[at], angle[at]))
    return {"time": time, "angle": angle, "rate": rate, "at": at, "period": period, "deviation": deviation,
            "slow": float(np.interp(math.pi / 2, angle, rate)), "fast": float(np.interp(0, angle, rate)),
            "drift": float(np.hypot(body["x"], body["z"]).max()), "slip": float(body["slip_rms"][at:].mean()),
            "report": common.report(out)}


def results_table(results):
    rows = []
    for name, r in results.items():
        step, viscosity = (r["report"]["case"][k][v] for k, v in (("time", "step"), ("fluid", "viscosity")))
        rows.append([RUNS[name][0], f"{step:g}", f"{step * viscosity * 2 * RUNS[name][0] / 0.5:.2g}", f"{r['period']:.3f}",
                     f"{100 * (r['period'] / PERIOD - 1):+.2f} %", f"{r['slow']:.4f}", f"{r['fast']:.4f}",
                     f"{abs(r['deviation']).max():.1f}", f"{r['slip']:.3f}", f"{r['drift']:.0e}", r["report"]["steps"],
                     f"{r['report']['wall_seconds'] / 60:.1f}"])
    rows.append(["Jeffery", "", "", f"{PERIOD:.3f}", "", "0.2000", "0.8000", "", "", "", "", ""])
    return common.markdown_table(["cells in b", "gamma dt", "nu dt / (dx b)", "gamma T", "off", "rate along the flow",
                         "rate across", "angle, largest difference, degrees", "slip, rms", "drift / a", "steps",
                         "minutes"], rows)


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained")
    best = list(results.values())[-1]
    times = np.linspace(best["time"][best["at"]], best["time"][-1], 400)
    orbit = jeffery(times - times[0], best["angle"][best["at"]])
    angles = np.linspace(0, 1.05 * math.pi / 2, 200)
    left.plot(times, np.degrees(orbit), color="k", lw=1.2, label="Jeffery")
    rates = (RATIO**2 * np.cos(angles) ** 2 + np.sin(angles) ** 2) / (RATIO**2 + 1)
    right.plot(np.degrees(angles), rates, color="k", lw=1.2)
    colours = dict(zip(RUNS, ("#c6dbef", "#6baed6", "#2171b5", "#fdae6b", "#d94801")))
    for name, r in results.items():
        cells, step = RUNS[name][0], r["report"]["case"]["time"]["step"]
        style = dict(color=colours[name], ls="--")
        left.plot(r["time"], np.degrees(r["angle"]), label=f"{cells} cells in b, step {step:g}", **style)
        right.plot(np.degrees(r["angle"][r["at"]:]), r["rate"][r["at"]:], **style)
    left.set(xlabel=r"time, $1/\gamma$", ylabel=r"angle $\phi$ from the gradient, degrees")
    right.set(xlabel=r"angle $\phi$, degrees", ylabel=r"rate $\dot\phi$, $\gamma$", ylim=(0, 0.9))
    left.legend()
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "spheroid-in-shear")
    results = {}
    for name, (_, settings) in RUNS.items():
        if not arguments.quick or name in QUICK:
            results[name] = measure(common.run(arguments, name, CASE / "case.toml", settings))
    bounds = common.Bounds()
    for judged in QUICK if arguments.quick else [*QUICK, FINEST]:
        bounds.near(f"period times shear rate, {RUNS[judged][0]} cells in b, run {judged}", results[judged]["period"],
                      PERIOD, LIMIT)
    text = bounds.markdown() + "\n\n" + results_table(results)
    if not arguments.quick:
        first, second, third = (results[f"4-{step}"]["period"] for step in (0.005, 0.0025, 0.00125))
        limit = third - (third - second) ** 2 / (third - 2 * second + first)
        text += (f"\n\nStep to 0, by Aitken's rule from the three runs with 4 cells: gamma T = {limit:.3f}, "
                 f"{100 * (limit / PERIOD - 1):+.2f} %.")
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
