"""Result of a sensitivity: its table, notes on it, and its report."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.formatting import format_with_error
from viscontact.results.variables import SCALARS
from viscontact.units.display import StudyResult
from viscontact.units.formatting import format_quantity


@dataclass(frozen=True)
class SensitivityResult(StudyResult):
    """Derivatives and elasticities of scalars of the result by the inputs of a case.

    Attributes
    ----------
    table : xarray.Dataset
        Over (output, input): `elasticity` d ln(output) / d ln(input) and `derivative` in SI units,
        each with its error (`elasticity_error`, `derivative_error`), NaN where a run failed. Over
        output: `value` and `value_error` of the case. Coordinates: names of the outputs, keys of
        the inputs, `output_units`, `input_units`, and the values of the case as `input_value` in SI
        units and `input_text` as they were typed.

        With scatter also, over (output, scattered): `first_order` and `total_order`, the Sobol'
        indices, with the ends of their 95 % intervals (`first_order_low`, `first_order_high`, ...);
        `percentile` over (output, percent) with 5, 50 and 95 %, and `band`, the same at each
        instant (or speed), with `nominal`, the values of the case; `sample`, the values of the
        output in all points (output, point), NaN where a run failed. `distribution` describes each
        input that scatters.
    notes : tuple of str
        Notes on the numbers: failed runs, inputs that were left out, values that
        depend on the mesh, and warnings of the run of the case.
    runs : int
        Number of runs.
    """

    table: xr.Dataset
    notes: tuple[str, ...]
    runs: int

    def ranked(self, output: str) -> list[str]:
        """Keys of the inputs, that with the largest elasticity of an output first.

        Parameters
        ----------
        output : str
            Name of the scalar.

        Returns
        -------
        list of str
            Keys whose elasticity is known.

        Examples
        --------
        >>> data = {"elasticity": (("output", "input"), [[0.1, -2.0]])}
        >>> coords = {"output": ["force"], "input": ["load.force", "indenter.radius"]}
        >>> SensitivityResult(xr.Dataset(data, coords), (), 9).ranked("force")
        ['indenter.radius', 'load.force']
        """
        sizes = abs(self.table["elasticity"].sel(output=output))
        known = sizes[np.isfinite(sizes)]
        return [str(key) for key in known["input"].values[np.argsort(-known.values, kind="stable")]]

    def _page(self) -> tuple[Any, ...]:
        title = self.table.attrs.get("title") or "Case"
        return "sensitivity", self.table, {"title": f"{title}: sensitivity"}

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        """Yield, for each output, its value and the inputs in the order of their elasticities."""
        for name in map(str, self.table["output"].values):
            one = self.table.sel(output=name)
            value, error = float(one["value"]), float(one["value_error"])
            yield f"{name} = {format_with_error(value, error, SCALARS[name].units)}"
            for key in self.ranked(name):
                of = one.sel(input=key)
                elasticity, error = float(of["elasticity"]), float(of["elasticity_error"])
                yield f"  {key}: {format_with_error(elasticity, error, '1')}"
            yield from _scatter_lines(one, name)


def _scatter_lines(one: xr.Dataset, name: str) -> Iterator[str]:
    """Yield the percentiles of an output, and the total indices of the inputs, largest first."""
    if "percentile" not in one:
        return
    unit = SCALARS[name].units
    low, middle, high = (format_quantity(float(each), unit) for each in one["percentile"].values)
    yield f"  scatter: 5 % {low}, 50 % {middle}, 95 % {high}"
    for key in one["scattered"].values[np.argsort(-one["total_order"].values, kind="stable")]:
        of = one.sel(scattered=key)
        first, total = (_index(of, each) for each in ("first_order", "total_order"))
        yield f"  variance by {key}: alone {first}, in total {total}"


def _index(of: xr.Dataset, name: str) -> str:
    value, low, high = (float(of[f"{name}{end}"]) for end in ("", "_low", "_high"))
    return "not known" if np.isnan(value) else f"{value:.2f} ({low:.2f} to {high:.2f})"
