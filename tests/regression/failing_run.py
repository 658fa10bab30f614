#!/usr/bin/env python3
"""Runs that cannot finish end with the right exit code, in time, and leave readable output.

Usage: failing_run.py PROGRAM MPIRUN [MPIRUN-OPTION]...
"""
import csv
import json
import os
import resource
import signal
import subprocess
import sys
import time

import surfaces
from harness import BODY, CASE, Harness, expect, write

harness = Harness(sys.argv[1], sys.argv[2:])
ENDLESS = CASE.replace("end = 0.05", "end = 1e6") + "surfaces.every = 1\nfields.every = 5\n" + BODY


def prepare(folder, text):
    write(folder, "case.toml", text)
    write(folder, "drop.gts", surfaces.sound())
    return os.path.join(folder, "out")


def read_history(out):
    """The rows of history.csv; fails on a line that is cut."""
    with open(os.path.join(out, "history.csv")) as stream:
        rows = list(csv.reader(stream))
    expect(all(len(row) == len(rows[0]) for row in rows), "history.csv has a line that is cut")
    return [[float(value) for value in row] for row in rows[1:]]


def expect_readable(out, rows_at_least):
    expect(len(read_history(out)) >= rows_at_least, "history.csv has too few lines")
    with open(os.path.join(out, "run.json")) as stream:
        json.load(stream)
    for folder, _, names in os.walk(out):
        for name in names:
            expect(not name.endswith(".tmp"), "a temporary file is left: " + os.path.join(folder, name))


def output_below_a_file(ranks):
    def test(folder):
        prepare(folder, CASE + BODY)
        blocked = write(folder, "file", "in the way") + "/out"
        result = harness.run("run", folder, "--out", blocked, ranks=ranks)
        expect(result.returncode in (2, 3), "exit code 2 or 3 expected", result)
        expect("file" in result.stderr, "the message does not name the folder", result)
    return test


def wait_for_rows(process, out):
    """Until the run has written a few lines of its history."""
    give_up = time.monotonic() + 40
    while time.monotonic() < give_up and process.poll() is None:
        if os.path.exists(os.path.join(out, "history.csv")) and len(read_history(out)) > 3:
            return
        time.sleep(0.05)
    process.kill()
    result = harness.finish(process, 30)
    expect(False, "the run does not get under way", result)


def interrupted(number, ranks):
    def test(folder):
        out = prepare(folder, ENDLESS)
        process = harness.start("run", folder, "--out", out, ranks=ranks)
        wait_for_rows(process, out)
        process.send_signal(number)
        result = harness.finish(process, 30)
        expect_readable(out, 3)
        # On one rank the shell's code for the signal; mpirun has codes of its own.
        expect(result.returncode == 128 + number if ranks == 1 else result.returncode > 0,
               "an exit code that tells the signal is expected", result)
    return test


def file_limit(series):
    return lambda folder: run_into_limit(folder, CASE.replace("end = 0.05", "end = 1e6") + series + " = 1\n" + BODY)


def run_into_limit(folder, text):
    """A limit on the size of files: writes fail as on a full disk, without the right to mount.

    The limit comes once the run is going: MPI's own files are larger."""
    out = prepare(folder, text)
    process = harness.start("run", folder, "--out", out, restore_signals=False,
                            preexec_fn=lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    wait_for_rows(process, out)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (2048, 2048))
    result = harness.finish(process, 30)
    expect(result.returncode == 3, "exit code 3 expected", result)
    expect(out in result.stderr, "the message does not name the file", result)
    expect_readable(out, 3)


def full_disk(ranks):
    def test(folder):
        disk = os.path.join(folder, "disk")
        os.mkdir(disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", disk], stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True)
        if mounted.returncode != 0:
            return "a small tmpfs cannot be mounted here: " + mounted.stdout.strip()
        try:
            prepare(folder, ENDLESS)
            out = os.path.join(disk, "out")
            result = harness.run("run", folder, "--out", out, ranks=ranks, timeout=120)
            expect(result.returncode == 3, "exit code 3 expected", result)
            expect(out in result.stderr, "the message does not name the file", result)
            expect("No space left" in result.stderr, "the message does not say that the disk is full", result)
            read_history(out)
        finally:
            subprocess.run(["umount", disk], check=False)
    return test


harness.check("output folder below a file", output_below_a_file(1))
harness.check("output folder below a file, 2 ranks", output_below_a_file(2))
harness.check("SIGTERM", interrupted(signal.SIGTERM, 1))
harness.check("Ctrl-C", interrupted(signal.SIGINT, 1))
harness.check("SIGTERM to mpirun of 2 ranks", interrupted(signal.SIGTERM, 2))
harness.check("surface files limited in size", file_limit("surfaces.every"))
harness.check("field files limited in size", file_limit("fields.every"))
harness.check("full disk", full_disk(1))
harness.check("full disk, 2 ranks", full_disk(2))

sys.exit(harness.report())
