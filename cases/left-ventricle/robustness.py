#!/usr/bin/python3
"""What the ventricle has to survive, on a tiny grid: a restart in mid-systole on the same and on another number of ranks, a
sack pumped far below its volume at rest, a sack of the user's own from a raw scan, and geometry that does not fit. Minutes.
See README.md."""
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

TINY = {"box.cells": [48, 48, 48], "fluid.viscosity": 0.002, "time.step": 0.004, "body.sack.surface.edge": 0.11,
        "body.plate.surface.edge": 0.1, "body.plate.surface.hole_edge": 0.1, "body.mitral-channel.surface.edge": 0.1,
        "body.aortic-channel.surface.edge": 0.1, "body.aortic-valve.surface.edge": 0.1, "output.fields.vorticity": False,
        "output.fields.phases": [0.9], "output.surfaces.phases": [0, 0.9]}
LEAFLETS = {"body.leaflet-right.surface.edge": 0.08, "body.leaflet-left.surface.edge": 0.08}
# The beat begins with systole, and twice the stroke is asked for: from 140 mL at rest down to 56.
EMPTYING = {"signals.beat.formula": "phase < 0.4 ? -sin(pi*phase/0.4)^2 : phase < 0.45 ? 0 : phase < 0.95 ? "
                                    "sin(pi*(phase-0.45)/0.5)^2 : 0",
            "cavity.ventricle.ejection_fraction": 0.6, "body.aortic-valve.schedule.phase": [0.42, 1.0]}
BAD = {"a leaflet that does not fit its channel": {"body.leaflet-right.surface.radius": 0.56},
       "a channel that goes through the plate beside its hole": {"body.mitral-channel.center": [0.7, 0, -0.2]},
       "a sack that the plate does not hold": {"body.sack.center": [0, 0, 0.3]}}


def simulate(arguments, name, settings, ranks=1, restart=None, steps=None, keep=1):
    out = arguments.out / name
    line = [str(arguments.binary), "run", str(CASE / "mechanical"), "--out", str(out), "--quiet"]
    settings = {**TINY, **LEAFLETS, **settings, "checkpoint.keep": keep}
    if "body.sack.surface" in settings:  # a whole table takes the place of the shape's keys
        del settings["body.sack.surface.edge"]
    line += [part for key, value in settings.items() for part in ("--set", f"{key}={common.toml_value(value)}")]
    line += ["--max-steps", str(steps)] if steps else []
    line += ["--restart", str(restart)] if restart else []
    line = (["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []) + line
    with open(out.with_name(name + ".log"), "w") as log:
        code = subprocess.run(line, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode
    if code != 0:
        raise common.RunFailed(f"{name} ended with code {code}:\n{out.with_name(name + '.log').read_text()[-1500:]}")
    return out


def scan(arguments):
    """A sack as a scanner may leave it: triangles by themselves (STL), bent, flattened and rough, with a hole and with faces
    turned the wrong way. Its rim lies in z = 0, within a per cent of the radius of a circle."""
    shape, raw = arguments.out / "shape.obj", arguments.out / "scan.stl"
    subprocess.run([arguments.binary, "mesh", "ventricle", "--radius", "1.17", "--height", "3.13", "--edge", "0.16", "-o", shape],
                   check=True, stdout=subprocess.DEVNULL)
    lines = [line.split() for line in shape.read_text().splitlines()]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=float)
    faces = np.array([[word.split("/")[0] for word in line[1:4]] for line in lines if line[:1] == ["f"]], dtype=int) - 1
    chance = np.random.default_rng(1)
    depth = -vertices[:, 2] / 3.13
    vertices[:, 0] += 0.35 * depth**2
    vertices[:, 1] *= 1 - 0.15 * depth
    inner = vertices[:, 2] < -0.05
    vertices[inner] += chance.normal(0, 0.012, (inner.sum(), 3))
    faces = np.delete(faces, [100, 101], axis=0)
    faces[::37] = faces[::37, ::-1]
    corners = ("".join(f"vertex {x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in vertices[face]) for face in faces)
    facets = "".join(f"facet normal 0 0 0\nouter loop\n{text}endloop\nendfacet\n" for text in corners)
    raw.write_text(f"solid scan\n{facets}endsolid scan\n")
    return raw


def own_sack(arguments, bounds):
    """Mended and remeshed, the scan takes the place of the sack for an E wave."""
    mesh = arguments.out / "sack.gts"
    line = [arguments.binary, "mesh", "remesh", scan(arguments), mesh, "--edge", "0.11", "--fill-holes", "1"]
    print(subprocess.run(line, check=True, capture_output=True, text=True).stdout)
    out = simulate(arguments, "own-sack", {"body.sack.surface": {"file": str(mesh.resolve()), "open": True}, "time.end": 8.64})
    table = common.read_table(out / "cavities" / "ventricle.csv")
    wanted = np.trapz(table["flow"], table["time"])
    bounds.within("a sack of the user's own, remeshed from a raw scan: volume gained in an E wave over what the piston gave",
                  (table["volume"][-1] - table["volume"][0]) / wanted, 0.98, 1.02)


def difference(one, other, first):
    """Largest difference of the volume, over its range, from a time on."""
    a, b = (common.read_table(out / "cavities" / "ventricle.csv") for out in (one, other))
    a, b = ({t: v for t, v in zip(c["time"], c["volume"]) if t > first} for c in (a, b))
    shared = sorted(set(a) & set(b))
    if not shared:
        raise common.RunFailed("the runs have no times in common")
    gaps = np.array([a[t] - b[t] for t in shared])
    return np.abs(gaps).max() / 3.84


def main():
    arguments = common.read_arguments(__doc__, "left-ventricle-robustness", quick="the same")
    if os.geteuid() == 0:
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
    bounds = common.Bounds()
    before, after = 5200, 5400  # of 7200 steps a cycle: systole lasts from 4464 to 7056
    whole = simulate(arguments, "whole", {}, steps=after)
    simulate(arguments, "half", {}, steps=before)
    checkpoint = common.Run(CASE, arguments.out / "half", {}).last("checkpoints/*.checkpoint")
    for name, ranks, bound in (("again", 1, 0), ("on-2-ranks", 2, 1e-6)):
        out = simulate(arguments, name, {}, ranks, checkpoint, after)
        bounds.at_most(f"volume after a restart in mid-systole, {ranks} rank{'s' * (ranks > 1)}, over the stroke, off by",
                       difference(whole, out, before * TINY["time.step"]), bound)
    emptied = simulate(arguments, "emptied", EMPTYING, steps=7200)
    volume = common.read_table(emptied / "cavities" / "ventricle.csv")["volume"]
    bounds.within("least volume of a sack that is pumped to 0.4 of its rest, over that", volume.min() / volume[0], 0.38, 0.42)
    bounds.within("its volume at the end of the cycle, over that at rest", volume[-1] / volume[0], 0.97, 1.03)
    own_sack(arguments, bounds)
    for what, settings in BAD.items():
        line = [str(arguments.binary), "check", str(CASE / "mechanical")]
        line += [part for key, value in {**TINY, **LEAFLETS, **settings}.items()
                 for part in ("--set", f"{key}={common.toml_value(value)}")]
        refused = subprocess.run(line, capture_output=True, text=True, cwd=arguments.out)
        words = (refused.stdout + refused.stderr).strip().splitlines()
        print(what + ":", words[0] if words else "", sep="\n  ")
        bounds.add(what, f"exit {refused.returncode}", "refused, exit 2", refused.returncode == 2)
    print("\n" + bounds.markdown())
    return 0 if bounds.passes else 1


if __name__ == "__main__":
    sys.exit(main())
