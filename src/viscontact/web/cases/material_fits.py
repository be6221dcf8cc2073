"""Fit of a law to tests of a material, uploaded to the page, at one temperature or several."""

from __future__ import annotations

import warnings
from typing import Any

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.prony import FitOptions
from viscontact.bodies.series_fits.table_fit import fit_measured, loss_note, measured_columns
from viscontact.drawing.matplotlib import fitted_series, master_curve
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.identification import (
    MasterCurve,
    ShiftFit,
    build_master_curve,
    fit_master_curve,
    material_section,
)
from viscontact.identification.shift_rows import (
    celsius,
    shift_head,
    shift_notes,
    shift_row,
    shift_rules,
)
from viscontact.identification.tabulated_sets import isotherms_of, usual_reference, with_volume
from viscontact.identification.vertical_shift import SuperpositionOptions
from viscontact.tables import Table, read_table
from viscontact.web.cases.case_reader import CaseReader, form_values
from viscontact.web.cases.fit_fields import quantities_of, uploaded_file
from viscontact.web.workspace.pictures import PictureChoice, picture
from viscontact.web.workspace.problems import InputProblem, RequestError, without_folder

#: Rules of the shift that may replace the factors that are found, by their names.
_RULES = {"factors": None, "wlf": "WLF", "arrhenius": "Arrhenius"}


@dataclass(frozen=True)
class MaterialFitRequest:
    """File of tests of a material, and options of the fit, as typed; empty for the usual ones."""

    file: str
    data: str = ""
    reference: str = ""
    shift: str = "factors"
    vertical: str = ""
    terms: str = ""
    poisson_ratio: str = ""
    bulk_modulus: str = ""


@dataclass(frozen=True)
class _Found:
    """Fit, with the master curve of several sets and the rules through its shift factors."""

    fit: Fit
    curve: MasterCurve | None = None
    rules: tuple[ShiftFit, ...] = ()


def fitted_tests(
    cases: CaseReader, request: MaterialFitRequest, *, dark: bool, width: Width | None = None
) -> dict[str, Any]:
    """Return the fit to a file that cases may name: shift factors, figure, and the material."""
    folder = cases.folder.case.parent
    if request.shift not in _RULES:
        raise RequestError(422, InputProblem(f"must be one of {', '.join(_RULES)}", "shift"))
    dimensions = {"reference": "temperature", "poisson_ratio": "", "bulk_modulus": "pressure"}
    given = quantities_of(request, dimensions)
    path = uploaded_file(request.file, folder)
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", AccuracyWarning)
            table = read_table(path)
            found = _fitted(table, request, given)
    except (ValueError, OSError) as error:
        raise RequestError(422, without_folder(str(error), folder)) from error
    section = material_section(found.fit, found.curve)
    material = form_values(section, folder)["material"]
    told = [without_folder(str(each.message), folder) for each in caught]
    return {
        "contact": [],
        "parameters": _parameters(material),
        "residual": " ".join(line.strip() for line in repr(found.fit).splitlines()[1:2]),
        "warnings": [*told, *filter(None, [loss_note(found.fit.measured)])],
        "shifts": _shifts(found),
        **{"figures": [], "drawings": [_drawing(found, width, dark=dark)]},
        **{"yaml": section, "material": material},
    }


def _fitted(table: Table, request: MaterialFitRequest, given: dict[str, float | None]) -> _Found:
    if table.has_varying_temperature:
        raise ValueError(
            f"{table.source.name}: the temperature of its test varies; `viscontact fit` takes it"
        )
    options = _options(table, request, given)
    volume = given["poisson_ratio"], given["bulk_modulus"]
    sets = table.sets()
    if len(sets) == 1:
        points, measured = measured_columns(table)
        return _Found(with_volume(fit_measured(points, measured, **options), *volume))
    isotherms, reference = isotherms_of(sets), given["reference"]
    reference = usual_reference(isotherms) if reference is None else reference
    _require_within(reference, [each.temperature for each in isotherms])
    joined = SuperpositionOptions()
    if request.vertical:
        joined["vertical"] = request.vertical  # type: ignore[typeddict-item]  # checked there
    curve = build_master_curve(isotherms, reference, **joined)
    rules = shift_rules(curve)
    if request.shift != "factors":
        chosen = [each for each in rules if type(each.shift).__name__ == _RULES[request.shift]]
        if not chosen:
            raise RequestError(422, InputProblem("needs more temperatures", "shift"))
        curve = build_master_curve(isotherms, reference, chosen[0].shift, **joined)
    fit = with_volume(fit_master_curve(curve, **options), *volume)
    return _Found(fit, curve, tuple(rules))


def _require_within(reference: float, temperatures: list[float]) -> None:
    low, high = celsius(min(temperatures)), celsius(max(temperatures))
    if not min(temperatures) <= reference <= max(temperatures):
        why = f"must be within the temperatures of the sets, {low} to {high}, got "
        raise RequestError(422, InputProblem(f"{why}{celsius(reference)}", "reference"))


def _options(
    table: Table, request: MaterialFitRequest, given: dict[str, float | None]
) -> FitOptions:
    """Options of the fit of a series; RequestError at the field that is missing."""
    data = request.data or table.data
    if data is None:
        why = "the headings do not say what kind of test it is; choose it"
        raise RequestError(422, InputProblem(why, "data"))
    terms = request.terms.strip()
    if terms and not terms.isdecimal():
        raise RequestError(422, InputProblem(f"must be a whole number, got {terms!r}", "terms"))
    options = FitOptions(data=data, fluid=False, terms=int(terms) if terms else None)
    if data != "uniaxial":
        return options
    if given["poisson_ratio"] is None and given["bulk_modulus"] is None:
        why = "uniaxial data need Poisson's ratio, such as 0.38, or a bulk modulus, such as 4 GPa"
        raise RequestError(422, InputProblem(why, "poisson_ratio"))
    options["poisson_ratio"] = given["poisson_ratio"]
    options["bulk_modulus"] = given["bulk_modulus"]
    return options


def _parameters(material: dict[str, Any]) -> list[dict[str, Any]]:
    """Name and value of each key of the law, as text."""
    return [
        {"name": name, "value": ", ".join(value) if isinstance(value, list) else str(value)}
        for name, value in material.items()
        if not isinstance(value, dict)
    ]


def _shifts(found: _Found) -> dict[str, Any] | None:
    """Table of the shift factors; None for a test at one temperature."""
    curve = found.curve
    if curve is None:
        return None
    count = len(curve.isotherms)
    title = f"{count} sets, shifted to {celsius(curve.reference_temperature)}"
    return {
        "title": f"{title}; intervals are those of 95 %",
        "head": shift_head(curve),
        "rows": [shift_row(curve, k) for k in range(count)],
        "notes": list(shift_notes(curve, list(found.rules))),
    }


def _drawing(found: _Found, width: Width | None, *, dark: bool) -> dict[str, str]:
    fit, curve = found.fit, found.curve
    if curve is None:
        figure = fitted_series(fit, width=width)
        caption = "Measured values, the fitted series and its residuals"
    else:
        figure = master_curve(curve, fit=fit, rules=found.rules, width=width)
        caption = "Sets at their temperatures, shift factors, and the master curve with the fit"
    choice = PictureChoice("fit", is_dark=dark)
    return {"caption": caption, "svg": picture(figure, choice).decode()}
