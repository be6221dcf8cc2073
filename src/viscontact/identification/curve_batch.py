"""Fits of one law to many curves: values, intervals, and why some curves have none."""

from __future__ import annotations

import csv
import math
import warnings
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor, Future
from dataclasses import replace
from pathlib import Path
from typing import ClassVar, Protocol, TypeVar

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.identification.fitted_curve import FittedCurve
from viscontact.units.display import Displayable, Plotted
from viscontact.units.formatting import column_heading, format_quantity
from viscontact.units.numbers import real_array

CurveT = TypeVar("CurveT")

#: Parts of the curves whose values the summary states, beside the median.
QUARTILES = (25.0, 50.0, 75.0)

#: Interval of a value that a curve does not have.
_UNKNOWN = (math.nan, math.nan)


class CurveFit(Protocol):
    """Fit of a curve that states itself in numbers."""

    def in_numbers(self, name: str) -> FittedCurve:
        """Return the fit of the curve of a name as numbers."""


@dataclass(frozen=True, eq=False, repr=False)
class CurveFits(Displayable, Plotted):
    """Laws or adhesion fitted to many curves, of `fit_each`.

    Attributes
    ----------
    curves : tuple of FittedCurve
        Each curve in the order in which it was given: ``name``, ``values`` and ``intervals`` of the
        parameters [SI], ``units``, ``residual``, ``indentation`` [m], ``force`` [N],
        ``warning``, ``failure``, which is empty for a curve that was fitted, and ``place`` in a
        map.

    Examples
    --------
    >>> good = FittedCurve("a", {"shear_modulus": 2e3}, {"shear_modulus": (1e3, 3e3)},
    ...                    {"shear_modulus": "Pa"})
    >>> bad = FittedCurve("b", {}, {}, {}, failure="no contact")
    >>> fits = CurveFits((good, bad))
    >>> fits.parameters, fits.values_of("shear_modulus").tolist(), len(fits.failed)
    (('shear_modulus',), [2000.0], 1)
    """

    _figure: ClassVar[str] = "curve_fits"

    curves: tuple[FittedCurve, ...]

    @property
    def fitted(self) -> tuple[FittedCurve, ...]:
        """Curves that have a fit."""
        return tuple(each for each in self.curves if not each.failure)

    @property
    def failed(self) -> tuple[FittedCurve, ...]:
        """Curves that have none."""
        return tuple(each for each in self.curves if each.failure)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(dict.fromkeys(name for each in self.fitted for name in each.values))

    def unit_of(self, parameter: str) -> str:
        """SI unit of a parameter; "1" without unit.

        Parameters
        ----------
        parameter : str
            Its name.
        """
        return (
            next(each.units[parameter] for each in self.fitted if parameter in each.values) or "1"
        )

    def values_of(self, parameter: str) -> Floats:
        """Values of a parameter over the fitted curves, in their order.

        Parameters
        ----------
        parameter : str
            Its name.

        Returns
        -------
        ndarray
            In SI units; NaN where a curve does not have it or does not determine it.
        """
        return np.array([each.values.get(parameter, math.nan) for each in self.fitted])

    @property
    def has_places(self) -> bool:
        """Whether the places of fitted curves are known."""
        return any(each.place is not None for each in self.fitted)

    def write(self, path: str | Path) -> None:
        """Write a table as CSV: a row for each curve, in SI units, with intervals.

        Parameters
        ----------
        path : path-like
            The file, which is replaced.
        """
        with Path(path).open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerows(self._rows())

    def _rows(self) -> Iterator[list[object]]:
        heads: list[object] = ["curve"]
        if self.has_places:
            heads += ["x [m]", "y [m]"]
        columns = {name: self._columns(name) for name in self.parameters}
        for name, ends in columns.items():
            heads += [column_heading(f"{name}{end}", self.unit_of(name)) for end in ends]
        yield [*heads, "residual", "indentation [m]", "force [N]", "warning", "failure"]
        for each in self.curves:
            numbers: list[float] = []
            if self.has_places:
                numbers += each.place or (math.nan, math.nan)
            for name, ends in columns.items():
                stated = each.values.get(name, math.nan), *each.intervals.get(name, _UNKNOWN)
                numbers += stated[: len(ends)]
            numbers += [each.residual, each.indentation, each.force]
            written = ["" if math.isnan(number) else f"{number:.6g}" for number in numbers]
            yield [each.name, *written, each.warning, each.failure]

    def _columns(self, parameter: str) -> tuple[str, ...]:
        """Endings of the columns of a parameter: its value, and its interval if it has one."""
        has_interval = any(parameter in each.intervals for each in self.fitted)
        return ("", " low", " high") if has_interval else ("",)

    def __repr__(self) -> str:
        total, found = len(self.curves), len(self.fitted)
        lines = [f"CurveFits: {found} of {total} curves"]
        if warned := sum(bool(each.warning) for each in self.fitted):
            lines[0] += f", {warned} with warnings"
        for name in self.parameters:
            unit = self.unit_of(name)
            values = self.values_of(name)
            known = values[np.isfinite(values)]
            if not known.size:
                lines.append(f"     {name}: not determined by any curve")
                continue
            low, middle, high = np.percentile(known, QUARTILES).tolist()
            texts = [format_quantity(each, unit, 4) for each in (middle, low, high)]
            whose = "half of the curves"
            if known.size < found:
                whose = f"determined by {known.size} of {found} curves, half of these"
            lines.append("     {} = {} ({}: {} to {})".format(name, texts[0], whose, *texts[1:]))
        return "\n".join(lines)


def fit_each(
    fit: Callable[[CurveT], CurveFit],
    curves: Mapping[str, CurveT],
    *,
    executor: Executor | None = None,
    progress: Callable[[int, int], None] | None = None,
    places: Mapping[str, tuple[float, float]] | None = None,
) -> CurveFits:
    """Fit each of many curves; one that cannot be fitted is kept with the reason.

    Parameters
    ----------
    fit : callable
        Returns the fit of a curve, as `fit_indentation` and `fit_adhesion` do; a ValueError or
        OSError is the reason why it has none. With an executor of processes a function of a module.
    curves : mapping of str
        The curves by name, or what `fit` reads them from, such as files.
    executor : concurrent.futures.Executor, optional
        Computes the fits, in place of this thread.
    progress : callable, optional
        Called after each curve with the number of finished ones and that of all.
    places : mapping of str to (float, float), optional
        Places x and y [m] of curves in a map, by name; the figure then has maps of the parameters.

    Returns
    -------
    CurveFits
        In the order of the curves.

    Raises
    ------
    ValueError
        If there are no curves, or a place is no pair of numbers.

    Examples
    --------
    >>> from viscontact.identification import IndentationRecord, fit_indentation
    >>> from viscontact.bodies.indenters import Sphere
    >>> t, d = np.linspace(0.0, 1.0, 11), 1e-6 * np.linspace(0.0, 1.0, 11)
    >>> records = {
    ...     f"curve {G:.0f}": IndentationRecord(Sphere(5e-6), t, d, 16 / 3 * G * 5e-6**0.5 * d**1.5)
    ...     for G in (1e3, 2e3, 4e3)
    ... }
    >>> fits = fit_each(lambda each: fit_indentation(each, "elastic", poisson_ratio=0.5), records)
    >>> fits.values_of("shear_modulus").round().tolist()
    [1000.0, 2000.0, 4000.0]
    """
    if not isinstance(curves, Mapping):
        raise ValueError(
            "fit_each: curves must be a mapping of names to curves, such as {path.name: path for "
            f"path in paths}}, got {type(curves).__name__}"
        )
    if not curves:
        raise ValueError("fit_each: needs at least one curve")
    known = {name: _place(place) for name, place in (places or {}).items()}
    pending: list[Future[FittedCurve]] = []
    if executor is not None:
        pending = [executor.submit(_fitted, fit, name, each) for name, each in curves.items()]
    found = []
    for number, (name, curve) in enumerate(curves.items()):
        fitted = pending[number].result() if pending else _fitted(fit, name, curve)
        found.append(replace(fitted, place=known.get(name)))
        if progress is not None:
            progress(len(found), len(curves))
    return CurveFits(tuple(found))


def _place(given: object) -> tuple[float, float]:
    """Place of a curve [m], checked."""
    place = real_array("fit_each: places", given, "m", 1)
    if place.size != 2:
        raise ValueError(f"fit_each: places must be pairs of x and y, got {place.size} numbers")
    return float(place[0]), float(place[1])


def _fitted(fit: Callable[[CurveT], CurveFit], name: str, curve: CurveT) -> FittedCurve:
    """Fit of one curve in numbers."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        try:
            found = fit(curve)
        except (ValueError, OSError) as error:
            return FittedCurve(name, {}, {}, {}, failure=str(error))
    told = [str(each.message) for each in caught if issubclass(each.category, AccuracyWarning)]
    return replace(found.in_numbers(name), warning=" | ".join(told))
