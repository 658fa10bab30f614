#!/usr/bin/env python3
"""What the program says of a case with units, before a run and after it.

Usage: units.py PROGRAM MPIRUN [MPIRUN-OPTION]...
"""
import csv
import json
import math
import os
import re
import sys

from harness import Harness, expect

harness = Harness(sys.argv[1], sys.argv[2:])
CASE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "examples", "heart-beat.toml")
DIAMETER, SPEED, DENSITY, VISCOSITY, PERIOD, STROKE = 0.025, 0.2, 1000.0, 1e-3, 3.6, 60e-6


BARE = """
box = { size = [1, 1, 1], cells = [8, 8, 8] }
fluid = { viscosity = 0.01 }
boundary = { x = "periodic", y = "periodic", "z-" = "wall", "z+" = { type = "wall", velocity = [3, 0, 0] } }
time.end = 1
"""


def close(value, exact, part=2e-4):
    return abs(value - exact) <= part * abs(exact)


def number_after(text, words):
    found = re.search(re.escape(words) + r" ?(-?[\d.]+(?:e[-+]?\d+)?)", text)
    expect(found is not None, "nothing follows '{}' in {}".format(words, text))
    return float(found.group(1))


def check(folder):
    result = harness.run("check", CASE)
    expect(result.returncode == 0, "the example is sound", result)
    said = result.stdout
    # E is 0.30 of the period long and carries half of that times its height, A 0.20 and is half as high.
    peak = STROKE / (PERIOD * (0.15 + 0.05))
    expect(close(number_after(said, "Re = U L/nu ="), SPEED * DIAMETER * DENSITY / VISCOSITY), "Re", result)
    expect(close(number_after(said, "Strouhal L/(U T) ="), DIAMETER / (SPEED * PERIOD)), "Strouhal", result)
    # Without scales, by the fastest velocity that the case prescribes: the piston's, in systole.
    bare = os.path.join(folder, "bare.toml")
    with open(bare, "w") as stream:
        stream.write(BARE)
    plain = harness.run("check", bare)
    expect(close(number_after(plain.stdout, "the velocity U ="), 3), "the lid is the fastest", plain)
    expect(close(number_after(plain.stdout, "Re = U L/nu ="), 300), "Re by the lid", plain)
    womersley = 0.5 * DIAMETER * (2 * math.pi / PERIOD * DENSITY / VISCOSITY) ** 0.5
    expect(close(number_after(said, "sqrt(2 pi/(T nu)) ="), womersley), "Womersley", result)
    expect("(signal beat, body disc)" in said, "the period has its owners", result)
    for words in ("length 25 mm, time 125 ms, velocity 200 mm/s, density 1000 kg/m^3, mass 15.62 g", "pressure 40 Pa",
                  "flow rate 125 mL/s", "box 50 mm x 50 mm x 75 mm, cells of 1.562 mm x 1.562 mm x 1.562 mm",
                  "end 3.6 s", "viscosity 1 mPa s", "stroke volume 60 mL",
                  "acts on the flow from phase 0.62 to 1 of each period of 28.8"):
        expect(words in said, "not said: " + words, result)
    expect(close(number_after(said, "(peak"), peak * 1e6), "the peak of the signal", result)
    carried = re.search(r"it carries ([\d.]+) there and ([\d.]+) back", said)
    expect(carried and carried.group(1) == carried.group(2), "what goes in comes out", result)


def run(folder):
    out = os.path.join(folder, "out")
    result = harness.run("run", CASE, "--out", out, "--max-steps", "4")
    expect(result.returncode == 0, "the example runs", result)
    with open(os.path.join(out, "run.json")) as stream:
        own = json.load(stream)["own_units_in_si"]
    exact = {"length": DIAMETER, "time": DIAMETER / SPEED, "mass": DENSITY * DIAMETER ** 3, "velocity": SPEED,
             "pressure": DENSITY * SPEED ** 2, "flow_rate": SPEED * DIAMETER ** 2, "density": DENSITY,
             "viscosity": DENSITY * SPEED * DIAMETER}
    for name, value in exact.items():
        expect(close(own[name], value, 1e-14), "{} is {}".format(name, own[name]))
    with open(os.path.join(out, "history.csv")) as stream:
        rows = list(csv.DictReader(stream))
    for row in rows[1:]:
        phase = float(row["time"]) * own["time"] / PERIOD
        rate = STROKE / (PERIOD * 0.2) * math.sin(math.pi * phase / 0.3) ** 2
        expect(close(float(row["flow_piston"]) * own["flow_rate"], rate, 1e-9), "the piston follows its signal")
    with open(os.path.join(out, "bodies", "disc.csv")) as stream:
        expect(all(row["on"] == "0" for row in csv.DictReader(stream)), "the disc is away in diastole")


def refusal(override, *words):
    def test(folder):
        result = harness.run("check", CASE, "--set", override)
        expect(result.returncode == 2, "is refused", result)
        for word in words:
            expect(word in result.stderr, "not said: " + word, result)
    return test


harness.check("check shows groups and sizes", check)
harness.check("a run says what its units are", run)
harness.check("a wrong dimension", refusal("fluid.viscosity=1 mm", "fluid.viscosity", '"1 mm"', "a length",
                                           "mass/(length time)"))
harness.check("a wrong dimension in a table", refusal('box.size=["50 mm", "50 s", "75 mm"]', "box.size", "a time"))
harness.check("a patch's flow rate", refusal("boundary.z-.patches.piston.flow_rate=80 mL", "flow_rate", "a volume"))
harness.check("a wrong scale", refusal("units.velocity=25 mm", "units.velocity", "a length"))
harness.check("a signal of another kind", refusal("signals.beat={ formula = 't', scale = '3 mm', period = '3.6 s' }",
                                                  "whose unit makes it a length"))
sys.exit(harness.report())
