#!/usr/bin/python3
"""A clamped strip bends under a load at its tip, against beam theory; bending moduli of networks. See README.md."""
import json
import random
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
        "shaken-10": (0.025, 0.2, 0.03, 0.1), "shaken-25": (0.025, 0.2, 0.03, 0.25)}
# Deflection of the tip over the length, by load: beam theory, and the elastica (Bisshopp and Drucker 1945).
DEFLECTION = {0.03: 0.01, 1: 0.3017, 2: 0.4935}
MESHES = {"lattice": 0, "shaken by 0.1 edges": 0.1, "shaken by 0.25 edges": 0.25, "disc": None}
SIZE = 1.0


def plate_file(arguments, name, size, edge, shake):
    """A plate whose inner vertices are moved at random in its plane."""
    file = arguments.out / f"{name}.obj"
    subprocess.run([arguments.binary, "mesh", "plate", "--size", *map(str, size), "--edge", str(edge), "-o", file], check=True,
                   stdout=subprocess.DEVNULL)
    chance = random.Random(1)
    lines = []
    for line in file.read_text().splitlines():
        if line.startswith("v "):
            x, y, z = map(float, line.split()[1:4])
            if abs(abs(x) - size[0] / 2) > 1e-6 and abs(abs(y) - size[1] / 2) > 1e-6:
                x, y = (q + shake * edge * chance.uniform(-1, 1) for q in (x, y))
            line = f"v {x!r} {y!r} {z!r}"
        lines.append(line)
    file.write_text("\n".join(lines) + "\n")
    return file


def surface(arguments, name, size, edge, shake):
    if not shake:
        return {"body.strip.surface.size": list(size), "body.strip.surface.edge": edge}
    return {"body.strip.surface": f'{{ file = "{plate_file(arguments, name, size, edge, shake)}", open = true }}'}


def settings(arguments, name):
    edge, width, load, shake = RUNS[name]
    return {**surface(arguments, name, (1.2, width), edge, shake), "body.strip.damping": 5e-5 * (edge / 0.05) ** 2,
            # Rows begin at x = 0 and at half an edge by turns: of the shaken ones too, only the former are clamped.
            "body.strip.selection.clamp.plane.tolerance": 0.25 * edge if shake else 0.01 * edge,
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
        left.axhline(-DEFLECTION[RUNS[name][2]], color=colour, lw=0.8, ls=":")
    left.set(xlabel="x", ylabel="z", aspect="equal", xlim=(-0.25, 1.05))
    for width, names in ((0.2, ("0.1", "0.05", "0.025", "0.0125")), (0.4, ("wide-0.05", "wide-0.025"))):
        right.plot([RUNS[n][0] / width for n in names], [100 * (results[n]["deflection"] / 0.01 - 1) for n in names], "o-",
                   label=f"width {width}")
    right.axhline(0, color="k", lw=0.8, ls=":")
    right.set(xlabel="edge over width", ylabel="deflection against beam theory, %", xlim=(0, None))
    right.legend()
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "bent-sheet", quick="the same: all runs take seconds")
    bounds, results, rows = common.Bounds(), {}, []
    for name, (edge, width, load, shake) in RUNS.items():
        out = common.run(arguments, name, CASE / "case.toml", settings(arguments, name))
        start, end = shapes(out)
        tip = start[:, 0] > 1 - 1e-6
        found, energy = -(end - start)[tip, 2].mean(), common.read_table(out / "bodies" / "strip.csv")["kinetic_energy"][-1]
        results[name] = {"shapes": (start, end), "deflection": found}
        rows.append([f"{edge:g}", f"{width:g}", f"{shake:g}", f"{load:g}", f"{DEFLECTION[load]:.4f}", f"{found:.4f}",
                     f"{100 * (found / DEFLECTION[load] - 1):+.1f} %", f"{energy:.0e}"])
    fine, finer = results["0.025"]["deflection"], results["0.0125"]["deflection"]
    bounds.near("deflection, edge 0.0125", finer, 0.01, 3)
    # A clamp keeps the strip from curling: between beam theory and bending to a cylinder, which is stiffer by 1 / (1 - nu^2).
    bounds.within("deflection, continued to edge 0", 2 * finer - fine, 0.01 * 8 / 9, 0.01)
    bounds.near("large deflection, F L^2 / EI = 1, edge 0.025", results["large-0.025"]["deflection"], DEFLECTION[1], 5)
    bounds.near("large deflection, F L^2 / EI = 2, edge 0.025", results["large-2"]["deflection"], DEFLECTION[2], 5)

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
    of_lattice = strip_stiffness(moduli(arguments, settings(arguments, "0.025")))
    for name in ("shaken-10", "shaken-25"):
        expected = strip_stiffness(moduli(arguments, settings(arguments, name))) / of_lattice
        bounds.near(f"stiffness of a strip shaken by {RUNS[name][3]} edges over a lattice's, against `pliant mesh moduli`",
                    fine / results[name]["deflection"], expected, 3)
    text = (bounds.markdown() + "\n\n" + common.markdown_table(
        ["edge", "width", "shaken by, edges", "F L^2 / EI", "deflection: theory", "found", "", "kinetic energy left"], rows)
        + "\nBending modulus that `pliant mesh moduli` finds, against that asked for, by the length of edges of a sheet of size 1:\n\n"
        + common.markdown_table(["mesh", "0.1", "0.05", "0.025"], table))
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
