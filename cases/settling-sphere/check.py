#!/usr/bin/python3
"""The settling spheres E1 and E4 of ten Cate et al. (2002): runs, compares, draws. See README.md."""
import math
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

DIAMETER = 0.015
# speed in an unbounded fluid, greatest speed over it by the table of the paper, times between which it falls steadily
EXPERIMENTS = {"E1": (0.038, 0.947, (1.0, 2.7)), "E4": (0.128, 0.955, (0.6, 1.1))}
PEAK = 0.99  # loads are averaged where the speed is above this part of its greatest
NEAR_FLOOR = 0.5  # diameters: curves are compared above
LIMIT = 3  # per cent
# name: experiment, diameter over grid spacing, file, settings
SETTLING = {
    "e4-7.5": ("E4", 7.5, "case.toml", {}),
    "e4-12": ("E4", 12, "case.toml", {"box.cells": "[80,80,128]"}),
    "e4-16.5": ("E4", 16.5, "case.toml", {"box.cells": "[110,110,176]", "time.end": 1.25,
                                      "output.history.every": 5}),
    "e1-7.5": ("E1", 7.5, "e1.toml", {}),
    "e1-12": ("E1", 12, "e1.toml", {"box.cells": "[80,80,128]", "time.max_step": 0.0012, "time.end": 2,
                                 "output.history.every": 5}),
}
PROBES = {"body.sphere.loads": "probes", "time.end": 0.85}  # later the probes reach through the floor
NEUTRAL = {"body.sphere.density": 960, "time.end": 0.1}
QUICK = ["e4-7.5", "e4-12", "e1-7.5"]
RISE = {"body.sphere.density": 96, "body.sphere.center": "[0,0,0.03]", "time.end": 0.25, "time.max_step": 0.001}
LIGHT = {
    "light-strong": ("strong, Aitken", {"body.sphere.coupling": "strong"}),
    "light-virtual": ("loose, virtual mass 0.5", {"body.sphere.virtual_mass": 0.5}),
    "light-virtual-1": ("loose, virtual mass 1", {"body.sphere.virtual_mass": 1}),
}


def points(name):
    import numpy as np

    return np.loadtxt(CASE / "reference" / f"{name}.dat", unpack=True)


def measure(out, experiment):
    import numpy as np

    body = common.read_table(out / "bodies" / "sphere.csv")
    time, speed, gap = body["time"], -body["velocity_z"], (body["z"] - DIAMETER / 2) / DIAMETER
    times, speeds = points(f"{experiment.lower()}-velocity")
    gap_times, gaps = points(f"{experiment.lower()}-gap")
    until = time[-1] if gap.min() > NEAR_FLOOR else np.interp(-NEAR_FLOOR, -gap, time)
    seen, gap_seen = times <= until, gap_times <= until
    peak = -speeds.min()
    return {
        "body": body, "speed": speed, "gap": gap, "peak": float(speed.max()), "measured peak": peak,
        "speed off": 100 * rms(np.interp(times[seen], time, speed) + speeds[seen]) / peak,
        "gap off": rms(np.interp(gap_times[gap_seen], time, gap) - gaps[gap_seen]),
        "report": common.report(out),
    }


def rms(values):
    return float((values**2).mean() ** 0.5)


def off(value, reference):
    return f"{100 * (value / reference - 1):+.1f} %"


def settling_table(results):
    rows = []
    for name, r in results.items():
        experiment, cells = SETTLING[name][:2]
        unbounded, ratio, _ = EXPERIMENTS[experiment]
        rows.append([experiment, f"{cells:g}", r["report"]["steps"], f"{r['peak']:.4f}", off(r["peak"], r["measured peak"]),
                     off(r["peak"], unbounded * ratio), f"{r['speed off']:.1f} %",
                     f"{r['gap off']:.2f} d", f"{r['report']['wall_seconds'] / 60:.1f}"])
    return common.markdown_table(["", "cells a diameter", "steps", "peak speed, m/s", "off figure 5b", "off the table",
                         "speed, rms off the curve", "gap, rms off the curve", "minutes"],
                        rows)


def references_table():
    """Whether the measured speeds agree with each other and with the way that there is to fall."""
    import numpy as np

    rows = []
    for experiment, (unbounded, ratio, (begin, end)) in EXPERIMENTS.items():
        times, speeds = points(f"{experiment.lower()}-velocity")
        gap_times, gaps = points(f"{experiment.lower()}-gap")
        steady = (gap_times > begin) & (gap_times < end)
        slope, scatter = np.polyfit(gap_times[steady], -DIAMETER * gaps[steady], 1, cov=True)
        order = np.argsort(times, kind="stable")
        t, v = np.append(0, times[order]), np.append(0, -speeds[order])
        fallen = 1e3 * float(((t[1:] - t[:-1]) * (v[1:] + v[:-1]) / 2).sum())
        there = 1e3 * DIAMETER * (8 - np.interp(t[-1], gap_times, gaps))
        rows.append([experiment, f"{v.max():.4f}", f"{unbounded * ratio:.4f}",
                     f"{slope[0]:.4f} +- {scatter[0, 0] ** 0.5:.4f}", f"{fallen:.1f}", f"{there:.1f}"])
    return common.markdown_table(["", "figure 5b, largest", "table", "slope of figure 5a", "way fallen, integral of figure 5b, mm",
                         "way there is to fall until then, mm"], rows)


def finest(results, experiment):
    return [r for n, r in results.items() if SETTLING[n][0] == experiment][-1]


def probes_table(results, driven):
    """Drag where the sphere is fastest, by both loads, over the weight that they carry there."""
    rows = []
    for name, r in {**{n: r for n, r in results.items() if n.startswith("e4")}, "driven": driven}.items():
        body, at = r["body"], r["speed"] > PEAK * r["peak"]
        volume = math.pi / 6 * DIAMETER**3
        weight = volume * 9.81 * (1120 - 960)
        moved_by = "probes" if name == "driven" else "momentum balance"
        cells = 7.5 if name == "driven" else SETTLING[name][1]
        rows.append([moved_by, f"{cells:g}", f"{r['peak']:.4f}", off(r["peak"], r["measured peak"]),
                     f"{body['force_z'][at].mean() / weight:.3f}", f"{body['probe_force_z'][at].mean() / weight:.3f}"])
    return common.markdown_table(["moved by", "cells a diameter", "peak speed, m/s", "off figure 5b",
                         "momentum balance / weight", "probes / weight"], rows)


def light_table(arguments, bounds):
    import numpy as np

    rows, speeds = [], {}
    times = [0.05, 0.1, 0.15, 0.2, 0.25]
    for name, (label, settings) in LIGHT.items():
        out = common.run(arguments, name, CASE / "case.toml", {**RISE, **settings})
        body, report = common.read_table(out / "bodies" / "sphere.csv"), common.report(out)
        speeds[name] = np.interp(times, body["time"], body["velocity_z"])
        rows.append([label, *(f"{v:.4f}" for v in speeds[name]), report["steps"], f"{report['wall_seconds']:.0f}"])
    strong = speeds["light-strong"]
    for name in ("light-virtual", "light-virtual-1"):
        largest = 100 * float(np.max(np.abs(speeds[name] / strong - 1)))
        bounds.at_most(f"light sphere, {LIGHT[name][0]}: rise speed off that of strong coupling, %", largest, 2)
    return common.markdown_table(["coupling", *(f"{t:g} s" for t in times), "steps", "seconds"], rows)


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.5), sharex="col", layout="constrained")
    for column, experiment in enumerate(EXPERIMENTS):
        speed_axis, gap_axis = axes[:, column]
        chosen = [(SETTLING[n][1], r) for n, r in results.items() if SETTLING[n][0] == experiment]
        for shade, (cells, r) in zip(("#9ecae1", "#4292c6", "#08306b"), sorted(chosen, key=lambda c: c[0])):
            speed_axis.plot(r["body"]["time"], r["speed"], color=shade, label=f"{cells:g} cells a diameter")
            gap_axis.plot(r["body"]["time"], r["gap"], color=shade)
        style = dict(ls="", marker="o", mfc="none", color="k", ms=4)
        times, speeds = points(f"{experiment.lower()}-velocity")
        speed_axis.plot(times, -speeds, label="experiment", **style)
        gap_axis.plot(*points(f"{experiment.lower()}-gap"), **style)
        speed_axis.set(title=f"{experiment}, Re = {'1.5' if experiment == 'E1' else '32'}", ylabel="speed, m/s", ylim=(0, None))
        gap_axis.set(xlabel="time, s", ylabel="gap to the floor, diameters", ylim=(0, None))
        speed_axis.legend(fontsize=9)
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "settling-sphere")
    results = {}
    for name, (experiment, _, file, settings) in SETTLING.items():
        if arguments.quick and name not in QUICK:
            continue
        results[name] = measure(common.run(arguments, name, CASE / file, settings), experiment)
    bounds = common.Bounds()
    for experiment in EXPERIMENTS:
        r = finest(results, experiment)
        unbounded, ratio, _ = EXPERIMENTS[experiment]
        bounds.near(f"{experiment}, finest grid: peak speed, m/s, against figure 5b", r["peak"], r["measured peak"],
                      LIMIT)
        bounds.near(f"{experiment}, finest grid: peak speed, m/s, against the table", r["peak"], unbounded * ratio,
                      LIMIT)
    parts = [settling_table(results), "### What the experiment says of the peak\nm/s.\n\n" + references_table()]
    if not arguments.quick:
        driven = measure(common.run(arguments, "e4-7.5-probes", CASE / "case.toml", PROBES), "E4")
        light = light_table(arguments, bounds)
        neutral = common.read_table(common.run(arguments, "neutral", CASE / "case.toml", NEUTRAL) / "bodies" / "sphere.csv")
        bounds.at_most("a sphere as heavy as the fluid, 50 steps: greatest speed, m/s",
                     max(abs(neutral[f"velocity_{d}"]).max() for d in "xyz"), 1e-14)
        parts += ["### Probes as the load\nE4.\n\n" + probes_table(results, driven),
                  "### A sphere a tenth as heavy as the fluid rises\nSpeed in m/s, 7.5 cells a diameter.\n\n" + light]
    text = "\n\n".join([bounds.markdown(), *parts])
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
