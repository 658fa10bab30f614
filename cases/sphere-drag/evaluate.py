"""Drag, wake and separation of a run of flow past the sphere (diameter, speed and density 1, flow along z)."""
import math
from dataclasses import dataclass

import h5py
import numpy as np


@dataclass
class Result:
    drag: float  # coefficient, from the momentum balance
    probe_drag: float  # from pressure and shear at the probes
    wake: float  # length from the rear of the sphere, in diameters
    angle: float  # of separation by the flow about the sphere, degrees from the front
    shear_angle: float  # the same by the shear at the probes
    change: float  # of the drag coefficient over the last 4 d/U
    slip: float  # rms at the markers
    minutes: float


def coefficient(force):
    return 8.0 * force / math.pi


def wake_length(path, lateral_center=0.0):
    """Where w on the axis behind the sphere changes sign, by w = a + b r^2 from the cells next to the axis."""
    with h5py.File(path) as file:
        x, y, z = ([0.5 * (n[1:] + n[:-1]) for n in (file[name][:] for name in "xyz")])
        near_x = np.abs(x - lateral_center) < 2.6 * (x[1] - x[0])
        near_y = np.abs(y - lateral_center) < 2.6 * (y[1] - y[0])
        w = file["velocity"][:, :, :, 2][:, near_y][:, :, near_x]
    r2 = (x[near_x][None, :] - lateral_center) ** 2 + (y[near_y][:, None] - lateral_center) ** 2
    near = r2 < 3.0 * (x[1] - x[0]) ** 2
    fit = np.linalg.lstsq(np.stack([np.ones(near.sum()), r2[near]], 1), w[:, near].T.astype(float), rcond=None)[0]
    axis = fit[0]
    behind = [k for k in range(len(z) - 1) if z[k] > 0.55 and axis[k] < 0 <= axis[k + 1]]
    if not behind:
        return math.nan
    k = behind[0]
    return z[k] - axis[k] / (axis[k + 1] - axis[k]) * (z[k + 1] - z[k]) - 0.5


def meridional_shear(path):
    """Angle from the front, degrees, and the shear along the meridian, over rho U^2, of each face."""
    with h5py.File(path) as file:
        points = file["positions"][:][file["triangles"][:]].mean(axis=1)
        shear = file["shear"][:]
    theta = np.arccos(np.clip(-points[:, 2] / np.linalg.norm(points, axis=1), -1, 1))
    phi = np.arctan2(points[:, 1], points[:, 0])
    along = np.stack([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), np.sin(theta)], 1)
    return np.degrees(theta), np.sum(shear * along, axis=1)


def pressure_coefficient(path):
    with h5py.File(path) as file:
        return 2.0 * file["pressure"][:].ravel()


def separation_angle(path):
    """By the shear at the probes: the sign change of a cubic through the shear of the faces within 15 degrees of it."""
    theta, shear = meridional_shear(path)
    guess = 130.0
    for _ in range(6):
        near = np.abs(theta - guess) < 15
        roots = np.roots(np.polyfit(theta[near] - guess, shear[near], 3))
        real = roots[np.abs(roots.imag) < 1e-6].real
        real = real[np.abs(real) < 15]
        if not len(real):
            return math.nan
        guess += real[np.argmin(np.abs(real))]
    return guess


def cubic_weights(fraction):
    """Of the four neighbours -1, 0, 1, 2 of a point between 0 and 1."""
    f = fraction
    return (-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
            (f + 1) * f * (f - 1) / 6)


def separation_angle_of_flow(path):
    """Where the line on which the velocity along the meridian changes sign meets the sphere: found at 1, 1.5, .. 3
    cells from it, mean of 16 meridians, and continued to the surface by a parabola. Cells about the sphere are equal."""
    with h5py.File(path) as file:
        nodes = [file[name][:] for name in "xyz"]
        centers = [0.5 * (n[1:] + n[:-1]) for n in nodes]
        ranges = [slice(*np.searchsorted(c, (-0.99, 0.99))) for c in centers]
        velocity = file["velocity"][ranges[2], ranges[1], ranges[0], :].astype(float)
    first = [c[r][0] for c, r in zip(centers, ranges)]
    spacing = [np.mean(np.diff(c[r])) for c, r in zip(centers, ranges)]
    theta = np.radians(np.arange(95, 178, 0.5))[:, None]
    phi = (np.arange(16) + 0.5)[None, :] * (2 * math.pi / 16)
    radial = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), -np.cos(theta) + 0 * phi], -1)
    along = np.stack([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), np.sin(theta) + 0 * phi], -1)
    distances, angles = np.arange(1, 3.1, 0.5) * spacing[0], []
    for distance in distances:
        at = ((0.5 + distance) * radial - first) / spacing
        base = np.floor(at).astype(int)
        weights = [cubic_weights(at[..., d] - base[..., d]) for d in range(3)]
        there = sum((weights[0][a] * weights[1][b] * weights[2][c])[..., None]
                    * velocity[base[..., 2] + c - 1, base[..., 1] + b - 1, base[..., 0] + a - 1]
                    for a in range(4) for b in range(4) for c in range(4))
        speed = np.sum(there * along, axis=-1).mean(axis=1)
        changes = np.flatnonzero((speed[:-1] > 0) & (speed[1:] <= 0))
        if not len(changes):
            return math.nan
        k = changes[0]
        angles.append(np.degrees(theta[k, 0] + speed[k] / (speed[k] - speed[k + 1]) * (theta[1, 0] - theta[0, 0])))
    return np.polyfit(distances, angles, 2)[-1]


def evaluate(run):
    table = run.body("sphere")
    drag = coefficient(np.array(table["force_z"]))
    earlier = np.interp(table["time"][-1] - 4.0, table["time"], drag)
    field = run.last("fields/fields_*.h5")
    return Result(drag[-1], coefficient(table["probe_force_z"][-1]), wake_length(field),
                  separation_angle_of_flow(field), separation_angle(run.last("surfaces/sphere_*.h5")), drag[-1] - earlier, table["slip_rms"][-1],
                  run.report()["wall_seconds"] / 60)
