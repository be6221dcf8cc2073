"""Fit of a law to a force curve or an indentation record that was uploaded to the page."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Cone, FlatPunch, Indenter, Pyramid, Sphere
from viscontact.drawing.content.look import Look
from viscontact.drawing.plotly.indentation_fits import (
    contact_point,
    fit_over_time,
    force_over_approach,
)
from viscontact.drawing.plotly.parts import plain
from viscontact.identification import (
    ContactPoint,
    ForceCurve,
    IndentationFit,
    IndentationRecord,
    find_contact,
    fit_indentation,
    material_section,
    read_force_curve,
)
from viscontact.identification.force_curve import tabulated_curve
from viscontact.identification.instrument_curves import is_instrument_file
from viscontact.tables import Table, read_table
from viscontact.units.formatting import format_number, format_quantity, readable_unit
from viscontact.units.parsing import parse_quantity
from viscontact.web.cases.case_reader import CaseReader, form_values
from viscontact.web.cases.fit_fields import quantities_of, uploaded_file
from viscontact.web.workspace.problems import InputProblem, RequestError, without_folder

#: Tips by their names, with the dimension of their size.
_TIPS: dict[str, tuple[Callable[[float], Indenter], str]] = {
    "sphere": (Sphere, "length"),
    "cone": (Cone, "angle"),
    "pyramid": (partial(Pyramid, faces=4), "angle"),
    "punch": (FlatPunch, "length"),
}


@dataclass(frozen=True)
class CurveFitRequest:
    """File of a measurement, its instrument and the law to fit, quantities as typed."""

    file: str
    size: str
    tip: str = "sphere"
    spring_constant: str = ""
    sensitivity: str = ""
    law: str = "zener"
    terms: int = 1
    poisson_ratio: str = ""
    bulk_modulus: str = ""


def fitted_curve(request: CurveFitRequest, folder: Path, look: Look) -> dict[str, Any]:
    """Return the fit to a file of a folder: parameters, figures, and the material of a case."""
    given = _quantities(request)
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", AccuracyWarning)
            record, contact = _record(request, folder, given)
            fit = fit_indentation(
                record,
                request.law,
                terms=request.terms,
                poisson_ratio=given["poisson_ratio"],
                bulk_modulus=given["bulk_modulus"],
            )
    except (ValueError, OSError) as error:
        raise RequestError(422, without_folder(str(error), folder)) from error
    section = material_section(fit)
    figures = [force_over_approach(fit, look), fit_over_time(fit, look)]
    if contact is not None:
        figures.insert(0, contact_point(contact, look))
    return {
        "contact": [] if contact is None else [*_contact_rows(contact), *_fitted_rows(fit)],
        "parameters": _parameter_rows(fit),
        "residual": f"{100 * fit.residual:.2g} % rms of the largest value",
        "warnings": [str(each.message) for each in caught],
        "figures": [plain(figure) for figure in figures],
        "yaml": section,
        "material": form_values(section, folder)["material"],
    }


def fit_of_upload(cases: CaseReader, request: CurveFitRequest, look: Look) -> dict[str, Any]:
    """Return the fit to a file that cases may name."""
    return fitted_curve(request, cases.folder.case.parent, look)


def _quantities(request: CurveFitRequest) -> dict[str, float | None]:
    """Quantities in SI, None where left out; RequestError with each that cannot be read."""
    dimensions = {
        **{"spring_constant": "stiffness", "sensitivity": "sensitivity"},
        **{"poisson_ratio": "", "bulk_modulus": "pressure"},
    }
    problems = []
    try:
        found = quantities_of(request, dimensions)
    except RequestError as error:
        problems += [InputProblem(**each) for each in error.body["problems"]]
    if not request.poisson_ratio.strip() and not request.bulk_modulus.strip():
        problems.append(
            InputProblem("give Poisson's ratio, such as 0.5, or a bulk modulus", "poisson_ratio")
        )
    if request.tip not in _TIPS:
        problems.append(InputProblem(f"must be one of {', '.join(_TIPS)}", "tip"))
    elif not request.size.strip():
        problems.append(InputProblem("is missing; the size of the tip, such as 5 um", "size"))
    if problems:
        raise RequestError(422, *problems)
    return found


def curve_of_file(
    path: Path, stiffness: float | None, sensitivity: float | None = None
) -> ForceCurve:
    """Force curve of a file, of an instrument or a table; spring constant [N/m], [m/V]."""
    if is_instrument_file(path):
        return read_force_curve(path, spring_constant=stiffness)
    return _tabulated(read_table(path), stiffness, sensitivity)


def _record(
    request: CurveFitRequest, folder: Path, given: dict[str, float | None]
) -> tuple[IndentationRecord, ContactPoint | None]:
    """Record of indentation, and the contact point of a force curve."""
    indenter, path = _tip(request), uploaded_file(request.file, folder)
    stiffness = given["spring_constant"]
    if is_instrument_file(path):
        return _from_curve(curve_of_file(path, stiffness), indenter)
    table = read_table(path)
    if "force" in table and "approach" in table:
        return IndentationRecord(indenter, table["time"], table["approach"], table["force"]), None
    return _from_curve(_tabulated(table, stiffness, given["sensitivity"]), indenter)


def _tabulated(table: Table, stiffness: float | None, sensitivity: float | None) -> ForceCurve:
    if stiffness is None:
        why = "a force curve in a table needs the spring constant, such as 0.1 N/m"
        raise RequestError(422, InputProblem(why, "spring_constant"))
    return tabulated_curve(table, stiffness, sensitivity)


def _from_curve(curve: ForceCurve, indenter: Indenter) -> tuple[IndentationRecord, ContactPoint]:
    contact = find_contact(curve, indenter)
    return contact.record(), contact


def _tip(request: CurveFitRequest) -> Indenter:
    kind, dimension = _TIPS[request.tip]
    try:
        return kind(parse_quantity(request.size, dimension))
    except ValueError as error:
        raise RequestError(422, InputProblem(str(error), "size")) from error


def _contact_rows(contact: ContactPoint) -> list[tuple[str, str]]:
    at = format_quantity(contact.position, "m", 5).replace("-", "−")
    return [
        ("Contact point", f"{at} ± {format_quantity(contact.position_error, 'm', 2)}"),
        ("Slope of the baseline", f"{format_number(contact.slope, 3)}"),
        ("Noise (rms)", format_quantity(contact.noise, "m", 2)),
        ("E/(1 − ν²) of an elastic body", format_quantity(contact.contact_modulus, "Pa", 4)),
        ("Spring constant", format_quantity(contact.curve.spring_constant, "N/m", 4)),
    ]


def _fitted_rows(fit: IndentationFit) -> list[tuple[str, str]]:
    """Contact point that was fitted together with the law."""
    if fit.contact is None:
        return []
    at, low, high = (
        format_quantity(each, "m", 5).replace("-", "−")
        for each in (fit.contact.position, *fit.contact.position_interval)
    )
    return [("Contact point, fitted with the law", f"{at} ({low} to {high})")]


def _parameter_rows(fit: IndentationFit) -> list[dict[str, Any]]:
    """Name, value and confidence interval of each parameter, as text."""
    rows, stated = [], fit.in_numbers("")
    for name, value in stated.values.items():
        unit = readable_unit(stated.units[name] or "1", value)
        interval = ""
        if name in stated.intervals:
            low, high = (format_number(each / unit.factor, 4) for each in stated.intervals[name])
            interval = f"{low} to {high} {unit.symbol}".strip()
        number = format_number(value / unit.factor, 4)
        rows.append(
            {
                **{"name": name, "value": f"{number} {unit.symbol}".strip()},
                "interval": interval,
                "confidence": f"{100 * fit.confidence:.0f} %",
            }
        )
    return rows
