"""What is run and what is asked of it: variants, meshes, capillary numbers, bounds."""
from dataclasses import dataclass

import model

CALIBRATION = 0.1  # the capillary number that shear rate 1 stands for by the constants as given
BOUNDED = (0.05, 0.1, 0.15, 0.2)
REPORTED = (0.3,)
DRAG = 100  # c_d of the case files


@dataclass(frozen=True)
class Bounds:
    """Largest difference from the model for Ca <= 0.2: of L and B in per cent, of the angle in degrees."""

    axes: float
    angle: float
    sigma: float | None = None  # of the calibrated surface tension from the given one, per cent


@dataclass(frozen=True)
class Variant:
    name: str
    title: str
    file: str
    bounds: Bounds
    given_sigma: float | None  # the surface tension that its constants stand for by theory
    colour: str
    marker: str
    marker_size: float


def tension_of_drop(network_tension):
    """Linear theory: a sphere relaxes through the drag c_d mu A/R as a drop of this surface tension does."""
    return 4 * network_tension / (model.F1 * DRAG)


VARIANTS = (
    Variant("tension", "surface tension", "case.toml", Bounds(1.0, 0.5, 5.0), tension_of_drop(114.29),
            "#1b6ca8", "o", 9.5),
    Variant("prestressed", "prestressed", "prestressed.toml", Bounds(0.5, 0.3), tension_of_drop(3**0.5 * 66),
            "#2e8b57", "s", 4.5),
    Variant("literal", "literal", "literal.toml", Bounds(2.0, 2.5), None, "#c8552b", "^", 7),
)
CONTROL_FILE = "traction-only.toml"
CONTROL_ANGLE, CONTROL_BOUND = 45.0, 0.5
CONTROL_RATES = (0.5, 1.0, 2.0)


@dataclass(frozen=True)
class Mesh:
    vertices: int
    frequency: int
    mass: float  # of a vertex: m gamma/c <= 0.02, c the drag of the smallest vertex


MESHES = (Mesh(162, 4, 0.05), Mesh(642, 8, 0.0125), Mesh(2562, 16, 0.003))


def control_settings(mesh):
    """Damping 2 mu/R a unit of area, and the mass that goes with it."""
    damping = {162: 0.155, 642: 0.0391, 2562: 0.00981}[mesh.vertices]
    return {"body.drop.damping": damping, "body.drop.mass_per_vertex": 0.02 * damping}


@dataclass(frozen=True)
class Plan:
    """A choice of runs. Times are in units of 1 / shear rate."""

    series: tuple  # of (Variant, Mesh)
    given: tuple  # of (Variant, Mesh): also without calibration
    by_viscosity: tuple  # of (Variant, Mesh)
    control: tuple  # of Mesh
    capillary: tuple
    end: float
    average_from: float
    control_end: float = 12.0
    control_average_from: float = 6.0


def make_plan(quick, only=None):
    variants = [v for v in VARIANTS if only in (None, v.name)]
    tension = [v for v in variants if v.given_sigma and v.bounds.sigma]
    control = only in (None, "control")
    if quick:
        series = [(v, m) for v in variants for m in MESHES[:2] if v.name != "literal" or m.vertices == 162]
        small = [(v, m) for v in tension for m in MESHES[:1]]
        return Plan(tuple(series), tuple(small), tuple(small), MESHES[:1] if control else (), BOUNDED, 12.0, 6.0)
    series = tuple((v, m) for v in variants for m in MESHES)
    return Plan(series, tuple((v, m) for v in tension for m in MESHES), tuple((v, MESHES[1]) for v in variants),
                MESHES if control else (), BOUNDED + REPORTED, 20.0, 10.0)
