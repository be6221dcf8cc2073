"""Problems of design with a scan of runs, to compare the optimum that a design finds."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import viscontact as vc
from viscontact.studies.case_values import result_with
from viscontact.studies.design.goals import constraints_of
from viscontact.studies.scalars import magnitude
from viscontact.studies.space import Choice, Range, given_parameter

POM = """
indenter:
  shape: roller
  diameter: 12 mm
  length: 20 mm
  straight_length: 14 mm
  crown_radius: 300 mm
material: pom-c-23c
load: {kind: step, force: 600 N, eccentricity_x: 6 mm}
time: {end: 30 d, steps: 12, spacing: log, first: 1 h}
"""
ROLLER = """
indenter: {shape: roller, radius: 5 mm, half_length: 9 mm, crown_radius: 75 mm, length: 30 mm}
material: {law: elastic, shear_modulus: 900 MPa, poisson_ratio: 0.38}
load: {kind: step, force: 10 kN}
time: {end: 1 s, steps: 1}
grid: {shape: [60, 40], size: [31 mm, 3.6 mm]}
"""
LOGARITHMIC = """
indenter:
  shape: roller
  radius: 6 mm
  length: 20 mm
  profile: {kind: logarithmic, amplitude: 20 um, crown_ratio: 0.6, end_drop: 100 um}
material: {law: elastic, shear_modulus: 900 MPa, poisson_ratio: 0.38}
load: {kind: step, force: 2 kN, eccentricity_x: 1 mm}
time: {end: 1 s, steps: 1}
grid: {shape: [60, 40], size: [20.5 mm, 2.4 mm]}
"""
CHAMFER = """
indenter:
  shape: roller
  radius: 6 mm
  half_length: 8 mm
  profile: {kind: chamfer, angle: 4 deg, length: 2 mm, corner_radius: 10 mm}
material: {law: elastic, shear_modulus: 900 MPa, poisson_ratio: 0.38}
load: {kind: step, force: 3 kN, eccentricity_x: 1 mm}
time: {end: 1 s, steps: 1}
grid: {shape: [60, 40], size: [20.5 mm, 2.4 mm]}
"""
PMMA = """
indenter: {shape: roller, radius: 5 mm, half_length: 9.565 mm, crown_radius: 50 mm, length: 30 mm}
material: pmma-paper
load: {kind: step, force: 10 kN, eccentricity_x: 4.78 mm}
time: {end: 1000 s, steps: 4, spacing: log, first: 1 s}
grid: {shape: [60, 40], size: [31 mm, 4 mm]}
"""
COVER = """
indenter: {shape: sphere, radius: 20 mm}
material:
  layers:
    - {thickness: 3 mm, law: elastic, shear_modulus: 2 MPa, poisson_ratio: 0.45}
  base: {law: elastic, shear_modulus: 80 GPa, poisson_ratio: 0.3}
load: {kind: step, force: 40 N}
time: {end: 1 s, steps: 1}
grid: {shape: [48, 48], size: [14 mm, 14 mm]}
"""
TWO_RADII = """
indenter:
  shape: roller
  radius: 6 mm
  half_length: 2 mm
  profile:
    kind: two-radii
    crown_radius: 500 mm
    crown_length: 6 mm
    end_radius: 50 mm
    end_length: 10 mm
material: {law: elastic, shear_modulus: 900 MPa, poisson_ratio: 0.38}
load: {kind: step, force: 2 kN, eccentricity_x: 1 mm}
time: {end: 1 s, steps: 1}
grid: {shape: [60, 32], size: [20.5 mm, 2.4 mm]}
"""
BALL = """
indenter: {shape: sphere, radius: 5 mm}
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load: {kind: step, force: 1 N}
time: {end: 3 s, steps: 6}
"""
ROUNDED = """
indenter:
  shape: revolved
  points: [[0 mm, 0 um], [1 mm, 10 um], [1.5 mm, 60 um], [2 mm, 260 um]]
  interpolation: smooth
material: {law: elastic, shear_modulus: 3 MPa, poisson_ratio: 0.45}
load: {kind: step, force: 4 N}
time: {end: 1 s, steps: 1}
grid: {shape: [48, 48], size: [4.2 mm, 4.2 mm]}
"""
ROLLING = """
indenter: {shape: paraboloid, radius_x: 10 mm, radius_y: 10 mm}
material:
  law: zener
  shear_modulus: 10 MPa
  delayed_modulus: 10 MPa
  viscosity: 10 MPa s
  poisson_ratio: 0.5
load: {kind: step, force: 4 N, tilt_y: 0}
motion: {kind: steady, speed: 1 mm/s, along: y, rolling: true}
grid: {shape: [40, 48], size: [3.2 mm, 3.6 mm]}
"""


@dataclass(frozen=True)
class Problem:
    """Design of a case, and the points of a scan of each parameter."""

    name: str
    case: str
    change: Mapping[str, Any]
    goal: str
    points: tuple[int, ...]
    constraints: tuple[str, ...] = ()
    least: bool = True
    runs: int | None = None

    @property
    def aim(self) -> dict[str, Any]:
        """Arguments of `design`."""
        return {
            "minimise" if self.least else "maximise": self.goal,
            "constraints": self.constraints,
            "runs": self.runs,
        }

    def written(self, folder: Path) -> Path:
        """Case file of the problem."""
        path = folder / "problem.yaml"
        path.write_text(self.case)
        return path

    def designed(self, folder: Path, **options: Any) -> vc.DesignResult:
        """Design of the problem."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", vc.AccuracyWarning)
            return vc.design(self.written(folder), dict(self.change), **self.aim, **options)

    def scanned(self, folder: Path) -> float:
        """Best value of a scan of runs, among those with a limit that keep the constraints."""
        path, limits = self.written(folder), constraints_of(self.constraints)
        # Only a pressure at an end may have no limit, which its error bar says.
        unread = {"output.fields": "none", "output.errors": str("roller" in self.case).lower()}
        ranges = [given_parameter("change", *each) for each in self.change.items()]
        parts = [_parts(*each) for each in zip(ranges, self.points, strict=True)]
        found = []
        for point in product(*parts):
            values = {r.key: r.value(part) for r, part in zip(ranges, point, strict=True)}
            try:
                result = result_with(path, {**values, **unread})
            except (ValueError, vc.ConvergenceError, vc.DomainError):
                continue
            value = magnitude(result, self.goal, "worst", largest=self.least)
            excess = [limit.violation(limit.value(result).value) for limit in limits]
            if not value.depends_on_mesh and max(excess, default=0.0) <= 0.0:
                found.append(value.value)
        return min(found) if self.least else max(found)

    def found(self, design: vc.DesignResult) -> tuple[float, float]:
        """Best value of a design, and its error bar."""
        best = design.best
        return float(best[self.goal]), float(best[f"{self.goal}_error"])

    def shortfall(self, found: float, best: float) -> float:
        """Part of the best value by which the found one is worse."""
        return (found - best) / best * (1 if self.least else -1)


def _parts(parameter: Range | Choice, count: int) -> list[float]:
    """Coordinates of the points of a scan, with both ends of a range."""
    if isinstance(parameter, Choice):
        return [(number + 0.5) / count for number in range(count)]
    return [number / (count - 1) for number in range(count)]


CROWN, STRAIGHT = "indenter.crown_radius", "indenter.half_length"
PROFILE = "indenter.profile"
PROBLEMS = (
    Problem(
        *("crown, POM, 30 d", POM, {CROWN: ("30 mm", "5 m", "log")}, "peak_pressure", (61,)),
        runs=14,
    ),
    Problem("crown, elastic", ROLLER, {CROWN: ("20 mm", "2 m", "log")}, "peak_pressure", (61,)),
    Problem(
        *("crown and straight part", ROLLER),
        {CROWN: ("30 mm", "300 mm", "log"), STRAIGHT: ("1 mm", "13 mm")},
        *("peak_pressure", (25, 13)),
        constraints=("contact_length<=27 mm",),
    ),
    Problem(
        *("crown, creep, length bounded", PMMA, {CROWN: ("10 mm", "200 mm", "log")}),
        *("peak_pressure", (61,)),
        constraints=("contact_length<=24 mm",),
        runs=20,
    ),
    Problem(
        *("logarithmic profile", LOGARITHMIC),
        {f"{PROFILE}.amplitude": ("2 um", "200 um", "log"), f"{PROFILE}.crown_ratio": ("0.1", "1")},
        *("peak_pressure", (21, 13)),
    ),
    Problem(
        *("two radii", TWO_RADII),
        {
            f"{PROFILE}.crown_radius": ("100 mm", "5 m", "log"),
            f"{PROFILE}.end_radius": ("10 mm", "100 mm", "log"),
        },
        *("peak_pressure", (17, 11)),
    ),
    Problem(
        *("chamfer", CHAMFER),
        {f"{PROFILE}.corner_radius": ("0.5 mm", "25 mm", "log")},
        *("peak_pressure", (41,)),
        runs=25,
    ),
    Problem(
        *(
            "cover under a ball",
            COVER,
            {"material.layers[1].thickness": ("0.5 mm", "10 mm", "log")},
        ),
        *("peak_pressure", (41,)),
        constraints=("approach<=0.6 mm",),
        runs=25,
    ),
    Problem(
        *("cover and ball", COVER),
        {
            "material.layers[1].thickness": ("0.5 mm", "10 mm", "log"),
            "indenter.radius": ("5 mm", "60 mm", "log"),
        },
        *("peak_pressure", (17, 17)),
        constraints=("approach<=0.5 mm", "contact_width<=10 mm"),
        runs=40,
    ),
    Problem(
        *("ball, pressure bounded", BALL, {"load.force": ("0.05 N", "20 N", "log")}),
        *("approach", (41,)),
        constraints=("peak_pressure<=2 MPa",),
        least=False,
        runs=25,
    ),
    Problem(
        *("rounded punch", ROUNDED),
        {"indenter.points[2][2]": ("0 um", "60 um")},
        *("peak_pressure", (41,)),
        runs=25,
    ),
    Problem(
        *("rolling ball", ROLLING, {"motion.speed": ("0.1 mm/s", "20 mm/s", "log")}),
        *("friction_coefficient", (41,)),
        least=False,
        runs=25,
    ),
    Problem(
        *("crown and modulus", ROLLER),
        {CROWN: ("20 mm", "2 m", "log"), "material.shear_modulus": ["300 MPa", "900 MPa"]},
        *("peak_pressure", (41, 2)),
        constraints=("approach<=0.45 mm",),
    ),
)
