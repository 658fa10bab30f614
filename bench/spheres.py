#!/usr/bin/python3
"""What bodies cost: runs a channel with and without spheres, in turn, and compares the time of a step.

    bench/spheres.py [--rounds 5] [--steps 10] [--cells 256x256x192] [--spheres 200] [--frequency 8] [--motion rigid]
                     [--viscous explicit implicit] [--ranks 1]

The spheres have 20 frequency^2 faces with edges of about one cell, a marker each. Set-up, output and the rows of the
history are left out. Two ratios: of a step of the one run to a step of the other, and of a step with bodies to what
the flow alone takes in the same run, which a busy machine disturbs less.
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

CASE = """
title = "What {spheres} spheres cost"

[box]
size  = {size}
cells = {cells}

[fluid]
density   = 1.0
viscosity = 5e-4

[boundary]
x = "periodic"
y = "periodic"
z = "wall"

[initial]
flow     = "uniform"
velocity = [1, 0, 0]

[time]
end       = 1e6
max_steps = {steps}
step      = 2e-3
viscous   = "{viscous}"

[checkpoint]
keep = 0

[output]
history = {{ every = 1000 }}
"""
BODIES = """
[[body]]
name     = "spheres"
surface  = {{ shape = "sphere", frequency = {frequency}, diameter = {diameter} }}
count    = {spheres}
gap      = 0.02
motion   = "{motion}"
coupling = "loose"
{density}
"""


def make_case(folder, options, viscous, spheres):
    cells = [int(n) for n in options.cells.split("x")]
    text = CASE.format(cells=cells, size=[0.01 * n for n in cells], viscous=viscous, steps=options.steps, spheres=spheres)
    if spheres:
        # 20 f^2 triangles with edges of one cell cover the sphere.
        diameter = 0.01 * (20 * options.frequency**2 * 3**0.5 / 4 / 3.141592653589793) ** 0.5
        text += BODIES.format(frequency=options.frequency, diameter=diameter, spheres=spheres, motion=options.motion,
                              density="density  = 2.0" if options.motion == "rigid" else "")
    case = folder / "case.toml"
    case.write_text(text)
    return case


def run(options, viscous, spheres):
    """The report of a run."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        case = make_case(folder, options, viscous, spheres)
        command = [options.binary, "run", str(case), "--quiet", "--out", str(folder / "out")]
        if options.ranks > 1:
            command = ["mpirun", "--oversubscribe", "-n", str(options.ranks), *command]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} failed with code {done.returncode}:\n{done.stdout}{done.stderr}")
        return json.loads((folder / "out" / "run.json").read_text())


def costs(report):
    """Seconds a step, by part."""
    phases, steps = report["seconds_by_phase"], report["steps"]
    forcing = phases.get("bodies: forcing, within fluid", 0.0)
    seconds = {"flow": phases["fluid"] - forcing, "markers": phases.get("bodies: markers", 0.0), "forcing": forcing,
               "rest": phases.get("bodies: loads", 0.0) + phases.get("bodies: motion", 0.0)}
    return {part: value / steps for part, value in seconds.items()}


def spread(values, digits=2):
    return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f}-{max(values):.{digits}f})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="build/release/pliant")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--steps", type=int, default=10)
    parser.add_argument("--cells", default="256x256x192")
    parser.add_argument("--spheres", type=int, default=200)
    parser.add_argument("--frequency", type=int, default=8)
    parser.add_argument("--motion", choices=("rigid", "fixed"), default="rigid")
    parser.add_argument("--viscous", nargs="+", choices=("explicit", "implicit-z", "implicit"), default=["explicit"])
    parser.add_argument("--ranks", type=int, default=1)
    options = parser.parse_args()
    if os.geteuid() == 0:
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")

    print("| viscous terms | without, s a step | with, s a step | with over without | with over its own flow | "
          "markers | forcing | loads, motion | ns a marker and step |")
    print("|---" * 9 + "|")
    for viscous in options.viscous:
        rounds = [(costs(run(options, viscous, 0)), costs(run(options, viscous, options.spheres)))
                  for _ in range(options.rounds)]
        alone = [without["flow"] for without, _ in rounds]
        parts = [with_bodies for _, with_bodies in rounds]
        steps = [sum(p.values()) for p in parts]
        bodies = [sum(p.values()) - p["flow"] for p in parts]
        n_markers = options.spheres * 20 * options.frequency**2
        print(f"| {viscous} | {spread(alone, 3)} | {spread(steps, 3)} | "
              f"{spread([s / a for s, a in zip(steps, alone)])} | "
              f"{spread([s / p['flow'] for s, p in zip(steps, parts)])} | "
              + " | ".join(f"{spread([p[part] for p in parts], 3)}" for part in ("markers", "forcing", "rest"))
              + f" | {spread([1e9 * b / n_markers for b in bodies], 0)} |")


if __name__ == "__main__":
    main()
