#!/usr/bin/python3
"""Lift and drag of a plate of aspect ratio 2 over its incidence, against the experiments in Taira and Colonius (2009)."""
import argparse
import math
import sys
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
from common import Bounds, Runner, read_table, wall_seconds  # noqa: E402

ANGLES = (10, 20, 30, 40, 90)
MOMENT, WINDOW = 13.0, 0.5  # coefficients are means over [MOMENT - WINDOW, MOMENT]
BOUND = 8.0  # per cent
BOX, SMALL, WHOLE = (10.5, 4, 9), (7, 2.5, 6), (10.5, 8, 9)
WIDTH, GROWTH = 2, 0.05  # of the cells along z
THICK = {"body.plate.thin_sheet": False, "body.plate.marker_retraction": 0}


def planes(height, spacing):
    """Cells along z that are as long as those along x and y around the plate."""
    outside = (height - WIDTH) / 2
    return round(WIDTH * spacing + 2 * math.log1p(GROWTH * outside * spacing) / GROWTH)


def settings(angle, spacing, size=BOX, stretched=True):
    """`spacing`: cells a chord. All boxes but WHOLE hold half of the plate."""
    whole = size == WHOLE
    height = planes(size[2], spacing) if stretched else round(size[2] * spacing)
    uniform = {} if stretched else {"box.stretching.z": '{ law = "uniform" }'}
    return {"box.size": list(size), "box.origin": [-size[0] * 2.5 / 7, -size[1] / 2 if whole else 0, -size[2] / 2],
            "box.cells": [round(size[0] * spacing), round(size[1] * spacing), height], **uniform,
            "body.plate.rotation.angle": angle, "body.plate.surface.size": [1, 2 if whole else 1],
            "body.plate.center": [0, 0 if whole else 0.5, 0], "body.plate.surface.edge": round(1.25 / spacing, 4)}


def experiment(name):
    return np.loadtxt(CASE / "reference" / f"{name}.dat")


def measured_at(name, angle):
    table = experiment(name)
    return float(np.interp(angle, table[:, 0], table[:, 1]))


def coefficients(folder, size=BOX):
    """Mean drag and lift over the window: force of the whole plate over 1/2 rho U^2 (1 x 2 chords)."""
    table = read_table(folder / "bodies" / "plate.csv")
    late = table["time"] >= MOMENT - WINDOW
    whole = 1 if size == WHOLE else 2
    mean = {key: (1 if key == "slip" else whole) * float(np.mean(table[column][late])) for key, column in
            {"drag": "force_x", "lift": "force_z", "probe_drag": "probe_force_x", "probe_lift": "probe_force_z",
             "slip": "slip_rms"}.items()}
    mean["minutes"] = wall_seconds(folder) / 60
    return mean


def percent(value, reference):
    return 100 * (value / reference - 1)


def angle_table(results):
    lines = ["| incidence | drag: experiment | momentum balance | | probes | lift: experiment | momentum balance | | probes "
             "| slip, rms | minutes |", "|" + "---|" * 11]
    for angle, c in results.items():
        drag, lift = measured_at("drag", angle), measured_at("lift", angle)
        off = "" if angle == 90 else f"{percent(c['lift'], lift):+.1f} %"
        lines.append(f"| {angle} | {drag:.3f} | {c['drag']:.3f} | {percent(c['drag'], drag):+.1f} % | {c['probe_drag']:.3f} | "
                     f"{lift:.3f} | {c['lift']:.3f} | {off} | {c['probe_lift']:.3f} | {c['slip']:.4f} | {c['minutes']:.1f} |")
    return "\n".join(lines)


def along_plate(c, angle):
    """Normal and tangential force coefficient."""
    sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    return c["lift"] * cosine + c["drag"] * sine, c["drag"] * cosine - c["lift"] * sine


def sensitivity_table(rows, angle=30):
    lines = ["| cells a chord | | drag | lift | normal | tangential | probes: drag | lift | slip, rms | minutes |", "|" + "---|" * 10]
    for spacing, what, c in rows:
        normal, tangential = along_plate(c, angle)
        lines.append(f"| {spacing} | {what} | {c['drag']:.3f} | {c['lift']:.3f} | {normal:.3f} | {tangential:.3f} | "
                     f"{c['probe_drag']:.3f} | {c['probe_lift']:.3f} | {c['slip']:.4f} | {c['minutes']:.1f} |")
    normal, tangential = along_plate({"drag": measured_at("drag", angle), "lift": measured_at("lift", angle)}, angle)
    lines.append(f"| experiment | | {measured_at('drag', angle):.3f} | {measured_at('lift', angle):.3f} | {normal:.3f} | "
                 f"{tangential:.3f} | | | | |")
    return "\n".join(lines)


def draw(results, folders, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(12, 3.8), constrained_layout=True)
    angles = list(results)
    for axes, name, color in ((left, "drag", "C3"), (middle, "lift", "C0")):
        table = experiment(name)
        axes.plot(table[:, 0], table[:, 1], ".", color="0.6", label="experiment, oil tank")
        axes.fill_between(table[:, 0], table[:, 1] * (1 - BOUND / 100), table[:, 1] * (1 + BOUND / 100), color="0.92",
                          label=f"within {BOUND:g} %")
        axes.plot(angles, [results[a][name] for a in angles], "o", color=color, label="Pliant, momentum balance")
        axes.plot(angles, [results[a][f"probe_{name}"] for a in angles], "x", color="k", label="Pliant, probes")
        axes.set_xlabel("incidence, degrees")
        axes.set_ylabel(f"{name} coefficient")
        axes.legend(fontsize=7)
    for n, (angle, folder) in enumerate(folders.items()):
        table = read_table(folder / "bodies" / "plate.csv")
        right.plot(table["time"], 2 * table["force_x"], color=f"C{n}", label=f"{angle} degrees")
        right.plot(table["time"], 2 * table["force_z"], color=f"C{n}", ls="--")
    right.set_ylim(0, 2.4)
    right.set_xlabel("t U / chord")
    right.set_ylabel("drag (solid), lift (dashed)")
    right.legend(fontsize=7)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="12 cells a chord, no study of grid and box")
    parser.add_argument("--reuse", action="store_true", help="keep runs that the same settings have made")
    parser.add_argument("--binary", help="the program; default: build/release/pliant")
    parser.add_argument("--out", default="out/plate", help="folder of the runs, the figure and the tables")
    arguments = parser.parse_args()
    runner = Runner(CASE, arguments.out, arguments.binary, arguments.reuse)
    spacing = 12 if arguments.quick else 20

    folders = {a: runner.run(f"angle-{a}-n{spacing}", settings(a, spacing)) for a in ANGLES}
    results = {a: coefficients(folder) for a, folder in folders.items()}
    text = f"{spacing} cells a chord\n\n" + angle_table(results)

    if not arguments.quick:
        rows = []

        def study(n, what, kind="", size=BOX, stretched=True, further=None):
            folder = runner.run(f"angle-30-n{n}{kind}", {**settings(30, n, size, stretched), **(further or {})})
            rows.append((n, what, coefficients(folder, size)))

        for n in (12, 16, 20, 24):
            study(n, "")
        for n in (12, 16, 20):
            study(n, "no slip at the markers, edges not drawn in", "-thick", further=THICK)
        study(12, "whole plate, box twice as wide", "-whole", WHOLE)
        study(12, "equal cells along z", "-equal", stretched=False)
        study(12, "box of 7 x 2.5 x 6, equal cells", "-small", SMALL, stretched=False)
        text += "\n\nAt 30 degrees:\n\n" + sensitivity_table(rows)

    print(text + "\n")
    bounds = Bounds()
    for a, c in results.items():
        for name in ("drag", "lift"):
            if a == 90 and name == "lift":
                continue  # 0 by symmetry
            bounds.at_most(f"{name} at {a} degrees, difference from the experiment",
                           abs(percent(c[name], measured_at(name, a))), BOUND, " %")
    picture = Path(arguments.out) / "plate.png"
    draw(results, folders, picture)
    (Path(arguments.out) / "results.md").write_text(text + "\n\n" + bounds.markdown() + "\n")
    print(f"figure: {picture}")
    return 0 if bounds.passes else 1


if __name__ == "__main__":
    sys.exit(main())
