"""What the checks of several cases share: running the program, reading what it leaves, judging, tables."""
import csv
import json
import os
import shlex
import subprocess
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]


class RunFailed(Exception):
    pass


def find_binary(given=None):
    """The program: `given`, else $PLIANT, else the release build."""
    for path in [given] if given else [os.environ.get("PLIANT"), REPOSITORY / "build/release/pliant",
                                       REPOSITORY / "build/portable/pliant"]:
        if path and Path(path).is_file():
            return Path(path).resolve()
    raise RunFailed(f"no program at {given or REPOSITORY / 'build/release/pliant'}: build it, or name it with --binary")


def toml_value(value):
    """A value as --set takes it."""
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


class Run:
    """One run of a case file; `settings` go to --set."""

    def __init__(self, case_file, out, settings):
        self.case_file, self.out, self.settings = Path(case_file), Path(out), dict(settings)

    def command(self, binary):
        options = [part for key, value in self.settings.items() for part in ("--set", f"{key}={toml_value(value)}")]
        return [str(binary), "run", str(self.case_file), *options, "--out", str(self.out)]

    def execute(self, binary, reuse=False):
        """Runs the program, unless the outputs of the same command are there and `reuse` is wanted."""
        stamp = self.out / "command.txt"
        line = shlex.join(self.command("pliant")) + "\n"
        if reuse and stamp.is_file() and stamp.read_text() == line and self.report()["status"] == "finished":
            print(f"{self.out.name}: kept", flush=True)
            return
        self.out.mkdir(parents=True, exist_ok=True)
        stamp.unlink(missing_ok=True)
        start = time.monotonic()
        done = subprocess.run(self.command(binary), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, text=True)
        if done.returncode != 0:
            raise RunFailed(f"{self.out.name}: exit code {done.returncode}\n{done.stdout.strip()[-800:]}")
        stamp.write_text(line)
        print(f"{self.out.name}: {time.monotonic() - start:.0f} s", flush=True)

    def report(self):
        return json.loads((self.out / "run.json").read_text())

    def body(self, name):
        """The table of a body: column name to list of numbers."""
        with open(self.out / "bodies" / f"{name}.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return {key: [float(row[key]) for row in rows] for key in rows[0]} if rows else {}

    def last(self, pattern):
        """The newest of the files that match, such as fields/fields_*.h5."""
        return sorted(self.out.glob(pattern))[-1]


class Verdict:
    """Bounds with what was measured."""

    def __init__(self):
        self.lines, self.passes = [], True

    def within(self, what, value, low, high, unit=""):
        met = low <= value <= high
        self.passes &= met
        self.lines.append((what, f"{value:.4g}{unit}", f"{low:g} to {high:g}{unit}", "pass" if met else "**MISSED**"))
        return met

    def markdown(self):
        return markdown_table(["bound", "measured", "allowed", ""], self.lines)


def markdown_table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


START, END = "<!-- measured: written by check.py --update-readme -->", "<!-- end of measured -->"


def update_readme(readme, text):
    """Puts the text between the two marks of a README."""
    before, rest = readme.read_text().split(START)
    readme.write_text(before + START + "\n" + text + END + rest.split(END)[1])


def how_measured(report, command):
    """One line for the README: what ran."""
    program = report["program"]
    return (f"Measured by `{command}` (Pliant {program.get('version', '?')}, commit {program.get('commit', '?')}, "
            f"{program.get('compiler', '?')}), one core.\n")
