#!/usr/bin/python3
"""Capsules in unbounded shear flow without inertia by a boundary integral that shares nothing with Pliant but meshes: what the
runs in boxes should tend to, measured in the same way. Writes CSV files beside itself and a table into ../README.md."""
import argparse
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))
import bodies_in_shear as surfaces  # noqa: E402
import common  # noqa: E402

# law, Ca_E (springs: Ca_G): end, time step
RUNS = {("neo-hookean", 0.2): (8, 0.05), ("neo-hookean", 0.05): (5, 0.025), ("neo-hookean", 0.0125): (2, 0.008), ("springs", 0.02): (1, 0.0035)}
FRAMES = 40
MARKS = "<!-- boundary integral: written by reference/boundary_integral.py -->", "<!-- end of boundary integral -->"


def by_moments(x, faces):
    """D of the ellipsoid with the moments of what the surface encloses, and the angle of its longest axis to the flow."""
    corners = [x[faces[:, k]] for k in range(3)]
    volumes = np.einsum("ij,ij->i", corners[0], np.cross(corners[1], corners[2]))
    moments = sum(np.einsum("f,fi,fj->ij", volumes, p, p) for p in (*corners, sum(corners)))
    values, vectors = np.linalg.eigh(moments)
    axes, long = np.sqrt(values), vectors[:, 2]
    return (axes[2] - axes[0]) / (axes[2] + axes[0]), np.degrees(np.arctan(long[2] / long[0]))


def run(program, binary, law, capillary, frequency, out):
    """Time, D by radii, D by moments, angle."""
    mesh = out / f"sphere-{frequency}.obj"
    subprocess.run([binary, "mesh", "sphere", "--frequency", str(frequency), "--radius", "1", "-o", mesh], check=True, stdout=subprocess.DEVNULL)
    faces = np.array([[int(v) - 1 for v in line.split()[1:4]] for line in mesh.read_text().splitlines() if line.startswith("f ")])
    end, step = RUNS[law, capillary]
    in_shear = 3 * capillary if law == "neo-hookean" else capillary
    words = [program, mesh, law, str(in_shear), str(end), str(step), str(FRAMES)]
    frames = np.frombuffer(subprocess.run(words, check=True, stdout=subprocess.PIPE).stdout).reshape(FRAMES + 1, -1, 3)
    rows = []
    for n, x in enumerate(frames):
        about = x - surfaces.centroid(x, faces)
        radii = np.linalg.norm(about, axis=1)
        longest, least = (surfaces.extreme_radius(about, radii, sign) for sign in (1, -1))
        rows.append([end * n / FRAMES, (longest - least) / (longest + least), *(by_moments(about, faces) if n else (0.0, 45.0))])
    return np.array(rows)


def table(rows):
    """D and angles of each mesh, and D at 1/vertices -> 0: straight line through the two finest."""
    lines = []
    for law, capillary in RUNS:
        of_run = [row for row in rows if row[0] == law and float(row[1]) == capillary]
        lines += of_run
        if len(of_run) > 1:
            coarse, fine = (1 / int(row[2]) for row in of_run[-2:])
            ends = [float(last) + (float(last) - float(first)) * fine / (coarse - fine) for first, last in zip(of_run[-2][3:], of_run[-1][3:])]
            lines.append([law, capillary, "extrapolated", f"{ends[0]:.4f}", f"{ends[1]:.4f}", f"{ends[2]:.2f}"])
    return common.markdown_table(["law", "Ca_E; springs: Ca_G", "vertices", "D", "D by moments", "angle"], lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frequencies", type=int, nargs="+", default=[4, 6, 8], help="of the meshes: 10 f^2 + 2 vertices")
    parser.add_argument("--binary", help="the program that makes the meshes")
    parser.add_argument("--out", type=Path, default=common.REPOSITORY / "out" / "boundary-integral")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    binary, program = common.find_binary(arguments.binary), arguments.out / "boundary_integral"
    subprocess.run(["c++", "-O3", "-march=native", "-ffast-math", "-std=c++20", HERE / "boundary_integral.cpp", "-o", program], check=True)
    rows = []
    for law, capillary in RUNS:
        for frequency in arguments.frequencies:
            found = run(program, binary, law, capillary, frequency, arguments.out)
            window = found[:, 0] > 0.8 * found[-1, 0] - 1e-9
            d, moments, angle = found[window, 1:].mean(axis=0)
            rows.append([law, capillary, 10 * frequency**2 + 2, f"{d:.4f}", f"{moments:.4f}", f"{angle:.2f}"])
            print(*rows[-1], flush=True)
            if frequency == max(arguments.frequencies) and law == "neo-hookean":
                lines = ["time,D"] + [f"{t:.3f},{value:.5f}" for t, value in found[:, :2]]
                (HERE / f"boundary-integral-ca{capillary:g}.csv").write_text("\n".join(lines) + "\n")
    header = ["law", "capillary", "vertices", "D", "D_by_moments", "angle"]
    (HERE / "boundary-integral.csv").write_text("\n".join(",".join(map(str, row)) for row in [header, *rows]) + "\n")
    common.update_readme(HERE.parent / "README.md", table(rows), *MARKS)


if __name__ == "__main__":
    main()
