"""What went into a run, with units."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.description import NOUNS
from viscontact.laws import Law
from viscontact.plot.readable import display_number, display_unit
from viscontact.results import RESULT_NAME
from viscontact.units import in_words

_LENGTHS = (
    "radius half_length half_width crown_radius crown_length corner_radius depth end_drop "
    "end_length end_radius length radius_x radius_y ring_radius tube_radius semi_axis_x "
    "semi_axis_y semi_axis_z spacing thickness wavelength_x wavelength_y x y size positions drops "
    "drop height approach eccentricity_x eccentricity_y waviness edge offset tip_radius width"
)
_UNITS = {
    **dict.fromkeys(_LENGTHS.split(), "m"),
    **dict.fromkeys(["shear_modulus", "delayed_modulus", "bulk_modulus", "equilibrium"], "Pa"),
    **dict.fromkeys(["equilibrium_modulus", "moduli", "modulus"], "Pa"),
    **dict.fromkeys(["instant", "compliance"], "1/Pa"),
    **dict.fromkeys(["viscosity", "delayed_viscosity"], "Pa s"),
    "fluidity": "1/(Pa s)",
    **dict.fromkeys(["times", "time", "reference_time", "end", "period", "duration"], "s"),
    "measured_until": "s",
    "force": "N",
    **dict.fromkeys(["half_angle", "angle", "tilt_x", "tilt_y", "phase", "phase_x"], "rad"),
    "phase_y": "rad",
    **dict.fromkeys(["poisson_ratio", "exponent", "second_exponent", "cycles", "faces"], "1"),
    **dict.fromkeys(["shape", "tolerance", "crown_ratio", "slowed", "factor"], "1"),
}
#: The same names for other quantities, by the noun they belong to.
_OTHERWISE = {
    ("CreepSeries", "amplitudes"): "1/Pa",
    ("Waviness", "amplitude"): "m",
    ("HarmonicHistory force", "mean"): "N",
    ("HarmonicHistory force", "amplitude"): "N",
    ("HarmonicHistory approach", "mean"): "m",
    ("HarmonicHistory approach", "amplitude"): "m",
    ("BesideSpring", "equilibrium"): "Pa",
}
#: What a law calls by a name that says too little alone.
_WORDS = {
    ("CreepSeries", "instant"): "instant compliance",
    ("CreepSeries", "amplitudes"): "delayed compliances",
    ("CreepSeries", "times"): "retardation times",
    ("RelaxationSeries", "times"): "relaxation times",
    ("ForceHistory", "times"): "at times",
    ("ApproachHistory", "times"): "at times",
}
_LAWS = {name for name, noun in NOUNS.items() if issubclass(noun, Law)}
#: Nouns whose part of the table says what they are.
_PLAIN = {"Material", "Grid", "ForceHistory", "ApproachHistory", "HarmonicHistory"}
_PARTS = {
    "indenter": "Indenter",
    "material": "Material of the half-space",
    "indenter_material": "Material of the indenter",
    "load": "Load",
    "grid": "Grid",
}
#: What was typed is to be recognised.
_DIGITS = 6
#: So many numbers of a list say enough.
_MOST = 8
#: The case's name in a run directory.
_CASE_NAME = "case.yaml"


@dataclass(frozen=True)
class Input:
    """One thing that was given.

    Attributes
    ----------
    part, name, value : str
        Where it belongs, what it is, and what it is worth, with its unit.
    """

    part: str
    name: str
    value: str


def inputs(ds: xr.Dataset) -> list[Input]:
    """List what went into a run.

    Parameters
    ----------
    ds : xarray.Dataset
        A result; one of the user's own making, without its case, has no inputs.

    Examples
    --------
    >>> case = '{"indenter": {"type": "Sphere", "radius": 0.01}, "times": [0.0, 2.0]}'
    >>> [f"{each.name}: {each.value}" for each in inputs(xr.Dataset(attrs={"case": case}))]
    ['shape: sphere', 'radius: 10 mm', 'law: rigid', 'steps: 2, from 0 s to 2 s']
    """
    case = case_of(ds)
    found = [
        Input(title, name, value)
        for key, title in _PARTS.items()
        if isinstance(case.get(key), dict)
        for name, value in _told(case[key], "")
    ]
    if case and case.get("indenter_material") is None and "indenter" in case:
        place = sum(each.part in ("Indenter", _PARTS["material"]) for each in found)
        found.insert(place, Input(_PARTS["indenter_material"], "law", "rigid"))
    return [*found, *_steps(case)]


def case_of(ds: xr.Dataset) -> dict[str, Any]:
    """Return the case that a result keeps; empty where it keeps none."""
    try:
        case = json.loads(str(ds.attrs.get("case", "")))
    except ValueError:
        return {}
    return case if isinstance(case, dict) else {}


def prescribes_approach(ds: xr.Dataset) -> bool:
    """Tell whether a run's load is an approach, which the force answers."""
    load = case_of(ds).get("load") or {}
    return load.get("control") == "approach" or load.get("type") == "ApproachHistory"


def case_file(ds: xr.Dataset) -> str:
    """Return the case as it was written, if it lies beside the result."""
    source = Path(str(ds.encoding.get("source", "")))
    beside = source.parent / _CASE_NAME
    if source.name != RESULT_NAME or not beside.is_file():
        return ""
    return beside.read_text(encoding="utf-8", errors="replace")


def _steps(case: Mapping[str, Any]) -> Iterator[Input]:
    times, adaptive = case.get("times") or [], case.get("adaptive")
    if not times:
        return
    start, end = in_words(times[0], "s"), in_words(times[-1], "s")
    if adaptive is None:
        yield Input("Time", "steps", f"{len(times)}, from {start} to {end}")
    else:
        tolerance = adaptive.get("tolerance", "?")
        yield Input("Time", "steps", f"chosen by their error, {tolerance} at most, up to {end}")
    if "tolerance" in case:
        yield Input("Time", "tolerance of each instant", f"{case['tolerance']:g}")


def _told(noun: Mapping[str, Any], before: str) -> Iterator[tuple[str, str]]:
    """Yield names and values of a noun's arguments, those of nouns within it as well."""
    kind = str(noun.get("type", ""))
    if kind and kind not in _PLAIN:
        yield before or ("law" if kind in _LAWS else "shape"), _in_plain_words(kind)
    for key, value in noun.items():
        word = _WORDS.get((kind, key), key.replace("_", " ").replace("poisson", "Poisson's"))
        name = f"{before} {word}".strip()
        if isinstance(value, Mapping) and "sha256" in value:
            size = " × ".join(map(str, value.get("shape", ())))
            yield name, f"{size} points, fingerprint {str(value['sha256'])[:12]}"
        elif isinstance(value, Mapping):
            yield from _told(value, "" if key == "law" else name)
        elif _holds_nouns(value):
            for index, each in enumerate(value, 1):
                yield from _told(each, f"{name} {index}")
        elif key != "type" and not (value is None or value is False or _is_idle(key, value)):
            yield name, _worth(f"{kind} {noun.get('control', '')}".strip(), key, value)


def _is_idle(key: str, value: Any) -> bool:
    """Tell zeros that nobody has written."""
    return key in ("eccentricity_x", "eccentricity_y", "fluidity") and not np.any(value)


def _holds_nouns(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)


def _worth(kind: str, key: str, value: Any) -> str:
    unit = _OTHERWISE.get((kind, key), _UNITS.get(key, "SI"))
    if isinstance(value, bool) or not isinstance(value, int | float | list):
        return "yes" if value is True else str(value)
    try:
        numbers = np.atleast_1d(np.asarray(value, dtype=np.float64)).ravel().tolist()
    except (TypeError, ValueError):
        return str(value)
    if key in ("shape", "size"):
        return " × ".join(_number(number, unit) for number in numbers)
    if len(set(numbers)) == 1:
        numbers = numbers[:1]
    shown = ", ".join(_number(number, unit) for number in numbers[:_MOST])
    return shown + (f", … ({len(numbers)} in all)" if len(numbers) > _MOST else "")


def _number(value: float, unit: str) -> str:
    if unit == "1":
        return f"{value:.6g}"
    if unit == "1/Pa":
        readable = display_unit(unit, value)
        return f"{display_number(float(readable(value)), _DIGITS)} {readable.symbol}"
    if unit == "rad" and value:
        return f"{in_words(value, 'rad')} ({display_number(float(np.degrees(value)), 4)}°)"
    if unit in ("Pa s", "1/(Pa s)", "SI"):
        return f"{value:.4g} {unit}".replace(" SI", " (SI)")
    return in_words(value, unit, _DIGITS)


def _in_plain_words(kind: str) -> str:
    """``"CreepSeries"`` as people write it."""
    spaced = "".join(f" {letter}" if letter.isupper() else letter for letter in kind)
    return spaced.strip().lower()
