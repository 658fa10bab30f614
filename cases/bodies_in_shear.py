"""What the cases of deformable bodies in shear flow share: boxes, and shapes from surface files."""
import numpy as np

import common


def box(length, cells_per_radius, rate=1.0):
    """Settings of a cubic box of `length` radii with plane Couette flow along x, gradient along z."""
    n = round(length * cells_per_radius)
    half = length / 2
    return {"box.size": [length] * 3, "box.origin": [-half] * 3, "box.cells": [n] * 3,
            "boundary.z-.velocity": [-rate * half, 0, 0], "boundary.z+.velocity": [rate * half, 0, 0]}


def extreme_radius(positions, radii, sign):
    """Largest (sign 1) or least (-1) distance from the centre on the surface through the vertices: the top of the parabola
    fitted to those around the extreme one."""
    first = np.argmax(sign * radii)
    axis = positions[first] / radii[first]
    spacing = np.sort(np.linalg.norm(positions - positions[first], axis=1))[1:7].mean()
    near = np.linalg.norm(positions - positions[first], axis=1) < 2.6 * spacing
    across = np.linalg.svd(axis[None, :])[2][1:]
    a, b = (positions[near] @ across.T / radii[first]).T
    terms = np.column_stack([np.ones_like(a), a, b, a * a, a * b, b * b])
    c = np.linalg.lstsq(terms, radii[near], rcond=None)[0]
    top = np.linalg.lstsq(np.array([[2 * c[3], c[4]], [c[4], 2 * c[5]]]), -c[1:3], rcond=None)[0]
    if np.abs(top).max() > 2 * spacing:
        return radii[first]
    return c @ [1, top[0], top[1], top[0]**2, top[0] * top[1], top[1]**2]


def centroid(positions, faces):
    a, b, c = (positions[faces[:, k]] for k in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    return ((a + b + c) * volumes[:, None]).sum(axis=0) / (4 * volumes.sum())


def read_surface(file):
    """Time, positions about the centroid, faces."""
    import h5py

    with h5py.File(file) as data:
        positions, faces, time = data["positions"][:], data["triangles"][:], float(data.attrs["time"])
    return time, positions - centroid(positions, faces), faces


def radii(file):
    """Time, largest and least distance of the surface from its centroid."""
    time, positions, _ = read_surface(file)
    r = np.linalg.norm(positions, axis=1)
    return time, extreme_radius(positions, r, 1), extreme_radius(positions, r, -1)


def taylor_history(out, name):
    """Times, and D = (L - B)/(L + B) with L and B the largest and the least radius."""
    rows = np.array([radii(file) for file in sorted((out / "surfaces").glob(f"{name}_*.h5"))])
    return rows[:, 0], (rows[:, 1] - rows[:, 2]) / (rows[:, 1] + rows[:, 2])


def mean_hinge(file):
    """Root of the mean square angle between neighbouring faces, degrees: grows where a surface wrinkles."""
    _, x, faces = read_surface(file)
    normals = np.cross(x[faces[:, 1]] - x[faces[:, 0]], x[faces[:, 2]] - x[faces[:, 0]])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    sides = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    order = np.lexsort(sides.T)
    pairs = (order % len(faces)).reshape(-1, 2)  # a closed surface: every edge comes twice
    cosine = np.clip((normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1), -1, 1)
    return np.degrees(np.sqrt((np.arccos(cosine)**2).mean()))


def hinge_growth(out, name):
    """Mean hinge at the end over that at the start."""
    files = sorted((out / "surfaces").glob(f"{name}_*.h5"))
    return mean_hinge(files[-1]) / mean_hinge(files[0])


class Steady:
    """The end of a run: D by radii and by moments, angle, and how much D still changes."""

    def __init__(self, out, name, last=1.0):
        table = common.read_table(out / "bodies" / f"{name}.csv")
        self.report = common.report(out)
        self.time, self.taylor = taylor_history(out, name)
        window = self.time > self.time[-1] - last - 1e-9
        self.d = self.taylor[window].mean()
        self.change = abs(self.taylor[window][-1] / self.taylor[window][0] - 1) if self.d else 0.0
        moments = (table["L"] - table["B"]) / (table["L"] + table["B"])
        rows = table["time"] > table["time"][-1] - last - 1e-9
        self.by_moments, self.angle = moments[rows].mean(), table["angle"][rows].mean()
        self.history = table["time"], moments
        self.hinges = hinge_growth(out, name)
        self.minutes, self.steps = self.report["wall_seconds"] / 60, self.report["steps"]


def limit(inverse_cubes, values):
    """Value at 1/L^3 = 0 of the straight line through the values by least squares, and its slope over that value."""
    slope, value = np.polyfit(inverse_cubes, values, 1)
    return value, slope / value
