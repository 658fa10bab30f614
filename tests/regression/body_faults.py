#!/usr/bin/env python3
"""Runs whose bodies fail end together on all ranks, say which body, when and why, and leave their last state.

Usage: body_faults.py PROGRAM MPIRUN [MPIRUN-OPTION]...
"""
import json
import os
import re
import sys

from harness import Harness, expect, write

harness = Harness(sys.argv[1], sys.argv[2:])

# A closed box of edge 4 about the origin; a case is this and some of what follows.
BOX = """
[box]
size = [4, 4, 4]
origin = [-2, -2, -2]
cells = [10, 10, 10]
[fluid]
viscosity = 0.05
[boundary]
z = "wall"
[time]
end = 20
step = 0.02
[output]
history.every = 1
"""
GRAVITY = "[forcing]\ngravity = [0, 0, -1]\n"


def ball(keys, name="ball", radius=0.5):
    return '[[body]]\nname = "{}"\nsurface = {{ shape = "sphere", radius = {}, frequency = 2 }}\n{}\n'.format(
        name, radius, keys)


def snapshots(out, folder, name):
    return sorted(f for f in os.listdir(os.path.join(out, folder)) if re.fullmatch(name + r"_\d+\.h5", f))


def fails(name, text, patterns, ranks):
    def test(folder):
        write(folder, "case.toml", text)
        out = os.path.join(folder, "out")
        result = harness.refuses(["run", folder, "--out", out], patterns + [r"step \d+ \(t = "], code=3, ranks=ranks,
                                 timeout=100)
        # The same failure is told once, not by every rank.
        expect(len(re.findall(patterns[0], result.stderr)) == 1, "the message comes more than once", result)
        step = int(re.search(r"step (\d+)", result.stderr).group(1))
        for name in ["fields"] + re.findall(r'^name = "(.*)"', text, re.MULTILINE):
            files = snapshots(out, "fields" if name == "fields" else "surfaces", name)
            expect(files and files[-1] == "{}_{:06d}.h5".format(name, step), "no last state of " + name, result)
        with open(os.path.join(out, "run.json")) as stream:
            expect(json.load(stream)["status"].startswith("failed: step"), "run.json does not tell the failure", result)
        expect(os.listdir(os.path.join(out, "checkpoints")), "no checkpoint is left", result)
        # What is left is good to go on with.
        again = harness.run("run", folder, "--out", out, "--restart", "--max-steps", "1", ranks=ranks)
        expect(again.returncode in (0, 3), "the checkpoint cannot be continued", again)
    harness.check("{}, {} rank{}".format(name, ranks, "" if ranks == 1 else "s"), test)


def refused(name, text, patterns, ranks):
    def test(folder):
        write(folder, "case.toml", text)
        out = os.path.join(folder, "out")
        harness.refuses(["run", folder, "--out", out], patterns, ranks=ranks)
        expect(not os.path.exists(out), "an output folder was made for a case that is wrong")
    harness.check("{}, {} rank{}".format(name, ranks, "" if ranks == 1 else "s"), test)


# A light, stiff shell in vortices, which vibrates tens of times in a step of the flow.
SHELL = """
[box]
size = [4, 4, 4]
origin = [-2, -2, -2]
cells = [16, 16, 16]
[fluid]
viscosity = 0.001
[initial]
flow = "taylor-green"
normal = "z"
[time]
end = 1.2
step = {}
[[body]]
name = "shell"
coupling = "local-mass"
center = [0.3, 0.2, 0.1]
surface = {{ shape = "sphere", frequency = 4, radius = 1 }}
thickness = 0.01
density = 0.3
young = 75000
"""


def holds(folder):
    for step in (0.1, 0.04, 0.01):
        write(folder, "case.toml", SHELL.format(step))
        result = harness.run("run", folder, "--out", os.path.join(folder, f"out-{step}"), timeout=100)
        expect(result.returncode == 0, f"the run with the step {step} ends otherwise", result)


harness.check("a light, stiff wall holds with any step of the flow", holds)

for ranks in (1, 3):
    fails("body through a wall", BOX + ball('motion = "prescribed"\npath.z = "2*t"'),
          [r"body 'ball' has left the box: its vertex \d+ is at \(.*, .*, 2\.\d+\).*repulsion"], ranks)
    fails("heavy ball through the floor",
          BOX + GRAVITY + ball('motion = "rigid"\ndensity = 8') + ball('motion = "fixed"\ncenter = [1.2, 1.2, 1.2]', "rock"),
          [r"body 'ball' has left the box.*wall"], ranks)
    fails("probe through a wall",
          BOX + GRAVITY + ball('motion = "rigid"\ndensity = 8\nloads = "probes"\ntraction.probe_length = 0.5'),
          [r"body 'ball' has come too close to a side.*probe .*momentum-balance"], ranks)
    fails("vertices of a drop through a wall",
          BOX + ball('coupling = "one-way"\nmass_per_vertex = 0.05\ntraction = { form = "drag", coefficient = 1 }\n'
                     'potentials.edge = { stiffness = 10, rest_length = 6 }'),
          [r"body 'ball'.*outside the box"], ranks)
    fails("flow that is no number",
          BOX.replace("step = 0.02", "step = 0.9").replace("0.05", "0.001") + ball('motion = "rigid"\ndensity = 3')
          + '[initial]\nflow = "perturbed"\namplitude = 8\n',
          [r"the flow is not finite|body 'ball'"], ranks)
    fails("light ball, loosely coupled",
          BOX + GRAVITY + ball('motion = "rigid"\ndensity = 0.1\ncoupling = "loose"'),
          [r"body 'ball'.*coupling = \"strong\""], ranks)
    fails("too few iterations",
          BOX + GRAVITY + "[coupling]\nmax_iterations = 2\n" + ball('motion = "rigid"\ndensity = 0.1')
          + ball('motion = "rigid"\ndensity = 3\ncenter = [1.3, 1.3, 1.3]', "heavy"),
          [r"body 'ball': strong coupling did not converge in 2 iterations.*coupling\.max_iterations"], ranks)
    refused("balls that overlap", BOX + ball('motion = "rigid"') + ball('motion = "fixed"\ncenter = [0.9, 0, 0]', "rock"),
            [r"case\.toml:\d+: body\.ball and .*case\.toml:\d+: body\.rock overlap"], ranks)
    refused("too few markers for the grid",
            BOX.replace("cells = [10, 10, 10]", "cells = [40, 40, 40]")
            + ball('motion = "fixed"\nmarker_refinement = 1', radius=1.5),
            [r"body\.ball.*too few markers.*marker_refinement"], ranks)
    refused("box too thin for markers",
            BOX.replace("cells = [10, 10, 10]", "cells = [10, 2, 10]").replace("[time]", 'y = "wall"\n[time]')
            + ball('motion = "fixed"'), [r"box\.cells: 2 cells along y .*too few for markers"], ranks)

sys.exit(harness.report())
