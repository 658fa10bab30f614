#!/usr/bin/python3
"""A clamped strip bends under a load at its tip, against beam theory; bending moduli of networks. See README.md."""
import json
import math
import subprocess
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

EI = 0.05**3 / 12  # a width
# name: edge, width, load L^2 / EI, how far vertices are shaken in edges
RUNS = {"0.1": (0.1, 0.2, 0.03, 0), "0.05": (0.05, 0.2, 0.03, 0), "0.025": (0.025, 0.2, 0.03, 0),
        "0.0125": (0.0125, 0.2, 0.03, 0), "wide-0.05": (0.05, 0.4, 0.03, 0), "wide-0.025": (0.025, 0.4, 0.03, 0),
        "large-0.05": (0.05, 0.2, 1, 0), "large-0.025": (0.025, 0.2, 1, 0), "large-2": (0.025, 0.2, 2, 0),
        "shaken-10": (0.025, 0.4, 0.03, 0.1), "shaken-25": (0.025, 0.4, 0.03, 0.25)}
MESHES = {"lattice": 0, "shaken by 0.1 edges": 0.1, "shaken by 0.25 edges": 0.25, "disc": None}
SIZE = 1.0
CLAMP = 0.25  # edges beyond x = 0 that are still clamped: rows are not at 0 exactly, and shaken ones not straight


def elastica(load):
    """Deflection over length of the tip of a cantilever by a load F L^2 / EI across it, whatever its size: the angle obeys
    a'' = -load cos a, a(0) = 0, a'(1) = 0."""
    def shoot(curvature, steps=400):
        h, state, sunk = 1 / steps, (0.0, curvature), 0.0

        def slope(angle, bend):
            return bend, -load * math.cos(angle), math.sin(angle)

        for _ in range(steps):
            k1 = slope(*state)
            k2 = slope(state[0] + h / 2 * k1[0], state[1] + h / 2 * k1[1])
            k3 = slope(state[0] + h / 2 * k2[0], state[1] + h / 2 * k2[1])
            k4 = slope(state[0] + h * k3[0], state[1] + h * k3[1])
            change = [h / 6 * (p + 2 * q + 2 * r + t) for p, q, r, t in zip(k1, k2, k3, k4)]
            state, sunk = (state[0] + change[0], state[1] + change[1]), sunk + change[2]
        return state[1], sunk

    low, high = 0.0, load
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if shoot(middle)[0] > 0 else (middle, high)
    return shoot(low)[1]


def surface(arguments, name, size, edge, shake):
    if not shake:
        return {"body.strip.surface.size": list(size), "body.strip.surface.edge": edge}
    return {"body.strip.surface": f'{{ file = "{common.shaken_plate(arguments, name, size, edge, shake)}", open = true }}'}


def settings(arguments, name):
    edge, width, load, shake = RUNS[name]
    return {**surface(arguments, name, (1.2, width), edge, shake), "body.strip.damping": 5e-5 * (edge / 0.05) ** 2,
            "body.strip.selection.clamp.plane.tolerance": CLAMP * edge,
            "body.strip.pull.load.force": [0, 0, -load * EI * width]}


def shapes(out):
    """Positions of the vertices at the start and at the end."""
    import h5py

    files = sorted(out.glob("surfaces/strip_*.h5"))
    return [h5py.File(file)["positions"][:] for file in (files[0], files[-1])]


def moduli(arguments, overrides):
    options = [part for key, value in overrides.items() for part in ("--set", f"{key}={common.toml_value(value)}")]
    return json.loads(subprocess.check_output([arguments.binary, "mesh", "moduli", CASE / "case.toml", "strip", "--json", *options]))


def strip_stiffness(found):
    """Of a strip whose long sides are free, from the stiffness of the sheet: the curvature across follows."""
    c = found["bending_stiffness"]
    return c["c11"] - c["c12"] ** 2 / c["c22"]


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.4), layout="constrained")
    for name, colour in (("0.025", "#9ecae1"), ("large-0.025", "#4292c6"), ("large-2", "#08306b")):
        start, end = results[name]["shapes"]
        middle = np.abs(start[:, 1]) < 0.02
        order = np.argsort(start[middle, 0])
        left.plot(end[middle, 0][order], end[middle, 2][order], ".", ms=3, color=colour)
        left.axhline(-results[name]["theory"], color=colour, lw=0.8, ls=":")
    left.set(xlabel="x", ylabel="z", aspect="equal", xlim=(-0.25, 1.05))
    for width, names in ((0.2, ("0.1", "0.05", "0.025", "0.0125")), (0.4, ("wide-0.05", "wide-0.025"))):
        for key, style in (("theory", "o-"), ("by_moduli", "s--")):
            right.plot([RUNS[n][0] / width for n in names],
                       [100 * (results[n]["deflection"] / results[n][key] - 1) for n in names], style,
                       color="#08519c" if width == 0.2 else "#d95f0e",
                       label=f"width {width}" + (", moduli as found" if key == "by_moduli" else ""))
    right.axhline(0, color="k", lw=0.8, ls=":")
    right.set(xlabel="edge over width", ylabel="deflection against theory, %", xlim=(0, None))
    right.legend()
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "bent-sheet", quick="the same: all runs take seconds")
    bounds, results, rows = common.Bounds(), {}, []
    for name, (edge, width, load, shake) in RUNS.items():
        given = settings(arguments, name)
        out = common.run(arguments, name, CASE / "case.toml", given)
        start, end = shapes(out)
        tip, clamped = start[:, 0] > 1 - 1e-6, start[:, 0] <= CLAMP * edge
        # The strip begins at its last clamped vertices; shaken ones are there on average.
        row = start[clamped, 0] > start[clamped, 0].max() - 2.1 * shake * edge - 1e-6
        length = 1 - start[clamped, 0][row].mean()
        stiffness = strip_stiffness(moduli(arguments, given)) / EI
        found = -(end - start)[tip, 2].mean()
        theory, by_moduli = (length * elastica(load * length**2 / s) for s in (1, stiffness))
        energy = common.read_table(out / "bodies" / "strip.csv")["kinetic_energy"][-1]
        results[name] = {"shapes": (start, end), "deflection": found, "theory": theory, "by_moduli": by_moduli}
        rows.append([f"{edge:g}", f"{width:g}", f"{shake:g}", f"{load:g}", f"{length:.4f}", f"{found:.5f}", f"{theory:.5f}",
                     f"{100 * (found / theory - 1):+.1f} %", f"{stiffness:.3f}", f"{100 * (found / by_moduli - 1):+.1f} %",
                     f"{energy:.0e}"])
    for name in ("0.0125", "large-0.025", "large-2"):
        r = results[name]
        bounds.near(f"deflection, edge {RUNS[name][0]}, F / EI = {RUNS[name][2]}, against theory", r["deflection"], r["theory"], 3)
    for name in ("0.0125", "wide-0.025", "shaken-10", "shaken-25"):
        r, (edge, width, _, shake) = results[name], RUNS[name]
        bounds.near(f"deflection, edge {edge}, width {width}, shaken by {shake}, against theory with the moduli that "
                    "`pliant mesh moduli` finds", r["deflection"], r["by_moduli"], 3)

    table = []
    for name, shake in MESHES.items():
        row = [name]
        for edge in (0.1, 0.05, 0.025):
            overrides = ({"body.strip.surface": f'{{ shape = "disc", radius = {SIZE / 2}, edge = {edge} }}', "body.strip.pinned": [],
                          "body.strip.pull.load.selection": "tip"} if shake is None else
                         surface(arguments, f"{name.replace(' ', '-')}-{edge}", (SIZE, SIZE), edge, shake))
            found = moduli(arguments, overrides)["bending"]
            row.append(f"{100 * (found['found'] / found['asked'] - 1):+.1f} %")
            results[name, edge] = found["found"] / found["asked"]
        table.append(row)
    bounds.near("B of a lattice, edge 0.025, over that asked for", results["lattice", 0.025], 1, 1)
    text = (bounds.markdown() + "\n\n" + common.markdown_table(
        ["edge", "width", "shaken by, edges", "F / EI", "length", "deflection", "theory", "", "strip's stiffness found / asked for",
         "theory with that", "kinetic energy left"], rows)
        + "\nBending modulus that `pliant mesh moduli` finds, against that asked for, by the length of edges of a sheet of size 1:\n\n"
        + common.markdown_table(["mesh", "0.1", "0.05", "0.025"], table))
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
