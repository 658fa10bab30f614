#!/usr/bin/python3
"""A drop in shear flow against the model of Maffettone and Minale: runs, compares, draws. See README.md."""
import argparse
import json
import os
import shutil
import sys
import threading
import time
from pathlib import Path

import campaign
import report
import runs
import study

START, END = "<!-- measured: written by check.py --update-readme -->", "<!-- end of measured -->"


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="162 and 642 vertices, Ca <= 0.2, shorter runs")
    size.add_argument("--full", action="store_true", help="all meshes and capillary numbers (the default)")
    parser.add_argument("--only", choices=[v.name for v in study.VARIANTS] + ["control"], help="one variant")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="runs at a time")
    parser.add_argument("--reuse", action="store_true", help="keep finished runs of the same command")
    parser.add_argument("--binary", help="the program (default: build/release/pliant)")
    default_out = runs.REPOSITORY / "out" / "drop-in-shear"
    parser.add_argument("--out", type=Path, default=default_out, help="folder for everything")
    parser.add_argument("--update-readme", action="store_true", help="put tables and figures into the README")
    arguments = parser.parse_args()
    if arguments.update_readme and (arguments.quick or arguments.only):
        parser.error("--update-readme needs the full set of runs")
    if arguments.jobs < 1:
        parser.error("--jobs must be at least 1")
    return arguments


def reporter(start):
    lock, count = threading.Lock(), iter(range(1, 10**6))

    def note(run):
        with lock:
            state = "FAILED" if run.failure else "done"
            print(f"[{time.monotonic() - start:6.1f} s] run {next(count):3d} {state}: {run.name}", flush=True)

    return note


def result_rows(results):
    for p in results.points:
        if p.mean:
            length, breadth, angle = p.model
            yield {"variant": p.variant.name, "vertices": p.mesh.vertices, "kind": p.kind, "Ca": p.capillary, **p.mean,
                   "model_L": length, "model_B": breadth, "model_angle": angle}


def update_readme(text, pictures):
    readme = runs.CASE / "README.md"
    before, rest = readme.read_text().split(START)
    readme.write_text(before + START + "\n" + text + END + rest.split(END)[1])
    for picture in pictures:
        target = runs.REPOSITORY / "docs" / "images" if picture.stem == "drop-in-shear" else runs.CASE / "figures"
        target.mkdir(parents=True, exist_ok=True)
        shutil.copy(picture, target / picture.name)


def main():
    arguments = read_arguments()
    import figures  # needs matplotlib, which takes its time and need not be there for --help

    start = time.monotonic()
    runner = runs.Runner(runs.find_binary(arguments.binary), arguments.out / "runs", arguments.jobs, arguments.reuse)
    plan = study.make_plan(quick=arguments.quick, only=arguments.only)
    results = campaign.run_plan(plan, runner, reporter(start))

    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "results.json").write_text(json.dumps(list(result_rows(results)), indent=1) + "\n")
    size = " --quick" if arguments.quick else ""
    only = f" --only {arguments.only}" if arguments.only else ""
    command = f"cases/drop-in-shear/check.py{size}{only} --jobs {arguments.jobs}"
    print(report.plain(results))
    pictures = figures.draw(results, arguments.out)
    if any(run.failure is None for run in results.all_runs()):
        text = report.markdown(results, command)
        (arguments.out / "results.md").write_text(text)
        if arguments.update_readme:
            update_readme(text, pictures)
    print("\nPictures: " + ", ".join(os.path.relpath(p) for p in pictures))
    print(f"{'PASS' if results.passes else 'FAIL'}: {len(results.all_runs())} runs in {time.monotonic() - start:.0f} s")
    return 0 if results.passes else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except runs.RunFailed as problem:
        sys.exit(f"check.py: {problem}")
    except KeyboardInterrupt:
        sys.exit(130)
