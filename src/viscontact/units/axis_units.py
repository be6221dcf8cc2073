"""Arrays, axes and legends in the units of `viscontact.units`: 167 µm, not 0.000167 m."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.units.formatting import readable_unit


@dataclass(frozen=True)
class DisplayUnit:
    """A unit for an axis.

    Parameters
    ----------
    symbol : str
        What is printed, such as ``"mm"``.
    factor : float
        One such unit in SI units.

    Examples
    --------
    >>> DisplayUnit("mm", 1e-3)(0.0025).item()
    2.5
    """

    symbol: str
    factor: float

    def __call__(self, values: ArrayLike) -> NDArray[np.float64]:
        """Values given in SI units, expressed in this unit."""
        return np.asarray(values, dtype=np.float64) / self.factor

    def label(self, quantity: str) -> str:
        """Axis label: the quantity with its unit in brackets."""
        return f"{quantity} [{self.symbol}]"


def display_unit(si_unit: str, *values: ArrayLike) -> DisplayUnit:
    """Choose the unit in which the largest of the values reads best.

    Parameters
    ----------
    si_unit : str
        The SI unit of the values, as `viscontact.units.formatting.readable_unit` takes it.
    *values : array_like
        Everything that shares the axis [SI]; what is not finite is disregarded.

    Returns
    -------
    DisplayUnit
        The SI unit itself when all values are zero.

    Examples
    --------
    >>> display_unit("Pa", [0.0, 152.2e6]).symbol
    'MPa'
    >>> display_unit("1/Pa", [5.5e-10, 7e-10]).symbol
    '1/GPa'
    """
    finite = [np.abs(array[np.isfinite(array)]) for array in map(np.asarray, values)]
    largest = max((float(array.max(initial=0.0)) for array in finite), default=0.0)
    unit = readable_unit(largest, si_unit)
    return DisplayUnit(unit.symbol, unit.factor)


def display_number(value: float, digits: int = 3) -> str:
    """Write a number with so many significant digits, without exponent or idle zeros.

    Parameters
    ----------
    value : float
        Any finite number.
    digits : int, optional
        Significant digits kept.

    Returns
    -------
    str
        The number.

    Examples
    --------
    >>> display_number(8.33333), display_number(1000.0)
    ('8.33', '1000')
    """
    return np.format_float_positional(float(f"{value:.{digits - 1}e}"), trim="-")


def time_labels(times: Iterable[float]) -> tuple[str, ...]:
    """Write instants for a legend, all in one unit.

    Parameters
    ----------
    times : iterable of float
        Instants [s].

    Returns
    -------
    tuple of str
        One label an instant; further digits are added where two would read the same.

    Examples
    --------
    >>> time_labels([0.0, 30.0, 1000.0])
    ('0 s', '30 s', '1000 s')
    """
    instants = [float(instant) for instant in times]
    unit = display_unit("s", instants)
    labels: tuple[str, ...] = ()
    for digits in range(3, 18):
        labels = tuple(f"{display_number(float(unit(t)), digits)} {unit.symbol}" for t in instants)
        if len(set(labels)) == len(set(instants)):
            break
    return labels
