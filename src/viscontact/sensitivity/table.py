"""Table of a sensitivity: derivatives and elasticities of the outputs by the inputs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.results.variables import SCALARS
from viscontact.sensitivity.differences import Slopes
from viscontact.sensitivity.outcomes import Outcomes
from viscontact.sensitivity.plan import Cells, Derivative, Plan

Floats = NDArray[np.float64]


def derivative_table(plan: Plan, outcomes: Outcomes, outputs: Sequence[str]) -> xr.Dataset:
    """Table over (output, input) of the derivatives and elasticities, each with its error."""
    inputs = [each.given for each in plan.derivatives]
    values = np.array([outcomes.values(name)[0] for name in outputs])
    errors = np.array([outcomes.nominal_error(name) for name in outputs])
    shape = (len(outputs), len(inputs))
    slopes, bars = np.full(shape, np.nan), np.full(shape, np.nan)
    for column, each in enumerate(plan.derivatives):
        found = _slopes(each, outcomes, outputs)
        slope = found.extrapolated
        of_cells = np.nan_to_num(np.abs(slope) * errors / values, nan=0.0, posinf=np.inf)
        if "coarse" in plan.cells:
            coarse = _slopes(each, outcomes, outputs, "coarse")
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
    given: Derivative, outcomes: Outcomes, outputs: Sequence[str], cells: Cells = "case"
) -> Slopes:
    """Derivatives of the outputs by the logarithm of an input."""
    runs = {
        point: outcomes.place(given.run_name(point, cells)) for point in (0, *given.stencil.points)
    }
    found = [outcomes.values(name) for name in outputs]
    values = {point: np.array([each[run] for each in found]) for point, run in runs.items()}
    return given.stencil.slopes(values, given.step)
