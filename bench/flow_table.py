#!/usr/bin/python3
"""Measures the flow solver and prints the tables of bench/README.md.

Every configuration runs once a round, all configurations in turn, so that a drift of the machine meets all alike; the
tables show the median over the rounds and the range.

    bench/flow_table.py [--rounds 5] [--steps 3] [--cells 256x256x192 128x128x128 150x150x150] [--ranks 1 2]
                        [--sweeps plain fused] [--figure bench/flow-phases.png]
"""
import argparse
import json
import os
import statistics
import subprocess
import sys

MODES = ("explicit", "implicit-z", "implicit")
TARGET = {"explicit": 110, "implicit-z": 130, "implicit": 160}  # fused sweeps, one rank, 256 x 256 x 192


def measure(binary, cells, mode, sweeps, ranks, steps):
    command = [binary, "bench", "flow", "--cells", *cells.split("x"), "--viscous", mode, "--sweeps", sweeps, "--steps", str(steps),
               "--repeats", "1", "--stretching", "tanh", "--json"]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed with code {done.returncode}:\n{done.stdout}{done.stderr}")
    return json.loads(done.stdout)


def spread(values, digits=0):
    return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f}-{max(values):.{digits}f})"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default="build/release/pliant")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--steps", type=int, default=3)
    parser.add_argument("--cells", nargs="+", default=["256x256x192", "128x128x128", "150x150x150"])
    parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--sweeps", nargs="+", default=["plain", "fused"], choices=["plain", "fused"])
    parser.add_argument("--figure", help="also draw the phases")
    options = parser.parse_args()
    if os.geteuid() == 0:
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")

    results = {}
    for _ in range(options.rounds):
        for cells in options.cells:
            for mode in MODES:
                for sweeps in options.sweeps:
                    for ranks in options.ranks:
                        report = measure(options.binary, cells, mode, sweeps, ranks, options.steps)
                        results.setdefault((cells, mode, sweeps, ranks), []).append(report)

    def values(key, name):
        return [report[name] for report in results[key]]

    def ratio(of, to):
        # Round by round, since the two stand next to each other in time.
        if of not in results or of == to:
            return "-"
        return spread([a["ns_per_cell_step"] / b["ns_per_cell_step"] for a, b in zip(results[of], results[to])], 2)

    print("| cells | viscous terms | sweeps | ranks | ns a cell and step | triad GB/s | doubles a cell and step | target | "
          "doubles of memory a cell | plain over this | one rank over this |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for key in results:
        cells, mode, sweeps, ranks = key
        target = TARGET[mode] if (cells, sweeps, ranks) == ("256x256x192", "fused", 1) else "-"
        print(f"| {cells} | {mode} | {sweeps} | {ranks} | {spread(values(key, 'ns_per_cell_step'), 1)} | "
              f"{spread(values(key, 'triad_gb_per_s'), 1)} | {spread(values(key, 'doubles_per_cell_step'))} | {target} | "
              f"{statistics.median(values(key, 'bytes_per_cell')) / 8:.1f} | {ratio((cells, mode, 'plain', ranks), key)} | "
              f"{ratio((cells, mode, sweeps, 1), key)} |")

    print("\nPhases, ns a cell and step (medians):\n")
    phases = sorted({phase for reports in results.values() for report in reports for phase in report["phase_share"]})
    print("| cells | viscous terms | sweeps | ranks | " + " | ".join(phases) + " |")
    print("|---" * (4 + len(phases)) + "|")
    times = {}
    for key, reports in results.items():
        times[key] = {p: statistics.median(r["phase_share"].get(p, 0) * r["ns_per_cell_step"] for r in reports)
                      for p in phases}
        print("| {} | {} | {} | {} | ".format(*key) + " | ".join(f"{times[key][p]:.1f}" for p in phases) + " |")
    if options.figure:
        draw(times, phases, options.figure)


def draw(times, phases, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 0.9 + 0.32 * len(times)), constrained_layout=True)
    labels = [" ".join(str(part) for part in key[:3]) + f", {key[3]} rank{'s' * (key[3] > 1)}" for key in times]
    left = [0.0] * len(times)
    for n, phase in enumerate(phases):
        widths = [of_key[phase] for of_key in times.values()]
        axes.barh(labels, widths, left=left, label=phase, color=f"C{n}")
        left = [a + b for a, b in zip(left, widths)]
    axes.invert_yaxis()
    axes.set_xlabel("ns a cell and step")
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1, 1))
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main()
