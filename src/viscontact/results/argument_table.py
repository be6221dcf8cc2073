"""What a noun was made with: names and values of its arguments, in readable units."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from viscontact.laws import Law
from viscontact.results.provenance import STORED_CLASSES
from viscontact.units.formatting import format_quantity

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
    **dict.fromkeys(["shape", "tolerance", "crown_ratio", "slowed", "factor", "factors"], "1"),
    **dict.fromkeys(["reference_temperature", "temperatures", "c2"], "K"),
    "c1": "1",
}
#: The same names for other quantities, by the noun they belong to.
_OTHERWISE = {
    ("CreepSeries", "amplitudes"): "1/Pa",
    ("Waviness", "amplitude"): "m",
    ("LogarithmicProfile", "amplitude"): "m",
    ("Revolved", "r"): "m",
    ("Arrhenius", "activation_energy"): "J/mol",
    ("HarmonicHistory force", "mean"): "N",
    ("HarmonicHistory force", "amplitude"): "N",
    ("HarmonicHistory approach", "mean"): "m",
    ("HarmonicHistory approach", "amplitude"): "m",
    ("BesideSpring", "equilibrium"): "Pa",
}
#: What is called by a name that says too little alone.
_WORDS = {
    ("CreepSeries", "instant"): "instant compliance",
    ("CreepSeries", "amplitudes"): "delayed compliances",
    ("CreepSeries", "times"): "retardation times",
    ("RelaxationSeries", "times"): "relaxation times",
    ("PowerLaw", "instant"): "instant compliance",
    ("BesideSpring", "shear_modulus"): "modulus of the spring beside",
    ("PlacedIndenter", "angle"): "turned by",
    ("PlacedIndenter", "x"): "moved along x by",
    ("PlacedIndenter", "y"): "moved along y by",
    ("ForceHistory", "times"): "at times",
    ("ApproachHistory", "times"): "at times",
}
_LAWS = {name for name, noun in STORED_CLASSES.items() if issubclass(noun, Law)}
#: Nouns whose part of the table says what they are.
_PLAIN = {"Material", "Grid", "AutomaticGrid"}
_PLAIN |= {"ForceHistory", "ApproachHistory", "HarmonicHistory"}
_PLAIN |= {"CombinedIndenter", "PlacedIndenter"}
#: Arguments that nobody has written if this is their value.
_IDLE: dict[str, tuple[object, ...]] = {
    **dict.fromkeys(["eccentricity_x", "eccentricity_y", "fluidity", "phase"], (0,)),
    **dict.fromkeys(["phase_x", "phase_y", "angle", "second_exponent"], (0,)),
    "cross_section": ("circle",),
}
#: Nouns that are named by people, with a capital.
_NAMED = {"Maxwell", "Zener", "Burgers", "Arrhenius"}
#: What was typed is to be recognised.
_DIGITS = 6
#: So many numbers of a list say enough.
_MOST = 8


def particulars(noun: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, str]]:
    """Yield names and values of a noun's arguments, those of nouns within it as well.

    Parameters
    ----------
    noun : mapping
        The noun as `describe` gives it.
    before : str, optional
        What stands before each name: whose arguments they are.

    Yields
    ------
    name, value : str
        The argument in words, and its value with its unit.

    Examples
    --------
    >>> sphere = {"type": "Sphere", "radius": 0.01}
    >>> list(particulars(sphere))
    [('shape', 'sphere'), ('radius', '10 mm')]
    """
    kind = str(noun.get("type", ""))
    if kind and kind not in _PLAIN:
        yield before or ("law" if kind in _LAWS else "shape"), in_plain_words(kind)
    for key, value in noun.items():
        word = _WORDS.get((kind, key), key.replace("_", " ").replace("poisson", "Poisson's"))
        name = f"{before} {word}".strip()
        if isinstance(value, Mapping) and "sha256" in value:
            size = " × ".join(map(str, value.get("shape", ())))
            yield name, f"{size} points, fingerprint {str(value['sha256'])[:12]}"
        elif isinstance(value, Mapping):
            yield from particulars(value, before if key in ("law", "body") else name)
        elif _holds_nouns(value):
            for index, each in enumerate(value, 1):
                yield from particulars(each, f"{before} part {index}".strip())
        elif key != "type" and not _is_idle(kind, key, value):
            yield name, _worth(f"{kind} {noun.get('control', '')}".strip(), key, value)


def _is_idle(kind: str, key: str, value: Any) -> bool:
    """Tell what nobody has written."""
    if value is None or value is False or (kind == "PlacedIndenter" and value == 0):
        return True
    given = value if isinstance(value, list) else [value]
    return key in _IDLE and all(each in _IDLE[key] for each in given)


def _holds_nouns(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)


def _worth(kind: str, key: str, value: Any) -> str:
    unit = _OTHERWISE.get((kind, key), _UNITS.get(key, "SI"))
    if isinstance(value, bool) or not isinstance(value, int | float | list):
        return "yes" if value is True else str(value)
    if isinstance(value, list) and all(isinstance(each, str) for each in value):
        return ", ".join(each.replace("_", " ") for each in value)
    try:
        numbers = np.atleast_1d(np.asarray(value, dtype=np.float64)).ravel().tolist()
    except (TypeError, ValueError):
        return str(value)
    if key in ("shape", "size"):
        return " × ".join(_number(number, unit) for number in numbers)
    if isinstance(value, list) and isinstance(value[0], list):
        return f"{len(value)} × {len(value[0])} points, {_ends(numbers, unit)}"
    if len(set(numbers)) == 1:
        numbers = numbers[:1]
    if len(numbers) > _MOST:
        return f"{len(numbers)} values, {_ends(numbers, unit)}"
    return ", ".join(_number(number, unit) for number in numbers)


def _ends(numbers: Sequence[float], unit: str) -> str:
    least, most = (_number(number, unit, digits=4) for number in (min(numbers), max(numbers)))
    return f"from {least} to {most}"


def _number(value: float, unit: str, digits: int = _DIGITS) -> str:
    if unit == "1":
        return f"{value:.6g}"
    if unit == "K":  # nobody counts temperatures in kilokelvins
        return f"{value:.6g} K"
    if unit == "rad" and value:
        return (
            f"{format_quantity(value, 'rad')} ({format_quantity(float(np.degrees(value)), '1')}°)"
        )
    if unit in ("1/(Pa s)", "SI"):
        return f"{value:.4g} {unit}".replace(" SI", " (SI)")
    # As case files write it: 0.55 / GPa.
    return format_quantity(value, unit, digits).replace(" 1/", " / ")


def in_plain_words(kind: str) -> str:
    """Write the name of a type as people do.

    Parameters
    ----------
    kind : str
        Such as ``"CreepSeries"``.

    Examples
    --------
    >>> in_plain_words("CreepSeries"), in_plain_words("FractionalMaxwell")
    ('creep series', 'fractional Maxwell')
    """
    parts = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", kind).split()
    kept = (part.isupper() or part in _NAMED for part in parts)
    return " ".join(p if keep else p.lower() for p, keep in zip(parts, kept, strict=True))
