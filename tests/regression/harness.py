"""Runs the program on small cases and checks how it ends."""
import os
import re
import subprocess
import tempfile
import traceback

CASE = """
[box]
size = [4, 4, 4]
origin = [-2, -2, -2]
cells = [8, 8, 8]
[boundary]
z = "wall"
[time]
end = 0.05
step = 0.01
[output]
history.every = 1
"""

BODY = """
[[body]]
name = "drop"
surface = { file = "drop.gts" }
coupling = "one-way"
traction = { form = "drag" }
[body.potentials]
edge = { stiffness = 1 }
"""


class Failure(Exception):
    pass


def expect(condition, what, result=None):
    if not condition:
        said = "" if result is None else "\n  exit code {}\n  stdout: {}\n  stderr: {}".format(
            result.returncode, result.stdout[-2000:], result.stderr[-2000:])
        raise Failure(what + said)


class Harness:
    def __init__(self, program, mpirun):
        self.program, self.mpirun = program, mpirun
        self.failed, self.skipped, self.passed = [], [], 0

    def command(self, *arguments, ranks=1):
        launcher = [] if ranks == 1 else self.mpirun + ["-n", str(ranks)]
        return launcher + [self.program] + [str(a) for a in arguments]

    @staticmethod
    def environment():
        return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                    OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl_vader_single_copy_mechanism="none")

    def run(self, *arguments, ranks=1, timeout=60, **options):
        command = self.command(*arguments, ranks=ranks)
        try:
            return subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  timeout=timeout, encoding="utf-8", errors="replace", env=self.environment(),
                                  **options)
        except subprocess.TimeoutExpired:
            raise Failure("does not end within {} s: {}".format(timeout, " ".join(command)))

    def start(self, *arguments, ranks=1, **options):
        return subprocess.Popen(self.command(*arguments, ranks=ranks), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, env=self.environment(), **options)

    @staticmethod
    def finish(process, timeout=60):
        """The result of a run that was started, when it has ended."""
        try:
            stdout, stderr = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Failure("does not end within {} s".format(timeout))
        return subprocess.CompletedProcess(process.args, process.returncode, stdout, stderr)

    def refuses(self, arguments, patterns, code=2, ranks=1, **options):
        """The program ends with `code`, and its messages match every pattern."""
        result = self.run(*arguments, ranks=ranks, **options)
        expect(result.returncode == code, "exit code {} expected".format(code), result)
        for pattern in patterns:
            expect(re.search(pattern, result.stderr), "no /{}/ in the messages".format(pattern), result)
        return result

    def check(self, name, test):
        """Runs one test in a folder of its own; a returned text says why it was skipped."""
        with tempfile.TemporaryDirectory(prefix="pliant-") as folder:
            try:
                reason = test(folder)
            except Failure as failure:
                print("FAILED  {}: {}".format(name, failure), flush=True)
                return self.failed.append(name)
            except Exception:
                print("FAILED  {}: {}".format(name, traceback.format_exc()), flush=True)
                return self.failed.append(name)
        if reason:
            print("skipped {}: {}".format(name, reason), flush=True)
            return self.skipped.append(name)
        print("passed  {}".format(name), flush=True)
        self.passed += 1

    def report(self):
        print("{} passed, {} skipped, {} failed{}".format(self.passed, len(self.skipped), len(self.failed),
                                                          "".join(": " + n for n in self.failed)))
        return 1 if self.failed else 0


def write(folder, name, text):
    path = os.path.join(folder, name)
    mode = "wb" if isinstance(text, bytes) else "w"
    with open(path, mode) as stream:
        stream.write(text)
    return path
