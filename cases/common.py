"""Shared by the checks of the cases: runs the program with settings, reads what it leaves, and keeps score of bounds."""
import csv
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

REPOSITORY = Path(__file__).resolve().parents[1]


def find_binary(given=None):
    for path in [given] if given else [os.environ.get("PLIANT"), REPOSITORY / "build/release/pliant",
                                       REPOSITORY / "build/portable/pliant"]:
        if path and Path(path).is_file():
            return Path(path)
    sys.exit(f"no program at {given or REPOSITORY / 'build/release/pliant'}: build it, or name it with --binary")


def write(value):
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(write(v) for v in value) + "]"
    return repr(value) if isinstance(value, float) else str(value)


class Runner:
    """Runs a case into folders of its own; `reuse` keeps those that the same settings have made before."""

    def __init__(self, case, out, binary=None, reuse=False):
        self.case, self.out, self.binary, self.reuse = Path(case), Path(out), find_binary(binary), reuse

    def run(self, name, settings, expected=0):
        """Executes a run and returns its folder; ends the check if the exit code is not the expected one."""
        folder = self.out / name
        options = [part for key, value in settings.items() for part in ("--set", f"{key}={write(value)}")]
        # A run that is to fail leaves its words in log.txt.
        stamp, line = folder / "check.txt", " ".join(options)
        if self.reuse and stamp.exists() and stamp.read_text() == line:
            return folder
        stamp.unlink(missing_ok=True)
        folder.mkdir(parents=True, exist_ok=True)
        start = time.monotonic()
        with open(self.out / f"{name}.log", "w") as log:
            code = subprocess.run([str(self.binary), "run", str(self.case), "--out", str(folder), *options], stdout=log,
                                  stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode
        print(f"  {name}: {time.monotonic() - start:.0f} s", flush=True)
        if code != expected:
            sys.exit(f"{name} ended with code {code}, not {expected}:\n{(self.out / f'{name}.log').read_text()[-1500:]}")
        stamp.write_text(line)
        return folder

    def log(self, name):
        return (self.out / f"{name}.log").read_text()


def read_table(path):
    """A CSV with a header, as a dictionary of arrays."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float)
    return {name: values[:, n] for n, name in enumerate(rows[0])}


def wall_seconds(folder):
    return json.loads((Path(folder) / "run.json").read_text())["wall_seconds"]


class Bounds:
    """Prints each bound with what was measured."""

    def __init__(self):
        self.rows = []

    def at_most(self, what, value, bound, unit=""):
        self.add(what, f"{value:.4g}{unit}", f"at most {bound:g}{unit}", bool(value <= bound))

    def at_least(self, what, value, bound, unit=""):
        self.add(what, f"{value:.4g}{unit}", f"at least {bound:g}{unit}", bool(value >= bound))

    def add(self, what, measured, bound, holds):
        self.rows.append((what, measured, bound, "pass" if holds else "**missed**"))
        print(f"{'pass' if holds else 'MISS'}  {what}: {measured} ({bound})", flush=True)

    def table(self):
        return "\n".join(["| bound | measured | wanted | |", "|---|---|---|---|"] +
                         [f"| {a} | {b} | {c} | {d} |" for a, b, c, d in self.rows])

    def all_hold(self):
        return all(row[3] == "pass" for row in self.rows)
