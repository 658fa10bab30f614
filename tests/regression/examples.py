#!/usr/bin/env python3
"""The cases of docs/examples are sound and run.

Usage: examples.py PROGRAM MPIRUN [MPIRUN-OPTION]...
"""
import glob
import os
import sys

from harness import Harness, expect

harness = Harness(sys.argv[1], sys.argv[2:])
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "examples")


def example(path):
    def test(folder):
        result = harness.run("run", path, "--out", os.path.join(folder, "out"), "--max-steps", "3", ranks=2)
        expect(result.returncode == 0, "does not run", result)
    harness.check(os.path.basename(path), test)


cases = sorted(glob.glob(os.path.join(FOLDER, "*.toml")))
harness.check("there are examples", lambda folder: expect(cases, "no case in " + FOLDER))
for case in cases:
    example(case)

sys.exit(harness.report())
