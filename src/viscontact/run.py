"""A run, checked: everything that can be refused is refused before the first step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Integral, Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.adaptive import AdaptiveSteps
from viscontact.compliance import ContactCompliance
from viscontact.extent import auto_grid
from viscontact.grid import Grid
from viscontact.hull import refuse_outside
from viscontact.indenters import Indenter
from viscontact.load import LoadHistory
from viscontact.material import Material
from viscontact.memory import MemoryPlan, plan_memory
from viscontact.schedule import FixedSteps
from viscontact.stepping import AdaptiveTimes, uniform_times

#: Steps of a run whose instants are not given.
DEFAULT_STEPS = 60

#: Adaptive steps that the memory is planned for; more are remembered as well.
ADAPTIVE_STEPS = 500

#: Where the steps of a run come from.
Steps = FixedSteps | AdaptiveSteps


@dataclass(frozen=True, eq=False)
class Run:
    """What a run needs, checked and complete.

    Attributes
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material
        Material of the half-space.
    indenter_material : Material or None
        Material of the pressed body; None for a rigid one.
    compliance : ContactCompliance
        J(t) of both bodies together.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    grid : Grid
        The cells.
    open_gap : ndarray, shape (nx, ny)
        The indenter's gap on the grid [m], +inf outside its outline.
    times : ndarray
        Instants of the states [s]; those that adaptive steps have to hit, the last their end.
    adaptive : AdaptiveTimes or None
        The wish for steps that the run chooses itself.
    memory : MemoryPlan
        How the past is remembered.
    tolerance : float
        Relative error of gap and balances.
    threads : int
        Threads of one Fourier transform.
    """

    indenter: Indenter
    material: Material
    indenter_material: Material | None
    compliance: ContactCompliance
    load: LoadHistory
    grid: Grid
    open_gap: NDArray[np.float64]
    times: NDArray[np.float64]
    adaptive: AdaptiveTimes | None
    memory: MemoryPlan
    tolerance: float
    threads: int

    @property
    def is_mirrored(self) -> bool:
        """Whether shape and load are even across y = 0, so that one half tells all."""
        return _is_mirrored(self.open_gap, self.load)

    @property
    def measured_until(self) -> float:
        """Last time on which the laws rest on data [s]; inf for formulas."""
        bodies = (self.material, self.indenter_material)
        return min(body.known_until for body in bodies if body is not None)

    def steps(self) -> Steps:
        """The run's steps from the start."""
        if self.adaptive is None:
            return FixedSteps(self.times, self.load)
        return AdaptiveSteps(self.adaptive, self.times, self.load, self.compliance)


def prepare_run(
    indenter: Indenter,
    material: Material,
    load: LoadHistory,
    grid: Grid | None = None,
    times: ArrayLike | AdaptiveTimes | None = None,
    *,
    indenter_material: Material | None = None,
    tolerance: float = 1e-6,
    fields: str | Sequence[float] = "all",
    threads: int = 1,
) -> Run:
    """Check and complete the arguments of `march`.

    Parameters
    ----------
    indenter, material, load, grid, times, indenter_material, tolerance, fields, threads
        As in `march`.

    Returns
    -------
    Run
        Ready to be marched.

    Raises
    ------
    ValueError
        If anything in it makes no sense, with a remedy.
    """
    _check_kinds(indenter, material, load, grid, indenter_material)
    _check_numbers(tolerance, threads)
    compliance = material.contact_compliance()
    if indenter_material is not None:
        compliance = compliance + indenter_material.contact_compliance()
    adaptive = times if isinstance(times, AdaptiveTimes) else None
    instants = _instants_of(times, fields, load, compliance)
    end = float(instants[-1])
    field_instants(fields, instants)
    _check_magnitudes(compliance, load, grid, end)
    _check_jumps(compliance, load, end)
    if grid is None:
        grid = auto_grid(indenter, material, load, end=end, indenter_material=indenter_material)
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    _check_balance(open_gap, grid, load, end)
    return Run(
        indenter,
        material,
        indenter_material,
        compliance,
        load,
        grid,
        open_gap,
        instants,
        adaptive,
        _planned_memory(compliance, load, instants, adaptive, open_gap),
        float(tolerance),
        int(threads),
    )


def _is_mirrored(open_gap: NDArray[np.float64], load: LoadHistory) -> bool:
    even_grid = open_gap.shape[1] % 2 == 0
    return bool(even_grid and load.is_even and np.array_equal(open_gap, open_gap[:, ::-1]))


def _planned_memory(
    compliance: ContactCompliance,
    load: LoadHistory,
    instants: NDArray[np.float64],
    adaptive: AdaptiveTimes | None,
    open_gap: NDArray[np.float64],
) -> MemoryPlan:
    # Pressure and deflection are remembered, of all cells that are worked with.
    numbers = 2 * open_gap.size // (2 if _is_mirrored(open_gap, load) else 1)
    if adaptive is None:
        return plan_memory(compliance, FixedSteps(instants, load).instants, numbers)
    # The steps are not known yet: as if there were many, over all decades that may count.
    expected = np.append(0.0, np.geomspace(1e-9 * adaptive.end, adaptive.end, ADAPTIVE_STEPS))
    return replace(plan_memory(compliance, expected, numbers), instants=np.zeros(0))


def _instants_of(
    times: ArrayLike | AdaptiveTimes | None,
    fields: str | Sequence[float],
    load: LoadHistory,
    compliance: ContactCompliance,
) -> NDArray[np.float64]:
    if times is None:
        return _default_times(load, compliance)
    if not isinstance(times, AdaptiveTimes):
        return _checked_times(times)
    kept = _instants("fields", [0.0] if isinstance(fields, str) else fields)
    stops = np.unique(np.concatenate([[0.0, times.end], kept]))
    return stops[(stops >= 0) & (stops <= times.end)]


def field_instants(
    fields: str | Sequence[float], times: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Instants whose fields are kept.

    Parameters
    ----------
    fields : "all", "none" or sequence of float
        All instants, none, or some of the run's instants [s].
    times : ndarray
        Instants of the run [s].

    Returns
    -------
    ndarray
        Those instants, in order [s].

    Raises
    ------
    ValueError
        If it is another word, or an instant is not one of the run's.

    Examples
    --------
    >>> field_instants([0.0, 2.0], np.array([0.0, 1.0, 2.0])).tolist()
    [0.0, 2.0]
    """
    if isinstance(fields, str):
        if fields not in ("all", "none"):
            raise ValueError(f"fields must be 'all', 'none' or instants in s, got {fields!r}")
        return times if fields == "all" else times[:0]
    wanted = np.unique(_instants("fields", fields))
    index = np.clip(np.searchsorted(times, wanted), 0, len(times) - 1)
    index -= (index > 0) & (np.abs(times[index - 1] - wanted) < np.abs(times[index] - wanted))
    strange = ~np.isclose(times[index], wanted, rtol=1e-9, atol=0.0)
    if strange.any():
        raise ValueError(
            f"fields: {wanted[strange][0]:g} s is not among the run's times; "
            f"the nearest is {times[index][strange][0]:g} s"
        )
    return times[index]


def _check_kinds(
    indenter: object, material: object, load: object, grid: object, indenter_material: object
) -> None:
    wanted: list[tuple[str, object, type, bool]] = [
        ("indenter", indenter, Indenter, False),
        ("material", material, Material, False),
        ("load", load, LoadHistory, False),
        ("grid", grid, Grid, True),
        ("indenter_material", indenter_material, Material, True),
    ]
    for name, value, kind, optional in wanted:
        if not (isinstance(value, kind) or (optional and value is None)):
            raise ValueError(f"{name} must be of kind {kind.__name__}, got {value!r}")


def _check_numbers(tolerance: object, threads: object) -> None:
    if not (isinstance(tolerance, Real) and 1e-13 <= float(tolerance) <= 1e-2):
        raise ValueError(f"tolerance must lie between 1e-13 and 1e-2, got {tolerance!r}")
    if not (isinstance(threads, Integral) and 1 <= int(threads) <= 1024):
        raise ValueError(f"threads must be a whole number >= 1, and at most 1024, got {threads!r}")


def _check_magnitudes(
    compliance: ContactCompliance, load: LoadHistory, grid: Grid | None, end: float
) -> None:
    """Beyond these, squares and quotients are no numbers, and a search might never end."""
    sizes = () if grid is None else grid.size
    level = abs(load.largest_level)
    magnitudes = [(f"load.{load.control}", level), ("material", compliance(end))]
    for name, value in [*magnitudes, *(("grid.size", size) for size in sizes)]:
        if value and not 1e-30 <= value <= 1e30:
            raise ValueError(f"{name}: {value:.3g} in SI units is beyond what can be computed with")


def _instants(name: str, given: object) -> NDArray[np.float64]:
    try:
        array = np.asarray(given)
    except ValueError:  # rows of unequal length
        array = np.asarray(None)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name} must be instants in s, got {given!r}")
    return array.astype(np.float64)


def _checked_times(times: ArrayLike) -> NDArray[np.float64]:
    instants = np.atleast_1d(_instants("times", times))
    if instants.ndim != 1 or instants.size == 0 or not np.isfinite(instants).all():
        raise ValueError(f"times must be one or more finite instants in s, got {times!r}")
    if instants[0] < 0:
        raise ValueError(f"times must not be before 0, got {instants[0]:g} s")
    falling = np.flatnonzero(np.diff(instants) <= 0)
    if falling.size:
        before, after = instants[falling[0]], instants[falling[0] + 1]
        raise ValueError(f"times must be strictly increasing, got {before:g} s, then {after:g} s")
    return instants


def _default_times(load: LoadHistory, compliance: ContactCompliance) -> NDArray[np.float64]:
    """The load's kinks, and steps to its end or through the creep under a held load."""
    end = float(load.kinks[-1])
    if load.level_at(end) > 0:
        settled = compliance.settled_after
        if math.isinf(settled):
            raise ValueError(
                "times: the law does not say when its creep is over; say when the run ends, e.g. "
                "times=log_times(first, end, n)"
            )
        is_measured = math.isfinite(compliance.measured_until)
        end = max(end, settled) if is_measured else end + settled
    if end == 0:
        return np.zeros(1)
    kinks = load.kinks[load.kinks <= end]
    even = uniform_times(end, DEFAULT_STEPS)
    apart = np.abs(even[:, None] - kinks).min(axis=1) > 1e-9 * end
    return np.unique(np.concatenate([even[apart], kinks]))


def _check_jumps(compliance: ContactCompliance, load: LoadHistory, end: float) -> None:
    jumps = [jump for jump in load.jumps if jump <= end]
    if jumps and compliance.instant == 0:
        raise ValueError(
            f"load: the load jumps at t = {jumps[0]:g} s but the law has no instant compliance, "
            "so the surface could not follow; use a ramp, or give the law an instant compliance"
        )


def _check_balance(
    open_gap: NDArray[np.float64], grid: Grid, load: LoadHistory, end: float
) -> None:
    """The resultant must act within the hull of what can touch."""
    solid = np.isfinite(open_gap)
    if not solid.any():
        raise ValueError("grid: no cell lies under the indenter; use a finer or larger grid")
    # A point without load counts where the load grows from it or falls to it.
    instants = np.append(load.kinks[load.kinks < end], end)
    levels = np.maximum(load.level_at(instants, side="left"), load.level_at(instants))
    before, after = np.append(0.0, levels[:-1]), np.append(levels[1:], 0.0)
    for time in instants[(before > 0) | (levels > 0) | (after > 0)].tolist():
        for side in ("left", "right"):
            point = load.at(time, side=side)
            where = (
                None if point.tilt_x is not None else point.eccentricity_x,
                None if point.tilt_y is not None else point.eccentricity_y,
            )
            refuse_outside(solid, grid, where, time)
