#!/usr/bin/env python3
"""Draws the beating tank: speed and velocity in the plane y = 0 at four times, and the flow rates of the patches.

Usage: beating-tank.py OUTPUT-FOLDER PICTURE
"""
import csv
import glob
import os
import sys

import h5py
import matplotlib
import numpy

matplotlib.use("Agg")
import matplotlib.pyplot as plt

folder, picture = sys.argv[1:]
TIMES = [1.2, 1.5, 1.8, 2.0]

with open(os.path.join(folder, "history.csv")) as stream:
    history = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]
snapshots = []
for name in sorted(glob.glob(os.path.join(folder, "fields", "*.h5"))):
    with h5py.File(name) as file:
        snapshots.append((float(file.attrs["time"]), name))

figure = plt.figure(figsize=(11, 7.5), layout="constrained")
grid = figure.add_gridspec(3, 2, height_ratios=[1, 1, 0.5])
for n, time in enumerate(TIMES):
    name = min(snapshots, key=lambda s: abs(s[0] - time))[1]
    with h5py.File(name) as file:
        x, z = (0.5 * (file[a][1:] + file[a][:-1]) for a in "xz")
        j = file["velocity"].shape[1] // 2
        velocity = 0.5 * (file["velocity"][:, j - 1] + file["velocity"][:, j])
    axes = figure.add_subplot(grid[n // 2, n % 2])
    speed = numpy.linalg.norm(velocity, axis=-1)
    image = axes.pcolormesh(x, z, speed, shading="nearest", cmap="viridis", vmin=0, vmax=1.6)
    step = slice(1, None, 3)
    axes.quiver(x[step], z[step], velocity[step, step, 0], velocity[step, step, 2], color="white", scale=14, width=0.003)
    axes.set(title="t = {:.1f}".format(time), xlabel="x", ylabel="z", aspect="equal")
figure.colorbar(image, ax=figure.axes, label="speed", shrink=0.6)
axes = figure.add_subplot(grid[2, :])
for key in history[0]:
    if key.startswith("flow_"):
        axes.plot([row["time"] for row in history], [row[key] for row in history], label=key)
for time in TIMES:
    axes.axvline(time, color="grey", linewidth=0.5)
axes.set(xlabel="t", ylabel="flow rate into the box")
axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
figure.savefig(picture, dpi=75)
