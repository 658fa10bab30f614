#!/usr/bin/python3
"""How stiff a network at rest in the sphere is, as a tension, against the loads of the drop in shear and against pressure: small
displacements, k_e = R = 1, energies sum k_e dl^2 / 2 and sum k_b dtheta^2 / 2, volume held. See README.md."""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common  # noqa: E402


def angle(corners):
    """Between the normals of the two faces at the edge a b, c and d across."""
    a, b, c, d = corners.reshape(4, 3)
    left, right = np.cross(b - a, c - a), np.cross(d - a, b - a)
    return np.arctan2(np.dot(np.cross(left, right), b - a) / np.linalg.norm(b - a), np.dot(left, right))


def stiffness_matrix(x, faces, bending):
    opposite = {}
    for face in faces:
        for k in range(3):
            opposite.setdefault(tuple(sorted((face[k], face[(k + 1) % 3]))), []).append(face[(k + 2) % 3])
    matrix = np.zeros((x.size, x.size))
    for (a, b), (c, d) in opposite.items():
        rows = (3 * np.array([a, b, c, d])[:, None] + np.arange(3)).ravel()
        along = (x[b] - x[a]) / np.linalg.norm(x[b] - x[a])
        stretch = np.concatenate([-along, along, np.zeros(6)])
        turn = np.array([(angle(x[[a, b, c, d]].ravel() + h) - angle(x[[a, b, c, d]].ravel() - h)) / 2e-6 for h in 1e-6 * np.eye(12)])
        matrix[np.ix_(rows, rows)] += np.outer(stretch, stretch) + bending * np.outer(turn, turn)
    return matrix


def as_tension(matrix, x, area, load):
    """Tension of the liquid sphere that would bulge alike by its surface harmonic of second order: load over 4 w."""
    shape = 1.5 * x[:, 2]**2 - 0.5
    volume = (area[:, None] * x).ravel()
    moved = np.linalg.lstsq(matrix + 40 * np.outer(volume, volume), (area[:, None] * load).ravel(), rcond=1e-9)[0].reshape(-1, 3)
    return 0.25 / ((area * shape * (moved * x).sum(axis=1)).sum() / (area * shape**2).sum())


def main():
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "sphere.obj"
        subprocess.run([common.find_binary(), "mesh", "sphere", "--frequency", "6", "--radius", "1", "-o", mesh], check=True, stdout=subprocess.DEVNULL)
        lines = [line.split() for line in mesh.read_text().splitlines()]
    x = np.array([[float(q) for q in words[1:4]] for words in lines if words[:1] == ["v"]])
    faces = np.array([[int(q) - 1 for q in words[1:4]] for words in lines if words[:1] == ["f"]])
    area = np.zeros(len(x))
    for face in faces:
        area[face] += np.linalg.norm(np.cross(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]])) / 6
    shear, pressure = x @ np.diag([-0.5, -0.5, 1.0]), (1.5 * x[:, 2]**2 - 0.5)[:, None] * x
    rows = []
    for bending in (0.32, 0.16, 0.0032):
        matrix = stiffness_matrix(x, faces, bending)
        against = [as_tension(matrix, x, area, load) for load in (shear, pressure)]
        rows.append([f"{bending:g}", *(f"{s:.3f}" for s in against), f"{against[1] / against[0]:.2f}"])
    print(common.markdown_table(["k_b / (k_e R^2)", "tension / k_e against the drag of a strain (calibration)", "against pressure", "ratio"], rows))


if __name__ == "__main__":
    main()
