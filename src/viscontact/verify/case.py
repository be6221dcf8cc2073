"""Verification case: compared quantities, refinements and results."""

from __future__ import annotations

import math
import time as clock
import warnings
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.backend.lazy_dataclass import dataclass

#: Errors below this are due to the solver's tolerance and have no order.
SOLVED = 1e-8


@dataclass(frozen=True)
class Quantity:
    """Compared quantity and its error bounds.

    Attributes
    ----------
    name : str
        Name of the quantity.
    unit : str
        Its SI unit.
    fast_bound, bound : float
        Largest relative error allowed on the finest mesh of the fast and of the full form [-].
    has_order : bool
        True if the error is a power of the refinement; not for an instant found between two steps.

    Examples
    --------
    >>> Quantity("approach", "m", fast_bound=1e-2, bound=1e-3).has_order
    True
    """

    name: str
    unit: str
    fast_bound: float
    bound: float
    has_order: bool = True


@dataclass(frozen=True)
class Comparison:
    """Exact and computed value, and their relative error.

    Attributes
    ----------
    exact, ours : float
        The values, in the quantity's unit.
    error : float
        Their difference relative to the exact value, or to the largest of its history [-].

    Examples
    --------
    >>> round(single(exact=2.0, ours=2.002).error, 6)
    0.001
    """

    exact: float
    ours: float
    error: float


@dataclass(frozen=True)
class Case:
    """Comparison with an exact solution at several refinements.

    Attributes
    ----------
    name : str
        Bodies and load.
    reference : str
        Author and year of the exact solution.
    quantities : tuple of Quantity
        Compared quantities.
    levels : tuple of int
        Refinements, ascending: cells on a radius, or steps of a cycle. The fast form takes the
        first two.
    compare : callable
        From a refinement to a `Comparison` for each quantity.

    Examples
    --------
    >>> from viscontact.verify import CASES
    >>> CASES[0].name, CASES[0].reference, [each.name for each in CASES[0].quantities]
    ('sphere', 'Hertz 1882', ['approach', 'central pressure', 'contact radius'])
    """

    name: str
    reference: str
    quantities: tuple[Quantity, ...]
    levels: tuple[int, ...]
    compare: Callable[[int], tuple[Comparison, ...]]


@dataclass(frozen=True)
class Result:
    """Result of one quantity of a case.

    Attributes
    ----------
    case, reference, quantity, unit : str
        As in `Case` and `Quantity`.
    exact, ours : float
        Exact value and ours on the finest mesh, where they differ most.
    error : float
        Relative error there [-].
    bound : float
        Largest error allowed [-].
    order : float
        Observed exponent of the error in the refinement; NaN where there is none [-].
    seconds : float
        Wall time of the whole case [s].
    failure : str
        Reason of missing values; empty if there are values.

    Examples
    --------
    >>> Result("cone", "Love 1939", "approach", "m", 2e-5, 2.001e-5, 5e-4, 1e-3, 2.0, 0.1).passed
    True
    """

    case: str
    reference: str
    quantity: str
    unit: str
    exact: float
    ours: float
    error: float
    bound: float
    order: float
    seconds: float
    failure: str = ""

    @property
    def passed(self) -> bool:
        """True if the error is within its bound."""
        return self.error <= self.bound


def single(exact: float, ours: float) -> Comparison:
    """Comparison of two numbers."""
    exact, ours = float(exact), float(ours)
    return Comparison(exact, ours, abs(ours - exact) / abs(exact))


def with_mean_error(found: Sequence[Comparison]) -> Comparison:
    """Last comparison, with the mean error of all, on meshes of similar size."""
    return replace(found[-1], error=sum(one.error for one in found) / len(found))


def history(exact: ArrayLike, ours: ArrayLike) -> Comparison:
    """Comparison of two histories where they differ most, relative to the largest value."""
    truth, found = np.asarray(exact, dtype=float), np.asarray(ours, dtype=float)
    apart = np.abs(found - truth)
    worst = int(np.argmax(apart))
    error = float(apart[worst] / np.abs(truth).max())
    return Comparison(float(truth[worst]), float(found[worst]), round(error, 12))


def run_case(case: Case, *, fast: bool) -> list[Result]:
    """Run a case at its refinements, or the two coarsest; a stopped solver is a failed result."""
    levels = case.levels[:2] if fast else case.levels
    started = clock.perf_counter()
    try:
        with warnings.catch_warnings():
            # Coarse meshes and sharp edges are intended: their errors are measured here.
            warnings.simplefilter("ignore", AccuracyWarning)
            found = [case.compare(level) for level in levels]
    except (ConvergenceError, DomainError, ArithmeticError) as error:
        nothing = Comparison(math.nan, math.nan, math.nan)
        found, failure = [tuple(nothing for _ in case.quantities)], str(error)
        levels = levels[-1:]
    else:
        failure = ""
    seconds = clock.perf_counter() - started
    return [
        Result(
            case.name,
            case.reference,
            quantity.name,
            quantity.unit,
            at_levels[-1].exact,
            at_levels[-1].ours,
            at_levels[-1].error,
            quantity.fast_bound if fast else quantity.bound,
            _order(quantity, levels, at_levels),
            seconds,
            failure,
        )
        for quantity, at_levels in zip(case.quantities, zip(*found, strict=True), strict=True)
    ]


def _order(quantity: Quantity, levels: tuple[int, ...], at_levels: tuple[Comparison, ...]) -> float:
    if not quantity.has_order:
        return math.nan
    return observed_order(levels, [comparison.error for comparison in at_levels])


def observed_order(levels: tuple[int, ...], errors: list[float]) -> float:
    """Observed order: slope of log(error) over log(level); NaN at the solver's tolerance."""
    if len(levels) < 2 or not min(errors) > SOLVED:
        return math.nan
    return float(-np.polyfit(np.log(levels), np.log(errors), 1)[0])
