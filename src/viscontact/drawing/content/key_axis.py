"""Axis of a varied key of a sweep: its unit, scale and texts."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.panel import Axis
from viscontact.results.sweep_axes import key_label
from viscontact.units.formatting import ReadableUnit, format_compact, readable_unit
from viscontact.units.parsing import parse_any_quantity

#: Units that are printed otherwise than they are typed.
_PRINTED = {"degC": "°C", "degF": "°F", "deg": "°"}
#: Attribute of a key with the words before the number in which its texts differ.
_WORDS = "words"
#: The place between a number and its unit, which may be written together.
_UNIT = re.compile(r"(?<=\d)(?=(?!e[-+]?\d)[A-Za-zµμ°%])")
#: What separates words of a text, and what surrounds them.
_SEPARATORS, _AROUND = re.compile(r"[\s,;]+"), " []{}"
#: Least ratio of the largest to the least value on a logarithmic axis.
_DECADE = 9.0


def key_axis(ds: xr.Dataset, key: str) -> Axis:
    """Axis of a key: numbers in a readable unit, or texts at equal distances."""
    if not is_number(ds, key):
        texts = tuple(dict.fromkeys(map(str, ds[key].values.ravel())))
        return Axis(name_of(ds, key), ReadableUnit("", 1.0), texts=texts)
    known = np.unique(ds[key].values[np.isfinite(ds[key].values)])
    unit = _unit_of(ds, key, known)
    return Axis(name_of(ds, key), unit, scale="log" if _suits_logarithm(known) else "linear")


def name_of(ds: xr.Dataset, key: str) -> str:
    """Name of a key on an axis: its words, or those before the number in which its texts differ."""
    return str(ds[key].attrs.get(_WORDS, key_label(key)))


def numbered_texts(ds: xr.Dataset, keys: Sequence[str]) -> dict[str, xr.Variable]:
    """Coordinates of numbers in place of texts that differ in one quantity, as in a rate.

    ``retract at 1 um/s until contact is lost`` and the same at 5 um/s are 1 and 5 um/s.
    """
    return {
        key: found
        for key in keys
        if not is_number(ds, key) and (found := _numbered(ds[key])) is not None
    }


def _numbered(texts: xr.DataArray) -> xr.Variable | None:
    """Quantities in which texts differ, with the words before them; None if there is more."""
    split = [
        _SEPARATORS.split(_UNIT.sub(" ", str(text)).strip(_AROUND)) for text in texts.values.ravel()
    ]
    if len({len(words) for words in split}) != 1:
        return None
    columns = list(zip(*split, strict=True))
    unlike = [n for n, column in enumerate(columns) if len(set(column)) > 1]
    if not unlike:  # they differ in spaces only
        return None
    first = unlike[0]
    if unlike not in ([first], [first, first + 1]):
        return None
    with suppress(ValueError):
        numbers = [float(text) for text in columns[first]]
        has_unit = first + 1 < len(columns) and _is_unit(columns[first + 1][0])
        units = columns[first + 1] if has_unit else [""] * len(numbers)
        typed = [f"{text} {unit}".strip() for text, unit in zip(columns[first], units, strict=True)]
        found = [parse_any_quantity(each) for each in typed]
        if len({si for _, si in found}) == 1 and (has_unit or len(unlike) == 1):
            values = np.array([value for value, _ in found]).reshape(texts.shape)
            about = {"units": found[0][1], "typed_unit": units[0] if len(set(units)) == 1 else ""}
            said = _words_before([column[0] for column in columns[:first]])
            name = {_WORDS: said[:1].upper() + said[1:]} if said else {}
            return xr.Variable(texts.dims, values, {**texts.attrs, **about, **name})
    return None


def _words_before(words: Sequence[str]) -> str:
    """The last three words, as of ``hold force for``, or two; empty if there are none."""
    for last in (words[-3:], words[-2:]):
        if last and all(map(str.isalpha, last)):
            return " ".join(last)
    return ""


def _is_unit(word: str) -> bool:
    """True for a word that is a unit, as ``um/s``."""
    with suppress(ValueError):
        parse_any_quantity(f"1 {word}")
        return True
    return False


def places_on(axis: Axis, values: NDArray[np.generic]) -> Floats:
    """Places of values of a key on its axis: numbers [SI], or positions of texts."""
    if not axis.texts:
        return np.asarray(values, dtype=np.float64)
    return np.array([axis.texts.index(str(value)) for value in values], dtype=np.float64)


def key_labels(ds: xr.Dataset, key: str) -> list[str]:
    """Values of a key for a legend."""
    values = ds[key].values
    if not is_number(ds, key):
        return [str(value) for value in values]
    unit = _unit_of(ds, key, values)
    return [f"{format_compact(float(value))} {unit.symbol}".strip() for value in unit(values)]


def _unit_of(ds: xr.Dataset, key: str, values: Floats) -> ReadableUnit:
    """Unit in which all values of a key were typed, otherwise the one that reads best."""
    typed, si = ds[key].attrs.get("typed_unit"), str(ds[key].attrs.get("units", "1"))
    if typed and values.size:
        with suppress(ValueError):
            (zero, own), (one, _) = (parse_any_quantity(f"{n} {typed}") for n in (0, 1))
            if own == si:
                return ReadableUnit(
                    _PRINTED.get(typed, typed.replace("um", "µm")), one - zero, zero
                )
    return readable_unit(si, values)


def _suits_logarithm(values: Floats) -> bool:
    """Test for increasing values over a decade or so whose ratios vary less than their steps."""
    if values[0] <= 0 or values[-1] < _DECADE * values[0]:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(ratios.std() / ratios.mean() < steps.std() / steps.mean())


def is_number(ds: xr.Dataset, key: str) -> bool:
    """True if the values of a key are numbers."""
    return bool(np.issubdtype(ds[key].dtype, np.number))
