"""Executes a plan and compares every run with the model."""
from dataclasses import dataclass

import model
import study
from runs import Run, mean_shape, shear_settings


@dataclass
class Point:
    """A run at one capillary number against the model. Differences: L and B in per cent, the angle in degrees."""

    variant: study.Variant
    mesh: study.Mesh
    kind: str  # "calibrated", "viscosity" (calibrated, Ca by the viscosity) or "given" (sigma as theory says)
    capillary: float
    run: Run
    mean: dict | None = None

    @property
    def model(self):
        return model.shape(self.capillary)

    @property
    def difference(self):
        length, breadth, angle = self.model
        return (100 * (self.mean["L"] / length - 1), 100 * (self.mean["B"] / breadth - 1), self.mean["angle"] - angle)

    @property
    def is_bounded(self):
        return self.capillary <= max(study.BOUNDED)

    @property
    def passes(self):
        if self.mean is None:
            return False
        bounds = self.variant.bounds
        length, breadth, angle = self.difference
        return max(abs(length), abs(breadth)) <= bounds.axes and abs(angle) <= bounds.angle


@dataclass
class Calibration:
    """The run at shear rate 1, and the surface tension that it is the drop of."""

    variant: study.Variant
    mesh: study.Mesh
    run: Run
    mean: dict | None = None
    capillary: float | None = None

    @property
    def sigma(self):
        """mu gamma R / Ca, mu and gamma being 1 and R the radius of the sphere of the volume at rest."""
        return self.mean["radius"] / self.capillary

    @property
    def sigma_difference(self):
        return 100 * (self.sigma / self.variant.given_sigma - 1) if self.variant.given_sigma else None

    @property
    def passes(self):
        bound = self.variant.bounds.sigma
        return self.capillary is not None and (bound is None or abs(self.sigma_difference) <= bound)


@dataclass
class Control:
    mesh: study.Mesh
    rate: float
    run: Run
    mean: dict | None = None

    @property
    def passes(self):
        return self.mean is not None and abs(self.mean["angle"] - study.CONTROL_ANGLE) <= study.CONTROL_BOUND


@dataclass
class Results:
    plan: study.Plan
    calibrations: list
    points: list
    controls: list

    def all_runs(self):
        return [item.run for item in (*self.calibrations, *self.points, *self.controls)]

    def points_of(self, variant, mesh, kind="calibrated"):
        return [p for p in self.points if (p.variant, p.mesh, p.kind) == (variant, mesh, kind)]

    @property
    def passes(self):
        # As given, the coarse meshes stand for a few per cent less tension: that is what the bound on sigma is for.
        bounded = [p for p in self.points if p.is_bounded and p.kind != "given"]
        return all(item.passes for item in (*self.calibrations, *bounded, *self.controls))


def mesh_settings(mesh):
    return {"body.drop.surface.frequency": mesh.frequency, "body.drop.mass_per_vertex": mesh.mass}


def make_run(variant, mesh, label, settings):
    # Stiff bending makes the literal network's substeps short, on fine meshes most of all.
    cost = mesh.vertices * (1 + (mesh.vertices / 162 if variant.name == "literal" else 0))
    return Run(f"{variant.name}-{mesh.vertices}/{label}", variant.file, {**mesh_settings(mesh), **settings}, cost)


def run_plan(plan, runner, note):
    calibrations = [Calibration(v, m, make_run(v, m, "calibration", shear_settings(1.0, plan.end)))
                    for v, m in plan.series]
    controls = [Control(m, rate, Run(f"control-{m.vertices}/rate-{rate:g}", study.CONTROL_FILE,
                                     {"body.drop.surface.frequency": m.frequency, **study.control_settings(m),
                                      **shear_settings(rate, plan.control_end)}, m.vertices))
                for m in plan.control for rate in study.CONTROL_RATES]
    given = [Point(v, m, "given", ca, make_run(v, m, f"given-ca-{ca:g}", shear_settings(ca * v.given_sigma, plan.end)))
             for v, m in plan.given for ca in plan.capillary]
    runner.execute_all([item.run for item in (*calibrations, *controls, *given)], note)
    for item in (*calibrations, *given):
        average(item, plan.average_from)
    for item in controls:
        average(item, plan.control_average_from)

    points = list(given)
    for calibration in calibrations:
        if calibration.mean is None:
            continue
        calibration.capillary = model.fit_capillary(calibration.mean["L"], calibration.mean["B"])
        v, m = calibration.variant, calibration.mesh
        for ca in plan.capillary:
            rate = ca / calibration.capillary
            points.append(Point(v, m, "calibrated", ca,
                                make_run(v, m, f"ca-{ca:g}", shear_settings(rate, plan.end))))
            if (v, m) in plan.by_viscosity:
                settings = {**shear_settings(1.0, plan.end), "fluid.viscosity": rate}
                points.append(Point(v, m, "viscosity", ca, make_run(v, m, f"viscosity-ca-{ca:g}", settings)))
    fresh = [p for p in points if p.kind != "given"]
    runner.execute_all([p.run for p in fresh], note)
    for point in fresh:
        average(point, plan.average_from)
    return Results(plan, calibrations, points, controls)


def average(item, begin):
    """Averages over the second part of a run; `begin` in units of 1 / shear rate."""
    if item.run.failure is None:
        walls = item.run.settings["boundary.z+.velocity"]
        item.mean = mean_shape(item.run.rows(), begin / (walls[0] / 4.0))
