#!/usr/bin/env python3
"""Draws the parts of a heart that `pliant mesh` makes, closed and open: docs/images/heart-parts.png.

    python3 docs/geometry.py [PLIANT] [PICTURE]
"""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

HERE = pathlib.Path(__file__).resolve().parent
PLIANT = sys.argv[1] if len(sys.argv) > 1 else str(HERE.parent / "build/release/pliant")
PICTURE = sys.argv[2] if len(sys.argv) > 2 else str(HERE / "images/heart-parts.png")


def read_gts(path):
    lines = path.read_text().splitlines()
    counts = [int(n) for n in lines[0].split()[:3]]
    rows = [line.split() for line in lines[1:] if not line.startswith("#")]
    vertices = np.array(rows[: counts[0]], dtype=float)
    edges = np.array(rows[counts[0] : counts[0] + counts[1]], dtype=int) - 1
    faces = []
    for a, b, c in np.array(rows[counts[0] + counts[1] :], dtype=int) - 1:
        faces.append(sorted(set(edges[a]) | set(edges[b]) | set(edges[c])))
    selections = {}
    for line in lines:
        if line.startswith("# selection "):
            words = line.split()
            selections.setdefault(words[2], []).extend(int(v) - 1 for v in words[3:])
    return vertices, np.array(faces), selections


def make(folder, name, *options):
    path = folder / "part.gts"
    command = [PLIANT, "mesh", name, *(str(o) for o in options), "-o", str(path)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return read_gts(path)


def draw(axes, parts, title, view, zoom=1.0):
    """Parts are (mesh, shift, colour, opacity)."""
    polygons, colours, corners = [], [], []
    elevation, azimuth = np.radians(view)
    light = np.array([np.cos(elevation) * np.cos(azimuth - 0.6), np.cos(elevation) * np.sin(azimuth - 0.6), np.sin(elevation) + 0.4])
    light /= np.linalg.norm(light)
    for (vertices, faces, _), shift, colour, opacity in parts:
        places = vertices + np.asarray(shift, dtype=float)
        triangles = places[faces]
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        shade = 0.55 + 0.45 * np.abs(normals @ light) / np.linalg.norm(normals, axis=1)
        rgb = np.array(matplotlib.colors.to_rgb(colour))
        polygons.extend(triangles)
        colours.extend(np.append(np.clip(s * rgb, 0, 1), opacity) for s in shade)
        corners.append(places)
    axes.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors=(0, 0, 0, 0.35), linewidths=0.15))
    corners = np.concatenate(corners)
    middle, reach = (corners.min(0) + corners.max(0)) / 2, (corners.max(0) - corners.min(0)).max() / 2 / zoom
    axes.set(xlim=(middle[0] - reach, middle[0] + reach), ylim=(middle[1] - reach, middle[1] + reach),
             zlim=(middle[2] - reach, middle[2] + reach), title=title)
    axes.set_box_aspect((1, 1, 1))
    axes.view_init(*view)
    axes.set_proj_type("ortho")
    axes.set_axis_off()


def main():
    sack, plate, wall, blue, red = "#d98880", "#b0b7bd", "#8ea6b8", "#5d8aa8", "#c0653a"
    holes = ("--holes", -0.6, 0, 0.5, "--holes", 0.65, 0, 0.35)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        ventricle = make(folder, "ventricle", "--radius", 1.32, "--height", 3.52, "--edge", 0.12)
        floor = make(folder, "plate-with-holes", "--size", 3.4, 3.4, *holes, "--edge", 0.2, "--hole-edge", 0.08)
        inlet = make(folder, "channel", "--radius", 0.5, "--height", 0.6, "--edge", 0.08)
        outlet = make(folder, "channel", "--radius", 0.35, "--height", 0.6, "--edge", 0.08)
        ring = make(folder, "channel", "--radius", 0.5, "--height", 0.12, "--edge", 0.06)
        mechanical = {a: make(folder, "valve-bileaflet", "--radius", 0.5, "--edge", 0.04, "--angle", a) for a in (25, 85)}
        natural = {o: make(folder, "natural-valve", "--radius", 0.5, "--edge", 0.04, "--opening", o) for o in (0.02, 0.2, 0.4)}

        figure = plt.figure(figsize=(13, 7))
        whole = [(floor, (0, 0, 0), plate, 0.35), (ventricle, (0, 0, 0), sack, 0.35), (inlet, (-0.6, 0, 0), wall, 0.9),
                 (outlet, (0.65, 0, 0), wall, 0.9), (natural[0.2], (-0.6, 0, 0), red, 1)]
        draw(figure.add_subplot(2, 4, 1, projection="3d"), whole, "all parts on the plate", (16, -70), 1.45)
        draw(figure.add_subplot(2, 4, 5, projection="3d"), [(floor, (0, 0, 0), plate, 1)], "plate-with-holes", (60, -90), 1.55)
        for column, angle in ((2, 25), (3, 85)):
            parts = [(mechanical[angle], (0, 0, 0), blue, 1), (ring, (0, 0, -0.06), wall, 0.25)]
            kind = "closed" if angle == 25 else "open"
            draw(figure.add_subplot(2, 4, column, projection="3d"), parts, f"valve-bileaflet, {kind} ({angle} degrees)", (24, -65), 1.6)
        draw(figure.add_subplot(2, 4, 4, projection="3d"), [(mechanical[25], (0, 0, 0), blue, 1), (ring, (0, 0, -0.06), wall, 0.25)],
             "closed, along the channel", (90, -90), 1.5)
        for column, opening in ((6, 0.02), (7, 0.4)):
            kind = "nearly closed" if opening < 0.1 else "open"
            draw(figure.add_subplot(2, 4, column, projection="3d"), [(natural[opening], (0, 0, 0), red, 1)],
                 f"natural-valve, {kind}", (-28, -35), 1.6)
        draw(figure.add_subplot(2, 4, 8, projection="3d"), [(natural[0.2], (0, 0, 0), red, 1)], "at rest (opening 0.2), from below",
             (-90, -90), 1.5)
        figure.subplots_adjust(left=0, right=1, bottom=0.01, top=0.95, wspace=0, hspace=0.08)
        figure.savefig(PICTURE, dpi=110)


if __name__ == "__main__":
    main()
