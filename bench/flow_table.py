#!/usr/bin/env python3
"""Measures the flow solver and prints the tables of bench/README.md.

Every configuration runs once a round, all configurations in turn, so that a drift of the machine meets all alike; the
tables show the median over the rounds and the range.

    bench/flow_table.py [--rounds 5] [--steps 3] [--cells 256x256x192 128x128x128 150x150x150] [--ranks 1 2]
"""
import argparse
import json
import os
import statistics
import subprocess
import sys

MODES = ("explicit", "implicit-z", "implicit")
FIRST_TARGET = {"explicit": 240, "implicit-z": 290, "implicit": 350}


def measure(binary, cells, mode, ranks, steps):
    command = [binary, "bench", "flow", "--cells", *cells.split("x"), "--viscous", mode, "--steps", str(steps),
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
    options = parser.parse_args()
    if os.geteuid() == 0:
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT", "1")
        os.environ.setdefault("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")

    results = {}
    for _ in range(options.rounds):
        for cells in options.cells:
            for mode in MODES:
                for ranks in options.ranks:
                    report = measure(options.binary, cells, mode, ranks, options.steps)
                    results.setdefault((cells, mode, ranks), []).append(report)

    def values(key, name):
        return [report[name] for report in results[key]]

    print("| cells | viscous terms | ranks | ns a cell and step | triad GB/s | doubles a cell and step | first target | "
          "doubles of memory a cell | speed-up |")
    print("|---|---|---|---|---|---|---|---|---|")
    for key in results:
        cells, mode, ranks = key
        target = FIRST_TARGET[mode] if ranks == 1 and cells == "256x256x192" else "-"
        one = results.get((cells, mode, 1))
        ratio = "-"
        if ranks > 1 and one:
            # Round by round, since the two stand next to each other in time.
            pairs = [a["ns_per_cell_step"] / b["ns_per_cell_step"] for a, b in zip(one, results[key])]
            ratio = spread(pairs, 2)
        print(f"| {cells} | {mode} | {ranks} | {spread(values(key, 'ns_per_cell_step'), 1)} | "
              f"{spread(values(key, 'triad_gb_per_s'), 1)} | {spread(values(key, 'doubles_per_cell_step'))} | {target} | "
              f"{statistics.median(values(key, 'bytes_per_cell')) / 8:.1f} | {ratio} |")

    print("\nShare of the phases, per cent (medians):\n")
    phases = sorted({phase for reports in results.values() for report in reports for phase in report["phase_share"]})
    print("| cells | viscous terms | ranks | " + " | ".join(phases) + " |")
    print("|---" * (3 + len(phases)) + "|")
    for key, reports in results.items():
        shares = [100 * statistics.median(r["phase_share"].get(p, 0) for r in reports) for p in phases]
        print("| {} | {} | {} | ".format(*key) + " | ".join(f"{s:.1f}" for s in shares) + " |")


if __name__ == "__main__":
    main()
