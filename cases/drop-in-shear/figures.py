"""The figures: the paper's two panels a resolution, the differences, the meshes, and the picture of the top README."""
import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import model
import study

plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 11,
                     "legend.frameon": False, "figure.facecolor": "white",
                     "mathtext.fontset": "dejavusans"})
RANGE = np.linspace(0.005, 0.33, 120)
CURVES = np.array([model.shape(ca) for ca in RANGE])
LINE = dict(color="black", lw=1.2, zorder=1)


def draw(results, folder):
    """Draws what the results allow; returns the paths."""
    pictures = []
    meshes = [m for m in study.MESHES if any(p.mesh == m and p.mean for p in results.points)]
    if meshes:
        pictures += [draw_panels(results, meshes, folder / "semi-axes-and-angle.png"),
                     draw_differences(results, meshes, folder / "differences.png"),
                     draw_meshes(results, meshes, folder / "meshes.png")]
        point = best_picture(results)
        if point:
            pictures.append(draw_summary(results, point, folder / "drop-in-shear.png"))
    return pictures


def markers(variant):
    """Of different sizes, as the points of the variants lie on each other."""
    face = variant.colour if variant.marker_size < 6 else "none"
    return dict(ls="", marker=variant.marker, color=variant.colour, mfc=face, ms=variant.marker_size, mew=1.3, zorder=3)


def plot_points(axis, points, values, **style):
    shown = [p for p in points if p.mean]
    if shown:
        axis.plot([p.capillary for p in shown], [values(p) for p in shown], **style)


def plot_axes(axis, results, mesh):
    axis.plot(RANGE, CURVES[:, 0], label="Maffettone-Minale", **LINE)
    axis.plot(RANGE, CURVES[:, 1], **LINE)
    for variant in study.VARIANTS:
        points = results.points_of(variant, mesh)
        plot_points(axis, points, lambda p: p.mean["L"], label=variant.title, **markers(variant))
        plot_points(axis, points, lambda p: p.mean["B"], **markers(variant))
    axis.axvline(study.CALIBRATION, color="0.6", lw=0.8, ls=":", zorder=0)
    axis.text(0.03, 1.10, "$L/R$")
    axis.text(0.03, 0.885, "$B/R$")
    axis.set(xlim=(0, 0.33), ylim=(0.7, 1.45))


def plot_angle(axis, results, mesh):
    axis.plot(RANGE, CURVES[:, 2], label="Maffettone-Minale", **LINE)
    for variant in study.VARIANTS:
        plot_points(axis, results.points_of(variant, mesh), lambda p: p.mean["angle"], label=variant.title,
                    **markers(variant))
    axis.axvline(study.CALIBRATION, color="0.6", lw=0.8, ls=":", zorder=0)
    axis.set(xlim=(0, 0.33), ylim=(26, 46), xlabel="capillary number Ca")


def plot_by_viscosity(above, below, results, mesh):
    points = [p for p in results.points if p.mesh == mesh and p.kind == "viscosity"]
    style = dict(ls="", marker="+", color="black", ms=7, mew=0.9, zorder=4)
    plot_points(above, points, lambda p: p.mean["L"], **style)
    plot_points(above, points, lambda p: p.mean["B"], **style)
    plot_points(below, points, lambda p: p.mean["angle"], label="all: Ca by the viscosity", **style)


def draw_panels(results, meshes, path):
    """The paper's figure: semi-axes above, angle below, a column a resolution."""
    figure, axes = plt.subplots(2, len(meshes), figsize=(3.4 * len(meshes) + 0.6, 6.2), sharex=True, sharey="row",
                                squeeze=False, layout="constrained")
    for column, mesh in enumerate(meshes):
        plot_axes(axes[0, column], results, mesh)
        plot_angle(axes[1, column], results, mesh)
        plot_by_viscosity(axes[0, column], axes[1, column], results, mesh)
        axes[0, column].set_title(f"{mesh.vertices} vertices")
    axes[0, 0].set_ylabel("semi-axes in the plane of shear")
    axes[1, 0].set_ylabel("angle of $L$ to the flow (degrees)")
    entries = {}
    for axis in axes[1]:
        entries.update(zip(*reversed(axis.get_legend_handles_labels())))
    axes[1, 0].legend(entries.values(), entries.keys(), loc="upper right", fontsize=9)
    axes[0, 0].annotate("calibrated here", (study.CALIBRATION, 0.72), xytext=(4, 0), textcoords="offset points",
                        fontsize=8, color="0.4")
    return save(figure, path)


def draw_differences(results, meshes, path):
    """The differences from the model with their bounds: columns L, B, angle; a row a variant, a shade a resolution."""
    variants = [v for v in study.VARIANTS if any(p.variant == v and p.mean for p in results.points)]
    figure, axes = plt.subplots(len(variants), 3, figsize=(10.5, 2.3 * len(variants) + 0.5), sharex=True, squeeze=False,
                                layout="constrained")
    names = ("$L$ (%)", "$B$ (%)", "angle (degrees)")
    for row, variant in enumerate(variants):
        bounds = (variant.bounds.axes, variant.bounds.axes, variant.bounds.angle)
        for column in range(3):
            axis, bound = axes[row, column], bounds[column]
            axis.fill_between([0, 0.2], -bound, bound, color="0.93", zorder=0)
            axis.axhline(0, color="black", lw=0.8)
            for mesh, style in zip(study.MESHES, ("o:", "s--", "^-")):
                points = [p for p in results.points_of(variant, mesh) if p.mean]
                axis.plot([p.capillary for p in points], [p.difference[column] for p in points], style, ms=5, lw=1,
                          mfc="white", color=variant.colour, label=f"{mesh.vertices} vertices" if points else None)
            largest = max([bound] + [abs(p.difference[column]) for p in results.points
                                     if p.variant == variant and p.kind == "calibrated" and p.mean])
            axis.set(xlim=(0, 0.33), ylim=(-1.15 * largest, 1.15 * largest))
            if row == 0:
                axis.set_title("difference in " + names[column])
            if row == len(variants) - 1:
                axis.set_xlabel("capillary number Ca")
        axes[row, 0].set_ylabel(variant.title)
        axes[row, 0].legend(loc="lower left", fontsize=8)
    return save(figure, path)


def read_surface(path):
    with h5py.File(path) as file:
        return file["positions"][:], file["triangles"][:]


def draw_surface(axis, positions, triangles, rest, light, dark):
    """The surface seen along the vorticity, flow to the right. The faces that lay in the lower half at rest stay
    dark, so that the turning of the membrane shows."""
    corners = positions[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    seen = normals[:, 1] < 0  # looking along +y
    was_above = rest[triangles].mean(axis=1)[:, 2] > 0
    brightness = 0.55 + 0.45 * np.clip(normals @ np.array([-0.35, -0.75, 0.56]), 0, 1)
    base = np.where(was_above[:, None], matplotlib.colors.to_rgb(light), matplotlib.colors.to_rgb(dark))
    shades = np.clip(base * brightness[:, None], 0, 1)
    axis.add_collection(PolyCollection(corners[seen][:, :, [0, 2]], facecolors=shades[seen],
                                       edgecolors=(0, 0, 0, 0.35), linewidths=10 / np.sqrt(len(triangles))))


def draw_model(axis, capillary, **style):
    length, breadth, angle = model.shape(capillary) if capillary else (1, 1, 0)
    t = np.linspace(0, 2 * np.pi, 200)
    turn = np.radians(angle)
    x, z = length * np.cos(t), breadth * np.sin(t)
    axis.plot(x * np.cos(turn) - z * np.sin(turn), x * np.sin(turn) + z * np.cos(turn), **style)


def colours(variant):
    tone = np.array(matplotlib.colors.to_rgb(variant.colour))
    return 0.35 * tone + 0.65, 0.75 * tone + 0.25


def draw_meshes(results, meshes, path):
    """A row a resolution: the mesh at rest, and the meshes of all variants at Ca = 0.2 with the model's outline."""
    capillary = max(study.BOUNDED)
    variants = [v for v in study.VARIANTS if any(p.variant == v and p.mean for p in results.points)]
    figure, axes = plt.subplots(len(meshes), len(variants) + 1, squeeze=False, layout="constrained",
                                figsize=(2.9 * (len(variants) + 1), 2.5 * len(meshes) + 0.3))
    for axis in axes.flat:
        axis.set(xlim=(-1.35, 1.35), ylim=(-1.1, 1.1), aspect="equal")
        axis.axis("off")
    for row, mesh in enumerate(meshes):
        for column, variant in enumerate(variants, start=1):
            axis = axes[row, column]
            point = next((p for p in results.points_of(variant, mesh) if p.capillary == capillary and p.mean), None)
            if not point:
                axis.text(0, 0, "not run", ha="center", color="0.5")
                continue
            first, *_, last = point.run.surfaces()
            rest, triangles = read_surface(first)
            draw_surface(axis, read_surface(last)[0], triangles, rest, *colours(variant))
            draw_model(axis, capillary, color="black", lw=0.9, ls="--")
            if not axes[row, 0].collections:
                draw_surface(axes[row, 0], rest, triangles, rest, "0.92", "0.7")
        axes[row, 0].text(-1.3, 0, f"{mesh.vertices} vertices", rotation=90, va="center", ha="center")
    for axis, title in zip(axes[0], ["at rest"] + [f"{v.title}, Ca = {capillary:g}" for v in variants]):
        axis.set_title(title)
    return save(figure, path, dpi=100)


def best_picture(results):
    """The drop at the largest bounded Ca, surface tension if it was run, on a mesh that one can still see."""
    points = [p for p in results.points if p.kind == "calibrated" and p.capillary == max(study.BOUNDED) and p.mean]
    order = {v.name: i for i, v in enumerate(study.VARIANTS)}
    return min(points, key=lambda p: (order[p.variant.name], abs(p.mesh.vertices - 642)), default=None)


def draw_summary(results, point, path):
    """One picture for a first look: the drop in the flow, and both panels on the mesh of the drop."""
    figure, axes = plt.subplots(1, 3, figsize=(12.5, 3.7), layout="constrained", width_ratios=[1.25, 1, 1])
    flow = axes[0]
    first, *_, last = point.run.surfaces()
    rest, triangles = read_surface(first)
    heights = np.linspace(-1.4, 1.4, 9)
    for height in heights[np.abs(heights) > 0.01]:
        speed = 0.4 * height
        flow.annotate("", (2.15 + speed, height), (2.15, height),
                      arrowprops=dict(arrowstyle="-|>", color="0.45", lw=1, shrinkA=0, shrinkB=0))
    flow.plot([2.15, 2.15], [-1.4, 1.4], color="0.45", lw=1)
    flow.plot([2.15 - 0.56, 2.15 + 0.56], [-1.4, 1.4], color="0.45", lw=1, ls=":")
    draw_model(flow, 0, color="0.55", lw=1, ls=":")
    draw_surface(flow, read_surface(last)[0], triangles, rest, *colours(point.variant))
    draw_model(flow, point.capillary, color="black", lw=1.1, ls="--")
    flow.set(xlim=(-1.4, 2.8), ylim=(-1.5, 1.5), aspect="equal")
    flow.set_title(f"{point.variant.title}, {point.mesh.vertices} vertices, Ca = {point.capillary:g}")
    flow.axis("off")
    plot_axes(axes[1], results, point.mesh)
    axes[1].set(xlabel="capillary number Ca", title="semi-axes in the plane of shear")
    plot_angle(axes[2], results, point.mesh)
    axes[2].legend(loc="upper right", fontsize=8.5)
    axes[2].set_title("angle to the flow (degrees)")
    return save(figure, path)


def save(figure, path, dpi=130):
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=dpi)
    plt.close(figure)
    return path
