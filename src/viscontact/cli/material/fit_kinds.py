"""Kinds of measured data that `fit` recognises, and the options that apply to each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass

_INDENTED = (
    "an indentation (columns time, approach and force, or time, position, and deflection or force)"
)
_CURVE = "a force curve (columns time, position, and deflection or force)"
_SERIES = "creep, relaxation or oscillation"
_WARMED = "tests at several temperatures or one test whose temperature varies"

#: Data that an option of `fit` goes with, by its parameter; the others go with all data.
GOES_WITH = {
    "data": _SERIES,
    "fluid": _SERIES,
    "weight": "storage and loss over frequency at constant temperatures",
    "stress": "the strain of a creep test",
    "columns": "a table",
    "reference": _WARMED,
    "temperature": _WARMED,
    "vertical": "tests at several temperatures",
    "expansion": "tests at several temperatures",
    "shift": "one test whose temperature varies",
    "thermal_strain": "one creep test whose temperature varies",
    "indenter": _INDENTED,
    "until": _INDENTED,
    "law": _INDENTED,
    "reference_time": _INDENTED,
    "thickness": _INDENTED,
    "spring_constant": _CURVE,
    "reach": _CURVE,
    "adhesion": _CURVE,
    "sensitivity": "a force curve with its deflection in volts",
}


@dataclass(frozen=True)
class Kind:
    """Kind of measured data: its name in messages, and the options of `GOES_WITH` it has."""

    name: str
    options: frozenset[str]

    def refuse_idle(self, source: str, given: Iterable[str], contents: str = "") -> None:
        """Refuse given options that do not apply to data of this kind in a file.

        `contents` are the columns of a table in words.
        """
        typed = list(given)
        kind = self._with_adhesion() if "adhesion" in self.options & {*typed} else self
        idle = [each for each in typed if each in GOES_WITH and each not in kind.options]
        if not idle:
            return
        where = "; ".join(f"{switch(each)} goes with {GOES_WITH[each]}" for each in idle)
        found = f"{kind.name}; {contents}" if contents else kind.name
        left = " and ".join(map(switch, idle))
        raise ValueError(f"{source}: {where}; this is {found}; leave {left} out")

    def _with_adhesion(self) -> Kind:
        """The same force curve where its adhesion is fitted: the body is elastic."""
        options = self.options - {"law", "until", "reference_time", "thickness", "reach"}
        return Kind(f"{self.name}, fitted as a whole with --adhesion to an elastic body", options)


def switch(parameter: str) -> str:
    """Return an option as it is typed."""
    return f"--{parameter.replace('_', '-')}"


# A stress chooses among the columns of a table, whose reader refuses it.
_OF_TABLES = frozenset({"columns", "stress"})
_OF_SERIES = _OF_TABLES | {"data", "fluid"}
_OF_WARMED = _OF_SERIES | {"reference", "temperature"}
_OF_INDENTATIONS = frozenset({"indenter", "until", "law", "reference_time", "thickness"})
_OF_CURVES = _OF_INDENTATIONS | {"spring_constant", "reach", "adhesion"}

INDENTATION = Kind("an indentation record with its approach", _OF_INDENTATIONS | _OF_TABLES)
FORCE_CURVE = Kind(
    "a force curve with its deflection as a length or force", _OF_CURVES | _OF_TABLES
)
VOLTAGE_CURVE = Kind("a force curve in volts", FORCE_CURVE.options | {"sensitivity"})
INSTRUMENT_CURVE = Kind("a force curve in a file of an instrument", _OF_CURVES)


def one_set(measured: Mapping[str, Floats]) -> Kind:
    """Kind of measured columns at one temperature."""
    return Kind(f"{_test(measured)} at one temperature", _OF_SERIES | _weight(measured))


def several_sets(measured: Mapping[str, Floats]) -> Kind:
    """Kind of measured columns at several temperatures."""
    options = _OF_WARMED | _weight(measured) | {"vertical", "expansion"}
    return Kind(f"{_test(measured)} at several temperatures", options)


def varying_temperature(measured: Mapping[str, Floats]) -> Kind:
    """Kind of measured columns over a temperature that varies."""
    strained = {"thermal_strain"} if "compliance" in measured else set()
    options = _OF_WARMED | {"shift"} | strained
    return Kind(f"{_test(measured)} whose temperature varies", options)


def _test(measured: Mapping[str, Floats]) -> str:
    if "storage" in measured:
        return "an oscillation test" + ("" if "loss" in measured else " without losses")
    return "a creep test" if "compliance" in measured else "a relaxation test"


def _weight(measured: Mapping[str, Floats]) -> frozenset[str]:
    return frozenset({"weight"} if "loss" in measured else ())
