"""Units of arguments: written once, with the dataclass field; of arrays converted or refused."""

from __future__ import annotations

import dataclasses
import itertools
import re
import typing
from collections.abc import Iterator
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import viscontact as vc
from project.array_arguments import (
    Argument,
    array_arguments,
    public_calls,
    public_methods,
    takes_arrays,
)
from returned import some
from viscontact.bodies.loads.history import Control
from viscontact.results.descriptions import stored_class, stored_classes
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.numbers import unit_of

CLASSES = tuple(stored_classes().values())
NUMERIC = re.compile(r"\b(float|int|Floats)\b")
UNITS = {dimension.unit for dimension in DIMENSIONS.values()} | {"1", "N/s"}


@pytest.mark.parametrize("owner", CLASSES, ids=lambda owner: owner.__name__)
def test_numeric_fields_have_a_unit_and_other_fields_have_none(owner: type) -> None:
    wrong = [
        field.name
        for field in dataclasses.fields(owner)  # of which one profile has none
        if not {unit_of(owner, field.name, control) for control in typing.get_args(Control)}
        <= (UNITS if NUMERIC.search(str(field.type)) else {None})
    ]
    assert wrong == []


def test_a_unit_may_depend_on_what_a_load_controls() -> None:
    harmonic = stored_class("HarmonicHistory")
    assert unit_of(harmonic, "mean", "force") == "N"
    assert unit_of(harmonic, "mean", "approach") == "m"
    assert unit_of(harmonic, "phase") == "rad"


#: Arguments of several numbers, by the function or class.
FUNCTIONS = {
    function: list(arguments)
    for function, arguments in itertools.groupby(array_arguments(), lambda each: each.function)
}
UREG = pint.UnitRegistry()

#: Another unit of each SI unit, and its factor.
OTHER_UNITS = {
    **{"s": ("ms", 1e-3), "m": ("um", 1e-6), "N": ("mN", 1e-3), "Pa": ("MPa", 1e6)},
    **{"1/Pa": ("1/GPa", 1e-9), "rad": ("mrad", 1e-3), "m/s": ("mm/s", 1e-3), "1": ("%", 1e-2)},
    **{"rad/s": ("krad/s", 1e3), "K": ("mK", 1e-3), "N m": ("mN m", 1e-3)},
}


def as_array(argument: Argument) -> np.ndarray:
    given = argument.given[argument.name]
    return np.asarray(next(iter(given.values())) if isinstance(given, dict) else given)


def refused(argument: Argument) -> dict[str, Any]:
    """Values that are no numbers in an SI unit, by what they are."""
    values = as_array(argument)
    masked = np.ma.masked_array(values, mask=np.arange(values.size).reshape(values.shape) == 0)
    hidden = values.astype(object)
    hidden[(0,) * hidden.ndim] = np.ma.masked
    dates = np.full(values.shape, np.datetime64("2020-01-01"))
    found = {
        "of another dimension": values * UREG.kg,
        "an attribute of another dimension": xr.DataArray(values, attrs={"units": "kg"}),
        "masked": masked,
        "masked in a list": hidden.tolist(),
        "dates": dates,
        "durations": dates - dates,
        "dates of the standard library": dates.tolist(),
        "complex": values + 1j,
        "complex in a list": (values + 1j).tolist(),
        "truth values": values > 0,
        "texts": values.astype(str),
        "texts in a list": values.astype(str).tolist(),
        "a table's texts": pd.Series(values.ravel().astype(str)),
    }
    if argument.name == "heights":
        del found["masked"]  # points that were not measured
    return found


def numbers_of(result: object) -> np.ndarray:
    """All numbers of a result, one after the other."""
    if isinstance(result, Iterator):
        result = list(result)
    if is_dataclass(result):
        result = [getattr(result, field.name) for field in dataclasses.fields(result)]
    if isinstance(result, xr.Dataset):
        result = {**result.variables}
    if isinstance(result, dict):
        result = list(result.values())
    if isinstance(result, list | tuple):
        return np.concatenate([np.zeros(0), *map(numbers_of, result)])
    array = np.asarray(result)
    return array.ravel() if array.dtype.kind in "ifc" else np.zeros(0)


def test_every_public_argument_of_several_numbers_has_a_call() -> None:
    left_out = [
        f"{name}: {argument}"
        for name, call, calls in (*public_calls(), *public_methods())
        for argument in takes_arrays(call)
        if not any(argument in given for given in calls)
    ]
    assert not left_out, "add a call to `CALLS` of array_arguments.py"
    assert sum(map(len, FUNCTIONS.values())) > 200


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_what_is_no_number_in_an_si_unit_is_refused_by_name(function: str) -> None:
    for argument in some(FUNCTIONS[function]):
        for kind, value in some(refused(argument).items()):
            with pytest.raises(ValueError, match=argument.named) as refusal:
                argument.with_value(value)
            assert "\n" not in str(refusal.value), kind


@pytest.mark.parametrize("function", [name for name in FUNCTIONS if not name.startswith("plot.")])
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
def test_numbers_with_a_unit_are_converted(
    function: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)  # one of them writes a file
    # Forces or approaches, segment by segment, are without units only.
    arguments = [each for each in FUNCTIONS[function] if each.name not in ("begins", "ends")]
    for argument in some(arguments):
        values, (unit, factor) = as_array(argument), OTHER_UNITS[argument.unit]
        wanted = numbers_of(argument.with_value(values.tolist()))
        assert wanted.size or function == "viscontact.write_dxf"
        other = (values / factor) * UREG.Unit(unit)
        described = xr.DataArray(values / factor, attrs={"units": unit})
        for given in (other, other.tolist(), described):
            found = numbers_of(argument.with_value(given))
            np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-30)


def test_single_numbers_of_exact_solutions_have_no_unit() -> None:
    for force in (UREG.Quantity(1.0, "kN"), xr.DataArray(1.0, attrs={"units": "kN"})):
        with pytest.raises(ValueError, match="force must be a positive finite number in N"):
            vc.reference.hertz_sphere(force, 0.01, 1e6)
