#!/usr/bin/python3
"""A drop held in a uniform stream: its aspect ratio against the Weber number. Runs, compares, draws. See README.md."""
import math
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402
import shape  # noqa: E402

SLOPE = 0.085        # -d(l_x/l_z)/dWe at We -> 0, Re = 150: no-slip, the traction along the surface carried by its tension
SLOPE_EVEN = 0.0635  # the same with even tension
MOORE = 9 / 64       # clean bubble, Re -> infinity
BAND = 0.1           # about Loth's curve
SLOPE_LIMIT = 15     # per cent
SHARE_LIMIT = 15     # per cent of a step
FINE = {"box.cells": [200, 100, 100], "body.drop.surface.frequency": 16, "time.end": 6, "output.surfaces.interval": 0.25}


def loth(weber):
    return 1 - 0.75 * math.tanh(0.165 * weber)


def clean(weber, further=None):
    return {"body.drop.potentials.surface_tension.sigma": round(1 / weber, 6), **(further or {})}


def contaminated(weber, further=None):
    return {**clean(weber), "body.drop.potentials.surface_tension.mesh_control": round(1 / weber / 3**0.5, 6),
            "body.drop.potentials.area.stiffness": round(1 / weber, 6), **(further or {})}


# name: kind, We, file, settings
RUNS = {f"clean-we{we:g}": ("clean", we, "clean.toml", clean(we)) for we in (0.25, 0.5, 1, 2, 4)}
RUNS |= {f"contaminated-we{we:g}": ("contaminated", we, "case.toml", contaminated(we)) for we in (0.25, 0.5, 2, 4)}
RUNS |= {"clean-fine-we2": ("clean, 20 cells a diameter", 2, "clean.toml", clean(2, {**FINE, "output.fields.interval": 1})),
         "contaminated-fine-we0.5": ("contaminated, 20 cells a diameter", 0.5, "case.toml", contaminated(0.5, FINE))}
QUICK = ["clean-we0.5", "clean-we2", "contaminated-we0.5"]


class Result:
    def __init__(self, kind, weber, out):
        self.kind, self.weber = kind, weber
        self.out, self.report = out, common.report(out)
        self.finished = self.report["status"] == "finished"
        self.time, self.ratios, self.sideways = shape.inverse_aspect_ratio(out)
        window = self.time > 0.75 * self.time[-1] - 1e-9
        self.ratio, self.swing = self.ratios[window].mean(), self.ratios[window].max() - self.ratios[window].min()
        self.y_to_z = self.sideways[window].mean()
        table = common.read_table(out / "bodies" / "drop.csv")
        rows = table["time"] > 0.75 * table["time"][-1]
        self.drag = abs(table["force_x"][rows].mean()) / (0.5 * math.pi / 4)
        self.drift = abs(table["x"][-1] - table["x"][0])
        phases = self.report["seconds_by_phase"]
        bodies = phases["bodies: motion"] + phases["bodies: soft, within fluid"]
        step = phases["fluid"] + phases["bodies: motion"]
        self.share = 100 * bodies / step

    def row(self):
        r, s = self, self.report
        return [r.kind, f"{r.weber:g}", f"{r.ratio:.4f}", f"{r.swing:.4f}", f"{loth(r.weber):.3f}", f"{(1 - r.ratio) / r.weber:.4f}", f"{r.y_to_z:.3f}",
                f"{r.drag:.3f}", f"{s['time'] / s['steps']:.4f}", s["steps"], f"{r.share:.0f} %", f"{s['wall_seconds'] / 60:.1f}"]


HEADER = ["interface", "We", "l_x / l_z", "its swing at the end", "Loth", "(1 - l_x/l_z)/We", "l_y / l_z", "drag coefficient", "step", "steps",
          "structure and coupling", "minutes"]


def slope_of(results, kind):
    """1 - l_x/l_z over We by least squares through the sphere at We = 0, up to We = 0.5."""
    points = [(r.weber, 1 - r.ratio) for r in results.values() if r.kind == kind and r.weber <= 0.5]
    return sum(w * d for w, d in points) / sum(w * w for w, _ in points)


def draw_curves(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 3.8), layout="constrained")
    weber = np.linspace(0, 4.2, 100)
    curve = np.array([loth(w) for w in weber])
    left.plot(weber, curve, "k", label="Loth (2008)")
    left.fill_between(weber, curve - BAND, curve + BAND, color="0.92", zorder=0)
    left.plot(weber[:40], 1 - SLOPE * weber[:40], "k:", lw=1, label="small We, no slip")
    styles = {"contaminated": ("o", "#08519c"), "clean": ("s", "#d95f0e"), "contaminated, 20 cells a diameter": ("^", "#08519c"),
              "clean, 20 cells a diameter": ("v", "#d95f0e")}
    for kind, (marker, colour) in styles.items():
        points = [(r.weber, r.ratio) for r in results.values() if r.kind == kind]
        if points:
            left.plot(*zip(*points), marker, color=colour, ms=5, mfc="none" if "," in kind else colour, label=kind)
    left.set(xlim=(0, 4.2), ylim=(0.3, 1.02), xlabel="We", ylabel="$l_x / l_z$")
    left.legend(fontsize=8)
    for r in results.values():
        if r.kind in ("contaminated", "clean"):
            right.plot(r.time, r.ratios, color=styles[r.kind][1], lw=0.9)
            right.text(r.time[-1] + 0.1, r.ratios[-1], f"{r.weber:g}", fontsize=7, color=styles[r.kind][1], va="center")
    right.set(xlim=(0, 10.8), ylim=(0.3, 1.02), xlabel="$t U / d$", ylabel="$l_x / l_z$")
    figure.savefig(file, dpi=110)


def outline(positions, faces):
    """x and z of the edges between faces that look to either side of the plane."""
    import numpy as np

    corners = positions[faces]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 1] > 0
    sides = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    order = np.lexsort(sides.T)
    pairs = facing[order % len(faces)].reshape(-1, 2)
    edges = sides[order][::2][pairs[:, 0] != pairs[:, 1]]
    ends = np.full((len(edges), 3, 3), np.nan)
    ends[:, :2] = positions[edges]
    return ends[:, :, 0].ravel(), ends[:, :, 2].ravel()


def draw_pictures(result, times, file):
    """Left the velocity w in the plane through the middle and the outline, right the network: as the paper's figure."""
    import h5py
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    figure = plt.figure(figsize=(10, 3.4 * len(times)), layout="constrained")
    for row, wanted in enumerate(times):
        def nearest(pattern):
            files = sorted(result.out.glob(pattern))
            stamps = []
            for name in files:
                with h5py.File(name) as data:
                    stamps.append(float(data.attrs["time"]))
            return files[int(np.argmin(np.abs(np.array(stamps) - wanted)))]

        surface = nearest("surfaces/drop_*.h5")
        with h5py.File(surface) as data:
            positions, faces = data["positions"][:], data["triangles"][:]
        with h5py.File(nearest("fields/fields_*.h5")) as data:
            x, z, time = data["x"][:], data["z"][:], float(data.attrs["time"])
            w = data["velocity"][:, data["velocity"].shape[1] // 2, :, 2]
        plane = figure.add_subplot(len(times), 2, 2 * row + 1)
        image = plane.pcolormesh(x, z, w, cmap="RdBu_r", vmin=-0.4, vmax=0.4, rasterized=True)
        plane.plot(*outline(positions, faces), color="k", lw=1.2)
        plane.set(xlim=(1, 7), ylim=(1, 4), aspect="equal", xlabel="x / d", ylabel="z / d", title=f"w / U at t U / d = {time:.1f}")
        figure.colorbar(image, ax=plane, shrink=0.7)
        network = figure.add_subplot(len(times), 2, 2 * row + 2, projection="3d")
        about = positions - positions.mean(axis=0)
        network.plot_trisurf(about[:, 0], about[:, 1], faces, about[:, 2], color="#9ecae1", edgecolor="#08306b", linewidth=0.25)
        network.set(xlim=(-0.55, 0.55), ylim=(-0.55, 0.55), zlim=(-0.55, 0.55))
        network.set_box_aspect((1, 1, 1))
        network.view_init(elev=12, azim=-65)
        network.set_axis_off()
    figure.savefig(file, dpi=90)


def main():
    arguments = common.read_arguments(__doc__, "drop-in-cross-flow", quick="four runs with 10 cells a diameter")
    results = {}
    for name, (kind, weber, file, change) in RUNS.items():
        if arguments.quick and name not in QUICK:
            continue
        try:
            results[name] = Result(kind, weber, common.run(arguments, name, CASE / file, change))
        except common.RunFailed as failure:
            print(f"{name}: no result: {failure}", flush=True)
    bounds = common.Bounds()
    for name in RUNS:
        if name in results:
            r = results[name]
            bounds.within(f"l_x / l_z at We = {r.weber:g}, {r.kind}", r.ratio, round(loth(r.weber) - BAND, 3), round(loth(r.weber) + BAND, 3))
    if not arguments.quick:
        bounds.near("slope of l_x / l_z up to We = 0.5, contaminated", slope_of(results, "contaminated"), SLOPE, SLOPE_LIMIT)
    for name, r in results.items():
        if name == "clean-fine-we2":
            bounds.at_most("structure and coupling, 200 x 100 x 100 cells, 5120 faces", r.share, SHARE_LIMIT, " % of a step")
    text = common.how_measured(next(iter(results.values())).report, "cases/drop-in-cross-flow/check.py --update-readme") + "\n" + bounds.markdown()
    text += "\n" + common.markdown_table(HEADER, [r.row() for r in results.values()])
    pictures = (CASE if arguments.update_readme else arguments.out) / "drop-in-cross-flow-shapes.png"
    if "clean-fine-we2" in results:
        draw_pictures(results["clean-fine-we2"], (1, 6), pictures)
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw_curves(results, picture))


if __name__ == "__main__":
    sys.exit(main())
