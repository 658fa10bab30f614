#!/usr/bin/python3
"""Two drops that pass each other in shear: gaps, crossings, volumes, and what repulsion does. See README.md."""
import sys
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

SHOWN, RANGE, NAMES = "Ca 0.3", 0.2, ("left", "right")
# capillary number, repulsion, half the distance at the start along x and along z, end
RUNS = {"Ca 0.1": (0.1, True, 2, 0.4, 10), "Ca 0.3": (0.3, True, 2, 0.4, 10), "Ca 0.1, close": (0.1, True, 1.15, 0.1, 20),
        "Ca 0.1, no repulsion": (0.1, False, 2, 0.4, 10), "Ca 0.1, close, no repulsion": (0.1, False, 1.15, 0.1, 20)}


def settings(capillary, repulsion, x, z, end):
    chosen = {"body.left.center": [-x, 0, z], "body.right.center": [x, 0, -z], "time.end": end}
    chosen |= {f"body.{name}.potentials.surface_tension.sigma": round(10 / capillary, 4) for name in NAMES}
    chosen["repulsion.strength"] = round(5 / capillary, 4)  # sigma/(2R), the tension's pressure is 2 sigma/R
    return chosen if repulsion else {**chosen, "repulsion.range": 0, "repulsion.strength": 0}


def read(file):
    import h5py

    with h5py.File(file) as data:
        return float(data.attrs["time"]), data["positions"][:], data["triangles"][:]


def winding_number(points, positions, faces):
    """How often a closed surface winds around each point: 1 inside, 0 outside (sum of solid angles)."""
    a, b, c = (positions[faces[:, k]][None] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
    volume = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
    dot = lambda p, q: np.einsum("ijk,ijk->ij", p, q)  # noqa: E731
    return np.arctan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb).sum(axis=1) / (2 * np.pi)


def distance_to_faces(points, positions, faces):
    """Least distance of each point from the surface: foot on the nearest of each face's plane, edges and corners."""
    a, b, c = (positions[faces[:, k]][None] for k in range(3))
    p = points[:, None]
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    height = ((p - a) * normal).sum(axis=2)
    foot = p - height[..., None] * normal
    inside = np.ones(height.shape, bool)
    least = np.full(height.shape, np.inf)
    for s, e in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(e - s, foot - s) * normal).sum(axis=2) >= 0
        along = np.clip(((p - s) * (e - s)).sum(axis=2) / ((e - s)**2).sum(axis=2), 0, 1)
        least = np.minimum(least, np.linalg.norm(p - s - along[..., None] * (e - s), axis=2))
    return np.where(inside, abs(height), least).min(axis=1)


class Passage:
    """Gap, vertices inside the other drop, and centres over time; periodic along x with the period of the box."""

    def __init__(self, out, period):
        from scipy.spatial import cKDTree

        self.report = common.report(out)
        self.bodies = {name: common.read_table(out / "bodies" / f"{name}.csv") for name in NAMES}
        files = [sorted((out / "surfaces").glob(f"{name}_*.h5")) for name in NAMES]
        self.times, self.gaps, self.inside, self.shapes = [], [], 0, []
        for pair in zip(*files):
            (time, left, faces), (_, right, _) = map(read, pair)
            right = right - [period * np.round((right.mean(axis=0) - left.mean(axis=0))[0] / period), 0, 0]
            if np.abs(np.ptp(left[:, 0]) - period) < 1 or np.abs(np.ptp(right[:, 0]) - period) < 1:
                continue  # a drop that lies across the periodic side
            gap = np.inf
            for points, other in ((left, right), (right, left)):
                # Vertices farther from those of the other drop than an edge more than the nearest are not the nearest to its
                # faces; nor has one come in by more than 0.5 R between two instants.
                apart = cKDTree(other).query(points)[0]
                gap = min(gap, distance_to_faces(points[apart < apart.min() + 0.3], other, faces).min())
                near = points[apart < 0.5]
                self.inside += int((winding_number(near, other, faces) > 0.5).sum()) if len(near) else 0
            self.gaps.append(gap)
            self.times.append(time)
            self.shapes.append((time, left, right))
        self.least, self.at = min(zip(self.gaps, self.times))

    def drift(self):
        """Largest change of a volume, and what volume correction put back, over the volume."""
        return max(abs(b["volume"] / b["volume"][0] - 1).max() for b in self.bodies.values())

    def restored(self):
        return max(abs(b["volume_restored"]).max() for b in self.bodies.values())

    def offsets(self):
        """Difference of the centres' heights at the start and at the end."""
        return tuple(self.bodies["left"]["z"][i] - self.bodies["right"]["z"][i] for i in (0, -1))

    def asymmetry(self):
        """The two drops are each other's image by half a turn about y."""
        left, right = (self.bodies[name] for name in NAMES)
        return max(abs(left[a] + right[a]).max() for a in "xz")


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (shapes, gaps) = plt.subplots(1, 2, figsize=(13, 3.2), layout="constrained", width_ratios=[2.2, 1])
    passage = results[SHOWN if SHOWN in results else next(iter(results))]
    for k, instant in enumerate((0, 2, 4, 6, 8)):
        time, *drops = min(passage.shapes, key=lambda s: abs(s[0] - instant))
        for drop, colour in zip(drops, ("#08306b", "#d95f0e")):
            near = np.abs(drop[:, 1]) < 0.25
            shapes.plot(drop[near, 0] + 7.5 * k, drop[near, 2], ".", ms=2, color=colour)
        shapes.text(7.5 * k, -3, f"t = {time:.0f}", ha="center")
    shapes.set(aspect="equal", ylabel="z/R", xticks=[], title=f"{SHOWN}: vertices near the mid-plane")
    for (name, passage), style in zip(results.items(), ("C0-", "C1-", "C2-", "C0:", "C2:")):
        gaps.plot(passage.times, passage.gaps, style, label=name)
    gaps.axhspan(0, RANGE, color="0.93", zorder=0)
    gaps.set(xlabel=r"$\gamma t$", ylabel="least gap / R", ylim=(0, 1))
    gaps.legend(fontsize="small")
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "two-drops", quick="Ca = 0.1 alone")
    results, rows = {}, []
    for name in list(RUNS)[:1] if arguments.quick else RUNS:
        out = common.run(arguments, name.replace(",", "").replace(" ", "-").lower(), CASE / "case.toml", settings(*RUNS[name]))
        results[name] = Passage(out, 12)
    bounds = common.Bounds()
    for name, passage in results.items():
        start, end = passage.offsets()
        rows.append([name, f"{passage.least:.3f}", f"{passage.at:.1f}", passage.inside, f"{start:.2f}", f"{end:.2f}",
                     f"{passage.drift():.1e}", f"{passage.restored():.1e}", f"{passage.asymmetry():.1e}",
                     f"{passage.report['wall_seconds']:.0f}"])
        if not RUNS[name][1]:
            continue
        bounds.at_most(f"{name}: vertices of one drop inside the other, all instants", passage.inside, 0)
        bounds.at_least(f"{name}: least gap, of the range of repulsion", passage.least / RANGE, 0.2)
        bounds.at_most(f"{name}: change of a volume", passage.drift(), 1e-3)
        bounds.at_most(f"{name}: drops against each other's image by half a turn, in R", passage.asymmetry(), 0.02)
    table = common.markdown_table(["run", "least gap, R", "at gamma t", "vertices inside the other", "offset in z, start", "end",
                                   "change of a volume", "of it put back by correction", "asymmetry, R", "seconds"], rows)
    first = next(iter(results.values()))
    text = common.how_measured(first.report, "cases/two-drops/check.py --update-readme") + "\n" + bounds.markdown() + "\n" + table
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
