"""Cost of contacts in steady motion in convolutions of the solver, and in time.

Convolutions are those of all cells of a contact's grid; one on a patch or a coarser grid counts by
its part of these cells. Times are divided by that of a reference convolution on the same cells, as
in run.py; they include the influence coefficients. A user who has no steady solver marches a
transient contact to the steady state: a path of six retardation lengths, a cell a step, at a
measured 7 to 9 convolutions a step.

    python benchmarks/steady.py [--cells 256]
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from run import reference_convolution

import viscontact as vc
from viscontact.backend.transforms import fastest_transforms, transforms_by
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.steady_motion.contact import SteadyContact, SteadySolver
from viscontact.simulation.steady_motion.curve import SteadyCurve
from viscontact.simulation.steady_motion.moving_law import moving_law
from viscontact.simulation.steady_motion.preparation import prepare
from viscontact.simulation.steady_motion.problem import steady_problem
from viscontact.simulation.steady_motion.region import Region, find_region

#: Contact of the tables: modulus, radius, load and relaxation time; the middle of the speeds.
INSTANT, RADIUS, LOAD, SPEED = 1 / 2000, 10.0, 10.0, 0.1
RATIOS, POWERS = (2, 10, 100, 1000), range(-3, 4)
CENTRED = (False, True)

#: Straight half length and place of the force of the crowned roller, in radii of the relaxed
#: contact of the sphere, and radius of its crowns in its own: a contact some five times as long as
#: wide.
STRAIGHT, ECCENTRICITY, CROWN = 1.5, 0.8, 30.0

#: Most convolutions: of a contact whose region is known, of the search for it, of 20 speeds, of 24
#: combinations of ratio and speed, of the others; and growth from 128² to 512² cells.
PROMISED = {"known": 60, "search": 30, "curve": 800, "combination": 80, "hardest": 1500}
LARGER = 1.7


def solver(
    ratio: float,
    speeds: list[float],
    grid: vc.AutomaticGrid | None = None,
    *,
    roller: bool = False,
) -> SteadySolver:
    """Solver for the sphere, or for the crowned roller under an eccentric force."""
    series = vc.CreepSeries(2 * INSTANT, [2 * (ratio - 1) * INSTANT], [float(ratio)])
    material, load = vc.Material(series, poisson_ratio=0.5), vc.step(LOAD, tilt_x=0.0, tilt_y=0.0)
    body: vc.Indenter = vc.Paraboloid(RADIUS, RADIUS)
    if roller:
        length = relaxed_radius(ratio)
        load = vc.step(LOAD, eccentricity_x=ECCENTRICITY * length, tilt_y=0.0)
        body = vc.Roller(RADIUS, STRAIGHT * length, CROWN * RADIUS, cross_section="parabola")
    contact = Problem(body, material, load, grid)
    problem = steady_problem(contact, speeds, "y" if roller else "x", None)
    law = moving_law(problem, (1.0, 1.0))
    return SteadySolver(problem, law, transforms_by(fastest_transforms()))


def relaxed_radius(ratio: float) -> float:
    """Radius of the contact at rest after a long time."""
    return float((0.75 * LOAD * RADIUS * ratio * INSTANT) ** (1 / 3))


def search(
    found: SteadySolver, speed: float, half: float, centred: tuple[bool, bool] = CENTRED
) -> tuple[Region, float]:
    start = Region(np.array([-half, -half]), np.array([half, half]))
    region, work = find_region(found, speed, start, centred=centred)
    return region.widened(0.1).centred(centred), work


def timed(found: SteadySolver, speed: float, region: Region, cells: int) -> SteadyContact:
    """Contact in a region, with a line of its cost."""
    convolve = reference_convolution((cells, cells))
    started = time.perf_counter()
    for _ in range(10):
        convolve()
    reference = (time.perf_counter() - started) / 10
    started = time.perf_counter()
    contact = found.solve(speed, region.grid(cells), 1e-6)
    passed = time.perf_counter() - started
    print(
        f"  {cells}² cells: {contact.solution.work:5.1f} convolutions, "
        f"{passed / reference:5.0f} reference convolutions of time ({passed:.2f} s)"
    )
    return contact


def sphere(cells: int) -> None:
    print(f"sphere at {SPEED} V τ/a = {SPEED / relaxed_radius(10):.2g}, moduli ratio 10, 1e-6")
    found = solver(10, [SPEED])
    region, work = search(found, SPEED, relaxed_radius(10))
    timed(found, SPEED, region, 128)  # first use of the transforms
    costs = [timed(found, SPEED, region, each).solution.work for each in (128, cells, 512)]
    share = (48 / cells) ** 2
    print(f"  search for its region: {work * share:.1f} convolutions of {cells}² cells")
    print(f"  promised: {PROMISED['known']}, {PROMISED['search']}, growth to 512² {LARGER}")
    print(f"  growth from 128² to 512²: {costs[2] / costs[0]:.2f}")
    step = region.extents[0] / cells
    steps = 6 * SPEED * 10.0 / step
    print(f"  marched to the steady state: {steps:.0f} steps, {7 * steps:.0f} convolutions or more")


def curve(cells: int) -> None:
    speeds = np.geomspace(1e-3, 1e3, 20).tolist()
    request = vc.AutomaticGrid(tolerance=(6.0 / (0.6 * cells)) ** 2)
    found = solver(10, speeds, request)
    started = time.perf_counter()
    run = prepare(found.problem)
    searched = time.perf_counter() - started
    solved = SteadyCurve(run, errors=False)
    for _ in solved:
        pass
    passed = time.perf_counter() - started
    work = sum(solved.work)
    sizes = [grid.shape[0] for grid in run.grids]
    print(f"20 speeds from 1e-3 to 1e3, {min(sizes)} to {max(sizes)} cells along the motion")
    print(
        f"  {work:.0f} convolutions and {run.work:.0f} of the search, {passed:.1f} s "
        f"({searched:.1f} s); promised: {PROMISED['curve']}"
    )


def combinations(cells: int = 128, *, roller: bool = False) -> None:
    """Table of the convolutions of a sphere, or of a crowned roller under an eccentric force."""
    bodies, centred = ("crowned rollers", (False, False)) if roller else ("spheres", CENTRED)
    print(f"{bodies} on {cells}² cells: convolutions to 1e-6 (search), by moduli ratio and V τ/a")
    print("        " + "".join(f"{f'1e{power}':>11}" for power in POWERS))
    easy = certified = 0
    for ratio in RATIOS:
        line, radius = f"  {ratio:<6}", relaxed_radius(ratio)
        for power in POWERS:
            speed = 10.0**power * radius
            found = solver(ratio, [speed], roller=roller)
            region, work = search(found, speed, radius, centred)
            contact = found.solve(speed, region.grid(cells), 1e-6)
            easy += contact.solution.work <= PROMISED["combination"]
            certified += contact.solution.converged
            line += f"{contact.solution.work:5.0f} ({work * (48 / cells) ** 2:3.0f})"
        print(line)
    print(
        f"  {certified} of 28 certified, {easy} within {PROMISED['combination']}; "
        f"promised: 28, 24, and {PROMISED['hardest']} for the others"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cells", type=int, default=256)
    cells = parser.parse_args().cells
    sphere(cells)
    curve(cells)
    combinations()
    combinations(roller=True)


if __name__ == "__main__":
    main()
