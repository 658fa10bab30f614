#!/usr/bin/env python3
"""The program refuses wrong input with exit code 2 and a message that names the file and the key or line.

Usage: bad_input.py PROGRAM MPIRUN [MPIRUN-OPTION]...
"""
import os
import re
import sys

import surfaces
from harness import BODY, CASE, Harness, expect, write

harness = Harness(sys.argv[1], sys.argv[2:])


def bad_case(name, text, patterns, command="check", ranks=1, arguments=()):
    def test(folder):
        write(folder, "case.toml", text)
        write(folder, "drop.gts", surfaces.sound())
        out = os.path.join(folder, "out")
        options = list(arguments) + (["--out", out] if command == "run" else [])
        words = [command] if isinstance(command, str) else command
        harness.refuses(words + [folder] + options, patterns, ranks=ranks, cwd=folder)
        expect(not os.path.exists(out), "an output folder was made for a case that is wrong")
    harness.check(name, test)


def bad_surface(name, text, patterns, command="check"):
    def test(folder):
        write(folder, "case.toml", CASE + BODY)
        if text is not None:
            write(folder, "drop.gts", text)
        options = ["--out", os.path.join(folder, "out")] if command == "run" else []
        harness.refuses([command, folder] + options, patterns, cwd=folder)
    harness.check(name, test)


def bad_command(name, arguments, patterns):
    harness.check(name, lambda folder: harness.refuses(arguments, patterns) and None)


def sound_case(folder):
    write(folder, "case.toml", CASE + BODY)
    write(folder, "drop.gts", surfaces.sound())
    result = harness.run("check", folder)
    expect(result.returncode == 0, "the sound case is refused", result)
    again = os.path.join(folder, "resolved.toml")
    write(folder, "resolved.toml", result.stdout)
    second = harness.run("check", again)
    expect(second.returncode == 0 and second.stdout == result.stdout, "the resolved case reads differently", second)
    run = harness.run("run", folder, "--out", os.path.join(folder, "out"), "--max-steps", "2")
    expect(run.returncode == 0, "the sound case does not run", run)


harness.check("sound case", sound_case)

# The command line
bad_command("no subcommand", [], ["subcommand"])
bad_command("unknown subcommand", ["rum"], ["rum|subcommand"])
bad_command("unknown option", ["check", "x", "--fast"], ["--fast"])
bad_command("missing case", ["run"], ["CASE"])
bad_command("missing file", ["check", "/nonexistent/case.toml"], [r"/nonexistent/case\.toml.*cannot be opened"])
bad_command("missing folder", ["run", "/nonexistent"], ["/nonexistent"])
bad_command("missing mesh", ["mesh", "info", "/nonexistent/a.gts"], [r"/nonexistent/a\.gts"])
bad_command("mesh of frequency 0", ["mesh", "sphere", "--frequency", "0", "-o", "/tmp/never.gts"], ["frequency"])

# The case file
bad_case("misspelt key", CASE.replace("cells", "cell"), [r"case\.toml:5: unknown key box\.cell\b.*box\.cells"])
bad_case("unknown section", CASE + "[fluit]\nviscosity = 1\n", [r"case\.toml:\d+: unknown key fluit.*fluid"])
bad_case("wrong type", CASE + "[fluid]\nviscosity = \"thin\"\n", [r"case\.toml:14: fluid\.viscosity must be a number"])
bad_case("negative size", CASE.replace("size = [4, 4, 4]", "size = [4, -4, 4]"),
         [r"case\.toml:3: box\.size component y must be > 0"])
bad_case("two problems at once", CASE.replace("size = [4, 4, 4]", "size = [4, -4, 4]") + "[fluid]\ndensity = 0\n",
         [r"box\.size", r"fluid\.density", "2 problems"],
         command="run")
bad_case("unknown boundary type", CASE.replace('z = "wall"', 'z = "inlet"'), [r'unknown type "inlet"; known: "periodic"'])
bad_case("inflow without a way out", CASE.replace('z = "wall"', '"z-" = { type = "inflow", velocity = [0, 0, 1] }\n"z+" = "wall"'),
         [r"boundary\.z-\.type.*nothing lets the fluid out"])
bad_case("half periodic", CASE.replace('z = "wall"', '"z-" = "wall"'), [r"case\.toml:7: boundary\.z-"])
bad_case("not TOML", CASE.replace("[box]", "[box"), [r"case\.toml:2: not valid TOML"])
bad_case("empty file", "", [r"case\.toml: is empty"])
bad_case("binary garbage", bytes(range(256)) * 8, [r"case\.toml:\d+: not valid TOML"])
bad_case("wrong override", CASE, ["--set fluid.viscosity=-1"], arguments=["--set", "fluid.viscosity=-1"])
bad_case("sphere outside the box", CASE + BODY.replace('file = "drop.gts"', 'shape = "sphere", radius = 2.5'),
         [r"case\.toml:14: body\.drop .* outside the box"])
bad_case("probes outside the box",
         CASE + BODY.replace('{ form = "drag" }', '{ form = "one-sided", probe_length = 4 }'),
         [r"body\.drop is too close to a side of z.*probe_length"])
bad_case("more cells than memory", CASE, [r"box\.cells 9000 x 9000 x 9000 needs at least .* GB"], command="run",
         arguments=["--set", "box.cells=[9000,9000,9000]"])
bad_case("more cells than memory, 2 ranks", CASE, [r"box\.cells .* needs at least"], command="run", ranks=2,
         arguments=["--set", "box.cells=[9000,9000,9000]"])
bad_case("surface file outside the box", CASE + BODY + "", [r"body\.drop .* outside the box"],
         arguments=["--set", "body.drop.center=[0,0,1.5]"])
bad_case("more ranks than planes", CASE.replace("cells = [8, 8, 8]", "cells = [8, 8, 2]"),
         [r"case\.toml:5: box\.cells has 2 planes.* 3 ranks"], command="run", ranks=3)

# Shapes, places and copies
SPHERE = BODY.replace('file = "drop.gts"', 'shape = "sphere", radius = 0.5')


def bad_body(name, text, patterns, command="check", ranks=1, places=None):
    """A case with one body `drop`, whose keys `text` follow a sphere of radius 0.5."""
    def test(folder):
        write(folder, "case.toml", CASE + SPHERE.replace("[body.potentials]", text + "\n[body.potentials]"))
        if places is not None:
            write(folder, "places.csv", places)
        out = os.path.join(folder, "out")
        harness.refuses([command, folder] + (["--out", out] if command == "run" else []), patterns, ranks=ranks,
                        cwd=folder)
        expect(not os.path.exists(out), "an output folder was made for a case that is wrong")
    harness.check(name, test)


bad_case("unknown shape", CASE + SPHERE.replace("sphere", "cube"), [r'surface\.shape .*"cube"; known: "sphere".*"box"'])
bad_case("size of another shape", CASE + SPHERE.replace("radius = 0.5", "radius = 0.5, height = 2"),
         [r'surface\.height has no effect.*"cylinder"'])
bad_case("plate with three sizes", CASE + SPHERE.replace('"sphere", radius = 0.5', '"plate", size = [1, 1, 1]'),
         [r"surface\.size must be an array of 2 numbers"])
bad_case("too many faces", CASE + SPHERE.replace('"sphere", radius = 0.5', '"disc", radius = 0.5, edge = 1e-5'),
         [r"body\.drop\.surface: disc: edge = 1e-05 makes about .* faces"])
bad_case("volume of an open surface",
         CASE + SPHERE.replace('"sphere", radius = 0.5', '"disc"') + "volume = { stiffness = 1 }\n",
         [r"body\.drop\.potentials\.volume .*open"])
bad_body("axis of length 0", "rotation = { axis = [0, 0, 0], angle = 3 }", [r"rotation\.axis must not be 0"])
bad_case("turned out of the box",
         CASE + SPHERE.replace('"sphere", radius = 0.5', '"ellipsoid", semi_axes = [2.5, 0.5, 0.5]').replace(
             "[body.potentials]", "rotation = { axis = [0, 1, 0], angle = 60 }\n[body.potentials]"),
         [r"body\.drop reaches .* along z, outside the box"])
bad_body("count and positions", 'count = 3\npositions = "places.csv"', [r"count .*exclude each other"], places="0,0,0\n")
bad_body("center of copies", "count = 3\ncenter = [1, 1, 1]", [r"center has no effect.*neither count nor positions"])
bad_body("gap of a single body", "gap = 0.1", [r"gap has no effect.*count is given"])
bad_body("count of 0", "count = 0", [r"count must be >= 1"])
bad_body("region upside down", "count = 1\nregion = { lower = [0, 0, 0], upper = [1, -1, 1] }", [r"region reaches from 0 to -1 along y"])
bad_body("copies that do not fit", "count = 200", [r"count = 200, but after \d+ copies .* fewer copies"], command="run")
bad_body("copies that do not fit, 2 ranks", "count = 200", [r"count = 200, but after"], command="run", ranks=2)
bad_body("missing positions", 'positions = "none.csv"', [r"none\.csv: .*cannot be read"])
bad_body("broken positions", 'positions = "places.csv"', [r"places\.csv:2: .*\"one\"", r"places\.csv:3: .*2 values"],
         places="x,y,z\n0,one,0\n0,1\n")
bad_body("empty positions", 'positions = "places.csv"', [r"places\.csv.*there is no position"], places="")
bad_body("copy outside the box", 'positions = "places.csv"', [r"body\.drop, copy drop-0002, reaches .*outside the box"],
         places="0,0,0\n0,1,1.8\n")
bad_body("copies that overlap", 'positions = "places.csv"',
         [r"case\.toml:\d+: body\.drop-0001 and .*body\.drop-0003 overlap at the start.*file of positions"],
         places="-1.7,0,0\n0,0,0\n1.7,0,0\n", command="run")
bad_body("empty selection", 'pinned = ["tip"]\nselection.tip.sphere = { center = [3, 0, 0], radius = 1 }',
         [r"body\.drop\.selection\.tip holds no vertex"], command="run")
bad_body("unknown selection", 'pinned = ["tip"]', [r'case\.toml:\d+: body\.drop\.pinned names "tip", which is no selection'])
bad_body("massless by itself", "mass_per_vertex = 0", [r"case\.toml:\d+: body\.drop\.mass_per_vertex is 0"])
bad_case("moduli of no body", CASE + SPHERE, [r'has no body "dorp"; it has drop'], command=["mesh", "moduli"],
         arguments=["dorp"])
bad_case("moduli of a rigid body", CASE + SPHERE.split("coupling")[0] + 'motion = "rigid"\n',
         [r'"drop".*only bodies with motion = "deformable"'], command=["mesh", "moduli"], arguments=["drop"])
bad_case("moduli of a coarse sphere", CASE + SPHERE.replace("radius = 0.5", "radius = 0.5, frequency = 2"),
         [r"body\.drop: the faces are too large .* refine"], command=["mesh", "moduli"], arguments=["drop"])
bad_case("bodies that overlap", CASE + SPHERE + SPHERE.replace('"drop"', '"other"').replace(
    "[body.potentials]", "center = [0, 0.8, 0]\n[body.potentials]"),
         [r"case\.toml:\d+: body\.drop and .*case\.toml:\d+: body\.other overlap"], command="run", ranks=2)
bad_case("body in a body", CASE + SPHERE + SPHERE.replace('"drop"', '"other"').replace("0.5", "1.2"),
         [r"body\.drop lies inside .*body\.other"])
bad_command("mesh of a bad shape", ["mesh", "plate", "--size", "-1", "2", "-o", "/tmp/never.gts"], [r"size a = -1"])
bad_command("mesh with unknown ends", ["mesh", "cylinder", "--ends", "shut", "-o", "/tmp/never.gts"], ["capped"])

# Signals and patches
PATCHES = """
[box]
size = [4, 4, 2]
origin = [-2, -2, 0]
cells = [20, 20, 8]
[signals.beat]
formula = "sin(2*pi*t)"
period = 1.0
[boundary]
x = "wall"
y = "wall"
"z-" = "wall"
[boundary."z+"]
type = "wall"
patches = [
  { name = "in", center = [0.8, 0], radius = 0.7, flow_rate = "beat", phase = [0, 0.5] },
  { name = "out", center = [-0.8, 0], radius = 0.7, balance = true },
]
[time]
end = 0.05
step = 0.01
"""


def sound_patches(folder):
    write(folder, "case.toml", PATCHES)
    result = harness.run("run", folder, "--out", os.path.join(folder, "out"), ranks=2)
    expect(result.returncode == 0, "the sound case does not run", result)
    with open(os.path.join(folder, "out", "history.csv")) as stream:
        names, *lines = [line.strip().split(",") for line in stream]
    last = dict(zip(names, map(float, lines[-1])))
    expect(last["flow_in"] > 0.3 and abs(last["flow_in"] + last["flow_out"]) < 1e-14, "the patches do not balance: %s" % last)


def bad_patches(name, old, new, patterns, **options):
    bad_case("patches: " + name, PATCHES.replace(old, new), patterns, **options)


harness.check("sound patches", sound_patches)
bad_patches("unknown signal", 'flow_rate = "beat"', 'flow_rate = "baet"',
            [r'case\.toml:16: boundary\.z\+\.patches\.in\.flow_rate "baet" is neither a signal \(the case has: beat\)'])
bad_patches("bad formula", "sin(2*pi*t)", "sin(2*pi*t", [r"case\.toml:7: signals\.beat\.formula.*wrong at character \d+"])
bad_patches("missing signal file", 'formula = "sin(2*pi*t)"', 'csv = "q.csv"', [r"signals\.beat\.csv.*q\.csv.*cannot be opened"],
            command="run", ranks=2)
bad_patches("phase without period", "period = 1.0", "", [r"patches\.in\.phase.*key period"])
bad_patches("no balance", "balance = true", 'flow_rate = "1"', [r"patches\.in carries a flow, but nothing lets it out"])
bad_patches("two balances", 'flow_rate = "beat", phase = [0, 0.5]', "balance = true", [r"patches\.out\.balance.*only one"])
bad_patches("balance beside outflow", 'x = "wall"', 'x = "outflow"', [r"patches\.out\.balance.*outflow side"])
bad_patches("overlap", "[0.8, 0]", "[0.2, 0]", [r'case\.toml:17: boundary\.z\+\.patches\.out overlaps with the patch "in"'])
bad_patches("beyond the side", "[0.8, 0]", "[1.8, 0]", [r"patches\.in reaches from .* beyond the side"])
bad_patches("smaller than a cell", "[0.8, 0], radius = 0.7", "[0.8, 0], radius = 0.05", [r"patches\.in covers 0 faces"])
bad_patches("on an outflow side", 'type = "wall"', 'type = "outflow"', [r"patches\.in is on a side of type \"outflow\""])
bad_patches("on a side of x", 'x = "wall"', '"x-" = { type = "wall", patches = [{ name = "a", radius = 1, flow_rate = "t" }] }\n"x+" = "wall"',
            [r"boundary\.x- has patches, which only the sides"])
bad_patches("inside out ring", "radius = 0.7, flow_rate", 'shape = "annulus", radius = 0.5, inner_radius = 0.6, flow_rate',
            [r"patches\.in\.inner_radius is 0\.6, not less than the radius 0\.5"])
bad_patches("many at once", 'radius = 0.7, flow_rate = "beat", phase = [0, 0.5]', 'radius = -1, flow_rate = "sin(", phase = [0.5, 2]',
            [r"patches\.in\.radius", r"patches\.in\.flow_rate", r"patches\.in\.phase", "3 problems"])

# Motions and coupling
BALL = SPHERE[:SPHERE.index("traction")].replace('coupling = "one-way"\n', "")
PLATE = BALL.replace('"sphere", radius = 0.5', '"plate"')


def bad_motion(name, motion, text, patterns, surface=BALL, more=""):
    bad_case(name, CASE + surface + 'motion = "{}"\n{}\n{}'.format(motion, text, more), patterns)


bad_motion("rigid and soft", "rigid", 'coupling = "local-mass"',
           [r'case\.toml:\d+: body\.drop\.coupling is "local-mass".*deformable'])
bad_motion("rigid and one-way", "rigid", 'coupling = "one-way"', [r'body\.drop\.coupling is "one-way".*"rigid"'])
bad_motion("hinge and one-way", "hinge", 'coupling = "one-way"', [r'body\.drop\.coupling is "one-way".*"hinge"'])
bad_motion("drag on a rigid body", "rigid", 'traction.form = "drag"', [r'body\.drop\.traction\.form is "drag"'])
bad_motion("quadratic on a deformable body", "deformable", 'coupling = "one-way"\ntraction.form = "quadratic"',
           [r'body\.drop\.traction\.form is "quadratic"'])
bad_motion("probes without probes", "rigid", 'loads = "probes"\ntraction.form = "none"', [r'body\.drop\.loads is "probes"'])
bad_motion("loads of a fixed body", "fixed", 'loads = "probes"', [r"body\.drop\.loads has no effect.*rigid"])
bad_motion("hinge without an axis", "hinge", "hinge.axis = [0, 0, 0]", [r"body\.drop\.hinge\.axis must not be 0"])
bad_motion("path without an axis", "prescribed", "path.axis = [0, 0, 0]", [r"body\.drop\.path\.axis must not be 0"])
bad_motion("path that is no formula", "prescribed", 'path.y = "2*q"', [r"case\.toml:\d+: body\.drop\.path\.y"])
bad_motion("path that is not finite", "prescribed", 'path.angle = "log(t)"', [r"body\.drop\.path\.angle.*no finite value"])
bad_motion("stops the wrong way round", "hinge", "hinge = { min_angle = 9, max_angle = 3 }",
           [r"hinge\.min_angle is 9, above hinge\.max_angle = 3"])
bad_motion("start beyond a stop", "hinge", "hinge = { max_angle = 3, angle = 4 }", [r"hinge\.angle starts at 4 degrees"])
bad_motion("hinge with copies", "hinge", "count = 2", [r"body\.drop\.count makes copies"])
bad_motion("open rigid body without a wall", "rigid", "", [r"body\.drop\.thickness is 0.*open"], surface=PLATE)
for command in ("check", "run"):
    bad_case("box too thin for markers, " + command, CASE.replace("[8, 8, 8]", "[8, 8, 2]") + BALL + 'motion = "fixed"\n',
             [r"error: box\.cells: 2 cells along z between bounded sides are too few for markers: use at least 3, or periodic"],
             command=command)
bad_motion("half free", "rigid", "free_rotation = [1, 1, 0.5]", [r"free_rotation has the component 0\.5 along z"])
bad_motion("repulsion without strength", "fixed", "", [r"repulsion\.range is given"], more="[repulsion]\nrange = 1\n")
bad_motion("repulsion without range", "fixed", "", [r"repulsion\.strength is given"], more="[repulsion]\nstrength = 1\n")
bad_motion("repulsion across the box", "fixed", "", [r"repulsion\.range is 3, more than half of the periodic direction x"],
           more="[repulsion]\nrange = 3\nstrength = 1\n")
bad_motion("contact as wide as the body", "deformable", 'coupling = "one-way"',
           [r"repulsion\.range is 0\.6, more than half of the size of body 'drop'"], more="[repulsion]\nrange = 0.6\nstrength = 1\n")
bad_motion("several problems of a motion", "hinge", 'coupling = "one-way"\ncount = 2\nhinge.axis = [0, 0, 0]',
           ["3 problems", r"coupling", r"count", r"hinge\.axis"])

# Parts of a heart
def part(shape):
    return CASE + SPHERE.replace('shape = "sphere", radius = 0.5', shape)


bad_case("leaflets in no room", part('shape = "mechanical-leaflet", radius = 0.5, hinge_offset = 0.7'),
         [r"body\.drop\.surface: mechanical-leaflet: hinge_offset = 0\.7"])
bad_case("holes that meet", part('shape = "plate-with-holes", size = [2, 2], holes = [[0.2, 0, 0.3], [-0.2, 0, 0.3]]'),
         [r"holes 1 and 2 are closer than one edge"])
bad_case("half a hole", part('shape = "plate-with-holes", size = [2, 2], holes = [[0.2, 0]]'),
         [r"case\.toml:\d+: body\.drop\.surface\.holes hole 1 must be 3 numbers"])
bad_body("selection of another shape", 'pinned = ["rim"]', [r'pinned names "rim", which is no selection'])
bad_case("selection that the shape has not", part('shape = "ventricle", radius = 0.5').replace(
    "[body.potentials]", 'pinned = ["annulus"]\n[body.potentials]'),
         [r'pinned names "annulus", which is no selection of the body; it has "rim", "apex"'])


def selections_through_a_file(folder):
    surface = os.path.join(folder, "sack.gts")
    made = harness.run("mesh", "ventricle", "--radius", "0.5", "--height", "1", "--edge", "0.2", "-o", surface)
    expect(made.returncode == 0 and "rim (" in made.stdout, "no ventricle", made)

    def case(shape, selection):
        return part(shape).replace("[body.potentials]", 'pinned = ["{}"]\n[body.potentials]'.format(selection))
    shape = 'file = "sack.gts", open = true'
    write(folder, "case.toml", case(shape, "rim"))
    run = harness.run("run", folder, "--out", os.path.join(folder, "out"), "--max-steps", "1")
    expect(run.returncode == 0, "a selection of the file is not found", run)
    write(folder, "case.toml", case(shape, "middle"))
    harness.refuses(["check", folder], [r"body\.drop has no selection named middle; its surface brings rim, apex"])


harness.check("selections through a file", selections_through_a_file)


def picture_of_an_overlap(folder):
    write(folder, "case.toml", CASE + SPHERE + SPHERE.replace('"drop"', '"other"').replace(
        "[body.potentials]", "center = [0, 0.8, 0]\n[body.potentials]"))
    harness.refuses(["check", folder], [r"overlap at the start", r"faces that overlap are in case-overlaps\.ply"], cwd=folder)
    info = harness.run("mesh", "info", os.path.join(folder, "case-overlaps.ply"))
    expect(info.returncode == 0 and "faces" in info.stdout, "the picture cannot be read", info)


harness.check("picture of an overlap", picture_of_an_overlap)


def remeshing(folder):
    scan, made = os.path.join(folder, "scan.gts"), os.path.join(folder, "made.gts")
    write(folder, "scan.gts", surfaces.flipped_face())
    harness.refuses(["mesh", "info", scan], ["flipped face"])
    result = harness.run("mesh", "remesh", scan, made, "--edge", "0.4")
    if "without CGAL" in result.stderr:
        return "built without CGAL"
    expect(result.returncode == 0 and "1 faces were turned" in result.stdout, "a flipped face is not mended", result)
    info = harness.run("mesh", "info", made)
    expect(re.search(r"closed +yes", info.stdout), "the mended surface is not closed", info)
    harness.refuses(["mesh", "remesh", scan, made, "--edge", "0"], [r"--edge must be positive"])
    harness.refuses(["mesh", "remesh", "/nonexistent/a.stl", made, "--edge", "1"], [r"/nonexistent/a\.stl"])


harness.check("remeshing", remeshing)

# Surfaces
bad_surface("surface in two pieces", surfaces.two_pieces(), [r"drop\.gts: .* 2 closed pieces"])
bad_surface("surface that crosses itself", surfaces.crossing_itself(), [r"body\.drop has a surface that crosses itself"])
bad_surface("missing surface", None, [r"drop\.gts"])
bad_surface("index out of range", surfaces.index_out_of_range(), [r"drop\.gts:27\b.*99"])
bad_surface("degenerate face", surfaces.degenerate_face(), [r"drop\.gts:27\b"])
bad_surface("face without area", surfaces.face_without_area(), [r"drop\.gts:\d+"])
bad_surface("hole", surfaces.hole(), [r"drop\.gts:\d+.*surface\.open = true"], command="run")
bad_surface("flipped face", surfaces.flipped_face(), [r"drop\.gts:\d+"])
bad_surface("inside out", surfaces.inside_out(), [r"drop\.gts"])
bad_surface("non-manifold edge", surfaces.non_manifold_edge(), [r"drop\.gts:\d+"])
bad_surface("truncated surface", surfaces.truncated(), [r"drop\.gts:\d+"])
bad_surface("letters for numbers", surfaces.not_a_number(), [r"drop\.gts:3\b"])
bad_surface("empty surface", "", [r"drop\.gts"])
bad_surface("binary surface", bytes(range(256)) * 8, [r"drop\.gts"])

sys.exit(harness.report())
