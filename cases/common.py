"""What the checks of the cases share: running the program, reading what it leaves, judging by bounds, tables, READMEs."""
import argparse
import csv
import json
import os
import random
import shlex
import subprocess
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
START, END = "<!-- measured: written by check.py --update-readme -->", "<!-- end of measured -->"


class RunFailed(SystemExit):
    """A run did not end as it should; ends the check with the reason unless someone deals with it."""


def find_binary(given=None):
    """The program: `given`, else $PLIANT, else the release build."""
    for path in [given] if given else [os.environ.get("PLIANT"), REPOSITORY / "build/release/pliant",
                                       REPOSITORY / "build/portable/pliant"]:
        if path and Path(path).is_file():
            return Path(path).resolve()
    raise RunFailed(f"no program at {given or REPOSITORY / 'build/release/pliant'}: build it, or name it with --binary")


def shaken_plate(arguments, name, size, edge, shake):
    """File of a plate whose inner vertices are moved at random in its plane, by up to `shake` edges."""
    file = arguments.out / f"{name}.obj"
    subprocess.run([arguments.binary, "mesh", "plate", "--size", *map(str, size), "--edge", str(edge), "-o", file], check=True,
                   stdout=subprocess.DEVNULL)
    chance = random.Random(1)
    lines = []
    for line in file.read_text().splitlines():
        if line.startswith("v "):
            x, y, z = map(float, line.split()[1:4])
            if abs(abs(x) - size[0] / 2) > 1e-6 and abs(abs(y) - size[1] / 2) > 1e-6:
                x, y = (q + shake * edge * chance.uniform(-1, 1) for q in (x, y))
            line = f"v {x!r} {y!r} {z!r}"
        lines.append(line)
    file.write_text("\n".join(lines) + "\n")
    return file


def positive(text):
    """A whole number above 0, for argparse."""
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def read_arguments(description, name, quick="only the runs that take minutes", further=None):
    """The options that checks share; `further(parser)` adds those of one check."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quick", action="store_true", help=quick)
    parser.add_argument("--reuse", action="store_true", help="keep finished runs of the same settings")
    parser.add_argument("--binary", help="the program (default: build/release/pliant)")
    parser.add_argument("--out", type=Path, default=REPOSITORY / "out" / name, help="folder for everything")
    parser.add_argument("--update-readme", action="store_true", help="put tables and figure into the case's folder")
    if further is not None:
        further(parser)
    arguments = parser.parse_args()
    if arguments.quick and arguments.update_readme:
        parser.error("--update-readme needs all runs")
    arguments.binary = find_binary(arguments.binary)
    arguments.out.mkdir(parents=True, exist_ok=True)
    return arguments


def conclude(arguments, case, text, bounds, draw):
    """Leaves the text and the figure that draw(file) makes in OUT, or in the case's folder if its README is to be brought up
    to date. Returns the exit code."""
    (arguments.out / "results.md").write_text(text.strip() + "\n")
    picture = (case if arguments.update_readme else arguments.out) / f"{case.name}.png"
    draw(picture)
    if arguments.update_readme:
        update_readme(case / "README.md", text)
    print(f"\n{text}\nFigure: {os.path.relpath(picture)}\n{'PASS' if bounds.passes else 'FAIL'}")
    return 0 if bounds.passes else 1


def toml_value(value):
    """A value as --set takes it."""
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k} = {json.dumps(v) if isinstance(v, str) else toml_value(v)}" for k, v in value.items()) + "}"
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


class Run:
    """One run of a case file; `settings` go to --set. Its words are in OUT.log."""

    def __init__(self, case_file, out, settings):
        self.case_file, self.out, self.settings = Path(case_file), Path(out), dict(settings)

    def command(self, binary):
        options = [part for key, value in self.settings.items() for part in ("--set", f"{key}={toml_value(value)}")]
        return [str(binary), "run", str(self.case_file), *options, "--out", str(self.out)]

    def execute(self, binary, reuse=False, expected=0):
        """Runs the program, unless the outputs of the same command are there and `reuse` is wanted. Raises RunFailed if the
        exit code is not the expected one."""
        stamp = self.out / "command.txt"
        line = shlex.join(self.command("pliant")) + "\n"
        if reuse and stamp.is_file() and stamp.read_text() == line:
            print(f"{self.out.name}: kept", flush=True)
            return
        self.out.mkdir(parents=True, exist_ok=True)
        stamp.unlink(missing_ok=True)
        start = time.monotonic()
        with open(self.log_file(), "w") as log:
            code = subprocess.run(self.command(binary), stdout=log, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL).returncode
        if code != expected:
            raise RunFailed(f"{self.out.name} ended with code {code}, not {expected}:\n{self.log().strip()[-1500:]}")
        stamp.write_text(line)
        print(f"{self.out.name}: {time.monotonic() - start:.0f} s", flush=True)

    def log_file(self):
        return self.out.with_name(self.out.name + ".log")

    def log(self):
        return self.log_file().read_text()

    def report(self):
        return report(self.out)

    def body(self, name):
        """The table of a body: column name to numbers."""
        return read_table(self.out / "bodies" / f"{name}.csv")

    def last(self, pattern):
        """The newest of the files that match, such as fields/fields_*.h5."""
        return sorted(self.out.glob(pattern))[-1]


def run(arguments, name, file, settings=None):
    """Runs a case into OUT/name without checkpoints, or keeps what is there (--reuse); returns the folder."""
    one = Run(file, arguments.out / name, {**(settings or {}), "checkpoint.keep": 0})
    one.execute(arguments.binary, arguments.reuse)
    return one.out


class Runner:
    """Runs one case with many settings."""

    def __init__(self, case, out, binary=None, reuse=False):
        self.case, self.out, self.binary, self.reuse = Path(case), Path(out), find_binary(binary), reuse

    def run(self, name, settings, expected=0):
        one = Run(self.case, self.out / name, settings)
        one.execute(self.binary, self.reuse, expected)
        return one.out

    def log(self, name):
        return Run(self.case, self.out / name, {}).log()


def report(out):
    return json.loads((Path(out) / "run.json").read_text())


def wall_seconds(out):
    return report(out)["wall_seconds"]


def read_table(file):
    """The columns of a CSV file as numpy arrays by name."""
    import numpy as np

    with open(file, newline="") as lines:
        rows = list(csv.reader(lines))
    return {name: np.array([float(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0])}


class Bounds:
    """Bounds on what is measured, printed as they are judged."""

    def __init__(self):
        self.rows, self.passes = [], True

    def add(self, what, measured, bound, holds):
        self.passes &= bool(holds)
        self.rows.append([what, measured, bound, "pass" if holds else "**missed**"])
        print(f"{'pass' if holds else 'MISSED'}: {what}: {measured} (bound {bound})", flush=True)

    def within(self, what, value, low, high, unit=""):
        self.add(what, f"{value:.4g}{unit}", f"{low:g} to {high:g}{unit}", low <= value <= high)

    def near(self, what, value, reference, percent):
        """|value / reference - 1| <= percent."""
        off = 100 * (value / reference - 1)
        self.add(what, f"{value:.4g}, {off:+.2f} % of {reference:.4g}", f"{percent} %", abs(off) <= percent)

    def at_most(self, what, value, bound, unit=""):
        self.add(what, f"{value:.4g}{unit}", f"at most {bound:g}{unit}", value <= bound)

    def at_least(self, what, value, bound, unit=""):
        self.add(what, f"{value:.4g}{unit}", f"at least {bound:g}{unit}", value >= bound)

    def markdown(self):
        return markdown_table(["bound on", "measured", "bound", ""], self.rows)


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def update_readme(readme, text, start=START, end=END):
    """Puts the text between the two marks of a README."""
    before, rest = readme.read_text().split(start)
    readme.write_text(before + start + "\n" + text.strip() + "\n" + end + rest.split(end, 1)[1])


def how_measured(run_report, command):
    """One line for the README: what ran."""
    program = run_report["program"]
    return (f"Measured by `{command}` (Pliant {program.get('version', '?')}, commit {program.get('commit', '?')}, "
            f"{program.get('compiler', '?')}), one core.\n")
