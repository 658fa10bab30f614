#!/usr/bin/python3
"""Drag, wake length and separation angle of a fixed sphere at Re = 50, 100, 150: runs, compares, draws. See README.md."""
import math
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

# Axisymmetric steady solutions of the unbounded flow, and their estimated errors (README).
REFERENCE = {50: (1.575, 0.407, 139.1), 100: (1.083, 0.870, 126.8), 150: (0.879, 1.194, 120.5)}
FINEST = {50: 20, 100: 20, 150: 16}  # cells a diameter; at Re = 150 the flow takes longest to become steady
WIDTH = 8  # of the box, in diameters


def plan(quick):
    """(Re, cells a diameter, width of the box) of every run."""
    grids = [(re, 10, width) for re in REFERENCE for width in (WIDTH, 12)]
    if quick:
        return grids
    return grids + [(100, 10, 16), (100, 14, WIDTH)] + [(re, n, WIDTH) for re, n in FINEST.items()]


def make_run(out, reynolds, n, width):
    end = 16.0 if reynolds == 50 else 20.0
    return common.Run(CASE / "case.toml", out / f"re{reynolds}-n{n}-w{width}", {
        "title": f"Flow past a fixed sphere, Re = {reynolds}",
        "fluid.viscosity": 1.0 / reynolds,
        "box.size": [width, width, 17],
        "box.origin": [-width / 2, -width / 2, -5],
        "box.cells": [width * n, width * n, round(8.6 * n)],
        "box.stretching.z.growth": 0.6 / n,
        "time.end": end,
        "output.fields.interval": end,
        "output.surfaces.interval": end,
    })


def blockage(results, reynolds):
    """Factors from the width of 8 d to an unbounded flow: values go as 1 + b / area, b from 8 and 12 d at 10 cells."""
    narrow, wide = results[reynolds, 10, WIDTH], results[reynolds, 10, 12]
    share = (1 / WIDTH**2) / (1 / WIDTH**2 - 1 / 12**2)  # of the whole change that lies between the two

    def unbounded(name):
        a, b = getattr(narrow, name), getattr(wide, name)
        return a + share * (b - a)

    return (unbounded("drag") / narrow.drag, unbounded("wake") / narrow.wake,
            0.0 if math.isnan(unbounded("angle")) else unbounded("angle") - narrow.angle)


def corrected(results, reynolds, n):
    """Drag by momentum balance, by probes, wake length and angle of the unbounded flow."""
    result, (drag, wake, angle) = results[reynolds, n, WIDTH], blockage(results, reynolds)
    return result.drag * drag, result.probe_drag * drag, result.wake * wake, result.angle + angle


def judge(results, quick):
    verdict, slack = common.Bounds(), 2 if quick else 1
    for reynolds, (drag, wake, angle) in REFERENCE.items():
        n = 10 if quick else FINEST[reynolds]
        measured = corrected(results, reynolds, n)
        name = f"Re = {reynolds}, {n} cells a diameter: "
        verdict.within(name + "drag against the reference", 100 * (measured[0] / drag - 1), -3 * slack, 3 * slack, " %")
        verdict.within(name + "drag by probes against the momentum balance", 100 * (measured[1] / measured[0] - 1),
                       -6 * slack, 6 * slack, " %")
        verdict.within(name + "wake length", 100 * (measured[2] / wake - 1), -5 * slack, 5 * slack, " %")
        verdict.within(name + "separation angle, by the flow", measured[3] - angle, -2 * slack, 2 * slack, " degrees")
        verdict.within(name + "separation angle, by the shear at the probes", results[reynolds, n, WIDTH].shear_angle
                       - angle, -2 * slack, 2 * slack, " degrees")
        verdict.within(name + "change of the drag over the last 4 d/U",
                       100 * abs(results[reynolds, n, WIDTH].change) / drag, 0, 0.1, " %")
    if not quick:
        first, second, third = (corrected(results, 100, n)[0] for n in (10, 14, 20))
        verdict.within("Re = 100: change of the drag from 14 to 20 cells over that from 10 to 14",
                       abs(third - second) / abs(second - first), 0, 1)
    return verdict


def number(value, form):
    return "none" if math.isnan(value) else format(value, form)


def tables(results):
    rows = []
    for reynolds, n in sorted({(re, n) for re, n, width in results if width == WIDTH}):
        r, (drag, probes, wake, angle) = results[reynolds, n, WIDTH], corrected(results, reynolds, n)
        ref = REFERENCE[reynolds]
        rows.append([reynolds, n, f"{drag:.3f}", f"{100 * (drag / ref[0] - 1):+.1f} %", f"{probes:.3f}",
                     f"{100 * (probes / drag - 1):+.1f} %", number(wake, ".3f"), number(100 * (wake / ref[1] - 1), "+.1f") + " %",
                     number(angle, ".1f"), number(angle - ref[2], "+.1f"), number(r.shear_angle, ".1f"), f"{r.slip:.3f}", f"{r.minutes:.1f}"])
    main = common.markdown_table(["Re", "d/h", "C_D", "against reference", "C_D by probes", "against balance", "L/d",
                                  "against reference", "angle", "against reference", "by probes", "rms slip", "minutes"], rows)
    rows = [[re, width, f"{r.drag:.4f}", f"{r.probe_drag:.4f}", f"{r.wake:.4f}", number(r.angle, ".2f")]
            for (re, n, width), r in sorted(results.items()) if n == 10]
    for re in REFERENCE:
        drag, wake, angle = blockage(results, re)
        r = results[re, 10, WIDTH]
        rows.append([re, "unbounded, from 8 and 12", f"{r.drag * drag:.4f} ({100 * (drag - 1):+.2f} %)", "",
                     f"{r.wake * wake:.4f} ({100 * (wake - 1):+.2f} %)", number(r.angle + angle, ".2f")])
    rows.sort(key=lambda row: (row[0], str(row[1]).zfill(2)))
    side = common.markdown_table(["Re", "width / d", "C_D", "C_D by probes", "L/d", "angle"], rows)
    return main, side


def main():
    arguments = common.read_arguments(
        __doc__, "sphere-drag", quick="10 cells a diameter only, judged by twice the bounds",
        further=lambda parser: parser.add_argument("--jobs", type=common.positive, default=1, help="runs at a time"))
    import evaluate  # need numpy, h5py and matplotlib, which need not be there for --help
    import figures

    runs = {}
    for key in sorted(plan(arguments.quick), key=lambda key: -key[1] * key[2]):
        runs[key] = make_run(arguments.out, *key)
    with ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(lambda run: run.execute(arguments.binary, arguments.reuse), runs.values()))
    results = {key: evaluate.evaluate(run) for key, run in runs.items()}

    verdict = judge(results, arguments.quick)
    main_table, blockage_table = tables(results)
    finest = max(n for _, n, _ in results)
    text = (common.how_measured(runs[100, finest, WIDTH].report(),
                                "cases/sphere-drag/check.py" + (" --quick" if arguments.quick else ""))
            + f"\n{main_table}\n### Blockage, 10 cells a diameter\n{blockage_table}\n### Bounds\n{verdict.markdown()}")
    return common.conclude(arguments, CASE, text, verdict, lambda picture: figures.draw(
        runs, results, {key: corrected(results, *key[:2]) for key in runs if key[2] == WIDTH}, REFERENCE, picture))


if __name__ == "__main__":
    sys.exit(main())
