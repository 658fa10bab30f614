#!/usr/bin/python3
"""A square flag in a uniform stream: amplitude and Strouhal number of the middle of its trailing edge. See README.md."""
import sys
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

AMPLITUDE, STROUHAL = (0.75, 0.82), (0.255, 0.27)
PUBLISHED = {"Huang & Sung 2010": (0.780, 0.260), "Tian et al. 2014, plate": (0.806, 0.266),
             "Tian et al. 2014, solid": (0.812, 0.263), "Lee & Choi 2015": (0.752, 0.265)}
COARSE, FINE, FINEST = "16 cells", "24 cells", "32 cells"
FINER = {"box.cells": [144, 72, 72], "box.stretching.z.growth": 0.04, "body.flag.surface.edge": 0.0417, "time.max_step": 0.00625}
RUNS = {COARSE: {},
        f"{COARSE}, half the step": {"time.max_step": 0.005},
        f"{COARSE}, loose": {"body.flag.coupling": "loose"},
        f"{COARSE}, loose, wider box": {"body.flag.coupling": "loose", "box.size": [6, 5, 6], "box.origin": [-1.5, -2.5, -3],
                                        "box.cells": [96, 80, 60]},
        f"{COARSE}, force-spreading": {"body.flag.coupling": "force-spreading"},
        FINE: FINER,
        f"{FINE}, loose": {**FINER, "body.flag.coupling": "loose", "time.end": 14},
        FINEST: {"box.cells": [192, 96, 96], "box.stretching.z.growth": 0.03, "body.flag.surface.edge": 0.03125,
                 "time.max_step": 0.005, "time.end": 16, "output.fields.interval": 16}}


class Flapping:
    """Motion of the middle of the trailing edge, and what one takes from it: from `after` on, over whole periods."""

    def __init__(self, out, after=8.0):
        import h5py

        self.report = common.report(out)
        self.body = common.read_table(out / "bodies" / "flag.csv")
        times, shapes = [], []
        for file in sorted((out / "surfaces").glob("flag_*.h5")):
            with h5py.File(file) as data:
                times.append(float(data.attrs["time"]))
                shapes.append(data["positions"][:])
        self.times, self.shapes = np.array(times), np.array(shapes)
        start = self.shapes[0]
        edge = np.flatnonzero(start[:, 0] > start[:, 0].max() - 1e-6)
        self.tip = self.shapes[:, edge[np.argmin(abs(start[edge, 1]))]]
        self.middle = np.flatnonzero(abs(start[:, 1]) < 0.03)
        self.middle = self.middle[np.argsort(start[self.middle, 0])]
        z, t = self.tip[:, 2], self.times
        level = 0.5 * (z[t >= after].max() + z[t >= after].min())
        up = [k for k in range(len(t) - 1) if z[k] < level <= z[k + 1] and t[k] >= after]
        self.crossings = [t[k] + (level - z[k]) / (z[k + 1] - z[k]) * (t[k + 1] - t[k]) for k in up]
        periods = list(zip(self.crossings[:-1], self.crossings[1:]))
        self.periods = len(periods)
        self.strouhals = [1 / (b - a) for a, b in periods]
        self.amplitudes = [np.ptp(z[(t >= a) & (t <= b)]) for a, b in periods]
        self.strouhal = np.mean(self.strouhals) if periods else np.nan
        self.amplitude = np.mean(self.amplitudes) if periods else np.nan

    def stretch_energy(self):
        """Largest energy of the springs after the start."""
        return self.body["energy_edge"][self.body["time"] > 2].max()

    def drag(self):
        """Mean coefficient over whole periods."""
        if not self.periods:
            return np.nan
        when = (self.body["time"] >= self.crossings[0]) & (self.body["time"] <= self.crossings[-1])
        return 2 * self.body["force_x"][when].mean()


def draw(results, file):
    import h5py
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (motion, shapes, wake) = plt.subplots(1, 3, figsize=(13, 3.4), layout="constrained", width_ratios=[1.3, 0.9, 1.4])
    for (name, (_, r)), colour in zip(results.items(), ("#9ecae1", "#41ab5d", "#d95f0e", "#fdae6b", "#bcbddc", "#4292c6", "#7f2704", "#08306b")):
        motion.plot(r.times, r.tip[:, 2], color=colour, lw=1, label=name)
    for sign in (-1, 1):
        motion.axhspan(*sorted(sign * a / 2 for a in AMPLITUDE), color="0.9", zorder=0)
    motion.set(xlabel="t U/L", ylabel="z/L of the trailing edge's middle")
    motion.set_ylim(-0.5, 0.75)
    motion.legend(fontsize="small", ncols=2, loc="upper center")
    out, best = next((results[n] for n in (FINEST, COARSE) if n in results))
    last = best.times >= best.times[-1] - 3.8
    for shape in best.shapes[last][::4]:
        shapes.plot(shape[best.middle, 0], shape[best.middle, 2], color="#08306b", lw=0.7)
    shapes.set(aspect="equal", xlabel="x/L", ylabel="z/L", title="middle line over the last period")
    with h5py.File(sorted((out / "fields").glob("*.h5"))[-1]) as data:
        x, z = ((data[a][:-1] + data[a][1:]) / 2 for a in "xz")
        velocity = data["velocity"][:]
        plane = velocity.shape[1] // 2
        u, w = velocity[:, plane, :, 0], velocity[:, plane, :, 2]
        time = float(data.attrs["time"])
    spin = np.gradient(u, z, axis=0) - np.gradient(w, x, axis=1)
    wake.pcolormesh(x, z, spin, cmap="RdBu_r", vmin=-8, vmax=8, shading="nearest", rasterized=True)
    shape = best.shapes[np.argmin(abs(best.times - time))]
    wake.plot(shape[best.middle, 0], shape[best.middle, 2], "k", lw=1.5)
    wake.set(aspect="equal", xlim=(-0.7, 4.4), ylim=(-1.4, 1.4), xlabel="x/L", ylabel="z/L", title=f"vorticity in the mid-plane, t = {time:.0f}")
    figure.savefig(file, dpi=100)


def main():
    arguments = common.read_arguments(__doc__, "flag", quick="16 cells a length, local-mass")
    results, rows = {}, []
    for name in [COARSE] if arguments.quick else RUNS:
        out = common.run(arguments, name.replace(", ", "-").replace(" ", "-"), CASE / "case.toml", RUNS[name])
        results[name] = out, Flapping(out)
    bounds = common.Bounds()
    for name, (out, r) in results.items():
        bounds.within(f"{name}: A/L, mean of the periods", r.amplitude, *AMPLITUDE)
        bounds.within(f"{name}: St", r.strouhal, *STROUHAL)
        rows.append([name, f"{r.amplitude:.3f}", f"{r.strouhal:.3f}", ", ".join(f"{a:.3f}" for a in r.amplitudes),
                     ", ".join(f"{s:.3f}" for s in r.strouhals), f"{r.drag():.3f}", f"{r.stretch_energy():.1e}",
                     len(r.body["step"]) - 1, f"{common.wall_seconds(out) / 60:.1f}"])
    rows += [[f"*{who}*", f"{a:.3f}", f"{s:.3f}"] + [""] * 6 for who, (a, s) in PUBLISHED.items()]
    table = common.markdown_table(["cells a length", "A/L", "St", "A/L by period", "St by period", "drag coefficient",
                                   "largest stretching energy", "steps", "minutes"], rows)
    first = next(iter(results.values()))[1]
    text = common.how_measured(first.report, "cases/flag/check.py --update-readme") + "\n" + bounds.markdown() + "\n" + table
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
