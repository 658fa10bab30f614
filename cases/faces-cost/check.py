#!/usr/bin/python3
"""Time of a step against the number of faces, for fixed and for free bodies: runs, compares, draws. See README.md."""
import random
import statistics
import sys
from pathlib import Path

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

FACES = 320  # of a sphere
COUNTS = (1, 10, 100)
MOTIONS = {  # how the bodies move: settings
    "fixed": {"motion": "fixed"},
    "free": {"motion": "rigid", "density": 2.0, "loads": "momentum-balance"},
    "free, by probes": {"motion": "rigid", "density": 2.0, "loads": "probes"},
}
GRIDS = {"small": (60, 60, 360), "paper": (120, 120, 720)}  # cells; the spheres keep eight cells in diameter
STEPS = {"small": 25, "paper": 10}
BOUND = 1.05  # time of a step with 32,000 faces over that with 320


def make_run(out, grid, motion, count, repeat):
    cells = GRIDS[grid]
    name = motion.replace(", by ", "-")
    return common.Run(CASE / "case.toml", out / f"{grid}-{name}-{count}-{repeat}", {
        "box.cells": cells,
        "time.max_steps": STEPS[grid],
        "time.step": 0.12 / cells[0],
        "body.spheres.surface.diameter": 8.0 / cells[0] * 1.0005,
        "body.spheres.gap": 3.6 / cells[0],
        "body.spheres.count": count,
        **{f"body.spheres.{key}": value for key, value in MOTIONS[motion].items()},
    })


def costs(run):
    """Seconds a step: of the flow alone, and of the bodies. Both from one run, so that a busy machine slows both."""
    report = run.report()
    phases, steps = report["seconds_by_phase"], report["steps"]
    forcing = phases.get("bodies: forcing, within fluid", 0.0)
    bodies = forcing + sum(phases.get("bodies: " + part, 0.0) for part in ("markers", "loads", "motion"))
    return (phases["fluid"] - forcing) / steps, bodies / steps


def measure(arguments, grid):
    """For every motion and count the (flow, bodies) of all repeats; the runs in random order within a repeat."""
    samples = {(motion, count): [] for motion in MOTIONS for count in COUNTS}
    order = random.Random(1)
    for repeat in range(arguments.repeats):
        keys = list(samples)
        order.shuffle(keys)
        for motion, count in keys:
            run = make_run(arguments.out, grid, motion, count, repeat)
            run.execute(arguments.binary, arguments.reuse)
            samples[motion, count].append(costs(run))
    return samples


def relative(samples, motion, count):
    """Time of a step over that with one sphere, each as a multiple of its own run's flow: median, least, largest."""
    def of(n):
        return [1 + bodies / flow for flow, bodies in samples[motion, n]]

    base = statistics.median(of(COUNTS[0]))
    values = [value / base for value in of(count)]
    return statistics.median(values), min(values), max(values)


def table(samples):
    rows = []
    for motion in MOTIONS:
        for count in COUNTS:
            pairs = samples[motion, count]
            steps = [flow + bodies for flow, bodies in pairs]
            parts = [1e3 * bodies for _, bodies in pairs]
            middle, least, most = relative(samples, motion, count)
            per_face = 1e6 * statistics.median(parts) / (FACES * count)
            rows.append([motion, f"{FACES * count:,}", f"{statistics.median(steps):.3f} ({min(steps):.3f}-{max(steps):.3f})",
                         f"{statistics.median(parts):.2f} ({min(parts):.2f}-{max(parts):.2f})", f"{per_face:.0f}",
                         f"**{middle:.3f}** ({least:.3f}-{most:.3f})"])
    return common.markdown_table(["bodies", "faces", "a step, s", "of which bodies, ms", "bodies, ns a face and step",
                                  "over 320 faces"], rows)


def draw(all_samples, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, len(MOTIONS), figsize=(12, 3.8), sharey=True, constrained_layout=True)
    for axis, motion in zip(axes, MOTIONS):
        for grid, samples in all_samples.items():
            points = [relative(samples, motion, count) for count in COUNTS]
            middles = [p[0] for p in points]
            errors = [[p[0] - p[1] for p in points], [p[2] - p[0] for p in points]]
            axis.errorbar([FACES * count for count in COUNTS], middles, yerr=errors, marker="o", capsize=3,
                          label=" x ".join(map(str, GRIDS[grid])) + " cells")
        axis.axhline(BOUND, color="0.5", linestyle=":", label=f"target {BOUND}")
        if motion == "free, by probes":
            axis.axhline(1.3, color="0.7", linestyle="--", label="paper, moving, at 32,000")
        axis.set(xscale="log", xlabel="faces", title=f"bodies {motion}")
        axis.legend(fontsize=8)
    axes[0].set(ylabel="time of a step over that with 320 faces")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main():
    arguments = common.read_arguments(
        __doc__, "faces-cost", quick="only the small grid, which is reported and not judged",
        further=lambda parser: parser.add_argument("--repeats", type=common.positive, default=3,
                                                   help="of every run; the median counts"))
    grids = ["small"] if arguments.quick else ["paper", "small"]
    samples = {grid: measure(arguments, grid) for grid in grids}

    verdict = common.Bounds()
    if not arguments.quick:
        for motion in MOTIONS:
            verdict.within(f"{motion}: a step with 32,000 faces over one with 320",
                           relative(samples["paper"], motion, COUNTS[-1])[0], 0, BOUND)
    report = make_run(arguments.out, grids[0], next(iter(MOTIONS)), COUNTS[0], 0).report()
    command = f"cases/faces-cost/check.py{' --quick' if arguments.quick else ''} --repeats {arguments.repeats}"
    text = common.how_measured(report, command)
    for grid, values in samples.items():
        text += f"\n### {' x '.join(map(str, GRIDS[grid]))} cells\n{table(values)}"
    text += f"\n### Bounds\n{verdict.markdown()}"
    return common.conclude(arguments, CASE, text, verdict, lambda picture: draw(samples, picture))


if __name__ == "__main__":
    sys.exit(main())
