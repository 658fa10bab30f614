"""What the checks of several cases share: runs of the program, its CSV files, bounds, and tables in a README."""
import argparse
import csv
import json
import os
import subprocess
import sys
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
START, END = "<!-- measured: written by check.py --update-readme -->", "<!-- end of measured -->"


def read_arguments(description, name):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quick", action="store_true", help="only the runs that take minutes")
    parser.add_argument("--reuse", action="store_true", help="keep finished runs of the same settings")
    parser.add_argument("--binary", help="the program (default: build/release/pliant)")
    parser.add_argument("--out", type=Path, default=REPOSITORY / "out" / name, help="folder for everything")
    parser.add_argument("--update-readme", action="store_true", help="put tables and figure into the case's folder")
    arguments = parser.parse_args()
    if arguments.quick and arguments.update_readme:
        parser.error("--update-readme needs all runs")
    arguments.binary = find_binary(arguments.binary)
    arguments.out.mkdir(parents=True, exist_ok=True)
    return arguments


def find_binary(given):
    for path in [given] if given else [os.environ.get("PLIANT"), REPOSITORY / "build/release/pliant",
                                       REPOSITORY / "build/portable/pliant"]:
        if path and Path(path).is_file():
            return Path(path).resolve()
    sys.exit(f"check.py: no program at {given or REPOSITORY / 'build/release/pliant'}: build it, or name it with --binary")


def run(arguments, name, file, settings=None):
    """Runs a case with `--set` settings into OUT/name, or keeps what is there (--reuse); returns the folder."""
    out = arguments.out / name
    settings = {**(settings or {}), "checkpoint.keep": 0}
    options = [part for key, value in settings.items() for part in ("--set", f"{key}={value}")]
    stamp, line = out / "settings.txt", " ".join([Path(file).name, *options]) + "\n"
    if arguments.reuse and stamp.exists() and stamp.read_text() == line:
        return out
    print(f"run {name}: {line.strip()}", flush=True)
    stamp.unlink(missing_ok=True)
    begin = time.monotonic()
    done = subprocess.run([str(arguments.binary), "run", str(file), *options, "--out", str(out)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        sys.exit(f"check.py: run {name} failed with exit code {done.returncode}: {done.stdout.strip()[-800:]}")
    stamp.write_text(line)
    print(f"    {time.monotonic() - begin:.0f} s", flush=True)
    return out


def report(out):
    return json.loads((out / "run.json").read_text())


def columns(file):
    """The columns of a CSV file as numpy arrays by name."""
    import numpy as np

    with open(file, newline="") as lines:
        rows = list(csv.reader(lines))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


def table(head, rows):
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in [head, ["---"] * len(head), *rows])


class Bounds:
    """Bounds on measured values: printed as they are judged."""

    def __init__(self):
        self.rows, self.missed = [], 0

    def within(self, what, measured, reference, percent):
        """|measured / reference - 1| <= percent."""
        off = 100 * (measured / reference - 1)
        self.judge(what, f"{measured:.4g}, {off:+.2f} % of {reference:.4g}", f"{percent} %", abs(off) <= percent)

    def below(self, what, measured, limit):
        self.judge(what, f"{measured:.3g}", f"<= {limit:g}", measured <= limit)

    def judge(self, what, measured, bound, holds):
        self.missed += not holds
        self.rows.append([what, measured, bound, "pass" if holds else "**missed**"])
        print(f"{'pass' if holds else 'MISSED'}: {what}: {measured} (bound {bound})", flush=True)

    def markdown(self):
        return table(["bound on", "measured", "bound", ""], self.rows)


def update_readme(folder, text):
    readme = folder / "README.md"
    before, rest = readme.read_text().split(START)
    readme.write_text(before + START + "\n" + text.strip() + "\n" + END + rest.split(END)[1])
