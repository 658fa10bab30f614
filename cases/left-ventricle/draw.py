#!/usr/bin/python3
"""Draws what a run of this case found, as far as it went: the figures of check.py from any output folders. See README.md."""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import check  # noqa: E402

FIGURES = {"snapshots": check.draw_snapshots, "speed": check.draw_speed, "leaflets": check.draw_leaflets, "flow": check.draw_flow,
           "position": check.draw_position, "valves": check.draw_valves, "wall-shear": check.draw_wall_shear}
AT_PHASES = ("snapshots", "speed", "wall-shear")


def valve_of(beat):
    return "natural" if any(body["name"] == "valve" for body in beat.case["body"]) else "mechanical"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=Path, nargs="+", help="output folders; at most one with each valve")
    parser.add_argument("--figure", choices=FIGURES, default="snapshots")
    parser.add_argument("--phases", type=float, nargs="+", help=f"t/T of the snapshots, for {', '.join(AT_PHASES)}")
    parser.add_argument("--cycle", type=int, help="1 for the first; default: the last complete one")
    parser.add_argument("-o", "--output", type=Path, default=Path("figure.png"))
    arguments = parser.parse_args()
    if arguments.phases and arguments.figure not in AT_PHASES:
        parser.error(f"--phases is for {', '.join(AT_PHASES)}")
    if arguments.cycle is not None and arguments.cycle < 1:
        parser.error("--cycle counts from 1")
    beats = {}
    for run in arguments.runs:
        if not (run / "run.json").is_file():
            parser.error(f"{run} has no run.json: name the output folder of a run")
        beat = check.Beat(run, None if arguments.cycle is None else arguments.cycle - 1)
        if valve_of(beat) in beats:
            parser.error(f"{run} is the second run with the {valve_of(beat)} valve")
        beats[valve_of(beat)] = beat

    further = {"phases": tuple(arguments.phases)} if arguments.phases else {}
    FIGURES[arguments.figure](check.pyplot(), dict(sorted(beats.items())), arguments.output, **further)
    for name, beat in beats.items():
        print(f"{name}: cycle {beat.cycle + 1} to t/T = {beat.cavity['phase'][-1]:.3f}, dV/dt off the flow by up to "
              f"{100 * beat.difference:.2f} % of the peak")
    return 0


if __name__ == "__main__":
    sys.exit(main())
