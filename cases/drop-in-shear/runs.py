"""Runs the program on a case with other settings, and reads what it leaves."""
import csv
import json
import math
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

CASE = Path(__file__).resolve().parent
REPOSITORY = CASE.parents[1]


class RunFailed(Exception):
    pass


@dataclass
class Run:
    """One run: `settings` go to --set; results are there once it has been executed."""

    name: str
    file: str
    settings: dict
    cost: float = 1.0  # relative; long runs start first
    failure: str | None = None
    out: Path | None = field(default=None, repr=False)

    def command(self, binary):
        options = [part for key, value in self.settings.items() for part in ("--set", f"{key}={write(value)}")]
        return [str(binary), "run", os.path.relpath(CASE / self.file), *options]

    def rows(self):
        """The body's record, a dictionary a line."""
        with open(self.out / "bodies" / "drop.csv", newline="") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def report(self):
        return json.loads((self.out / "run.json").read_text())

    def surfaces(self):
        return sorted((self.out / "surfaces").glob("drop_*.h5"))


def write(value):
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(write(v) for v in value) + "]"
    return repr(value) if isinstance(value, float) else str(value)


def shear_settings(rate, end, step=0.05):
    """Settings for another shear rate; `end` and the step in units of 1 / rate. Surfaces: the first and the last."""
    return {
        "boundary.z-.velocity": [-4.0 * rate, 0, 0],
        "boundary.z+.velocity": [4.0 * rate, 0, 0],
        "time.end": end / rate,
        "time.step": step / rate,
        "output.surfaces.interval": end / rate,
    }


class Runner:
    def __init__(self, binary, out, jobs, reuse):
        self.binary, self.out, self.jobs, self.reuse = Path(binary), Path(out), jobs, reuse

    def execute_all(self, runs, note):
        """Executes the runs, several at a time, the costly ones first; calls note(run) as each ends."""
        def execute(run):
            self.execute(run)
            note(run)

        pool = ThreadPoolExecutor(self.jobs)
        try:
            list(pool.map(execute, sorted(runs, key=lambda run: -run.cost)))
        finally:  # after an interrupt the runs that wait must not start
            pool.shutdown(cancel_futures=True)

    def execute(self, run):
        run.out = self.out / run.name
        command = run.command(self.binary) + ["--out", str(run.out)]
        stamp = run.out / "command.txt"
        line = " ".join(command) + "\n"
        if self.reuse and stamp.exists() and stamp.read_text() == line:
            return
        stamp.unlink(missing_ok=True)
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                              text=True, cwd=Path.cwd())
        if done.returncode != 0:
            run.failure = done.stdout.strip()[-600:] or f"exit code {done.returncode}"
            return
        stamp.write_text(line)


def find_binary(given):
    for path in [given] if given else [os.environ.get("PLIANT"), REPOSITORY / "build/release/pliant",
                                       REPOSITORY / "build/portable/pliant"]:
        if path and Path(path).is_file():
            return Path(path)
    raise RunFailed(f"no program at {given or REPOSITORY / 'build/release/pliant'}: build it (scripts/demo does), or "
                    "name it with --binary")


def mean_shape(rows, begin):
    """L, B, W in units of the radius at rest and the angle, averaged over time from `begin` on; the volume over
    that at rest; the radius of the sphere of the volume at rest; and half the range of L, B and the angle."""
    rest = (rows[0]["L"] * rows[0]["B"] * rows[0]["W"]) ** (1 / 3)
    radius = (3 * rows[0]["volume"] / (4 * math.pi)) ** (1 / 3)
    kept = [row for row in rows if row["time"] >= begin * (1 - 1e-9)]
    mean = {key: sum(row[key] for row in kept) / len(kept) for key in ("L", "B", "W", "angle", "volume")}
    swing = {key: (max(row[key] for row in kept) - min(row[key] for row in kept)) / 2 for key in ("L", "B", "angle")}
    return {"L": mean["L"] / rest, "B": mean["B"] / rest, "W": mean["W"] / rest, "angle": mean["angle"],
            "volume": mean["volume"] / rows[0]["volume"], "radius": radius,
            "swing_L": swing["L"] / rest, "swing_B": swing["B"] / rest, "swing_angle": swing["angle"]}
