"""Bodies on layers: steps, ramps and unloading, on rigid and elastic bases and creeping stacks.

Truth: integral equations (`layer_solution`), where the contact is round or a line and all layers
creep alike, the contact of the elastic body at each instant (Lee and Radok 1960: the contact grows
or stands still); elsewhere a run on a third of the cells' length.
"""

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

import viscontact as vc
from verification.families.exact_run import ExactRun, NotDrawnError
from verification.families.layer_solution import (
    Contact,
    Deviation,
    ball,
    bonded_on,
    bonded_on_rigid,
    cylinder,
    sliding_on_rigid,
    under,
)

Array = np.ndarray

#: Contact radii over the thickness, and cells across given grids.
RATIOS, ACROSS = (0.2, 20.0), (11.0, 60.0)

#: Cells of the finer run per cell, and the most cells of a run that has a finer one.
FINER, MOST_CELLS = 3, 120**2

#: Period along a cylinder [m].
LENGTH = 1e-3

#: Scalars of an exact solution, and of a finer run.
NAMES = ("approach", "force", "contact_area", "peak_pressure", "mean_pressure")
COMPARED = (*NAMES, "contact_length", "contact_width", "work")

Solution = Callable[[float, float, Deviation], Contact]


def random_ratio(rng: np.random.Generator, most: float = RATIOS[1]) -> float:
    return math.exp(rng.uniform(math.log(RATIOS[0]), math.log(most)))


def random_poisson(rng: np.random.Generator) -> float:
    return 0.5 if rng.random() < 0.25 else float(rng.uniform(0.3, 0.5))


def random_law(rng: np.random.Generator, shear: float, creeping: bool) -> vc.Zener | vc.Elastic:
    """Elastic, or relaxing to a half or a tenth of its modulus in 1 s."""
    if not creeping:
        return vc.Elastic(shear)
    weaker = math.exp(rng.uniform(math.log(2), math.log(10)))
    branch = shear / (weaker - 1)
    return vc.Zener(shear, branch, branch)


def chosen_grid(
    rng: np.random.Generator,
    half: tuple[float, float],
    arguments: tuple[vc.Indenter, vc.Layered, vc.LoadHistory],
    end: float,
) -> vc.Grid:
    """An automatic grid or a given one around a contact of these half extents [m]."""
    if rng.random() < 0.45:
        tolerance = math.exp(rng.uniform(math.log(3e-3), math.log(0.05)))
        return vc.auto_grid(*arguments, tolerance, end=end)
    shape, size = [], []
    count = math.exp(rng.uniform(*np.log(ACROSS)))
    for extent in half:
        cell = 2 * extent / (count + rng.uniform(-0.5, 0.5))
        cells = math.ceil(2 * extent * rng.uniform(1.15, 1.5) / cell) + 2
        shape.append(cells)
        size.append(cells * cell)
    return vc.Grid((shape[0], shape[1]), (size[0], size[1]))


def times_of(creeping: bool) -> list[float]:
    return [0.0, *np.geomspace(0.02, 5.0, 24).tolist()] if creeping else [0.0]


def layered_ball(rng: np.random.Generator) -> ExactRun:
    """A ball on one layer on a rigid base, or on a base that creeps alike."""
    a_over_h, nu = random_ratio(rng), random_poisson(rng)
    thickness, shear = 10 ** rng.uniform(-5, -2), 10 ** rng.uniform(5, 9)
    creeping = rng.random() < 0.5
    kind = rng.choice(["bonded", "sliding", "based"], p=[0.5, 0.2, 0.3])
    law = random_law(rng, shear, creeping)
    layer = vc.Layer(thickness, vc.Material(law, poisson_ratio=nu))
    base: Any = "rigid"
    deviation = sliding_on_rigid() if kind == "sliding" else bonded_on_rigid(nu)
    name = f"ball, {kind}"
    if kind == "based":
        ratio, nu_base = 10 ** rng.uniform(-3, 2), float(rng.uniform(0.2, 0.5))
        base = vc.Material(_softer(law, ratio), nu_base)
        deviation = bonded_on(ratio, nu, nu_base)
        name += f" {ratio:.3g}"
    body = vc.Layered([layer], base, bonded=kind != "sliding")
    return _on_layer(rng, name, ball, a_over_h, body, deviation)


def _softer(law: vc.Zener | vc.Elastic, ratio: float) -> vc.Zener | vc.Elastic:
    """The same law with a modulus that is smaller by a ratio."""
    if isinstance(law, vc.Elastic):
        return vc.Elastic(law.shear_modulus / ratio)
    return vc.Zener(law.shear_modulus / ratio, law.delayed_modulus / ratio, law.viscosity / ratio)


def layered_cylinder(rng: np.random.Generator) -> ExactRun:
    """A cylinder on one layer on a rigid base: a line contact."""
    a_over_h, nu = random_ratio(rng), random_poisson(rng)
    thickness, shear = 10 ** rng.uniform(-5, -2), 10 ** rng.uniform(5, 9)
    creeping, bonded = rng.random() < 0.5, bool(rng.random() < 0.8)
    material = vc.Material(random_law(rng, shear, creeping), poisson_ratio=nu)
    body = vc.Layered([vc.Layer(thickness, material)], "rigid", bonded=bonded)
    deviation = bonded_on_rigid(nu) if bonded else sliding_on_rigid()
    name = f"cylinder, {'bonded' if bonded else 'sliding'}"
    return _on_layer(rng, name, cylinder, a_over_h, body, deviation)


def _on_layer(
    rng: np.random.Generator,
    name: str,
    solve: Solution,
    a_over_h: float,
    body: vc.Layered,
    deviation: Deviation,
) -> ExactRun:
    """A step of force or approach, up to about a contact radius."""
    thickness, material = body.layers[0].thickness, body.layers[0].material
    law, nu, is_line = material.law, material.poisson_ratio, solve is cylinder
    # Radius of the ball over the thickness: shallow.
    radius = 10 ** rng.uniform(1.0, 2.0) * max(a_over_h, 1.0)
    times = np.array(times_of(not isinstance(law, vc.Elastic)))
    largest = solve(a_over_h, radius, deviation)
    unit = thickness * LENGTH if is_line else thickness**2
    by_force = bool(rng.random() < 0.6)
    if by_force:
        load = vc.step(largest.force * unit / ((1 - nu) * float(law(times[-1]))))
    else:
        load = vc.step(approach=largest.approach * thickness)
    shape = vc.Paraboloid(math.inf if is_line else radius * thickness, radius * thickness)
    half = a_over_h * thickness
    if is_line:
        count = math.exp(rng.uniform(*np.log(ACROSS)))
        cells = math.ceil(count * rng.uniform(1.15, 1.5)) + 2
        grid = vc.Grid((1, cells), (LENGTH, 2 * half / count * cells), periodic=(True, False))
    else:
        grid = chosen_grid(rng, (half, half), (shape, body, load), float(times[-1]))

    def exact_at(instant: float) -> list[float]:
        creep, relaxed = (
            (1 - nu) * float(law(instant)),
            (1 - nu) / (2 * float(law.relaxation(instant))),
        )
        level = load.at(instant).force * creep / unit if by_force else largest.approach
        at = under(
            level,
            "force" if by_force else "approach",
            lambda a: solve(a, radius, deviation),
            (1e-3 * a_over_h, 2 * a_over_h),
        )
        # Under an approach the contact stands, and all pressures relax alike.
        force = at.force * unit / (creep if by_force else relaxed)
        size = at.radius * thickness
        area = 2 * size * LENGTH if is_line else math.pi * size**2
        peak = math.nan if by_force and instant > 0 else at.peak / relaxed
        return [at.approach * thickness, force, area, peak, force / area]

    def exact(instants: Array) -> dict[str, Array]:
        values = np.array([exact_at(float(each)) for each in instants]).T
        return dict(zip(NAMES, values, strict=True))

    cell = min(grid.cell_size[1:]) / thickness
    label = (
        f"{name}, {'creeping' if times.size > 1 else 'elastic'}, {load.control}, nu {nu:.3f}, "
        f"a/h {a_over_h:.2f}, cells {grid.shape}, cell/h {cell:.2g}"
    )
    return ExactRun(label, shape, body, load, grid, times.tolist(), exact)


def random_history(rng: np.random.Generator, force: float) -> tuple[vc.LoadHistory, list[float]]:
    """A step, a ramp, or a load that is taken back to a third, and its instants."""
    kind = rng.random()
    if kind < 0.35:
        return vc.step(force), times_of(True)
    if kind < 0.6:
        return vc.ramp(force, 2.0), times_of(True)
    load = vc.ForceHistory([0.0, 1.0, 3.0, 3.5, 5.0], [0.0, force, force, force / 3, force / 3])
    return load, [*np.linspace(0.0, 3.0, 25), *np.linspace(3.0, 5.0, 25)[1:]]


def covered_core(rng: np.random.Generator) -> ExactRun:
    """Bodies of any curvatures on layers that creep otherwise than what is beneath."""
    a_over_h = random_ratio(rng, 8.0)
    thickness, shear = 10 ** rng.uniform(-5, -2), 10 ** rng.uniform(5, 9)
    cover = vc.Material(random_law(rng, shear, creeping=True), random_poisson(rng))
    core = vc.Material(vc.Elastic(shear * 10 ** rng.uniform(0, 5)), float(rng.uniform(0.2, 0.45)))
    layers, kind = [vc.Layer(thickness, cover)], rng.random()
    if kind < 0.25:  # a coating on a creeping body
        layers = [
            vc.Layer(thickness, vc.Material(vc.Elastic(shear * 10 ** rng.uniform(-1, 1)), 0.35))
        ]
        core = cover
    elif kind < 0.55:  # two layers that creep
        below = random_law(rng, shear * 10 ** rng.uniform(-1, 1), creeping=True)
        thick = thickness * rng.uniform(0.5, 2.0)
        layers.append(vc.Layer(thick, vc.Material(_slower(below, 5.0), random_poisson(rng))))
    body = vc.Layered(layers, core)
    long = math.exp(rng.uniform(0.0, math.log(6.0))) if rng.random() < 0.6 else 1.0
    half = a_over_h * thickness
    radius = 30 * max(half, thickness)
    shape = vc.Paraboloid(radius * long**1.5, radius)
    load: vc.LoadHistory = vc.step(approach=half**2 / radius * rng.uniform(0.4, 1.0))
    times = times_of(True)
    if rng.random() < 0.7:
        probe = vc.AutomaticGrid(0.05, quantities=("approach",))
        pressed = vc.simulate(shape, body, load, probe, [0.0, 5.0], errors=False, fields="none")
        load, times = random_history(rng, float(pressed.force[-1]))
    around = vc.auto_grid(shape, body, load, 0.05, quantities=("approach",), end=5.0)
    extents = (around.size[0] / 2.6, around.size[1] / 2.6)
    grid = chosen_grid(rng, extents, (shape, body, load), times[-1])
    if grid.shape[0] * grid.shape[1] > MOST_CELLS:
        raise NotDrawnError
    name = "coating" if kind < 0.25 else "two layers" if kind < 0.55 else "cover"
    label = (
        f"{name}, {load.control} of {load.kinks.size} corners, nu {cover.poisson_ratio:.3f}, "
        f"a/h {a_over_h:.2f}, long {long:.2f}, cells {grid.shape}, "
        f"cell/h {min(grid.cell_size) / thickness:.2g}"
    )
    return _by_finer_run(label, shape, body, load, grid, times)


def _slower(law: vc.Zener | vc.Elastic, times: float) -> vc.Zener | vc.Elastic:
    assert isinstance(law, vc.Zener)
    return vc.Zener(law.shear_modulus, law.delayed_modulus, law.viscosity * times)


def _by_finer_run(
    label: str,
    shape: vc.Indenter,
    body: vc.Layered,
    load: vc.LoadHistory,
    grid: vc.Grid,
    times: list[float],
) -> ExactRun:
    """The truth is a run of a third of the cells' length and twice the steps."""

    @cache
    def finer() -> Any:
        cells = (grid.shape[0] * FINER, grid.shape[1] * FINER)
        own = np.array(times)
        steps = np.union1d(own, (own[1:] + own[:-1]) / 2)
        fine = vc.Grid(cells, grid.size)
        return vc.simulate(shape, body, load, fine, steps, errors=False, fields="none")

    def exact(instants: Array) -> dict[str, Array]:
        ds = finer().sel(time=instants, method="nearest")
        return {name: ds[name].values for name in COMPARED}

    return ExactRun(label, shape, body, load, grid, times, exact)
