"""pliant bench transfer: what it reports, on any number of ranks, and what it refuses."""
import json
import sys

from harness import Harness, expect

harness = Harness(sys.argv[1], sys.argv[2:])
SMALL = ["bench", "transfer", "--markers", "203", "--repeats", "1", "--json"]
PARTS = {"stencil", "interpolation", "spreading", "probe", "placing", "step_of_run"}


def reports(ranks, *arguments):
    def test(_):
        result = harness.run(*SMALL, *arguments, ranks=ranks)
        expect(result.returncode == 0, "exit code 0 expected", result)
        report = json.loads(result.stdout)
        expect(report["ranks"] == ranks and report["markers"] == 203, "another run was reported", result)
        for key in ("ns_per_marker_step", "ns_per_marker_step_generic", "ns_per_marker_step_generic_lean"):
            expect(report[key] > 0, key + " is not positive", result)
        expect(set(report["ns_per_marker"]) == PARTS, "the parts are not those of the documentation", result)
        # The closed form is that of the solves: only round-off is left between them.
        expect(report["largest_difference"] < 1e-11, "closed form and 4 x 4 solves differ", result)
    return test


def refused(arguments, *patterns):
    def test(_):
        harness.refuses(["bench", "transfer", *arguments], patterns)
    return test


harness.check("periodic", reports(1, "--cells", "12", "11", "13", "--boundary", "periodic"))
harness.check("closed, stretched", reports(1, "--cells", "12", "11", "13", "--boundary", "closed", "--stretching", "tanh"))
harness.check("3 ranks, periodic", reports(3, "--cells", "12", "11", "13", "--boundary", "periodic", "--order", "random"))
harness.check("3 ranks, thin slabs", reports(3, "--cells", "3", "5", "4", "--boundary", "channel"))
harness.check("no markers", refused(["--markers", "0"], "--markers"))
harness.check("too few cells", refused(["--cells", "2", "8", "1"], "2 along x", "1 along z", "2 problems"))
harness.check("unknown order", refused(["--order", "sorted"], "--order"))

sys.exit(harness.report())
