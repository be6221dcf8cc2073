"""Random moving contacts with error bars, beside finer runs of the same problems.

Paraboloids and strips on five kinds of laws travel from rest, turn back, ramp their speed or
reciprocate, under a constant or a changing force, load cycles or an approach, in steps of whole
cells, in even and in adaptive ones.
"""

import itertools
import math
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

import viscontact as vc
from viscontact.bodies.loads.motion import Motion

Array = np.ndarray

#: Scalars that are compared; those along the motion are named without their axis.
QUANTITIES = (
    *("resistance", "friction_coefficient", "motion_work", "dissipation", "heat"),
    *("loss_per_cycle", "approach", "work", "contact_area", "peak_pressure"),
)

#: Refinement of cells and of steps in the two finer runs, and the factor of their difference that
#: is left to the limit at second order.
FINER, LEFT = (2, 3), 1 / ((3 / 2) ** 2 - 1)

#: Largest uncertainty of the limit over the larger one of error and bar; and the part of the
#: largest value of a run that counts as zero.
CERTAIN, ZERO = 0.3, 1e-3

RADIUS, COMPLIANCE, RETARDATION = 10.0, 1 / 2000, 10.0


@dataclass(frozen=True)
class MovingRun:
    """Arguments of a run, and what it is."""

    name: str
    body: vc.Indenter
    material: vc.Material
    load: Any
    grid: vc.Grid
    times: Any  # None: whole cells
    motion: Motion

    @property
    def along(self) -> str:
        """Axis of the motion."""
        return "xy"[int(self.motion.moves[1])]


def drawn(seed: int, count: int) -> Iterator[MovingRun]:
    """Random runs of a seed."""
    for index in range(count):
        yield _drawn(np.random.default_rng([seed, index]), index)


def _drawn(rng: np.random.Generator, index: int) -> MovingRun:
    ratio = float(np.exp(rng.uniform(np.log(2), np.log(50))))
    law_name, law = _law(rng, ratio)
    material = vc.Material(law, poisson_ratio=0.0)
    shape = float(rng.choice([1.0, 1.0, 0.4, 2.5]))
    strip = rng.random() < 0.15
    along = "y" if strip else str(rng.choice(["x", "y"]))
    body = vc.Paraboloid(np.inf, RADIUS) if strip else vc.Paraboloid(RADIUS, RADIUS / shape)
    # Half length of the relaxed contact under 10 N, at least that of most of these runs.
    half = 0.75 * (0.75 * 10.0 * RADIUS * COMPLIANCE * min(ratio, 10.0)) ** (1 / 3)
    path_name, path, end = _path(rng, half, along)
    load_name, load = _load(rng, end, half, strip=strip)
    grid = _grid(rng, path, half, shape=shape, strip=strip)
    cell = grid.cell_size["xy".index(along)]
    steps_name, times = _times(rng, path, end, cell)
    name = f"{index}: {'strip' if strip else shape} {law_name} {ratio:.0f}, {path_name} along "
    name += f"{along}, {load_name}, {steps_name}, {grid.shape}"
    return MovingRun(name, body, material, load, grid, times, path)


def _law(rng: np.random.Generator, ratio: float) -> tuple[str, Any]:
    grown = COMPLIANCE * (ratio - 1)
    kind = rng.integers(5)
    if kind == 0:
        return "Zener", vc.CreepSeries(COMPLIANCE, [grown], [RETARDATION])
    if kind == 1:
        parts = rng.dirichlet(np.ones(3))
        times = RETARDATION * 10 ** np.array([-1.5, -0.5, 0.5])
        return "3 terms", vc.CreepSeries(COMPLIANCE, grown * parts, times)
    if kind == 2:
        modulus = 0.5 / COMPLIANCE
        return "Burgers", vc.Burgers(
            modulus, modulus * 60.0, modulus / (ratio - 1), modulus / (ratio - 1) * RETARDATION
        )
    if kind == 3:
        exponent = float(rng.uniform(0.25, 0.7))
        return "power", vc.PowerLaw(grown / 2, exponent, RETARDATION, instant=COMPLIANCE)
    modulus = 0.5 / COMPLIANCE
    return "fractional", vc.FractionalZener(
        modulus, modulus / ratio, RETARDATION / ratio, float(rng.uniform(0.4, 0.9))
    )


def _path(rng: np.random.Generator, half: float, along: str) -> tuple[str, Motion, float]:
    """A motion with its name and end [s]."""
    speed = half / RETARDATION * 10 ** rng.uniform(-1.0, 2.0)
    kind = rng.random()
    if kind < 0.45:
        amplitude = half * rng.uniform(0.4, 1.6)
        period, cycles = 4 * amplitude / speed, int(rng.integers(1, 3))
        path = vc.reciprocating(amplitude, period, cycles=cycles, along=along)
        return f"{cycles} cycles of {amplitude / half:.2g} a", path, cycles * period
    way = half * rng.uniform(1.0, 4.0)
    end = way / speed
    if kind < 0.7:
        name, times, ways = "start", [0.0, end], [0.0, way]
    elif kind < 0.85:
        name, times, ways = (
            "return",
            [0.0, end / 2, end],
            [0.0, way / 2, rng.uniform(-0.2, 0.2) * way],
        )
    else:
        parts = np.linspace(0, 1, 5)
        name, times, ways = "ramp", (end * parts).tolist(), (way * parts**2).tolist()
    sign = float(rng.choice([-1.0, 1.0]))
    path = vc.Travel(times, **{along: sign * np.array(ways)})
    return f"{name} of {way / half:.2g} a", path, end


def _load(rng: np.random.Generator, end: float, half: float, *, strip: bool) -> tuple[str, Any]:
    level = {"tilt_x": 0.0, "tilt_y": 0.0}
    if strip:
        level.pop("tilt_x")
    kind = rng.random()
    if kind < 0.5:
        return "force", vc.step(10.0, **level)
    if kind < 0.6 and not strip:
        period = float(end / 2)
        return "load cycles", vc.harmonic(8.0, 3.0, period, cycles=2, **level)
    if kind < 0.8:
        middle, last = rng.uniform(0.3, 1.0, 2) * 10.0
        return "changing force", vc.ForceHistory([0.0, end / 2, end], [10.0, middle, last], **level)
    if strip:
        return "light force", vc.step(5.0, **level)
    return "approach", vc.step(approach=half**2 / RADIUS, **level)


def _grid(
    rng: np.random.Generator, path: Motion, half: float, *, shape: float, strip: bool
) -> vc.Grid:
    """Cells of a size along the motion of a tenth or less of the contact, that holds all of it."""
    reach = [high - low for low, high in path.reach]
    middle = [(high + low) / 2 for low, high in path.reach]
    across = rng.uniform(9, 16)
    cell = 2 * half / across
    sizes = [cell * float(rng.choice([1.0, 1.0, 1.25])), cell]
    wide = 5.0 * half
    extents = [wide + reach[0], wide / min(shape, 1.0) ** 0.5 * 1.0 + reach[1]]
    counts = [int(np.ceil(extent / size)) for extent, size in zip(extents, sizes, strict=True)]
    centre = [middle[k] + rng.uniform(-0.5, 0.5) * sizes[k] for k in (0, 1)]
    if strip:
        return vc.Grid(
            (1, counts[1]),
            (1.0, counts[1] * sizes[1]),
            periodic=(True, False),
            centre=(0.0, centre[1]),
        )
    return vc.Grid(
        (counts[0], counts[1]),
        (counts[0] * sizes[0], counts[1] * sizes[1]),
        centre=(centre[0], centre[1]),
    )


def _times(rng: np.random.Generator, path: Motion, end: float, cell: float) -> tuple[str, Any]:
    kind = rng.random()
    if kind < 0.35:
        return "whole cells", None
    if kind < 0.7:
        tolerance = float(rng.choice([1e-2, 3e-3]))
        return f"adaptive {tolerance:g}", vc.adaptive_times(end, tolerance)
    steps = int(np.ceil(end * path.top_speed / (rng.uniform(0.4, 1.3) * cell)))
    return f"{steps} even steps", np.linspace(0.0, end, max(steps, 16) + 1)


def solved(run: MovingRun, times: Any = None, *, by: int = 1, errors: bool = False) -> xr.Dataset:
    """The run, or a finer one with `by` times as many cells along each axis, at given times."""
    nx, ny = (cells if cells == 1 else by * cells for cells in run.grid.shape)
    grid = vc.Grid((nx, ny), run.grid.size, periodic=run.grid.periodic, centre=run.grid.centre)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        return vc.simulate(
            *(run.body, run.material, run.load, grid, times),
            motion=run.motion,
            fields="none",
            errors=errors,
        )


def divided(times: Array, parts: int, longest: float) -> Array:
    """Times with each step divided, that behind the jump to the first load in progression.

    Steps of the run are no longer than `longest` [s].
    """
    found = [times[:1], times[0] + (times[1] - times[0]) * np.geomspace(1e-4, 1, 8 * parts)]
    for begin, end in itertools.pairwise(times.tolist()):
        steps = parts * math.ceil((end - begin) / longest * (1 - 1e-9))
        found.append(np.append(np.linspace(begin, end, max(steps, parts) + 1)[1:-1], end))
    return np.unique(np.concatenate(found))


def finer_runs(run: MovingRun, times: Array) -> list[xr.Dataset]:
    """Finer runs with all steps divided as the cells are, at the times of a run."""
    runs = (
        solved(run, divided(times, by, run.motion.longest_step), by=by).sel(time=times)
        for by in FINER
    )
    return list(runs)


def compared(run: MovingRun) -> dict[str, Array]:
    """Bars over errors by quantity, over the instants of a run; NaN where nothing is compared."""
    found = solved(run, run.times, errors=True)
    finer = finer_runs(run, found.time.values)
    return {name: _ratios(name, run.along, found, finer) for name in QUANTITIES}


def _ratios(quantity: str, along: str, found: xr.Dataset, finer: list[xr.Dataset]) -> Array:
    name = f"resistance_{along}" if quantity == "resistance" else quantity
    if name not in found:
        return np.full(found.time.size, np.nan)
    own, bar = found[name].values, found[f"{name}_error"].values
    first, second = (each[name].values for each in finer)
    exact, doubt = second + LEFT * (second - first), LEFT * np.abs(second - first)
    error = np.abs(own - exact)
    with np.errstate(invalid="ignore"):
        counts = np.isfinite(own) & np.isfinite(exact) & np.isfinite(bar)
        counts &= np.abs(exact) > ZERO * np.nanmax(np.abs(own), initial=0.0)
        counts &= doubt <= CERTAIN * np.maximum(error, bar)
        counts &= error > 1e-9 * np.abs(own)
        counts &= ~((quantity == "approach") & (error <= 1e-7 * np.abs(own)))
    return np.where(counts, bar / np.maximum(error, 1e-300), np.nan)
