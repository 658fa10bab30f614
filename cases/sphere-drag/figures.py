"""The figure of this case."""
import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import evaluate  # noqa: E402

COLOR = {50: "#2a6f97", 100: "#c8553d", 150: "#5a8f3c"}


def wake(axes, run, reynolds):
    """Speed along the flow and streamlines in the plane y = 0."""
    with h5py.File(run.last("fields/fields_*.h5")) as file:
        x, y, z = ([0.5 * (n[1:] + n[:-1]) for n in (file[name][:] for name in "xyz")])
        rows = [len(y) // 2 - 1, len(y) // 2]
        velocity = file["velocity"][:, rows, :, :].mean(axis=1)
    lines_z, lines_x = np.linspace(-1.2, 2.6, 191), np.linspace(-1.2, 1.2, 121)

    def even(values):
        by_z = np.stack([np.interp(lines_z, z, values[:, i]) for i in range(len(x))], 1)
        return np.stack([np.interp(lines_x, x, row) for row in by_z], 0).T

    u, w = even(velocity[..., 0]), even(velocity[..., 2])
    image = axes.pcolormesh(lines_z, lines_x, w, cmap="RdBu_r", vmin=-1.3, vmax=1.3, rasterized=True, shading="gouraud")
    axes.streamplot(lines_z, lines_x, w, u, color="0.25", linewidth=0.5, density=1.3, arrowsize=0.5)
    axes.add_patch(plt.Circle((0, 0), 0.5, facecolor="0.85", edgecolor="k", zorder=5))
    axes.set(aspect="equal", xlabel="z / d", ylabel="x / d", xlim=(-1.2, 2.6), ylim=(-1.2, 1.2),
             title=f"Re = {reynolds}: velocity along the flow, w / U")
    plt.colorbar(image, ax=axes, shrink=0.75)


def drag(axes, corrected, reference):
    re = np.linspace(30, 200, 100)
    axes.plot(re, 24 / re * (1 + 0.1935 * re**0.6305), color="0.6", label="Clift, Grace & Weber")
    axes.plot(list(reference), [r[0] for r in reference.values()], "k_", markersize=16, label="reference")
    for n, marker in ((10, "v"), (14, "s"), (16, "D"), (20, "o")):
        points = sorted((key[0], value[0]) for key, value in corrected.items() if key[1] == n)
        if points:
            axes.plot(*zip(*points), marker, markersize=5, markerfacecolor="none", color=COLOR[100],
                      label=f"{n} cells a diameter")
    axes.set(xlabel="Re", ylabel="drag coefficient", title="Drag, corrected for blockage", ylim=(0.75, 2.1))
    axes.legend(fontsize=8)


def convergence(axes, corrected, reference):
    for reynolds, ref in reference.items():
        for index, style, name in ((0, "o-", "momentum balance"), (1, "s--", "probes")):
            points = sorted((1.0 / key[1], 100 * (value[index] / ref[0] - 1))
                            for key, value in corrected.items() if key[0] == reynolds)
            axes.plot(*zip(*points), style, color=COLOR[reynolds], markersize=4, label=f"Re = {reynolds}, {name}")
    axes.axhline(0, color="k", linewidth=0.8)
    axes.axhspan(-3, 3, color="0.93", zorder=0)
    axes.set(xlabel="h / d", ylabel="drag against the reference, %", xlim=(0, 0.11), title="Grid convergence")
    axes.legend(fontsize=7)


def shear(axes, runs, reference):
    for reynolds, ref in reference.items():
        key = max((key for key in runs if key[0] == reynolds and key[2] == 8), key=lambda key: key[1])
        theta, values = evaluate.meridional_shear(runs[key].last("surfaces/sphere_*.h5"))
        bins = np.arange(0, 181, 3.0)
        which = np.digitize(theta, bins) - 1
        mean = [values[which == b].mean() if (which == b).any() else np.nan for b in range(len(bins) - 1)]
        axes.plot(theta, values, ",", color=COLOR[reynolds], alpha=0.5)
        axes.plot(0.5 * (bins[1:] + bins[:-1]), mean, color=COLOR[reynolds], label=f"Re = {reynolds}")
        axes.axvline(ref[2], color=COLOR[reynolds], linestyle=":", linewidth=1)
    axes.axhline(0, color="k", linewidth=0.8)
    axes.set(xlabel="angle from the front, degrees", ylabel="wall shear / (rho U$^2$)", xlim=(0, 180),
             title="Shear along the meridian; dotted: reference separation")
    axes.legend(fontsize=8)


def draw(runs, results, corrected, reference, path):
    figure, axes = plt.subplots(2, 2, figsize=(11, 7.4), constrained_layout=True)
    finest = max(key for key in runs if key[0] == 100 and key[2] == 8)
    wake(axes[0, 0], runs[finest], 100)
    drag(axes[0, 1], corrected, reference)
    convergence(axes[1, 0], corrected, reference)
    shear(axes[1, 1], runs, reference)
    figure.savefig(path, dpi=110)
    plt.close(figure)
