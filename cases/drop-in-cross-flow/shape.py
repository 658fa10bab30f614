"""Lengths of the box around a drop, from surface files."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import bodies_in_shear as surfaces  # noqa: E402


def reach(positions, axis, sign):
    """How far the surface reaches along an axis: the top of the parabola through the vertices around the farthest one."""
    height = sign * positions[:, axis]
    first = np.argmax(height)
    distance = np.linalg.norm(positions - positions[first], axis=1)
    near = distance < 2.6 * np.sort(distance)[1:7].mean()
    a, b = np.delete(positions[near] - positions[first], axis, axis=1).T
    terms = np.column_stack([np.ones_like(a), a, b, a * a, a * b, b * b])
    c = np.linalg.lstsq(terms, height[near], rcond=None)[0]
    top = np.linalg.lstsq(np.array([[2 * c[3], c[4]], [c[4], 2 * c[5]]]), -c[1:3], rcond=None)[0]
    if np.abs(top).max() > distance[near].max():
        return height[first]
    return c @ [1, top[0], top[1], top[0]**2, top[0] * top[1], top[1]**2]


def box_around(file):
    """Time, centroid, and the lengths along x, y, z of the box around the surface."""
    time, positions, _ = surfaces.read_surface(file)
    return time, [reach(positions, d, 1) + reach(positions, d, -1) for d in range(3)]


def inverse_aspect_ratio(out, name="drop"):
    """Times and l_x / l_z."""
    found = [box_around(file) for file in sorted((out / "surfaces").glob(f"{name}_*.h5"))]
    return np.array([t for t, _ in found]), np.array([x / z for _, (x, _, z) in found]), np.array([y / z for _, (_, y, z) in found])
