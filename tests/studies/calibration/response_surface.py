"""Responses interpolated between a few runs, so that a hundred records can be fitted."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

import viscontact as vc
from viscontact.studies.calibration.preparation import experiment_of
from viscontact.studies.calibration.response import Mounting, RecordRun
from viscontact.studies.case_values import case_with
from viscontact.studies.evaluation import Entry, Level
from viscontact.units.parsing import parse_any_quantity

Array = NDArray[np.float64]

#: Largest total degree of the polynomials, and runs that they are fitted to, on the coarse cells;
#: the ratio of the approaches on the case's cells to them changes far less with the values.
_DEGREE, _RUNS = 4, 64
_RATIO_DEGREE, _RATIO_RUNS = 1, 16


class ResponseSurface:
    """Approach under the force of a record, as polynomials of the logarithms of the unknowns."""

    def __init__(
        self, case: Path, record: vc.ContactRecord, middle: Mapping[str, str], factor: float
    ) -> None:
        """Run the case at values within a factor of the middle ones, and fit the polynomials.

        The force of the record is prescribed; its approach does not matter.
        """
        self._middle = {key: parse_any_quantity(text) for key, text in middle.items()}
        self._reach = np.log(factor)
        self._force = record.column("force")
        self._test = experiment_of(case, {}, case_with(case, {}), record, "force")
        points = 2 * qmc.Sobol(len(middle), seed=1).random(_RUNS) - 1
        coarse = np.log([self._run(point, "coarse") for point in points])
        own = np.log([self._run(point, "case") for point in points[:_RATIO_RUNS]])
        self._coarse = _fitted(points, coarse, _DEGREE)
        self._ratio = _fitted(points[:_RATIO_RUNS], own - coarse[:_RATIO_RUNS], _RATIO_DEGREE)

    def __call__(self, response: RecordRun) -> Entry:
        """Force and approach of a run [N, m], in place of `RecordRun.__call__`."""
        factors = [
            parse_any_quantity(response.values[key])[0] / middle
            for key, (middle, _) in self._middle.items()
        ]
        point = np.log([factors]) / self._reach
        logarithm = _powers(point, _DEGREE) @ self._coarse
        if response.level == "case":
            logarithm = logarithm + _powers(point, _RATIO_DEGREE) @ self._ratio
        approach = np.zeros(self._force.size)  # rows without force do not count
        approach[self._force > 0] = np.exp(logarithm[0])
        return Entry({"force": self._force.tolist(), "approach": approach.tolist()})

    def _run(self, point: Array, level: Level) -> Array:
        """Approach of the simulator at the rows that have a force [m]."""
        factors = np.exp(self._reach * point)
        values = {
            key: f"{float(middle * factor)!r} {unit}"
            for (key, (middle, unit)), factor in zip(self._middle.items(), factors, strict=True)
        }
        found = RecordRun(self._test, values, Mounting(), level)()
        return np.array(found.values["approach"])[self._force > 0]


def _fitted(points: Array, values: Array, degree: int) -> Array:
    """Coefficients of the polynomials by least squares, one column for each row of the record."""
    return np.asarray(np.linalg.lstsq(_powers(points, degree), values)[0])


def _powers(points: Array, degree: int) -> Array:
    """Products of Chebyshev polynomials up to a total degree, at points from -1 to 1."""
    of_each = [np.polynomial.chebyshev.chebvander(along, degree) for along in points.T]
    powers = [n for n in product(range(degree + 1), repeat=len(of_each)) if sum(n) <= degree]
    columns = [
        np.prod([along[:, k] for along, k in zip(of_each, n, strict=True)], axis=0) for n in powers
    ]
    return np.stack(columns, axis=1)
