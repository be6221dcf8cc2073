"""Checks of bodies that end: what they cannot be computed with, and where the ends lie."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.cell_borders import is_border
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Roller
from viscontact.bodies.loads import LoadPoint
from viscontact.bodies.loads.motion import Motion
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.bodies.materials.layers import Layered, without_ends
from viscontact.mechanics import halfspace
from viscontact.mechanics.halfspace.ended_response import EndedLayers, EndedResponse
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.problem.surface import ended_response
from viscontact.units.formatting import format_quantity

#: Largest difference of the ends of a roller and of its material, relative to its half length.
SAME = 1e-6

#: Part of the displacement at an end that the elements of layers miss at most, for Poisson's ratios
#: up to LARGEST_RATIO: on meshes twice as fine it changes by less than half as much.
LAYER_ERROR, LARGEST_RATIO = 1e-3, 0.495

#: Longest period along y between two ends, in half lengths: its wave is the longest in tables.
LONGEST_PERIOD = 2 * math.pi / 0.08

#: Reason why a body between two ends has no approach.
NO_DATUM = (
    "a body that ends on both sides is a plate below a depth of its length, and sinks as the "
    "logarithm of the depth from which it is measured, so that the approach has no datum"
)

#: Reason why a body between two free ends has no tilt along x.
NO_TILT = (
    "a body with two free ends bends as a plate below a depth of its length, and the slope of its "
    "edge along x grows as the logarithm of the depth from which it is measured"
)


def check_ends(problem: Problem) -> None:
    """Refuse what bodies that end cannot be computed with, before a grid is known."""
    for name in problem.ended_bodies:
        if _moves_along_x(problem.motion):
            raise ValueError(
                f"{name}.ends: the motion is along x, across the ends, over which nothing can "
                "move; let the contact move along y, or give the material without ends"
            )
        for other in ("friction", "adhesion"):
            if getattr(problem, other) is not None:
                raise ValueError(
                    f"{name}.ends: {other} is not available on a body that ends; leave one out"
                )
    _check_roller(problem)
    _check_layers(problem)
    supported = problem.ends_twice and problem.surface.is_supported
    if problem.ends_twice and not supported and problem.load.control != "force":
        raise ValueError(
            f"load.approach: {NO_DATUM}, and an approach cannot be prescribed; give the force"
        )


def _check_layers(problem: Problem) -> None:
    """Refuse layers that end where what an end adds is not known."""
    for name, body in problem.ended_bodies.items():
        if not isinstance(body.material, Layered):
            continue
        if any((part.poisson_ratio or 0.0) > LARGEST_RATIO for part in body.material.materials):
            raise ValueError(
                f"{name}.ends: Poisson's ratios of layers that end are {LARGEST_RATIO} at most, "
                "as elements of nearly incompressible ones are too stiff; give 0.495"
            )


def _check_roller(problem: Problem) -> None:
    """Refuse a roller whose material ends elsewhere than its shape does."""
    roller, body = problem.indenter, problem.ended_bodies.get("indenter_material")
    if body is None or not isinstance(roller, Roller):
        return
    last = roller.total_length / 2
    if math.isinf(last):
        return
    for plane, kind, side in zip(body.planes, body.ends, (-1, 1), strict=True):
        if plane is None or kind != "free" or abs(side * plane - last) < SAME * last:
            continue
        end, own = (format_quantity(side * each, "m", 6) for each in (last, side * plane))
        raise ValueError(
            f"indenter_material.length: the roller ends at x = {end}, and its material at {own}; "
            f"give it the roller's length, {format_quantity(2 * last, 'm', 6)}, about x = 0, "
            "or a shape without end there"
        )


def _moves_along_x(motion: Motion) -> bool:
    """True of a motion along x or at an angle."""
    if isinstance(motion, SteadyMotion):
        return motion.along == "x"
    return motion.moves[0]


def check_grid_of_ends(problem: Problem, grid: Grid) -> None:
    """Refuse a grid whose cells do not end where the bodies do."""
    for name, body in problem.ended_bodies.items():
        _check_period_of_ends(problem, grid, name)
        for plane in body.planes:
            if plane is None or is_border(grid, plane):
                continue
            cell = grid.cell_size[0]
            raise ValueError(
                f"{name}.ends: the end at x = {format_quantity(plane, 'm', 6)} must be a border of "
                f"cells, which are {format_quantity(cell, 'm', 6)} long, and lies within one; "
                f"make the length of the grid, now {format_quantity(grid.size[0], 'm', 6)}, such "
                "that whole cells fit between the end and the edge of the grid"
            )
        before, after = body.planes
        half = grid.size[0] / 2
        begins, stops = grid.centre[0] - half, grid.centre[0] + half
        if (before is not None and before >= stops) or (after is not None and after <= begins):
            raise ValueError(f"{name}.ends: no cell of the grid lies on the body; move the grid")


def _check_period_of_ends(problem: Problem, grid: Grid, name: str) -> None:
    """Refuse a period with which the ends of a body are not known."""
    if grid.periodic[0]:
        raise ValueError(
            f"grid.periodic: must be false along x for a body that ends there ({name}.ends); give "
            "'periodic: [false, true]' for a contact that goes on along y, or no period"
        )
    if not grid.periodic[1]:
        return
    if isinstance(without_ends(problem.ended_bodies[name]), Layered):
        raise ValueError(
            f"{name}.ends: layers that end are not available on a grid that is periodic along y; "
            "give one material, or a grid without period"
        )
    if not problem.motion.stands:
        raise ValueError(
            f"{name}.ends: a contact that repeats along y cannot move on a body that ends along x; "
            "leave motion out, or give a grid without period"
        )
    body = problem.ended_bodies[name]
    if body.ends.count("free") == 0 or None in body.ends or grid.shape[1] == 1:
        return
    longest = LONGEST_PERIOD * body.length / body.ends.count("free")
    if grid.size[1] > longest:
        raise ValueError(
            f"grid.size: a period along y of a body that ends on both sides ({name}.ends) is at "
            f"most {format_quantity(longest, 'm', 3)} long, as longer waves are not known, and not "
            f"{format_quantity(grid.size[1], 'm', 3)}; give a single cell along y if nothing "
            "varies there, or a shorter period"
        )


def check_tilt_of_ends(
    problem: Problem, load: Sequence[LoadPoint], grid: Grid, open_gap: Floats
) -> None:
    """Refuse a prescribed tilt that has no datum; open gap on the grid [m]."""
    if all(point.tilt_x is None for point in load):
        return
    if not tilts_from_datum(problem, grid, open_gap):
        raise ValueError(
            f"load.tilt_x: {NO_TILT}, so that it cannot be prescribed; leave it out, and give the "
            "eccentricity of the force, or make body, ends, grid and load symmetric about x = 0"
        )


def tilts_from_datum(problem: Problem, grid: Grid, open_gap: Floats) -> bool:
    """True if the tilt along x has a datum: one end at most is free, or all is even about x = 0."""
    bodies = problem.ended_bodies.values()
    if not any(body.ends == ("free", "free") for body in bodies) or problem.surface.is_supported:
        return True
    return (
        all(body.is_even for body in bodies)
        and problem.load.is_even(0)
        and grid.centre[0] == 0
        and np.array_equal(open_gap, open_gap[::-1])
    )


def error_of_ends(problem: Problem, *, even: bool) -> float:
    """Part of the displacement that the operator of free ends may miss [-].

    Over the largest displacement by them or by the half-space. With `even`, pressures are even
    about x = 0 only.
    """
    errors = [0.0]
    for body, material in zip(problem.ends, problem.bodies, strict=True):
        if body is None or "free" not in body.ends:
            continue
        response = ended_response(body, material)
        kinds = (False, True) if body.ends == ("free", "free") and not even else (False,)
        if isinstance(response, EndedLayers):
            half = body.length / body.ends.count("free")
            table = halfspace.strip_basis.layer_table_of
            found = (table(response.stack, half, odd=odd).error for odd in kinds)
            errors.append(LAYER_ERROR + max(found))
            continue
        errors.append(_error_of(response, kinds, problem))
    return max(errors)


def _error_of(response: EndedResponse, kinds: tuple[bool, ...], problem: Problem) -> float:
    """The same of one half-space, under pressures of kinds: odd ones, or even ones."""
    twice, mean, grid = None not in response.planes, 0.0, problem.grid
    if isinstance(grid, Grid) and grid.periodic[1]:
        strip = halfspace.plane_strip.plane_strip
        mean = (
            halfspace.periodic_ends.NEGLECTED + max(strip(odd=odd).error for odd in kinds) * twice
        )
        if grid.shape[1] == 1:  # only the mean along y counts
            return mean
    ratio = response.poisson_ratio
    found = halfspace.ends_error(ratio) + mean
    if twice:
        found += max(halfspace.strip_basis.strip_error(ratio, odd=odd) for odd in kinds)
    return found


def stress_left_on_ends(problem: Problem, grid: Grid, pressure: Floats | None) -> float:
    """Largest stress that a pressure on the grid leaves on free ends, over its peak [-].

    NaN without a pressure, 0 without free ends.
    """
    if not any("free" in body.ends for body in problem.ended_bodies.values()):
        return 0.0
    if pressure is None or not pressure.any() or grid.periodic[1]:
        return math.nan  # of a contact that repeats, it is not known
    left = halfspace.end_certificate.stress_left
    pairs = [pair for pair in zip(problem.ends, problem.bodies, strict=True) if pair[0]]
    if any(isinstance(material, Layered) for _, material in pairs):
        return math.nan  # the stress is found by waves in a half-space
    return max(
        left(ended_response(body, material), pressure, grid) for body, material in pairs if body
    )


def datum_of_ends_warnings(
    problem: Problem, undefined: tuple[str, ...], *, tilts: bool
) -> dict[str, str]:
    """Warn that approach and what follows from it, `undefined`, have no datum between two ends.

    With `tilts`, the tilt along x has one.
    """
    if not problem.ends_twice or problem.surface.is_supported:
        return {}
    words = f"{NO_DATUM}: {undefined[0]} is not defined (NaN)"
    if len(undefined) > 1:
        *others, last = undefined
        words = f"{NO_DATUM}: {', '.join(others)} and {last} are not defined (NaN)"
    return {"datum": words if tilts else f"{words}; {NO_TILT}, so that tilt_x is not, either"}
