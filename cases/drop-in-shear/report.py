"""The measured tables, for a terminal and as Markdown for the README."""
import study


def numbers(point):
    if point.mean is None:
        return "failed"
    length, breadth, angle = point.difference
    return f"{length:+.2f} {breadth:+.2f} {angle:+.2f}"


def verdict(passes, kind="calibrated"):
    if kind == "given":
        return "within" if passes else "outside"
    return "pass" if passes else "**MISS**"


def worst(points):
    """The largest absolute differences over the bounded capillary numbers."""
    differences = [p.difference for p in points if p.is_bounded and p.mean]
    return tuple(max(abs(d[i]) for d in differences) for i in range(3)) if differences else None


def series_table(results, kind):
    """One line a variant and mesh: the differences at each capillary number."""
    capillary = results.plan.capillary
    names = " | ".join(f"Ca {ca:g}" for ca in capillary)
    lines = [f"| variant | vertices | {names} | largest, Ca <= 0.2 | bound | |",
             "|---|---|" + "---|" * len(capillary) + "---|---|---|"]
    for variant in study.VARIANTS:
        for mesh in study.MESHES:
            points = results.points_of(variant, mesh, kind)
            if not points:
                continue
            bounds, largest = variant.bounds, worst(points)
            passes = all(p.passes for p in points if p.is_bounded)
            lines.append(
                f"| {variant.title} | {mesh.vertices} | " + " | ".join(numbers(p) for p in points) + " | "
                + (" ".join(f"{x:.2f}" for x in largest) if largest else "-")
                + f" | {bounds.axes:g} {bounds.axes:g} {bounds.angle:g} | {verdict(passes, kind)} |")
    return lines


def calibration_table(results):
    lines = ["| variant | vertices | L | B | W | angle | sigma, fitted | sigma, theory | difference | bound | |",
             "|---|---|---|---|---|---|---|---|---|---|---|"]
    for c in results.calibrations:
        start = f"| {c.variant.title} | {c.mesh.vertices} | "
        if c.mean is None:
            lines.append(start + "failed | | | | | | | | **MISS** |")
            continue
        m, bound, given = c.mean, c.variant.bounds.sigma, c.variant.given_sigma
        lines.append(start + f"{m['L']:.4f} | {m['B']:.4f} | {m['W']:.4f} | {m['angle']:.2f} | {c.sigma:.3f} | "
                     + (f"{given:.3f} | {c.sigma_difference:+.2f} % | " if given else "- | - | ")
                     + (f"{bound:g} % | {verdict(c.passes)} |" if bound else "- | |"))
    return lines


def control_table(results):
    lines = ["| vertices | shear rate | L | B | angle | bound | |", "|---|---|---|---|---|---|---|"]
    for c in results.controls:
        shape = f"{c.mean['L']:.4f} | {c.mean['B']:.4f} | {c.mean['angle']:.3f}" if c.mean else "failed | | "
        bound = f"{study.CONTROL_ANGLE:g} +- {study.CONTROL_BOUND:g}"
        lines.append(f"| {c.mesh.vertices} | {c.rate:g} | {shape} | {bound} | {verdict(c.passes)} |")
    return lines


def cost_table(results):
    lines = ["| variant | vertices | runs | seconds, all | longest run | of which the drop |",
             "|---|---|---|---|---|---|"]
    names = {}
    for run in results.all_runs():
        if run.failure is None:
            names.setdefault(run.name.split("/")[0], []).append(run.report())
    for name, reports in names.items():
        longest = max(reports, key=lambda report: report["wall_seconds"])
        share = longest["seconds_by_phase"].get("bodies", 0) / longest["wall_seconds"]
        variant, vertices = name.rsplit("-", 1)
        lines.append(f"| {variant} | {vertices} | {len(reports)} | {sum(r['wall_seconds'] for r in reports):.1f} | "
                     f"{longest['wall_seconds']:.1f} s | {100 * share:.0f} % |")
    total = sum(report["wall_seconds"] for reports in names.values() for report in reports)
    lines.append(f"| all | | {sum(len(reports) for reports in names.values())} | {total:.1f} | | |")
    return lines


SECTIONS = (
    ("Capillary number by the shear rate, after calibration at Ca = 0.1",
     "Differences from the model: L and B in per cent, the angle in degrees. Ca 0.3 is reported, not bounded.",
     lambda r: series_table(r, "calibrated")),
    ("Calibration: shear rate 1, constants as given",
     "sigma in units of mu gamma R. Its theory: see \"What stands for the surface tension\".", calibration_table),
    ("Capillary number by the viscosity, the shear rate kept at 1", "The same surface tension as above.",
     lambda r: series_table(r, "viscosity")),
    ("Without calibration: sigma as theory gives it",
     "Reported, not judged: the shear rate is set by the theoretical sigma, so that its error shows as a shift in Ca.",
     lambda r: series_table(r, "given")),
    ("Control: traction only", "Without drag nothing turns the drop.", control_table),
    ("Cost", "Seconds of wall time, one core a run.", cost_table),
)


def markdown(results, command):
    program = next(run for run in results.all_runs() if run.failure is None).report()["program"]
    lines = [f"Measured by `{command}` (Pliant {program['version']}, commit {program['commit']}, "
             f"{program['compiler']}, {program['flags']}), averaged over "
             f"t gamma = {results.plan.average_from:g} to {results.plan.end:g}:", ""]
    for title, text, table in SECTIONS:
        content = table(results)
        if len(content) > 2:
            lines += [f"### {title}", text, "", *content, ""]
    return "\n".join(lines)


def plain(results):
    """The tables for a terminal."""
    lines = []
    for title, text, table in SECTIONS:
        rows = [[cell.strip().replace("**", "") for cell in line.strip("|").split("|")] for line in table(results)]
        rows = rows[:1] + rows[2:]
        if len(rows) < 2:
            continue
        widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
        lines += ["", title, text]
        lines += ["  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    for run in results.all_runs():
        if run.failure:
            lines += ["", f"FAILED {run.name}:", run.failure]
    return "\n".join(lines)
