"""Fields of the fits of the page: quantities as typed, and names of uploaded files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from viscontact.case.plain_names import is_plain_name
from viscontact.identification.instrument_curves import split_number
from viscontact.tables import split_sheet
from viscontact.units.parsing import parse_quantity
from viscontact.web.workspace.problems import InputProblem, RequestError


def quantities_of(request: object, dimensions: Mapping[str, str]) -> dict[str, float | None]:
    """Quantities of fields in SI, None where left out; RequestError with each that is not read."""
    found: dict[str, float | None] = {}
    problems = []
    for name, dimension in dimensions.items():
        text = str(getattr(request, name)).strip()
        try:
            found[name] = _read_quantity(text, dimension) if text else None
        except ValueError as error:
            problems.append(InputProblem(str(error), name))
    if problems:
        raise RequestError(422, *problems)
    return found


def uploaded_file(name: str, folder: Path) -> Path:
    """Path of an uploaded file, with the sheet or the number of a curve behind it."""
    if not is_plain_name(name.partition("#")[0]) or "/" in name or "\\" in name:
        raise RequestError(422, InputProblem("upload the file, and give its name alone", "file"))
    path = folder / name
    if not split_number(split_sheet(path)[0])[0].is_file():
        raise RequestError(422, InputProblem(f"there is no file {name!r}; upload it", "file"))
    return path


def _read_quantity(text: str, dimension: str) -> float:
    if dimension:
        return parse_quantity(text, dimension)
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"{text!r} is not a number; write e.g. 0.5") from None
