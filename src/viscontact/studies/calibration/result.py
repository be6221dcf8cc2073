"""Result of a calibration: values with intervals, and the fitted curves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import yaml_source
from viscontact.studies.calibration.residuals import Residuals
from viscontact.studies.calibration.response import Experiment
from viscontact.studies.calibration.search import NoResidualsError, Optimum
from viscontact.studies.calibration.unknowns import Unknown, case_settings
from viscontact.studies.case_values import case_with
from viscontact.units.display import StudyResult
from viscontact.units.parsing import split_quantity

_DIGITS = 6


@dataclass(frozen=True, eq=False, repr=False)
class CaseFit(StudyResult):
    """Values of a case for which its runs fit measured records.

    Made by `fit_case`.

    Attributes
    ----------
    parameters : dict of str to float
        Fitted values by key of the case, of the contact point (its reading) and of the stiffness of
        the machine, in SI units.
    units : dict of str to str
        Their units.
    intervals : dict of str to (float, float)
        Confidence interval of each, from the scatter of the records.
    discretisation_errors : dict of str to float
        Change of each from the cells of the search with steps through the rows to those of the case
        with steps half as long. What remains is about as large or smaller; it is not part of the
        intervals.
    confidence : float
        Level of the intervals, such as 0.95.
    correlation : ndarray, shape (p, p)
        Correlation of the parameters, of logarithms on a logarithmic scale, in their order [-].
    curves : xarray.Dataset
        All rows along ``row``: the number of the record, time, ``measured`` and ``fitted`` values
        in SI units, ``residual`` over the largest measured value (NaN in rows that do not count),
        and ``prescribed``, the column that drives the run (NaN where it is the load of the case).
    settings : mapping of str to str
        Fitted values of the case, as ``--set`` takes them.
    notes : tuple of str
        Parameters that the records do not tell apart, that are at a bound or left open.
    runs : int
        Number of runs.

    Examples
    --------
    >>> import tempfile
    >>> from viscontact.studies.calibration.fit_case import fit_case
    >>> from viscontact.studies.calibration.record import ContactRecord
    >>> file = Path(tempfile.mkdtemp(), "ball.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: sphere, radius: 5 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}, "
    ...     "load: {kind: step, force: 0.1 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [32, 32], size: [2.4 mm, 2.4 mm]}}"
    ... )
    >>> force = 0.1 * np.linspace(0.2, 1.0, 5)
    >>> depth = (3 * force / (16 * 2e6 * np.sqrt(5e-3))) ** (2 / 3)  # Hertz, G = 2 MPa, nu = 0.5
    >>> record = ContactRecord(np.arange(5.0), force, depth)
    >>> fit = fit_case(file, record, {"material.shear_modulus": ("0.5 MPa", "9 MPa", "log")})
    >>> f"{fit.parameters['material.shear_modulus']:.2g} {fit.units['material.shear_modulus']}"
    '2e+06 Pa'
    """

    parameters: dict[str, float]
    units: dict[str, str]
    intervals: dict[str, tuple[float, float]]
    discretisation_errors: dict[str, float]
    confidence: float
    correlation: Floats
    curves: xr.Dataset
    settings: Mapping[str, str]
    notes: tuple[str, ...]
    runs: int
    case: Path
    fixed: Mapping[str, str]
    unknowns: tuple[Unknown, ...] = field(repr=False)
    point: Floats = field(repr=False)
    reach: Floats = field(repr=False)
    shift: Floats = field(repr=False)

    @property
    def residual(self) -> float:
        """Root mean square of the residuals [-]."""
        return float(np.sqrt(np.nanmean(self.curves["residual"].values ** 2)))

    @property
    def case_text(self) -> str:
        """Case with the fitted values as YAML."""
        return case_with(self.case, {**self.fixed, **self.settings}).text

    @property
    def section_text(self) -> str:
        """Sections of the case that have fitted values as YAML, with the intervals as comments."""
        data = case_with(self.case, {**self.fixed, **self.settings}).document.data
        names = dict.fromkeys(key.partition(".")[0].partition("[")[0] for key in self.settings)
        comments = "".join(f"# {line}\n" for line in self._lines)
        return comments + yaml_source.write({name: data[name] for name in names})

    def _page(self) -> tuple[Any, ...]:
        about = {"notes": "\n".join(self.notes), "confidence": self.confidence}
        words = {"title": f"Fit of {self.case.stem}", "headline": self._headline}
        words["section"] = self.section_text
        return "fit", self.curves.assign_attrs(about), self._rows, self._correlated, words

    @property
    def _headline(self) -> str:
        rows, records = self.curves.sizes["row"], len(np.unique(self.curves["record"]))
        return (
            f"{rows} rows of {records} record{'s' * (records > 1)}, residual "
            f"{self.residual:.2e} of the largest value, {self.runs} runs"
        )

    @property
    def _rows(self) -> list[tuple[str, ...]]:
        """Name, value, interval and discretisation error of each parameter, in units of ranges."""
        parts = zip(self.unknowns, self.point, self.reach, self.shift, strict=True)
        return [
            (
                *(u.name, _short_key(u.text(part))),
                f"{_bound(u, part - reach)} to {_bound(u, part + reach)}",
                _difference(u, part, shift),
            )
            for u, part, reach, shift in parts
        ]

    @property
    def _lines(self) -> list[str]:
        """A line for each parameter."""
        return [
            f"{name} = {value} ({self.confidence:.0%}: {interval}; discretisation {error})"
            for name, value, interval, error in self._rows
        ]

    @property
    def _correlated(self) -> list[tuple[str, str, str]]:
        """Names and correlation of each pair of parameters."""
        names = [unknown.name for unknown in self.unknowns]
        pairs = [(n, m) for n in range(len(names)) for m in range(n)]
        return [(names[m], names[n], f"{self.correlation[n, m]:+.3f}") for n, m in pairs]

    def __repr__(self) -> str:
        lines = [f"CaseFit: {self._headline}", *(f"     {line}" for line in self._lines)]
        if pairs := self._correlated:
            lines.append("     correlation:")
        lines += [f"       {one}, {other}: {value}" for one, other, value in pairs]
        return "\n".join(lines)


def rounded(text: str) -> str:
    """Quantity with six digits, as it is written to a case."""
    number, unit = split_quantity(text)
    return f"{float(number):.{_DIGITS}g} {unit}".rstrip()


def _short_key(text: str) -> str:
    number, unit = split_quantity(text)
    return f"{float(number):.4g} {unit}".rstrip()


def _bound(unknown: Unknown, part: float) -> str:
    """Bound of an interval; beyond a hundred ranges it says nothing."""
    if not abs(part) < 100:
        return "open"
    return f"{float(split_quantity(unknown.text(float(part)))[0]):.4g}"


def _difference(unknown: Unknown, part: float, shift: float) -> str:
    here, there = (
        float(split_quantity(unknown.text(float(each)))[0]) for each in (part, part - shift)
    )
    return f"{abs(here - there):.1g}"


def result_of(
    residuals: Residuals,
    found: Optimum,
    confidence: float,
    notes: tuple[str, ...],
    path: Path,
    fixed: Mapping[str, str],
) -> CaseFit:
    """Result of a search."""
    unknowns, reach = residuals.unknowns, found.reach(confidence)
    point, shift = found.point, found.shift
    parts = list(zip(unknowns, point.tolist(), reach.tolist(), shift.tolist(), strict=True))
    return CaseFit(
        parameters={u.name: u.si(part) for u, part, _, _ in parts},
        units={u.name: u.unit for u in unknowns},
        intervals={u.name: (_limit(u, part - r), _limit(u, part + r)) for u, part, r, _ in parts},
        discretisation_errors={u.name: abs(u.si(p) - u.si(p - s)) for u, p, _, s in parts},
        confidence=confidence,
        correlation=found.correlation,
        curves=_curves(residuals, point),
        settings={key: rounded(value) for key, value in case_settings(unknowns, point).items()},
        notes=notes,
        runs=residuals.evaluation.budget.runs,
        case=path,
        fixed=fixed,
        unknowns=unknowns,
        point=point,
        reach=reach,
        shift=shift,
    )


def _limit(unknown: Unknown, part: float) -> float:
    """Bound of an interval in SI units; infinite far outside the range."""
    if not abs(part) < 100:
        return 0.0 if part < 0 and unknown.bounds.logarithmic else math.copysign(math.inf, part)
    return unknown.si(part)


def _curves(residuals: Residuals, point: Floats) -> xr.Dataset:
    """Measured and fitted values of all records along the dimension ``row``."""
    (fitted,) = residuals.fitted([point], "case")
    if isinstance(fitted, str):
        raise NoResidualsError(fitted)
    pairs = zip(residuals.experiments, fitted, strict=True)
    parts = [_curve(n + 1, each, *values) for n, (each, values) in enumerate(pairs)]
    return xr.concat(parts, "row")


def _curve(number: int, experiment: Experiment, values: Floats, counted: Bools) -> xr.Dataset:
    """Rows of one record."""
    record, measured = experiment.record, experiment.measured
    residual = np.where(counted, (values - measured) / np.abs(measured).max(), np.nan)
    driven = experiment.drive != "case"
    prescribed = record.column(experiment.drive) if driven else np.full(measured.size, np.nan)
    texts = (record.name, experiment.compared, "N" if experiment.compared == "force" else "m")
    name, quantity, units = (("row", np.full(measured.size, each)) for each in texts)
    return xr.Dataset(
        {
            "record": ("row", np.full(measured.size, number), {"long_name": "number of record"}),
            **{"name": name, "quantity": quantity, "units": units},
            "time": ("row", record.times, {"units": "s"}),
            "prescribed": ("row", prescribed, {"long_name": "prescribed quantity"}),
            "measured": ("row", measured, {"long_name": "measured value"}),
            "fitted": ("row", np.where(counted, values, np.nan), {"long_name": "fitted value"}),
            "residual": ("row", residual, {"units": "1", "long_name": "fitted less measured"}),
        }
    )
