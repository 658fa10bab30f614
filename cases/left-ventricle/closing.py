#!/usr/bin/python3
"""The natural valve by itself under an even pressure from below, without flow: what part of the orifice stays open, seen along
its axis, with the sizes of the case and with earlier ones. Seconds: a first look at other sizes. See README.md."""
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

CASE = Path(__file__).resolve().parent
sys.path.insert(0, str(CASE.parent))
import common  # noqa: E402

# In rho U^2: about what the aortic orifice makes of the strongest ejection.
PRESSURE = 1.5
AROUND = """title = "Closing of the natural valve"
[units]
length   = "25 mm"
velocity = "0.2 m/s"
density  = "1000 kg/m^3"
[box]
size   = [3, 3, 4]
origin = [-1.5, -1.5, -3]
cells  = [8, 8, 8]
[fluid]
density   = 1
viscosity = 0.1
[boundary]
x    = "periodic"
y    = "periodic"
"z-" = { type = "wall" }
"z+" = { type = "wall" }
[time]
end  = 3
step = 0.01
[output]
history  = { every = 5 }
fields   = { every = 100000000 }
surfaces = { every = 50 }
"""
STILL = f"""coupling = "one-way"
damping = 0.003
potentials.pressure = {{ value = {-PRESSURE} }}"""
EARLIER = "opening = 0.3, free_edge = 2.4"


def valve_of_case():
    """The valve, its cords and its contact, as in the case file."""
    text = (CASE / "natural/case.toml").read_text()
    text = text[text.index('[[body]]\nname      = "valve"'):text.index("[output]")]
    text = re.sub(r"edge = [\d.]+", "edge = 0.052", text, count=1)
    text = re.sub(r'(?m)^density .*', "density = 10", text)  # heavy: it comes to rest in few substeps
    return re.sub(r'(?m)^coupling .*', STILL, text)


def variants():
    """Sizes and cords of the case, and what one gets without either change."""
    new = valve_of_case()
    short = re.sub(r"opening = .*? }", EARLIER + " }", new)
    straight = lambda text: re.sub(r"(?m)^(point +=) \[(-?)0.2,", lambda m: f"{m[1]} [{'' if m[2] else '-'}0.15,", text)  # noqa: E731
    return {"earlier": ("earlier sizes, cords straight down", straight(short)),
            "sizes": ("sizes of the case, cords straight down", straight(new)),
            "case": ("as in the case", new)}


def open_part(positions, faces, n=160):
    """Of lines along the axis through the orifice, the part that meets no face."""
    x, y = np.linspace(0.05, 1.05, n), np.linspace(-0.5, 0.5, n)
    covered = np.zeros((n, n), bool)
    for t in positions[faces][:, :, :2]:
        i, j = (slice(*np.searchsorted(grid, [t[:, axis].min(), t[:, axis].max()])) for axis, grid in enumerate((x, y)))
        px, py = np.meshgrid(x[i], y[j], indexing="ij")
        sides = [(b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0]) for a, b in zip(t, np.roll(t, -1, axis=0))]
        covered[i, j] |= np.all([s >= 0 for s in sides], axis=0) | np.all([s <= 0 for s in sides], axis=0)
    px, py = np.meshgrid(x, y, indexing="ij")
    inside = (px - 0.55) ** 2 + py**2 < 0.25
    return (inside & ~covered).sum() / inside.sum()


def main():
    import h5py

    arguments = common.read_arguments(__doc__, "left-ventricle-closing", quick="the same")
    rows = []
    for name, (what, text) in variants().items():
        file = arguments.out / f"{name}.toml"
        file.write_text(AROUND + text)
        out = common.run(arguments, name, file)
        with h5py.File(sorted((out / "surfaces").glob("valve_*.h5"))[-1]) as data:
            positions, faces = data["positions"][:], data["triangles"][:]
        rows.append([what, f"{100 * open_part(positions, faces):.2f}", f"{positions[:, 2].max():.3f}"])
    print("\n" + common.markdown_table(["natural valve under an even pressure", "orifice left open, %", "highest z, d"], rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
