"""Inputs of a run, with units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.results.argument_table import argument_rows
from viscontact.results.filed_case import FiledCase
from viscontact.results.recorded_case import case_of
from viscontact.results.run_files import CASE_NAME, RESULT_NAME
from viscontact.results.typed_rows import typed_rows
from viscontact.units.formatting import format_quantity

_PARTS = {
    "indenter": "Indenter",
    "material": "Material of the half-space",
    "indenter_material": "Material of the indenter",
    "load": "Load",
    "temperature": "Temperature",
    "motion": "Motion",
    "grid": "Grid",
}
#: Sections of a case file.
_TYPED_PARTS = _PARTS | {"time": "Time", "output": "Output"}

#: Speeds up to this number are listed one by one.
_FEW_SPEEDS = 6


@dataclass(frozen=True)
class InputRow:
    """One argument of a part of the case, with its value in a unit, and as it was typed."""

    part: str
    name: str
    value: str = ""
    typed: str = ""


def inputs(ds: xr.Dataset) -> list[InputRow]:
    """List the inputs of a run."""
    case = case_of(ds)
    found = [
        InputRow(title, name, value)
        for key, title in _PARTS.items()
        if isinstance(case.get(key), dict) and case[key].get("kind") != "steady"
        for name, value in argument_rows(case[key])
    ]
    if case and case.get("indenter_material") is None and "indenter" in case:
        place = sum(each.part in ("Indenter", _PARTS["material"]) for each in found)
        found.insert(place, InputRow(_PARTS["indenter_material"], "law", "rigid"))
    found += [*_steady(case), *_steps(case)]
    return _merge_rows(found, _typed_rows(FiledCase.of(ds.attrs).case_as_typed))


def _typed_rows(case: Mapping[str, Any]) -> Iterator[InputRow]:
    for key, title in _TYPED_PARTS.items():
        for name, text in typed_rows(case.get(key)):
            yield InputRow(title, name, typed=text)


def _merge_rows(computed: list[InputRow], typed: Iterable[InputRow]) -> list[InputRow]:
    """Put the typed values beside the computed ones of the same name, the others before these."""
    values = {(each.part, each.name): each.value for each in computed}
    rows: dict[str, list[InputRow]] = {part: [] for part in _TYPED_PARTS.values()}
    for each in typed:
        value = values.pop((each.part, each.name), "")
        same = _normal_text(value) == _normal_text(each.typed)
        rows[each.part].append(replace(each, value="" if same else value))
    for each in computed:
        if (each.part, each.name) in values:
            rows[each.part].append(each)
    return [each for part in rows.values() for each in part]


def _normal_text(text: str) -> str:
    """Text without what the two notations differ in."""
    return text.replace("-", " ").replace("um", "µm").replace(" ", "").replace("×", ",")


def case_file(ds: xr.Dataset) -> str:
    """The case file that lies next to the result; empty if there is none."""
    source = Path(str(ds.encoding.get("source", "")))
    beside = source.parent / CASE_NAME
    if source.name != RESULT_NAME or not beside.is_file():
        return ""
    return beside.read_text(encoding="utf-8", errors="replace")


def _steady(case: Mapping[str, Any]) -> Iterator[InputRow]:
    motion = case.get("motion") or {}
    if motion.get("kind") != "steady":
        return
    speeds = [format_quantity(float(each), "m/s") for each in motion["speed"]]
    few = len(speeds) <= _FEW_SPEEDS
    listed = ", ".join(speeds) if few else f"{len(speeds)}, from {speeds[0]} to {speeds[-1]}"
    yield InputRow("Motion", "kind", "steady")
    yield InputRow("Motion", "speed" if len(speeds) == 1 else "speeds", listed)
    yield InputRow("Motion", "along", str(motion["along"]))
    if motion.get("rolling") is not None:
        yield InputRow("Motion", "rolling", "yes" if motion["rolling"] else "no, it slides")
    if "tolerance" in case:
        yield InputRow("Motion", "tolerance at each speed", f"{case['tolerance']:g}")


def _steps(case: Mapping[str, Any]) -> Iterator[InputRow]:
    times, adaptive = case.get("times") or [], case.get("adaptive")
    if not times:
        return
    start, end = format_quantity(times[0], "s"), format_quantity(times[-1], "s")
    if adaptive is None:
        yield InputRow("Time", "steps", f"{len(times)}, from {start} to {end}")
    else:
        tolerance = adaptive.get("tolerance", "?")
        yield InputRow("Time", "steps", f"chosen by their error, {tolerance} at most, up to {end}")
    if "tolerance" in case:
        yield InputRow("Time", "tolerance of each instant", f"{case['tolerance']:g}")
