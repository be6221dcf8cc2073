"""Table of a sensitivity: derivatives and elasticities of the outputs by the inputs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Integers
from viscontact.results.variables import SCALARS
from viscontact.studies.evaluation import Level
from viscontact.studies.sensitivity.differences import Slopes
from viscontact.studies.sensitivity.outputs import OutputScalars
from viscontact.studies.sensitivity.plan import Derivative, Plan
from viscontact.studies.sensitivity.samples import Samples
from viscontact.studies.sensitivity.variance import indices_of, percentiles_of


def derivative_table(plan: Plan, scalars: OutputScalars, outputs: Sequence[str]) -> xr.Dataset:
    """Table over (output, input) of the derivatives and elasticities, each with its error."""
    inputs = [each.given for each in plan.derivatives]
    own = [scalars.nominal(name) for name in outputs]
    values, errors = (np.array([getattr(v, part) for v in own]) for part in ("value", "error"))
    shape = (len(outputs), len(inputs))
    slopes, bars = np.full(shape, np.nan), np.full(shape, np.nan)
    for column, each in enumerate(plan.derivatives):
        found = _slopes(each, scalars, outputs)
        slope = found.extrapolated
        of_cells = np.nan_to_num(np.abs(slope) * errors / values, nan=0.0, posinf=np.inf)
        if "coarse" in plan.cells:
            coarse = _slopes(each, scalars, outputs, "coarse")
            of_cells = np.maximum(of_cells, found.distance(coarse))
        slopes[:, column], bars[:, column] = slope, found.error + of_cells
    nominal, given = values[:, None], np.array([each.value for each in inputs])
    over = ("output", "input")
    with np.errstate(divide="ignore", invalid="ignore"):
        data = {
            "elasticity": (over, slopes / nominal, {"units": "1", "long_name": _ELASTICITY}),
            "elasticity_error": (over, bars / abs(nominal), {"units": "1", "long_name": _ERROR}),
            "derivative": (over, slopes / given, {"long_name": _DERIVATIVE}),
            "derivative_error": (over, bars / abs(given), {"long_name": _ERROR}),
            "value": ("output", values, {"long_name": "value of the case, in SI units"}),
            "value_error": ("output", errors, {"long_name": "estimated error of the value"}),
        }
    coords = {
        "output": list(outputs),
        "input": [each.key for each in inputs],
        "output_units": ("output", [SCALARS[name].units for name in outputs]),
        "input_units": ("input", [each.units for each in inputs]),
        "input_value": ("input", given, {"long_name": "value in the case, in SI units"}),
        "input_text": ("input", [each.text for each in inputs]),
    }
    return xr.Dataset(data, coords)


_ELASTICITY = "relative change of the output per relative change of the input"
_DERIVATIVE = "change of the output per change of the input, in SI units"
_ERROR = "estimated error: of the step, and of cells and time steps"


def _slopes(
    given: Derivative, scalars: OutputScalars, outputs: Sequence[str], cells: Level = "case"
) -> Slopes:
    """Derivatives of the outputs by the logarithm of an input."""
    runs = {
        point: scalars.place(given.run_name(point, cells)) for point in (0, *given.stencil.points)
    }
    found = [scalars.values(name) for name in outputs]
    values = {point: np.array([each[run] for each in found]) for point, run in runs.items()}
    return given.stencil.slopes(values, given.step)


#: Percentiles of the outputs over the samples [%].
PERCENTS = np.array([5.0, 50.0, 95.0])
_ENDS = ("", "_low", "_high")


def scatter_table(samples: Samples, scalars: OutputScalars, outputs: Sequence[str]) -> xr.Dataset:
    """Table of the scatter of the outputs: Sobol' indices, percentiles of A and B, and values."""
    labels, count = samples.labels, samples.count
    runs = np.array(
        [[scalars.place(samples.run_name(label, n)) for n in range(count)] for label in labels]
    )
    values = np.array([scalars.values(name)[runs] for name in outputs])
    found = [indices_of(each, samples.seed) for each in values]
    over = ("output", "scattered")
    data: dict[str, Any] = {
        f"{name}{end}": (over, [getattr(each, name)[row] for each in found], _attributes(name, end))
        for name in ("first_order", "total_order")
        for row, end in enumerate(_ENDS)
    }
    both = values[:, :2].reshape(len(outputs), -1)
    percentiles = [percentiles_of(each, PERCENTS) for each in both]
    data["percentile"] = (("output", "percent"), percentiles, {"long_name": _PERCENTILE})
    data["sample"] = (("output", "point"), both, {"long_name": "values of the samples A and B"})
    coords = {
        "scattered": list(labels[2:]),
        "distribution": ("scattered", [str(each) for each in samples.inputs]),
        "percent": PERCENTS,
    }
    return xr.Dataset(data, coords).merge(_over_rows(runs[:2].ravel(), scalars, outputs))


def _over_rows(runs: Integers, scalars: OutputScalars, outputs: Sequence[str]) -> xr.Dataset:
    """Percentiles at each instant or speed, and the values of the case, if all runs share them."""
    axis = scalars.shared_axis
    if axis is None:
        return xr.Dataset()
    whole = [scalars.over(name) for name in outputs]
    percentiles = [percentiles_of(each[runs], PERCENTS) for each in whole]
    over = ("output", "percent", axis.name)
    return xr.Dataset(
        {
            "band": (over, percentiles, {"long_name": f"{_PERCENTILE} over {axis.name}"}),
            "nominal": (("output", axis.name), [each[0] for each in whole]),
        },
        {axis.name: scalars.joint[axis.name].values},
    )


_PERCENTILE = "percentiles of the output over the samples, in SI units"
_INDICES = {
    "first_order": "part of the variance that the input causes alone",
    "total_order": "part of the variance that the input causes, also together with others",
}


def _attributes(name: str, end: str) -> dict[str, str]:
    suffix = {"": "", "_low": ", lower end (95 %)", "_high": ", upper end (95 %)"}[end]
    return {"units": "1", "long_name": f"{_INDICES[name]}{suffix}"}
