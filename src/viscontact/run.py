"""A run, checked: everything that can be refused is refused before the first step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Integral, Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.extent import auto_grid
from viscontact.grid import Grid
from viscontact.hull import refuse_outside
from viscontact.indenters import Indenter
from viscontact.load import ForceHistory
from viscontact.material import ContactCompliance, Material
from viscontact.stepping import uniform_times

#: Steps of a run whose instants are not given.
DEFAULT_STEPS = 60


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
    load : ForceHistory
        Force, eccentricity and prescribed tilts over time.
    grid : Grid
        The cells.
    open_gap : ndarray, shape (nx, ny)
        The indenter's gap on the grid [m], +inf outside its outline.
    times : ndarray
        Instants of the states [s].
    tolerance : float
        Relative error of gap and balances.
    threads : int
        Threads of one Fourier transform.
    """

    indenter: Indenter
    material: Material
    indenter_material: Material | None
    compliance: ContactCompliance
    load: ForceHistory
    grid: Grid
    open_gap: NDArray[np.float64]
    times: NDArray[np.float64]
    tolerance: float
    threads: int

    @property
    def is_mirrored(self) -> bool:
        """Whether shape and load are even across y = 0, so that one half tells all."""
        even_grid = self.grid.shape[1] % 2 == 0
        even_load = not np.any(self.load.eccentricity_y) and (
            self.load.tilt_y is None or not np.any(self.load.tilt_y)
        )
        return bool(
            even_grid and even_load and np.array_equal(self.open_gap, self.open_gap[:, ::-1])
        )


def prepare_run(
    indenter: Indenter,
    material: Material,
    load: ForceHistory,
    grid: Grid | None = None,
    times: ArrayLike | None = None,
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
    instants = _default_times(load, compliance) if times is None else _checked_times(times)
    field_instants(fields, instants)
    _check_magnitudes(compliance, load, grid, float(instants[-1]))
    _check_jumps(compliance, load, float(instants[-1]))
    if grid is None:
        grid = auto_grid(
            indenter, material, load, end=float(instants[-1]), indenter_material=indenter_material
        )
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    _check_balance(open_gap, grid, load, float(instants[-1]))
    return Run(
        indenter,
        material,
        indenter_material,
        compliance,
        load,
        grid,
        open_gap,
        instants,
        float(tolerance),
        int(threads),
    )


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
        ("load", load, ForceHistory, False),
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
    compliance: ContactCompliance, load: ForceHistory, grid: Grid | None, end: float
) -> None:
    """Beyond these, squares and quotients are no numbers, and a search might never end."""
    sizes = () if grid is None else grid.size
    magnitudes = [("load.force", load.largest_force), ("material", compliance(end))]
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


def _default_times(load: ForceHistory, compliance: ContactCompliance) -> NDArray[np.float64]:
    """The load's kinks, and steps to its end or through the creep under a held load."""
    end = float(load.times[-1])
    creep_times = list(compliance.times)
    if compliance.fluidity > 0 and compliance.instant > 0:
        creep_times.append(compliance.instant / compliance.fluidity)
    if load.force_at(end) > 0 and creep_times:
        end += 5 * max(creep_times)
    if end == 0:
        return np.zeros(1)
    kinks = load.kinks[load.kinks <= end]
    even = uniform_times(end, DEFAULT_STEPS)
    apart = np.abs(even[:, None] - kinks).min(axis=1) > 1e-9 * end
    return np.unique(np.concatenate([even[apart], kinks]))


def _check_jumps(compliance: ContactCompliance, load: ForceHistory, end: float) -> None:
    jumps = [jump for jump in load.jumps if jump <= end]
    if jumps and compliance.instant == 0:
        raise ValueError(
            f"load: the load jumps at t = {jumps[0]:g} s but the law has no instant compliance, "
            "so the surface could not follow; use a ramp, or give the law an instant compliance"
        )


def _check_balance(
    open_gap: NDArray[np.float64], grid: Grid, load: ForceHistory, end: float
) -> None:
    """The resultant must act within the hull of what can touch."""
    solid = np.isfinite(open_gap)
    if not solid.any():
        raise ValueError("grid: no cell lies under the indenter; use a finer or larger grid")
    # A point without force counts where the force grows from it or falls to it.
    instants = np.append(load.kinks[load.kinks < end], end)
    forces = np.maximum(load.force_at(instants, side="left"), load.force_at(instants))
    before, after = np.append(0.0, forces[:-1]), np.append(forces[1:], 0.0)
    for time in instants[(before > 0) | (forces > 0) | (after > 0)].tolist():
        for side in ("left", "right"):
            point = load.at(time, side=side)
            where = (
                None if point.tilt_x is not None else point.eccentricity_x,
                None if point.tilt_y is not None else point.eccentricity_y,
            )
            refuse_outside(solid, grid, where, time)
