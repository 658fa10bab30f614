#!/usr/bin/python3
"""A strip is stretched: Young's modulus and Poisson's ratio, fibres, membrane laws at large strains. See README.md."""
import json
import math
import subprocess
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

WIDTH, TENSION, SKALAK = 0.25, 0.001, 1  # C of Skalak's law


def neo_hookean(s):
    """Force over the width at the start, and the stretch across, at a stretch s along; G = 1/3."""
    return (s - s**-2) / 3, s**-0.5


def skalak(s):
    across = math.sqrt((1 + SKALAK * s**2) / (1 + SKALAK * s**4))
    return s * (s**2 - 1 + SKALAK * across**2 * (s**2 * across**2 - 1)) / 3, across


NEO = {"body.strip.potentials.membrane": '{ law = "neo-hookean", shear = 0.333333333333 }'}
SKA = {"body.strip.potentials.membrane": f'{{ law = "skalak", shear = 0.333333333333, ratio = {SKALAK} }}', "body.strip.substeps": 40}
ALONG = {"body.strip.fibre": [1, 0, 0], "body.strip.young_across": 0.333333333333}
ACROSS = {"body.strip.fibre": [0, 1, 0], "body.strip.young_across": 0.333333333333}
# name: edge, shaken by (edges), settings, Young's modulus asked for
SMALL = {"lattice-0.05": (0.05, 0, {}, 1), "lattice-0.025": (0.025, 0, {}, 1), "shaken-10": (0.025, 0.1, {}, 1),
         "shaken-25": (0.025, 0.25, {}, 1), "fibre-along": (0.025, 0, ALONG, 1), "fibre-across": (0.025, 0, ACROSS, 1 / 3),
         "fibre-along-shaken-25": (0.025, 0.25, ALONG, 1), "neo-hookean-shaken-25": (0.025, 0.25, NEO, 1)}
# name: edge, shaken by, settings, law, stretch
LARGE = {f"{name}-{s}": (0.025, 0.25, given, law, s)
         for name, given, law in (("neo-hookean", NEO, neo_hookean), ("skalak", SKA, skalak)) for s in (1.1, 1.3, 1.5)}
MESHES = {"lattice": 0, "shaken by 0.1 edges": 0.1, "shaken by 0.25 edges": 0.25, "disc": None}
ANGLES = (0, 15, 30, 45, 60, 75, 90)


def surface(arguments, name, size, edge, shake):
    if shake is None:
        return {"body.strip.surface": f'{{ shape = "disc", radius = {size[0] / 2}, edge = {edge} }}'}
    if not shake:
        return {"body.strip.surface.size": list(size), "body.strip.surface.edge": edge}
    return {"body.strip.surface": f'{{ file = "{common.shaken_plate(arguments, name, size, edge, shake)}", open = true }}'}


def settings(arguments, name, edge, shake, further, tension):
    return {**surface(arguments, name, (1, WIDTH), edge, shake), **further, "body.strip.damping": 0.0017 * (edge / 0.025) ** 2,
            "body.strip.pull.load.force": [tension * WIDTH, 0, 0]}


def strains(out):
    """Mean strain along and across in the middle of the strip, by straight lines through the displacements."""
    import h5py
    import numpy as np

    files = sorted(out.glob("surfaces/strip_*.h5"))
    start, end = (h5py.File(file)["positions"][:] for file in (files[0], files[-1]))
    middle = abs(start[:, 0]) < 0.35
    return [np.polyfit(start[middle, d], (end - start)[middle, d], 1)[0] for d in (0, 1)]


def moduli(arguments, overrides):
    options = [part for key, value in overrides.items() for part in ("--set", f"{key}={common.toml_value(value)}")]
    return json.loads(subprocess.check_output([arguments.binary, "mesh", "moduli", CASE / "case.toml", "strip", "--json", *options]))


def strip(c):
    """Young's modulus and Poisson's ratio along axis 1 of a sheet with these stiffnesses."""
    import numpy as np

    compliance = np.linalg.inv([[c["c11"], c["c12"], c["c16"]], [c["c12"], c["c22"], c["c26"]], [c["c16"], c["c26"], c["c66"]]])
    return 1 / compliance[0, 0], -compliance[0, 1] / compliance[0, 0]


def deviation(pair):
    return f"{100 * (pair['found'] / pair['asked'] - 1):+.1f} %"


def stretch_small(arguments, bounds, results):
    rows = []
    for name, (edge, shake, further, young) in SMALL.items():
        given = settings(arguments, name, edge, shake, further, TENSION * young)
        out = common.run(arguments, name, CASE / "case.toml", given)
        along, across = strains(out)
        found, c = TENSION * young / along, moduli(arguments, given)["plane_stiffness"]
        if further is ACROSS:
            c["c11"], c["c22"], c["c16"], c["c26"] = c["c22"], c["c11"], c["c26"], c["c16"]
        by_moduli, poisson = strip(c)
        results[name] = found / young
        rows.append([name, f"{young:.4f}", f"{found:.4f}", f"{100 * (found / young - 1):+.1f} %", f"{by_moduli:.4f}",
                     f"{-across / along:.3f}", f"{poisson:.3f}"])
        bounds.near(f"Young's modulus, {name}, against `pliant mesh moduli`", found, by_moduli, 2)
        bounds.within(f"Poisson's ratio, {name}, less that of `pliant mesh moduli`", -across / along - poisson, -0.02, 0.02)
    bounds.near("Young's modulus, lattice-0.025, against that asked for", results["lattice-0.025"], 1, 1)
    bounds.near("Young's modulus along fibres, fibre-along, against that asked for", results["fibre-along"], 1, 2)
    bounds.near("Young's modulus across fibres, fibre-across, against that asked for", results["fibre-across"], 1, 2)
    return common.markdown_table(["run", "Y asked for", "Y found", "", "by `mesh moduli`", "Poisson's ratio", "by `mesh moduli`"], rows)


def stretch_far(arguments, bounds, results):
    rows = []
    for name, (edge, shake, further, law, stretch) in LARGE.items():
        tension, across = law(stretch)
        out = common.run(arguments, name, CASE / "case.toml", settings(arguments, name, edge, shake, further, tension))
        found = [1 + strain for strain in strains(out)]
        results[name] = found[0], tension
        rows.append([name, f"{tension:.4f}", f"{stretch:g}", f"{found[0]:.4f}", f"{across:.4f}", f"{found[1]:.4f}"])
        bounds.near(f"stretch - 1, {name}", found[0] - 1, stretch - 1, 1)
        bounds.near(f"stretch across, {name}", found[1], across, 1)
    return common.markdown_table(["run", "force a width", "stretch: closed form", "found", "across: closed form", "found"], rows)


def tables_of_moduli(arguments):
    meshes, fibres = [], []
    for name, shake in MESHES.items():
        sheet = surface(arguments, f"sheet-{shake}", (1, 1), 0.05, shake)
        # A disc has none of the strip's selections at its ends.
        plain = {**sheet, "body.strip.pinned": []} if shake is None else sheet
        found = moduli(arguments, plain)
        meshes.append([name] + [deviation(found[key]) for key in ("area", "shear", "young", "poisson")])
        for ratio in (2, 4):
            row = [name, ratio]
            for angle in ANGLES:
                fibre = [math.cos(math.radians(angle)), math.sin(math.radians(angle)), 0]
                found = moduli(arguments, {**plain, "body.strip.fibre": fibre, "body.strip.young_across": 1 / ratio})
                row.append(f"{deviation(found['young_along'])}, {deviation(found['young_across'])}")
            fibres.append(row)
    return (common.markdown_table(["mesh", "K", "G", "Y", "Poisson's ratio"], meshes),
            common.markdown_table(["mesh", "Y along / across"] + [f"{a} degrees" for a in ANGLES], fibres))


def draw(results, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np

    plt.rcParams.update({"axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False})
    figure, axis = plt.subplots(figsize=(6.5, 3.8), layout="constrained")
    s = np.linspace(1, 1.6, 100)
    for law, name, colour, label in ((neo_hookean, "neo-hookean", "#08519c", "neo-Hookean"), (skalak, "skalak", "#238b45", "Skalak, C = 1")):
        axis.plot(s, [law(x)[0] for x in s], color=colour, lw=1, label=label)
        axis.plot(*zip(*[results[key] for key in LARGE if key.startswith(name)]), "o", color=colour, ms=5)
    axis.set(xlim=(1, 1.6), ylim=(0, 1.5), xlabel="stretch", ylabel="force a width, Y")
    axis.legend()
    figure.savefig(file, dpi=110)


def main():
    arguments = common.read_arguments(__doc__, "stretched-sheet", quick="the same: all runs take seconds")
    bounds, results = common.Bounds(), {}
    small, large = stretch_small(arguments, bounds, results), stretch_far(arguments, bounds, results)
    meshes, fibres = tables_of_moduli(arguments)
    text = (bounds.markdown() + "\nStrips under a tension of 0.001 Y:\n\n" + small + "\nStrips that are stretched far, shaken by 0.25 edges:\n\n"
            + large + "\nWhat `pliant mesh moduli` finds against what was asked for, sheets of size 1, edges of 0.05:\n\n" + meshes
            + "\nThe same along and across fibres, by their angle to x, along which a lattice has edges:\n\n" + fibres)
    return common.conclude(arguments, CASE, text, bounds, lambda picture: draw(results, picture))


if __name__ == "__main__":
    sys.exit(main())
