#!/usr/bin/python3
"""The left ventricle with a mechanical and with a natural mitral valve: balance, leaflets, leak, jets, figures. See README.md."""
import io
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

VALVES = ("mechanical", "natural")
# Phases of the beat: peak and end of the E wave, start and peak of ejection.
PEAK, E_END, SYSTOLE, LEAST = 0.15, 0.30, 0.62, 0.80
EJECTION, HINGED, EDGES = 0.30, ("leaflet-left", "leaflet-right"), ("anterior-edge", "posterior-edge")
ANNULUS, RADIUS = np.array([0.55, 0, 0]), 0.5
COLOURS = {"mechanical": "C3", "natural": "C0"}
# The case files are of 150^3 cells at Re = 5000; edges of the coarse size are about twice as long, and Re is 1000.
COARSE = {"box.cells": [72, 72, 72], "fluid.viscosity": 0.001, "time.step": 0.006, "body.sack.surface.edge": 0.075, "body.plate.surface.edge": 0.075,
          "body.plate.surface.hole_edge": 0.066, "body.mitral-channel.surface.edge": 0.066,
          "body.aortic-channel.surface.edge": 0.066, "body.aortic-valve.surface.edge": 0.066}
COARSE_VALVE = {"mechanical": {f"body.{name}.surface.edge": 0.053 for name in HINGED},
                "natural": {"body.valve.surface.edge": 0.052}}
# What is changed for the comparison of schemes, and the step over the case's own.
SCHEMES = {"half the step": ({}, 0.5),
           "force-spreading, a fifth of the step": ({"body.sack.coupling": "force-spreading"}, 0.2)}
# Of a healthy heart: A/E = 0.5 and twice the ejection fraction, so that the peak of the E wave is three times as high. The jet is
# still what is faster than half the peak mean velocity in the orifice.
HEALTHY = {"signals.beat.formula": "phase < 0.30 ? sin(pi*phase/0.30)^2 : phase < 0.45 ? 0 : phase < 0.60 ? 0.5*sin(pi*(phase-0.45)/0.15)^2 : "
                                   "phase < 0.62 ? 0 : phase < 0.98 ? -sin(pi*(phase-0.62)/0.36)^2 : 0",
           "cavity.ventricle.ejection_fraction": 0.6, "cavity.ventricle.jet.threshold": 1.6}


def further_options(parser):
    parser.add_argument("--cycles", type=common.positive, default=2, help="of each run (default: 2)")
    parser.add_argument("--full", action="store_true", help="the case files' own 150^3 cells instead of 72^3")
    parser.add_argument("--schemes", action="store_true",
                        help="also compare couplings of the sack and half the step, over the E wave")
    parser.add_argument("--healthy", action="store_true", help="also one cycle of a healthy amplitude with each valve: A/E = 0.5, EF = 0.6")
    parser.add_argument("--jobs", type=common.positive, default=1, help="runs at a time (default: 1)")


class Beat:
    """What a run found in one cycle: its last complete one (or as much as there is of the first), unless another is named."""

    def __init__(self, out, cycle=None):
        self.out, self.report = Path(out), common.report(out)
        self.case = self.report["case"]
        self.period = self.case["output"]["period"]
        everything = common.read_table(self.out / "cavities/ventricle.csv")
        self.cycle = max(0, int(everything["time"][-1] / self.period + 1e-6) - 1) if cycle is None else cycle
        self.cavity = self.of_cycle(everything)
        self.peak_flow = np.abs(everything["flow"]).max()
        # Of the same lines as the cycle's report in run.json, which a run that broke off has not.
        volume = self.cavity["volume"]
        self.ejection = (volume.max() - volume.min()) / volume.max()
        self.difference = np.abs(self.cavity["difference"]).max()
        self.complete = self.cavity["phase"][-1] > 0.999

    def of_cycle(self, table):
        phase = table["time"] / self.period - self.cycle
        keep = (phase >= -1e-9) & (phase <= 1 + 1e-9)
        return {"phase": phase[keep], **{name: column[keep] for name, column in table.items()}}

    def body(self, name):
        return self.of_cycle(common.read_table(self.out / "bodies" / f"{name}.csv"))

    def snapshot(self, kind, name, phase):
        """The file of a field or surface at a phase of the cycle, opened; None if there is none."""
        import h5py

        for file in sorted((self.out / kind).glob(f"{name}_*.h5"), reverse=True):
            data = h5py.File(file)
            if abs(data.attrs["time"] / self.period - self.cycle - phase) < 1e-3:
                return data
            data.close()
        return None

    def surface(self, name, phase):
        data = self.snapshot("surfaces", name, phase)
        if data is None or ("on" in data and not data["on"][:].any()):
            return None
        return data["positions"][:], data["triangles"][:]

    def surfaces(self, phase):
        """Those that are there: name to positions and faces."""
        found = {body["name"]: self.surface(body["name"], phase) for body in self.case["body"]}
        return {name: surface for name, surface in found.items() if surface is not None}

    def flow(self, phase):
        data = self.snapshot("fields", "fields", phase)
        return None if data is None else Field(data)

    def leak(self, phase):
        """Flow rate up through the mitral orifice, in the plane of the annulus."""
        flow = self.flow(phase)
        if flow is None:
            return np.nan
        r, angle = np.meshgrid((np.arange(60) + 0.5) / 60 * RADIUS, 2 * np.pi * np.arange(120) / 120)
        points = ANNULUS + np.stack([r * np.cos(angle), r * np.sin(angle), 0 * r], axis=-1)
        return (flow(points)[..., 2] * r).sum() * (RADIUS / 60) * (2 * np.pi / 120)

    def fastest(self, phase):
        flow = self.flow(phase)
        return np.nan if flow is None else np.linalg.norm(flow.velocity, axis=-1).max()

    def jet(self):
        """Of the E wave, over the depth of the apex: mean depth of the jet, depth at the peak, phase at which it is 0.9."""
        phase, depth = self.cavity["phase"], self.cavity["jet_depth_over_apex"]
        filling = phase <= E_END
        reached = phase[filling & (depth >= 0.9)]
        mean = np.trapz(depth[filling], phase[filling]) / (phase[filling][-1] - phase[filling][0])
        return mean, np.interp(PEAK, phase, depth, right=np.nan), reached[0] if len(reached) else np.nan

    def deepest(self):
        """Largest depth of the jet in the E wave over that of the apex."""
        return self.cavity["jet_depth_over_apex"][self.cavity["phase"] <= E_END].max()

    def leaflet(self, name):
        """Phases: half open, at the open stop, five degrees from it again, and at the closed stop after the start of ejection.
        A leaflet is at a stop when it is within one degree of it."""
        hinge = next(body["hinge"] for body in self.case["body"] if body["name"] == name)
        table = self.body(name)
        phase, angle = table["phase"], np.degrees(table["angle"])
        half = self.first(phase, angle >= (hinge["min_angle"] + hinge["max_angle"]) / 2)
        opened = self.first(phase, angle >= hinge["max_angle"] - 1)
        closing = self.first(phase, (phase > opened) & (angle < hinge["max_angle"] - 5))
        closed = self.first(phase, (phase >= SYSTOLE) & (angle <= hinge["min_angle"] + 1))
        return {"half open": half, "at the open stop": opened, "5 degrees from it": closing, "closed": closed}

    def gap(self):
        """Between the means of the two free edges of the natural valve: phases and distances."""
        table = self.body("valve")
        apart = (table[f"watch_{EDGES[0]}_{axis}"] - table[f"watch_{EDGES[1]}_{axis}"] for axis in "xyz")
        return table["phase"], np.sqrt(sum(q**2 for q in apart))

    @staticmethod
    def first(phase, true):
        where = np.flatnonzero(true)
        return phase[where[0]] if len(where) else np.nan


class Field:
    """The velocity at any points, trilinear between cell centres; periodic in x and y, constant beyond the last centres in z."""

    def __init__(self, data):
        self.velocity = data["velocity"][:]
        self.origin = np.array([data[axis][0] for axis in "xyz"])
        self.spacing = np.array([data[axis][1] - data[axis][0] for axis in "xyz"])

    def __call__(self, points):
        return self.interpolate(self.velocity, points)

    def interpolate(self, values, points):
        place = (points - self.origin) / self.spacing - 0.5
        low = np.floor(place).astype(int)
        part = place - low
        total = 0
        for corner in np.ndindex(2, 2, 2):
            i, j, k = (low[..., axis] + corner[axis] for axis in range(3))
            weight = np.prod(np.where(corner, part, 1 - part), axis=-1)
            found = values[np.clip(k, 0, values.shape[0] - 1), j % values.shape[1], i % values.shape[2]]
            total = total + (weight[..., None] if found.ndim > weight.ndim else weight) * found
        return total


def cut(positions, faces):
    """Segments (x, z) in which a surface meets the plane y = 0."""
    corners = positions[faces]
    side = corners[:, :, 1] > 0
    edges = [(0, 1), (1, 2), (2, 0)]
    crosses = np.stack([side[:, a] != side[:, b] for a, b in edges], axis=1)
    with np.errstate(all="ignore"):
        points = np.stack([corners[:, a] + (corners[:, a, 1] / (corners[:, a, 1] - corners[:, b, 1]))[:, None]
                           * (corners[:, b] - corners[:, a]) for a, b in edges], axis=1)
    return points[crosses][:, [0, 2]].reshape(-1, 2, 2)


def save(figure, file):
    """As a picture of few colours: a fifth of the size."""
    from PIL import Image

    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=95)
    Image.open(buffer).convert("RGB").quantize(256, kmeans=4).save(file, optimize=True)


def mark_phases(axes):
    for panel in np.atleast_1d(axes):
        panel.axvline(PEAK, color="0.75", lw=0.8, zorder=0)
        panel.axvline(LEAST, color="0.75", lw=0.8, zorder=0)
        panel.set(xlabel="t/T", xlim=(0, 1))


def draw_flow(plt, beats, file):
    figure, (rate, volume, difference) = plt.subplots(1, 3, figsize=(13, 3.2), layout="constrained")
    for name, beat in beats.items():
        table, colour = beat.cavity, COLOURS[name]
        rate.plot(table["phase"], table["dV_dt"], color=colour, label=f"dV/dt, {name}")
        volume.plot(table["phase"], table["volume"], color=colour, label=name)
        difference.plot(table["phase"], 100 * table["difference"], color=colour, lw=0.8, label=name)
    longest = max(beats.values(), key=lambda b: b.cavity["phase"][-1]).cavity
    rate.plot(longest["phase"], longest["flow"], "k:", label="Q")
    rate.set(ylabel=r"$U d^2$", title="flow rate into the ventricle")
    volume.set(ylabel=r"$V/d^3$", title="volume")
    difference.axhspan(-2, 2, color="0.93", zorder=0)
    difference.set(ylabel="% of the peak", title="dV/dt less Q")
    for panel in (rate, volume):
        panel.legend(fontsize="small")
    mark_phases([rate, volume, difference])
    save(figure, file)


def draw_position(plt, beats, file):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3), layout="constrained")
    for name, beat in beats.items():
        table = beat.body("sack")
        for panel, axis in zip(axes, "xz"):
            panel.plot(table["phase"], table[axis], color=COLOURS[name], label=name)
            panel.set(ylabel=f"{axis}/d", title=f"mean {axis} of the sack")
    axes[0].legend(fontsize="small")
    mark_phases(axes)
    save(figure, file)


def draw_leaflets(plt, beats, file):
    figure, (angles, heights, edges) = plt.subplots(1, 3, figsize=(13, 3.2), layout="constrained")
    if "mechanical" in beats:
        for name, style in zip(HINGED, ("-", "--")):
            table = beats["mechanical"].body(name)
            angles.plot(table["phase"], np.degrees(table["angle"]), "C3" + style, label=name)
            heights.plot(table["phase"], table["z"], "C3" + style, label=name)
    if "natural" in beats:
        table = beats["natural"].body("valve")
        for name, style in zip(EDGES, ("-", "--")):
            edges.plot(table["phase"], table[f"watch_{name}_z"], "C0" + style, label=name.replace("-", ", free "))
        edges.plot(*beats["natural"].gap(), "k:", label="distance between them")
        edges.axhline(0, color="k", lw=0.8)
    angles.set(ylabel="degrees", title="mechanical: angle from the annulus", ylim=(20, 90))
    heights.set(ylabel="z/d", title="mechanical: centre of mass")
    edges.set(ylabel="z/d", title="natural: free edges (annulus at 0)")
    for panel in (angles, edges):
        if panel.get_legend_handles_labels()[0]:
            panel.legend(fontsize="small")
    mark_phases([angles, heights, edges])
    save(figure, file)


def draw_snapshots(plt, beats, file, phases=(0.1, 0.15, 0.25, 0.52)):
    from matplotlib.collections import LineCollection

    x, z = np.linspace(-1.7, 1.7, 200), np.linspace(-3.75, 1.15, 288)
    figure, axes = plt.subplots(len(beats), len(phases), figsize=(2.9 * len(phases), 4.1 * len(beats)), layout="constrained",
                                squeeze=False, sharex=True, sharey=True)
    for row, (name, beat) in zip(axes, beats.items()):
        row[0].set_ylabel(f"{name}\nz/d")
        for panel, phase in zip(row, phases):
            panel.set(aspect="equal", title=f"t/T = {phase:g}", xlim=x[[0, -1]], ylim=z[[0, -1]])
            flow = beat.flow(phase)
            if flow is None:
                panel.text(0, -1.3, "no snapshot", ha="center")
                continue
            plane = lambda u, w: np.stack([*np.meshgrid(u, [0.0], w, indexing="ij")], axis=-1)[:, 0].swapaxes(0, 1)  # noqa: E731
            image = panel.imshow(np.linalg.norm(flow(plane(x, z)), axis=-1), origin="lower", extent=(*x[[0, -1]], *z[[0, -1]]),
                                 cmap="YlGnBu", vmin=0, vmax=2, interpolation="bilinear")
            u, w = x[5::11], z[5::11]
            velocity = flow(plane(u, w))
            panel.quiver(u, w, velocity[..., 0], velocity[..., 2], scale=18, width=0.0045, color="0.2")
            for part, (positions, faces) in beat.surfaces(phase).items():
                lines = cut(positions, faces)
                if part == "valve" or part in HINGED:
                    panel.add_collection(LineCollection(lines, color="w", lw=4))
                    panel.add_collection(LineCollection(lines, color="C3", lw=2.2))
                else:
                    panel.add_collection(LineCollection(lines, color="k", lw=1.2))
    if "image" in locals():
        figure.colorbar(image, ax=axes, shrink=0.5, label="speed / U", extend="max")
    save(figure, file)


def view(elevation, azimuth):
    """Axes of a picture: to the right, up, towards the eye."""
    e, a = np.radians([elevation, azimuth])
    towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0])
    return np.array([right, np.cross(towards, right), towards])


def outline(seen, faces):
    """Segments of a surface's borders and of where it turns away from the eye, in the picture's plane."""
    corners = seen[faces]
    towards = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 0
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, which, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    front = np.bincount(which.ravel(), weights=np.tile(towards, 3))
    return seen[edges[(count == 1) | (front == 1)]][:, :, :2]


def surface_of_speed(flow, level, frame, width, height, depth):
    """Where rays from the eye first meet the surface of equal speed: depth and shade of each pixel (nan: nowhere)."""
    speed = np.linalg.norm(flow.velocity, axis=-1)
    sample = lambda points: flow.interpolate(speed, points)  # noqa: E731
    flat = np.stack(np.meshgrid(width, height), axis=-1)
    place = lambda away: (np.concatenate([flat, np.broadcast_to(away, flat.shape[:2])[..., None]], axis=-1)) @ frame  # noqa: E731
    hit, before = np.full(flat.shape[:2], np.nan), None
    for away in depth:
        points = place(away)
        inside = (np.abs(points[..., :2]) < 1.95).all(axis=-1) & (points[..., 2] > -3.9) & (points[..., 2] < 1.1)
        now = np.where(inside, sample(points), 0)
        if before is not None:
            new = np.isnan(hit) & (now >= level)
            hit[new] = away - (depth[1] - depth[0]) * ((now - level) / np.maximum(now - before, 1e-9))[new].clip(0, 1)
        before = now
    points = place(np.nan_to_num(hit))
    step = flow.spacing.max() * 0.7
    normal = -np.stack([sample(points + step * axis) - sample(points - step * axis) for axis in np.eye(3)], axis=-1)
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-9)
    light = np.array([-0.4, 0.5, 0.77]) @ frame
    return hit, np.where(np.isnan(hit), np.nan, 0.35 + 0.65 * (normal @ light).clip(0, 1)), points[..., 2]


def draw_speed(plt, beats, file, phases=(0.1, 0.2), level=0.6):
    from matplotlib.collections import LineCollection, PolyCollection

    frame = view(8, -72)
    width, height, depth = np.linspace(-1.7, 1.7, 260), np.linspace(-3.55, 1.35, 375), np.linspace(2.4, -2.4, 130)
    figure, axes = plt.subplots(1, len(beats) * len(phases), figsize=(2.9 * len(beats) * len(phases), 4.8), layout="constrained",
                                squeeze=False)
    panels = iter(axes[0])
    for name, beat in beats.items():
        for phase in phases:
            panel = next(panels)
            panel.set(aspect="equal", title=f"{name}, t/T = {phase:g}", xlim=width[[0, -1]], ylim=height[[0, -1]])
            panel.axis("off")
            flow = beat.flow(phase)
            if flow is None:
                panel.text(0, -1.3, "no snapshot", ha="center")
                continue
            hit, shade, z = surface_of_speed(flow, level, frame, width, height, depth)
            colour = plt.cm.viridis(np.clip((z + 3.2) / 4, 0, 1))
            colour[..., :3] *= np.nan_to_num(shade)[..., None]
            colour[..., 3] = ~np.isnan(hit)
            panel.imshow(colour, origin="lower", extent=(*width[[0, -1]], *height[[0, -1]]), zorder=2, interpolation="bilinear")
            for part, (positions, faces) in beat.surfaces(phase).items():
                corners = positions[faces] @ frame.T
                normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
                facing = np.abs(normal[:, 2]) / np.linalg.norm(normal, axis=1)
                if part == "valve" or part in HINGED:  # in front of the surface of speed or behind it
                    middle = corners.mean(axis=1)
                    column = np.searchsorted(width, middle[:, 0]).clip(0, len(width) - 1)
                    row = np.searchsorted(height, middle[:, 1]).clip(0, len(height) - 1)
                    behind = middle[:, 2] < np.nan_to_num(hit[row, column], nan=-9)
                    for chosen, order in ((behind, 1.5), (~behind, 3)):
                        shades = np.outer(0.45 + 0.55 * facing[chosen], [0.85, 0.25, 0.2])
                        panel.add_collection(PolyCollection(corners[chosen][:, :, :2], facecolors=shades, edgecolors="none",
                                                            antialiased=False, zorder=order))
                elif part != "plate":
                    panel.add_collection(LineCollection(outline(positions @ frame.T, faces), color="0.3", lw=1, zorder=4))
    save(figure, file)


def draw_valves(plt, beats, file, phases=(("ejection", 0.8), ("opening", 0.05), ("inflow", 0.2))):
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    figure = plt.figure(figsize=(10.5, 3 * len(beats)), layout="constrained")
    light = view(-20, -20)[2]
    angle = np.linspace(0, 2 * np.pi, 100)
    for row, (name, beat) in enumerate(beats.items()):
        low = 0.3 if name == "mechanical" else 0
        for column, (state, phase) in enumerate(phases):
            axes = figure.add_subplot(len(beats), len(phases), row * len(phases) + column + 1, projection="3d")
            axes.plot(0.55 + RADIUS * np.cos(angle), RADIUS * np.sin(angle), low, "k", lw=1)
            parts = [beat.surface(part, phase) for part in (HINGED if name == "mechanical" else ("valve",))]
            for positions, faces in filter(None, parts):
                corners = positions[faces]
                normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
                shade = 0.45 + 0.55 * np.abs(normal @ light) / np.linalg.norm(normal, axis=1)
                axes.add_collection3d(Poly3DCollection(corners, facecolors=np.outer(shade, [0.95, 0.72, 0.55]), edgecolors="0.45",
                                                       linewidths=0.2))
            shown = f"{state}, t/T = {phase:g}" if parts[0] is not None else f"no surface at t/T = {phase:g}"
            axes.set(xlim=(0.05, 1.05), ylim=(-0.5, 0.5), zlim=(low - 0.6, low + 0.1), title=f"{name}: {shown}")
            axes.set_box_aspect((1, 1, 0.7), zoom=1.3)
            axes.view_init(elev=-22 if name == "natural" else 22, azim=-62)
            axes.axis("off")
    save(figure, file)


def wall_shear(beat, phase):
    """Of the sack's inner side, at its faces: magnitude over rho U^2, middles, areas; None if there is no such surface."""
    data = beat.snapshot("surfaces", "sack", phase)
    if data is None or "inner_shear" not in data:
        return None
    corners = data["positions"][:][data["triangles"][:]]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    return np.linalg.norm(data["inner_shear"][:], axis=1), corners, areas


def draw_wall_shear(plt, beats, file, phases=(0.1, 0.15, 0.2, 0.3, 0.7)):
    from matplotlib.collections import PolyCollection

    frame, far = view(8, -72), None
    figure, axes = plt.subplots(len(beats), len(phases), figsize=(2.4 * len(phases), 3.6 * len(beats)), layout="constrained",
                                squeeze=False)
    for row, (name, beat) in zip(axes, beats.items()):
        for panel, phase in zip(row, phases):
            panel.set(aspect="equal", title=f"{name}, t/T = {phase:g}", xlim=(-1.7, 1.7), ylim=(-3.6, 0.4))
            panel.axis("off")
            found = wall_shear(beat, phase)
            if found is None:
                panel.text(0, -1.3, "no snapshot", ha="center")
                continue
            shear, corners, _ = found
            seen = corners @ frame.T
            # The far wall, looked at from inside.
            towards = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])[:, 2]
            behind = seen[:, :, 2].mean(axis=1) < np.median(seen[:, :, 2])
            far = behind & (towards < 0 if (towards[behind] < 0).mean() > 0.5 else towards > 0)
            image = PolyCollection(seen[far][:, :, :2], array=shear[far], cmap="magma", edgecolors="face", linewidths=0.2)
            image.set_clim(0, 0.01)
            panel.add_collection(image)
    if far is not None:
        figure.colorbar(image, ax=axes, shrink=0.6, label=r"wall shear stress / $\rho U^2$", extend="max")
    save(figure, file)


def pyplot():
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    return plt


def draw(beats, picture):
    plt = pyplot()
    draw_flow(plt, beats, picture)
    for name, drawing in (("mean-position", draw_position), ("leaflets", draw_leaflets), ("snapshots", draw_snapshots),
                          ("speed", draw_speed), ("valves", draw_valves), ("wall-shear", draw_wall_shear)):
        drawing(plt, beats, picture.with_name(f"{name}.png"))


def judge(bounds, name, beat):
    bounds.add(f"{name}: the run", beat.report["status"], "finished", beat.report["status"] == "finished" and beat.complete)
    bounds.within(f"{name}: ejection fraction", beat.ejection, EJECTION - 0.01, EJECTION + 0.01)
    bounds.at_most(f"{name}: largest abs(dV/dt - Q) over the peak of Q", 100 * beat.difference, 2, " %")
    if name == "mechanical":
        times = {leaflet: beat.leaflet(leaflet) for leaflet in HINGED}
        for leaflet, phases in times.items():
            bounds.at_most(f"{name}: {leaflet} at its open stop, t/T", phases["at the open stop"], PEAK)
            bounds.at_least(f"{name}: {leaflet} starts to close, t/T", phases["5 degrees from it"], PEAK)
            bounds.within(f"{name}: {leaflet} closed, t/T", phases["closed"], LEAST - 0.1, LEAST + 0.1)
        apart = abs(np.subtract(*(times[leaflet]["closed"] for leaflet in HINGED)))
        bounds.at_least(f"{name}: between the closing of the two leaflets, T", apart, 0.002)
    else:
        table = beat.body("valve")
        systole = table["phase"] >= SYSTOLE
        for edge in EDGES:
            highest = table[f"watch_{edge}_z"][systole].max() if systole.any() else np.nan
            bounds.at_most(f"{name}: highest z of the {edge.replace('-edge', '')} free edge in systole, d", highest, 0)
        bounds.at_most(f"{name}: back through the mitral orifice at t/T = {LEAST:g}, of the peak of Q",
                       100 * beat.leak(LEAST) / beat.peak_flow, 5, " %")


def judge_healthy(bounds, name, beat):
    bounds.add(f"healthy, {name}: the run", beat.report["status"], "finished", beat.report["status"] == "finished" and beat.complete)
    wanted = HEALTHY["cavity.ventricle.ejection_fraction"]
    bounds.within(f"healthy, {name}: ejection fraction", beat.ejection, wanted - 0.01, wanted + 0.01)
    bounds.at_least(f"healthy, {name}: largest jet depth over that of the apex in the E wave", beat.deepest(), 0.9)


def healthy_table(beats):
    rows = []
    for name, beat in beats.items():
        mean, at_peak, reached = beat.jet()
        rows.append([name, f"{beat.ejection:.4f}", f"{beat.peak_flow:.2f}", number(mean), number(at_peak), number(beat.deepest()),
                     number(reached), number(beat.fastest(PEAK), 2)])
    return common.markdown_table(["healthy: A/E = 0.5", "EF", "largest flow rate, U d^2", "jet depth over that of the apex, mean of the E wave",
                                  "at the peak", "largest", "0.9 at t/T", "largest speed at the peak, U"], rows)


def number(value, digits=3):
    return "-" if np.isnan(value) else f"{value:.{digits}f}"


def tables(beats):
    rows, leaflets = [], []
    for name, beat in beats.items():
        mean, at_peak, reached = beat.jet()
        steps, time = beat.report["steps"], beat.report["time"]
        off = np.abs(beat.cavity["difference"])
        rows.append([name, beat.cycle + 1, f"{beat.ejection:.4f}", f"{100 * beat.difference:.2f}",
                     number(beat.cavity["phase"][off.argmax()]), f"{100 * np.mean(off > 0.02):.1f}",
                     number(mean), number(at_peak), number(reached), number(beat.fastest(PEAK), 2),
                     *(number(100 * beat.leak(phase) / beat.peak_flow, 1) for phase in (0.7, 0.8)), steps, f"{time / steps:.4f}",
                     f"{beat.report['wall_seconds'] / 60 / (time / beat.period):.1f}"])
    text = common.markdown_table(["valve", "cycle", "EF", "largest abs(dV/dt - Q), % of the peak",
                                  "there at t/T", "lines of the cycle with more than 2 %, %",
                                  "jet depth over that of the apex, mean of the E wave", "at the peak", "0.9 at t/T",
                                  "largest speed at the peak, U", "up through the mitral orifice at 0.7, % of the peak", "at 0.8",
                                  "steps", "mean step", "minutes a cycle"], rows)
    if "mechanical" in beats:
        for leaflet in HINGED:
            leaflets.append([leaflet, *(number(phase) for phase in beats["mechanical"].leaflet(leaflet).values())])
        header = ["mechanical, t/T", "half open", "at the open stop", "5 degrees from it again", "closed"]
        text += "\n" + common.markdown_table(header, leaflets)
    if "natural" in beats:
        phase, gap = beats["natural"].gap()
        text += "\n" + common.markdown_table(
            ["natural, distance between the means of the free edges, d", "at the start", "E wave, largest", "ejection, least"],
            [["", number(gap[0]), *(number(pick(gap[which]) if which.any() else np.nan)
                                    for pick, which in ((np.max, phase <= E_END), (np.min, phase >= SYSTOLE)))]])
    return text


def shear_table(beats):
    """Mean over the inner side of the sack and largest (99.9 % of the area have less), by phase."""
    rows = []
    for name, beat in beats.items():
        for phase in (0.1, PEAK, 0.2, E_END, 0.7):
            found = wall_shear(beat, phase)
            if found is None:
                continue
            shear, corners, areas = found
            order = np.argsort(shear)
            most = shear[order][np.searchsorted(np.cumsum(areas[order]), 0.999 * areas.sum())]
            depth = corners[..., 2].mean(axis=1)
            apex = depth < 0.75 * depth.min()
            rows.append([name, f"{phase:g}", *(f"{q:.5f}" for q in (np.average(shear, weights=areas), most,
                                                                  np.average(shear[apex], weights=areas[apex])))])
    return common.markdown_table(["wall shear stress over rho U^2, inner side of the sack", "t/T", "mean", "largest, but for 0.1 % of the area",
                                  "mean of the lowest quarter"], rows)


def coupling_of(beat):
    return next(body["coupling"] for body in beat.case["body"] if body["name"] == beat.case["cavity"]["ventricle"]["body"])


def compare_schemes(base, others):
    """Largest differences of the first E wave from the case's own scheme and step."""
    rows = []
    for name, beat in {"the case's own: " + coupling_of(base): base, **others}.items():
        phase = np.linspace(0, min(E_END, *(b.cavity["phase"][-1] for b in (base, beat))), 2000)
        at = lambda b, table, column: np.interp(phase, table["phase"], table[column])  # noqa: E731
        off = lambda column: np.abs(at(beat, beat.cavity, column) - at(base, base.cavity, column))  # noqa: E731
        angles = [np.degrees(np.abs(at(beat, beat.body(leaflet), "angle") - at(base, base.body(leaflet), "angle")))
                  for leaflet in HINGED]
        stroke = np.ptp(base.cavity["volume"])
        steps, time = beat.report["steps"], beat.report["time"]
        filling = beat.cavity["phase"] <= E_END
        filled = np.ptp(beat.cavity["volume"][filling]) / beat.cavity["volume"][0]
        difference = np.abs(beat.cavity["difference"][filling]).max()
        rows.append([name, f"{time / steps:.5f}", f"{filled:.4f}", f"{100 * difference:.2f}",
                     f"{100 * off('volume').max() / stroke:.2f}", f"{max(a.max() for a in angles):.1f}", f"{np.mean(angles):.2f}",
                     f"{off('jet_depth').max():.2f}", f"{off('jet_depth').mean():.3f}",
                     f"{beat.report['wall_seconds'] / 60 / (time / beat.period):.1f}"])
    return common.markdown_table(["first E wave, mechanical", "mean step", "volume gained, of that at rest", "largest abs(dV/dt - Q), % of the peak",
                                  "volume off by at most, % of the stroke", "leaflets' angle off by at most, degrees", "mean",
                                  "jet depth off by at most, d", "mean", "minutes a cycle"], rows)


def execute(arguments, jobs):
    """Runs all (name, case, settings), some at a time; a run that breaks off is judged by what it left."""
    def one(job):
        name, valve, settings = job
        try:
            common.run(arguments, name, CASE / valve / "case.toml", settings)
        except common.RunFailed as failure:
            if not (arguments.out / name / "cavities/ventricle.csv").is_file():
                raise
            print(failure, flush=True)

    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(one, jobs))
    return {name: arguments.out / name for name, _, _ in jobs}


def settings(arguments, valve, cycles, further=None):
    sizes = {} if arguments.full else {**COARSE, **COARSE_VALVE[valve]}
    return {**sizes, "time.end": f"{3.6 * cycles:g} s", **(further or {})}


def main():
    arguments = common.read_arguments(__doc__, "left-ventricle", quick="one cycle, mechanical valve", further=further_options)
    size = "-full" if arguments.full else ""
    valves, cycles = (VALVES[:1], 1) if arguments.quick else (VALVES, arguments.cycles)
    outs = execute(arguments, [(valve + size, valve, settings(arguments, valve, cycles)) for valve in valves])
    beats = {valve: Beat(outs[valve + size]) for valve in valves}
    bounds = common.Bounds()
    for name, beat in beats.items():
        judge(bounds, name, beat)
    if len(beats) == 2:
        deeper = beats["natural"].jet()[0] / beats["mechanical"].jet()[0]
        bounds.at_least("jet depth, mean of the E wave: natural over mechanical", deeper, 1)
    text = tables(beats) + "\n" + shear_table(beats)
    if arguments.schemes:
        base = Beat(outs["mechanical" + size], cycle=0)
        step = base.case["time"]["step"]
        others = execute(arguments, [(f"mechanical{size}-{name.replace(',', '').replace(' ', '-')}", "mechanical",
                                      settings(arguments, "mechanical", 1, {**changed, "time.step": step * part, "time.end": f"{3.6 * E_END:g} s"}))
                                     for name, (changed, part) in SCHEMES.items()])
        text += "\n" + compare_schemes(base, dict(zip(SCHEMES, (Beat(out, cycle=0) for out in others.values()))))
    if arguments.healthy:
        outs = execute(arguments, [(f"{valve}{size}-healthy", valve, settings(arguments, valve, 1, HEALTHY)) for valve in valves])
        healthy = {valve: Beat(outs[f"{valve}{size}-healthy"], cycle=0) for valve in valves}
        for name, beat in healthy.items():
            judge_healthy(bounds, name, beat)
        text += "\n" + healthy_table(healthy)
    options = [word for word in sys.argv[1:] if word in ("--full", "--schemes", "--healthy", "--update-readme")]
    command = " ".join(["cases/left-ventricle/check.py", f"--cycles {cycles}", *options])
    text = common.how_measured(beats["mechanical"].report, command) + "\n" + bounds.markdown() + "\n" + text
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(beats, picture))


if __name__ == "__main__":
    sys.exit(main())
