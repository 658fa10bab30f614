#!/usr/bin/python3
"""Lift and drag of a plate of aspect ratio 2 over its incidence, against the experiments in Taira and Colonius (2009)."""
import argparse
import sys
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
from common import Bounds, Runner, read_table, wall_seconds  # noqa: E402

ANGLES = (10, 20, 30, 40, 90)
MOMENT, WINDOW = 13.0, 0.5  # coefficients are means over [MOMENT - WINDOW, MOMENT]
BOUND = 8.0  # per cent
BOX, WIDE, WHOLE = (7, 2.5, 6), (10.5, 4, 9), (7, 5, 6)


def settings(angle, spacing, size=BOX):
    """`spacing`: cells a chord. All boxes but WHOLE hold half of the plate."""
    whole = size == WHOLE
    return {"box.size": list(size), "box.origin": [-size[0] * 2.5 / 7, -size[1] / 2 if whole else 0, -size[2] / 2],
            "box.cells": [round(s * spacing) for s in size], "body.plate.rotation.angle": angle,
            "body.plate.surface.size": [1, 2 if whole else 1], "body.plate.center": [0, 0 if whole else 0.5, 0],
            "body.plate.surface.edge": round(1.25 / spacing, 4)}


def experiment(name):
    return np.loadtxt(CASE / "reference" / f"{name}.dat")


def measured_at(name, angle):
    table = experiment(name)
    return float(np.interp(angle, table[:, 0], table[:, 1]))


def coefficients(folder, spacing, size=BOX):
    """Mean drag and lift over the window: force of the whole plate over 1/2 rho U^2 (1 x 2 chords)."""
    table = read_table(folder / "bodies" / "plate.csv")
    late = table["time"] >= MOMENT - WINDOW
    whole = 1 if size == WHOLE else 2
    mean = {key: (1 if key == "slip" else whole) * float(np.mean(table[column][late])) for key, column in
            {"drag": "force_x", "lift": "force_z", "probe_drag": "probe_force_x", "probe_lift": "probe_force_z",
             "slip": "slip_rms"}.items()}
    # Forcing acts about 0.2 cells outside the markers, at the edges too.
    mean["area"] = (1 + 0.4 / spacing) * (2 + 0.4 / spacing) / 2
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
    lines = ["| cells a chord | box, chords | drag | lift | normal | tangential | drag / acting area | lift / acting area | minutes |",
             "|" + "---|" * 9]

    def line(spacing, box, c, minutes):
        normal, tangential = along_plate(c, angle)
        lines.append(f"| {spacing} | {box} | {c['drag']:.3f} | {c['lift']:.3f} | {normal:.3f} | {tangential:.3f} | "
                     f"{c['drag'] / c['area']:.3f} | {c['lift'] / c['area']:.3f} | {minutes} |")

    for spacing, size, c in rows:
        part = "whole plate" if size == WHOLE else "half"
        line(spacing, f"{size[0]} x {size[1]} x {size[2]}, {part}", c, f"{c['minutes']:.1f}")
    spacings = [1 / n for n, size, _ in rows if size == BOX]
    limit = {key: float(np.polyfit(spacings, [c[key] for _, size, c in rows if size == BOX], 1)[1])
             for key in ("drag", "lift")}
    line("no spacing", "straight line through the four grids", {**limit, "area": 1.0}, "")
    line("experiment", "", {"drag": measured_at("drag", angle), "lift": measured_at("lift", angle), "area": 1.0}, "")
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
    results = {a: coefficients(folder, spacing) for a, folder in folders.items()}
    text = f"{spacing} cells a chord, half the plate in a box of {BOX[0]} x {BOX[1]} x {BOX[2]} chords\n\n" + angle_table(results)

    if not arguments.quick:
        rows = []
        for n, size, kind in ((12, BOX, ""), (12, WHOLE, "-whole"), (12, WIDE, "-wide"), (16, BOX, ""), (20, BOX, ""), (24, BOX, "")):
            folder = runner.run(f"angle-30-n{n}{kind}", settings(30, n, size))
            rows.append((n, size, coefficients(folder, n, size)))
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
