#!/usr/bin/env python3
"""A run that is killed again and again, and continued each time, leaves the outputs of one that is left alone.

Usage: restart.py PROGRAM MPIRUN [MPIRUN-OPTION]...
"""
import json
import os
import random
import re
import resource
import shutil
import signal
import sys
import time

import surfaces
from harness import BODY, CASE, Harness, expect, write

harness = Harness(sys.argv[1], sys.argv[2:])
# A drop that drifts through a periodic box; the step follows the flow.
ENDLESS = (CASE.replace("step = 0.01", "cfl = 0.3").replace("end = 0.05", "end = 1e6").replace('"wall"', '"periodic"')
           .replace("history.every = 1", "history.every = 7\nfields.interval = 9.0\nsurfaces.every = 90")
           + '[initial]\nflow = "perturbed"\n[fluid]\nviscosity = 0.002\n'
           + '[forcing]\nbulk_velocity = { axis = "x", value = 1 }\n[checkpoint]\nevery = 40\n' + BODY)


def long_case(steps):
    return ENDLESS.replace("end = 1e6", "end = 1e6\nmax_steps = {}".format(steps))


def prepare(folder, text):
    write(folder, "case.toml", text)
    write(folder, "drop.gts", surfaces.sound())


def start(folder, out, *options, ranks=1):
    return harness.start("run", folder, "--out", out, *options, ranks=ranks)


def last_step(out):
    try:
        with open(os.path.join(out, "history.csv"), "rb") as stream:
            stream.seek(0, os.SEEK_END)
            stream.seek(max(0, stream.tell() - 400))
            lines = stream.read().decode().splitlines()
        return int(lines[-1].split(",")[0]) if len(lines) > 1 else -1
    except (OSError, ValueError):
        return -1


def checkpoints(out):
    folder = os.path.join(out, "checkpoints")
    names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
    return [os.path.join(folder, name) for name in names if name.endswith(".checkpoint")]


def ranks_of(process):
    """The process ids of the program under mpirun."""
    found = []
    for name in os.listdir("/proc"):
        try:
            with open("/proc/{}/stat".format(name)) as stream:
                if int(stream.read().rsplit(")", 1)[1].split()[1]) == process.pid:
                    found.append(int(name))
        except (OSError, ValueError, IndexError):
            continue
    return found


def kill(process, number, ranks):
    if ranks == 1 or number == signal.SIGTERM:
        process.send_signal(number)
    else:
        # One rank dies; mpirun then ends the others.
        for pid in ranks_of(process)[:1]:
            os.kill(pid, number)


def restarts(out):
    """How many restarts the report of a run tells."""
    try:
        with open(os.path.join(out, "run.json")) as stream:
            return len(json.load(stream).get("restarts", []))
    except FileNotFoundError:
        return 0


def files_of(out):
    """All that must be the same: everything but the report, which holds times of the clock, and the checkpoints."""
    files = {}
    for folder, _, names in os.walk(out):
        for name in names:
            path = os.path.relpath(os.path.join(folder, name), out)
            if path != "run.json" and not path.startswith("checkpoints"):
                with open(os.path.join(folder, name), "rb") as stream:
                    files[path] = stream.read()
    return files


def expect_same(whole, other):
    a, b = files_of(whole), files_of(other)
    expect(sorted(a) == sorted(b), "other files: {}".format(sorted(set(a) ^ set(b))))
    for path in a:
        expect(a[path] == b[path], "{} differs".format(path))


def killed_often(kills, steps, ranks):
    def test(folder):
        dice = random.Random(8)
        prepare(folder, long_case(steps))
        whole, out = os.path.join(folder, "whole"), os.path.join(folder, "out")
        result = harness.finish(start(folder, whole, ranks=ranks))
        expect(result.returncode == 0, "the undisturbed run fails", result)
        signals = []
        moments = sorted(dice.randrange(steps - 50) for _ in range(kills))
        noted = 0
        for turn, moment in enumerate(moments):
            again = bool(checkpoints(out))
            process = start(folder, out, *(["--restart"] if again else []), ranks=ranks)
            # Every other run may be killed before it has begun; the others go on from their checkpoint first.
            begun = restarts(out) + 1 if again and turn % 2 == 0 else 0
            while process.poll() is None and (last_step(out) < moment or restarts(out) < begun):
                time.sleep(0.002)
            noted += begun > 0
            time.sleep(0.02 * dice.random())
            number = dice.choice([signal.SIGKILL, signal.SIGTERM])
            signals.append(number)
            kill(process, number, ranks)
            result = harness.finish(process)
            expect(result.returncode not in (2, 3), "the run failed by itself", result)
        expect(set(signals) == {signal.SIGKILL, signal.SIGTERM}, "both signals are tried")
        result = harness.finish(start(folder, out, "--restart", ranks=ranks))
        expect(result.returncode == 0, "the last part fails", result)
        expect_same(whole, out)
        with open(os.path.join(out, "run.json")) as stream:
            report = json.load(stream)
        expect(report["status"] == "finished" and len(report["restarts"]) > noted, "run.json tells the restarts")
    return test


def short_run(folder, ranks=1):
    prepare(folder, long_case(60))
    out = os.path.join(folder, "out")
    result = harness.finish(start(folder, out, ranks=ranks))
    expect(result.returncode == 0, "the first run fails", result)
    expect([os.path.basename(p) for p in checkpoints(out)] == ["step_000040.checkpoint", "step_000060.checkpoint"],
           "checkpoints of steps 40 and 60 are expected")
    return out


def damaged(ranks):
    def test(folder):
        out = short_run(folder, ranks)
        older, newer = checkpoints(out)
        with open(newer, "r+b") as stream:
            stream.seek(os.path.getsize(newer) // 2)
            byte = stream.read(1)[0]
            stream.seek(-1, os.SEEK_CUR)
            stream.write(bytes([byte ^ 1]))
        harness.refuses(["run", folder, "--out", out, "--restart", newer],
                        [re.escape(newer) + " is damaged: row .* checksum", "--restart " + re.escape(older)], ranks=ranks)
        result = harness.finish(start(folder, out, "--restart", ranks=ranks))
        expect(result.returncode == 0, "the older checkpoint is not taken", result)
        expect("warning" in result.stdout + result.stderr and newer in result.stdout + result.stderr,
               "nothing is said of the damaged checkpoint", result)
    return test


def foreign(folder):
    out = short_run(folder)
    harness.refuses(["run", folder, "--out", out, "--restart", "--set", "fluid.viscosity=0.5"],
                    [r"another case: fluid\.viscosity is 0\.5 in the case, 0\.002 in the checkpoint"])
    surface = surfaces.gts(*surfaces.octahedron(0.9))
    write(folder, "drop.gts", surface)
    harness.refuses(["run", folder, "--out", out, "--restart"], [r"body\.drop\.surface.*contents"])
    write(folder, "drop.gts", surfaces.sound())
    # What was there is as it was.
    result = harness.finish(start(folder, out, "--restart", "--max-steps", "70"))
    expect(result.returncode == 0, "the run cannot go on after refusals", result)
    expect(last_step(out) == 70, "step 70 is expected at the end")


def no_checkpoint(folder):
    prepare(folder, ENDLESS)
    harness.refuses(["run", folder, "--out", os.path.join(folder, "out"), "--restart"], ["no checkpoint to continue from"])
    harness.refuses(["run", folder, "--restart", os.path.join(folder, "never")], ["never cannot be opened"])
    harness.refuses(["run", folder, "--wall-clock", "soon"], ["--wall-clock soon is not a time"])


def wall_clock(ranks):
    def test(folder):
        prepare(folder, ENDLESS)
        out = os.path.join(folder, "out")
        begin = time.monotonic()
        result = harness.finish(start(folder, out, "--wall-clock", "00:00:04", ranks=ranks))
        elapsed = time.monotonic() - begin
        expect(result.returncode == 0, "a good end is expected", result)
        expect(1 < elapsed < 6, "takes {:.1f} s".format(elapsed))  # with the start and end of mpirun
        with open(os.path.join(out, "run.json")) as stream:
            report = json.load(stream)
        expect(report["status"] == "stopped by the wall clock" and report["wall_seconds"] < 4, "in time", result)
        expect(checkpoints(out)[-1].endswith("step_{:06d}.checkpoint".format(report["steps"])),
               "no checkpoint of the last step")
    return test


def full_disk(folder):
    """A limit on the size of files stands for the full disk; it comes once checkpoints are there, the only large files."""
    prepare(folder, ENDLESS.replace("history.every = 7", "history.every = 1000").replace("surfaces.every = 90\n", ""))
    out = os.path.join(folder, "out")
    process = harness.start("run", folder, "--out", out, restore_signals=False,
                            preexec_fn=lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN))
    while process.poll() is None and len(checkpoints(out)) < 2:
        time.sleep(0.01)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (8192, 8192))
    result = harness.finish(process)
    expect(result.returncode == 3, "exit code 3 expected", result)
    expect(re.search(r"error: cannot .*step_\d+\.checkpoint\.tmp", result.stderr), "the file is not named", result)
    expect(not [name for name in os.listdir(os.path.join(out, "checkpoints")) if name.endswith(".tmp")],
           "a part of a checkpoint is left")
    expect(len(checkpoints(out)) == 2, "the older checkpoints are gone")
    step = int(re.search(r"_(\d+)\.", checkpoints(out)[-1]).group(1))
    result = harness.finish(start(folder, out, "--restart", "--max-steps", str(step + 5)))
    expect(result.returncode == 0, "the run cannot go on", result)


def lost_table(folder):
    out = short_run(folder)
    shutil.copytree(out, out + "2")
    os.remove(os.path.join(out, "history.csv"))
    harness.refuses(["run", folder, "--out", out, "--restart"], [r"history\.csv", "--out DIR"])
    with open(os.path.join(out + "2", "bodies", "drop.csv"), "r+b") as stream:
        stream.truncate(100)
    harness.refuses(["run", folder, "--out", out + "2", "--restart"], [r"drop\.csv has 100 bytes, but had"])


harness.check("20 kills", killed_often(20, 1500, 1))
harness.check("5 kills of 2 ranks", killed_often(5, 400, 2))
harness.check("damaged checkpoint", damaged(1))
harness.check("damaged checkpoint, 2 ranks", damaged(2))
harness.check("foreign checkpoint", foreign)
harness.check("no checkpoint", no_checkpoint)
harness.check("full disk", full_disk)
harness.check("lost tables", lost_table)
harness.check("wall clock", wall_clock(1))
harness.check("wall clock, 2 ranks", wall_clock(2))

sys.exit(harness.report())
