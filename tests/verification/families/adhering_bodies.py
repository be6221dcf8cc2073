"""Round bodies that adhere: approached, pressed and pulled off.

Truth of elastic spheres under Dugdale's law: Maugis (1992). Truth of others: the same run on three
times the cells in thirds of the steps; its uncertainty is the difference from twice the cells in
halves, which is its own error where that falls with the square of the cells.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.exact_run import ExactRun
from verification.families.finer_runs import FinerRuns
from verification.families.solved import attributes_of, jumps_in
from viscontact import reference

Array = np.ndarray

#: Compared scalars.
SCALARS = (
    *("force", "approach", "contact_area", "contact_length", "contact_width", "peak_pressure"),
    *("work", "least_pressure", "tensile_area", "adhesion_energy"),
)

#: Compared values of jumps.
JUMPS = ("pull_off_force", "pull_off_time", "jump_in", "pull_off")

RADIUS, WORK = 1e-5, 0.05


class Scales:
    """Units of a sphere that adheres: of lengths, approaches and forces."""

    def __init__(self, compliance: float) -> None:
        """Take the relaxed compliance [1/Pa]."""
        self.length = float(np.cbrt(RADIUS**2 * WORK * compliance))
        self.depth, self.force = self.length**2 / RADIUS, math.pi * WORK * RADIUS

    def grid(self, rng: np.random.Generator, tabor: float) -> vc.Grid:
        """Cells that resolve the cohesive zone more or less, around all that attracts."""
        half = (4.5 if tabor > 0.5 else 6.0) * rng.uniform(1.0, 1.15)
        cells = int(rng.integers(28, 53))
        return vc.Grid((cells, cells), (2 * half * self.length,) * 2)


def maugis_sphere(rng: np.random.Generator) -> ExactRun:
    """Elastic sphere under Dugdale's law that is brought into contact and withdrawn."""
    compliance, tabor = 10 ** rng.uniform(-7, -5), math.exp(rng.uniform(math.log(0.2), 0.0))
    scales, law = Scales(compliance), vc.Elastic(1 / (4 * compliance))
    reach = scales.depth / tabor
    top = rng.uniform(0.2, 2.0) * scales.depth
    load = vc.ApproachHistory([0.0, 1.0, 3.0], [-2 * scales.depth, top, -4 * scales.depth])
    sphere = reference.maugis_dugdale(RADIUS, compliance, WORK, reach)
    last, largest = sphere.last, sphere.pull_off
    speed = (top + 4 * scales.depth) / 2

    def after(approach: float) -> float:
        return 1.0 + (top - approach) / speed

    def exact(times: Array) -> dict[str, Array]:
        approaches = np.array([load.at(time).approach for time in times])
        states = [
            sphere.at_approach(approach)
            if 1.0 <= time < after(last.approach)
            else reference.AdhesiveState(math.nan, approach, math.nan)
            for time, approach in zip(times, approaches, strict=True)
        ]
        radii = np.array([state.contact_radius for state in states])
        return {
            "force": np.array([state.force for state in states]),
            "contact_area": math.pi * radii**2,
            "contact_length": 2 * radii,
        }

    def jumps() -> dict[str, tuple[Array, Array]]:
        values = {
            "pull_off_force": -largest.force,
            "pull_off_time": after(largest.approach),
            "pull_off": after(last.approach),
        }
        return {name: (np.array([value]), np.zeros(1)) for name, value in values.items()}

    return ExactRun(
        f"Dugdale sphere, Tabor number {tabor:.2f}",
        vc.Paraboloid(RADIUS, RADIUS),
        vc.Material(law, poisson_ratio=0.5),
        load,
        scales.grid(rng, max(tabor, 0.51)),
        vc.uniform_times(3.0, int(rng.integers(16, 50))),
        exact,
        {"adhesion": vc.Adhesion(WORK, range=reach, law="dugdale")},
        jumps=jumps,
    )


def sticking_body(rng: np.random.Generator) -> ExactRun:
    """Body of one or two curvatures, any law and creep, under approach, force or a stage."""
    run, scales, ratio = _body(rng)
    end, control = 10 ** rng.uniform(-1, 2), ("approach", "force", "stage")[rng.integers(3)]
    turn = end * rng.uniform(0.2, 0.5)
    rest = turn + end * rng.choice([0.0, rng.uniform(0.05, 0.3)])
    spring = scales.force / scales.depth * 10 ** rng.uniform(-0.3, 1.0)
    corners = np.unique([0.0, turn, rest, end])
    held = [1.0] * (len(corners) - 2)
    load: vc.LoadHistory
    if control == "force":
        top = rng.uniform(0.0, 2.0) * scales.force
        levels = np.array([0.0, *(top * np.array(held)), -2.1 * ratio * scales.force])
        load = vc.ForceHistory(corners, levels)
    else:
        slack = 2.1 * scales.force / spring if control == "stage" else 0.0
        top = rng.uniform(0.2, 2.0) * scales.depth
        low = -3 * scales.depth - slack * ratio
        levels = np.array([-2 * scales.depth - slack, *(top * np.array(held)), low])
        stiffness = spring if control == "stage" else None
        load = vc.ApproachHistory(corners, levels, stage_stiffness=stiffness)
    times = np.unique([*np.linspace(0.0, end, int(rng.integers(12, 36))), *corners])
    return _with_truth(replace(run, load=load, times=times, name=f"{control}, {run.name}"))


def pulled_program(rng: np.random.Generator) -> ExactRun:
    """Move until a force is reached, hold height or force, retract until contact is lost."""
    run, scales, ratio = _body(rng)
    rise = 10 ** rng.uniform(-1, 1)
    rate, back = scales.depth / rise, scales.depth / rise * 10 ** rng.uniform(-0.5, 1.0)
    force, held = rng.uniform(0.0, 2.0) * scales.force, ("approach", "force")[rng.integers(2)]
    length = rise * rng.uniform(0.2, 2.0)
    program = vc.LoadProgram(
        [
            vc.Segment(rate, until=vc.Condition("force", force)),
            vc.Segment(control=held, duration=length),
            vc.Segment(-back, until="contact is lost"),
        ]
    )
    longest = 4 * rise + length + 8 * scales.depth * (1 + 0.3 * ratio) / back
    times = np.linspace(0.0, longest, int(rng.integers(24, 60)))
    return _with_truth(replace(run, load=program, times=times, name=f"{held} held, {run.name}"))


def _body(rng: np.random.Generator) -> tuple[ExactRun, Scales, float]:
    """A body on a grid, without load and truth; its units, and how much stiffer it is at once."""
    relaxed = 10 ** rng.uniform(-7, -5)
    scales, shear = Scales(relaxed), 1 / (4 * relaxed)
    law = ("exponential", "dugdale", "lennard-jones")[rng.integers(3)]
    tabor = math.exp(rng.uniform(math.log(0.2), math.log(0.7 if law == "dugdale" else 1.2)))
    ratio = float(rng.choice([1.0, 2.0, 10.0]))
    material: Any = vc.Elastic(shear)
    if ratio > 1:
        other = shear / (1 - 1 / ratio)
        material = vc.Zener(shear * ratio, other, other * 10 ** rng.uniform(-1.5, 1.5))
    oval = math.exp(rng.uniform(0.0, 0.5)) if rng.random() < 0.4 else 1.0
    kind = "elastic" if ratio == 1 else f"{ratio:g} times as stiff at once"
    run = ExactRun(
        f"{law}, Tabor number {tabor:.2f}, {kind}, radii {oval:.2f}",
        vc.Paraboloid(RADIUS * oval, RADIUS / oval),
        vc.Material(material, poisson_ratio=0.5),
        vc.ForceHistory([0.0, 1.0], [0.0, 1.0]),
        scales.grid(rng, tabor),
        None,
        exact=lambda times: {},
        more={"adhesion": vc.Adhesion(WORK, range=scales.depth / tabor, law=law)},
    )
    return run, scales, ratio


def _with_truth(run: ExactRun) -> ExactRun:
    """The run with the scalars and jumps of finer ones."""
    finer = FinerRuns(run, SCALARS, 1.0)

    def found(factor: int, name: str) -> Array:
        marched = finer.at(factor)
        return jumps_in(attributes_of(marched.setup, marched.states, {}), name)[0]

    def jumps() -> dict[str, tuple[Array, Array]]:
        values = {name: (found(3, name), found(2, name)) for name in JUMPS}
        return {
            name: (finest, np.abs(finest - other))
            for name, (finest, other) in values.items()
            if len(finest) == len(other)
        }

    return replace(run, exact=finer.values, uncertainty=finer.uncertainty, jumps=jumps)
