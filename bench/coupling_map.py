#!/usr/bin/python3
"""What couplings of a membrane and a flow hold, and how long a step they hold with.

A spherical membrane of R = 1 in Taylor-Green vortices of speed U = 1, in a periodic box of 5 R, Re = U R / nu = 1000.
m: mass a unit of area over rho R; E: Young's modulus times thickness over rho U^2 R. For every scheme, m and E the
largest step dt U/h is found with which the run goes to the end without a gain of energy, and for it: the energy that is
left, drift of the volume, slip, and seconds per unit of time. Results are added to a JSON file, from which --table
prints Markdown and --plot draws the figure. With --around N only two steps are tried: the one above the largest that
held with N cells a radius, and that one.

Usage: bench/coupling_map.py [--program FILE] [--cells-a-radius 8] [--end 20] [--schemes a,b] [--masses ..]
                             [--stiffnesses ..] [--steps ..] [--around 8] [--json FILE]
       bench/coupling_map.py --plot FIGURE --json FILE
       bench/coupling_map.py --table --json FILE
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
import time

STEPS = [0.5, 0.35, 0.25, 0.18, 0.13, 0.1, 0.05, 0.02, 0.01]
SCHEMES = {
    "loose": ["coupling=loose"],
    "probe-loose": ["coupling=loose", "loads=probes"],
    "strong": ["coupling=strong"],
    "force-spreading": ["coupling=force-spreading"],
    "local-mass": ["coupling=local-mass"],
}
THICKNESS = 0.01
MOST_GAIN = 0.02  # of the energy at the start: more is an instability
CASE = """title = "a membrane in vortices"
[box]
size = [5, 5, 5]
origin = [-2.5, -2.5, -2.5]
cells = [{cells}, {cells}, {cells}]
[fluid]
viscosity = 0.001
[initial]
flow = "taylor-green"
normal = "z"
[time]
end = {end}
step = {step}
[coupling]
max_iterations = 50
tolerance = 1e-3
[[body]]
name = "shell"
coupling = "auto"
center = [0.3, 0.2, 0.1]
surface = {{ shape = "sphere", frequency = {cells_a_radius}, radius = 1 }}
thickness = {thickness}
density = {density}
young = {young}
[output]
history.every = {every}
[checkpoint]
keep = 0
"""


def rows(name):
    with open(name) as stream:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]


def run(program, arguments, scheme, mass, stiffness, step):
    """One run; None if it fails or gains energy."""
    cells = 5 * arguments.cells_a_radius
    every = max(1, round(0.25 / step))
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "case.toml"), "w") as stream:
            stream.write(CASE.format(cells=cells, cells_a_radius=arguments.cells_a_radius, end=arguments.end, step=step,
                                     every=every, thickness=THICKNESS, density=mass / THICKNESS,
                                     young=stiffness / THICKNESS))
        settings = [word for key in SCHEMES[scheme] for word in ("--set", "body.shell." + key)]
        out = os.path.join(folder, "out")
        start = time.time()
        try:
            result = subprocess.run([program, "run", folder, "--out", out] + settings, capture_output=True, text=True,
                                    timeout=arguments.patience)
        except subprocess.TimeoutExpired:
            return {"failed": "patience"}
        seconds = time.time() - start
        if result.returncode != 0:
            return {"failed": result.stderr.strip()[-300:]}
        flow, body = rows(os.path.join(out, "history.csv")), rows(os.path.join(out, "bodies", "shell.csv"))
    energy = [125 * f["kinetic_energy"] + b["kinetic_energy"] + sum(v for k, v in b.items() if k.startswith("energy_"))
              for f, b in zip(flow, body)]
    largest = max(energy[i + 1] - min(energy[:i + 1]) for i in range(len(energy) - 1)) / energy[0]
    found = {"energy": energy[-1] / energy[0], "gain": largest,
             "volume": max(abs(b["volume"] / body[0]["volume"] - 1) for b in body),
             "restored": abs(body[-1].get("volume_restored", 0.0)), "slip": max(b["slip_rms"] for b in body[1:]),
             "seconds": seconds / arguments.end,
             "iterations": sum(f["coupling_iterations"] for f in flow[1:]) / max(1, len(flow) - 1)}
    if largest > MOST_GAIN:
        found["failed"] = "energy grew by {:.3g}".format(largest)
    return found


def measure(arguments):
    results = []
    if os.path.exists(arguments.json):
        with open(arguments.json) as stream:
            results = json.load(stream)
    h = 1 / arguments.cells_a_radius
    held = {(r["scheme"], r["mass"], r["stiffness"]): r["step"] for r in results if r["cells"] == arguments.around}
    for scheme in arguments.schemes.split(","):
        for mass in arguments.masses:
            for stiffness in arguments.stiffnesses:
                key = {"scheme": scheme, "mass": mass, "stiffness": stiffness, "cells": arguments.cells_a_radius,
                       "end": arguments.end}
                if any(all(r[k] == v for k, v in key.items()) for r in results):
                    continue
                steps = arguments.steps
                if arguments.around:
                    largest = held.get((scheme, mass, stiffness))
                    if largest is None:
                        print("{} m {} E {}: no step is known with {} cells a radius; left out".format(
                            scheme, mass, stiffness, arguments.around), flush=True)
                        continue
                    steps = [number for number in STEPS if number >= largest][-2:]
                tried = []
                for number in steps:
                    found = run(arguments.program, arguments, scheme, mass, stiffness, number * h)
                    tried.append("{} {}".format(number, found.get("failed", "holds")))
                    if "failed" not in found:
                        break
                holds = "failed" not in found
                results.append(dict(key, step=number if holds else None, tried=tried, **(found if holds else {})))
                print(json.dumps(results[-1]), flush=True)
                with open(arguments.json, "w") as stream:
                    json.dump(results, stream, indent=1)


def table(arguments):
    """Markdown of all results: largest step, energy left, volume given back or lost, slip, seconds a unit of time."""
    with open(arguments.json) as stream:
        results = json.load(stream)
    print("| scheme | R/h | m | E | largest dt U/h | energy left | volume | slip | s a unit of time | iterations |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for r in results:
        head = "| {} | {} | {:g} | {:g} |".format(r["scheme"], r["cells"], r["mass"], r["stiffness"])
        if r["step"] is None:
            print(head + " none | | | | | |")
        else:
            print(head + " {:g} | {:.2f} | {:.1e} | {:.3f} | {:.2g} | {} |".format(
                r["step"], r["energy"], max(r["volume"], r["restored"]), r["slip"], r["seconds"],
                "{:.1f}".format(r["iterations"]) if r["iterations"] else ""))


def plot(arguments):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    with open(arguments.json) as stream:
        results = json.load(stream)
    masses = sorted({r["mass"] for r in results}, reverse=True)
    stiffnesses = sorted({r["stiffness"] for r in results})
    schemes = [s for s in SCHEMES if any(r["scheme"] == s for r in results)]
    figure, axes = plt.subplots(1, len(schemes), figsize=(2.6 * len(schemes), 3.1), sharey=True)
    for ax, scheme in zip(axes, schemes):
        ax.set_title(scheme, fontsize=10)
        for i, stiffness in enumerate(stiffnesses):
            for j, mass in enumerate(masses):
                of = {r["cells"]: r["step"] for r in results
                      if r["scheme"] == scheme and r["mass"] == mass and r["stiffness"] == stiffness}
                if not of:
                    continue
                step = of.get(8) if 8 in of else next(iter(of.values()))
                shade = 0 if not step else 1 - sum(number > step for number in STEPS) / len(STEPS)
                ax.add_patch(plt.Rectangle((i, j), 1, 1, color=plt.cm.YlGn(0.75 * shade) if step else "#d9a0a0"))
                text = "/".join("-" if of[c] is None else "{:g}".format(of[c]) for c in sorted(of))
                ax.text(i + 0.5, j + 0.5, text, ha="center", va="center", fontsize=8)
        ax.set_xlim(0, len(stiffnesses))
        ax.set_ylim(len(masses), 0)
        ax.set_xticks([i + 0.5 for i in range(len(stiffnesses))], ["{:g}".format(s) for s in stiffnesses])
        ax.set_yticks([j + 0.5 for j in range(len(masses))], ["{:g}".format(m) for m in masses])
        ax.set_xlabel("E")
    axes[0].set_ylabel("m")
    figure.suptitle("largest dt U/h that holds, R = 8 / 16 cells", fontsize=10)
    figure.tight_layout()
    figure.savefig(arguments.plot, dpi=110)


def main():
    here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(here, "build", "release", "pliant"))
    parser.add_argument("--cells-a-radius", type=int, default=8)
    parser.add_argument("--end", type=float, default=20)
    parser.add_argument("--schemes", default=",".join(SCHEMES))
    parser.add_argument("--masses", type=float, nargs="+", default=[1, 0.1, 0.03, 0.003])
    parser.add_argument("--stiffnesses", type=float, nargs="+", default=[1, 30, 750])
    parser.add_argument("--steps", type=float, nargs="+", default=STEPS, help="dt U/h to try, the largest first")
    parser.add_argument("--around", type=int, help="cells a radius with which the largest step is known")
    parser.add_argument("--patience", type=float, default=600, help="seconds for one run")
    parser.add_argument("--json", default="coupling-map.json")
    parser.add_argument("--plot", metavar="FIGURE")
    parser.add_argument("--table", action="store_true")
    arguments = parser.parse_args()
    if arguments.table:
        table(arguments)
    elif arguments.plot:
        plot(arguments)
    else:
        measure(arguments)


if __name__ == "__main__":
    sys.exit(main())
