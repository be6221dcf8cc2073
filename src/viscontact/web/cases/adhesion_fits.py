"""Fit of adhesion to the force curve of a sphere that was uploaded to the page."""

from __future__ import annotations

import math
import warnings
from pathlib import Path
from typing import Any

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Sphere
from viscontact.drawing.matplotlib import fitted_adhesion
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.identification import AdhesionFit, adhesive_sections, fit_adhesion
from viscontact.units.formatting import format_number, format_quantity, readable_unit
from viscontact.web.cases.case_reader import CaseReader, form_values
from viscontact.web.cases.curve_fits import curve_of_file
from viscontact.web.cases.fit_fields import quantities_of, uploaded_file
from viscontact.web.workspace.pictures import PictureChoice, picture
from viscontact.web.workspace.problems import InputProblem, RequestError, without_folder

#: What has to be given, and how it is missed.
_NEEDED = {
    "size": "is missing; the radius of the sphere, such as 5 um",
    "poisson_ratio": "give Poisson's ratio, such as 0.5",
}


@dataclass(frozen=True)
class AdhesionFitRequest:
    """File of a force curve, its sphere and cantilever, quantities as typed."""

    file: str
    size: str
    spring_constant: str = ""
    sensitivity: str = ""
    poisson_ratio: str = ""


def adhesion_of_upload(
    cases: CaseReader, request: AdhesionFitRequest, *, dark: bool, width: Width | None = None
) -> dict[str, Any]:
    """Return the fit to a file that cases may name: values, figure, material and adhesion."""
    folder = cases.folder.case.parent
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", AccuracyWarning)
            fit = _fitted(request, folder)
    except (ValueError, OSError) as error:
        raise RequestError(422, without_folder(str(error), folder)) from error
    text = adhesive_sections(fit)
    sections = form_values(text, folder)
    choice = PictureChoice("fit", is_dark=dark)
    caption = "Force over approach and over time, measured and fitted, with jumps and residuals"
    svg = picture(fitted_adhesion(fit, width=width), choice).decode()
    return {
        "contact": _facts(fit),
        "parameters": [_row(fit, *each) for each in zip(fit.parameters, fit.units, strict=True)],
        "residual": f"{100 * fit.residual:.2g} % rms of the largest force",
        "warnings": [str(each.message) for each in caught],
        **{"figures": [], "drawings": [{"caption": caption, "svg": svg}], "yaml": text},
        **{name: sections[name] for name in ("material", "adhesion")},
    }


def _fitted(request: AdhesionFitRequest, folder: Path) -> AdhesionFit:
    dimensions = {"size": "length", "spring_constant": "stiffness", "sensitivity": "sensitivity"}
    given = quantities_of(request, dimensions | {"poisson_ratio": ""})
    missing = [InputProblem(why, name) for name, why in _NEEDED.items() if given[name] is None]
    if missing:
        raise RequestError(422, *missing)
    radius, poisson_ratio = given["size"], given["poisson_ratio"]
    assert radius is not None  # checked above
    assert poisson_ratio is not None
    path = uploaded_file(request.file, folder)
    curve = curve_of_file(path, given["spring_constant"], given["sensitivity"])
    return fit_adhesion(curve, Sphere(radius), poisson_ratio=poisson_ratio)


def _facts(fit: AdhesionFit) -> list[tuple[str, str]]:
    at, low, high = (
        format_quantity(each, "m", 5).replace("-", "−")
        for each in (fit.contact.position, *fit.contact.position_interval)
    )
    return [
        ("Contact point", f"{at} ({low} to {high})"),
        ("Pull-off force", format_quantity(fit.pull_off_force, "N", 4)),
        ("Limit", fit.limit),
        ("Spring constant", format_quantity(fit.curve.spring_constant, "N/m", 4)),
    ]


def _row(fit: AdhesionFit, name: str, unit: str) -> dict[str, Any]:
    """Name, value and interval of a parameter, as text; the end that is known of an open one."""
    value, (low, high) = fit.parameters[name], fit.intervals[name]
    readable = readable_unit(
        unit or "1", next(each for each in (value, high, low, 1.0) if _is(each))
    )

    def text(number: float, digits: int = 4) -> str:
        return f"{format_number(number / readable.factor, digits)} {readable.symbol}".strip()

    interval = f"{format_number(low / readable.factor, 4)} to {text(high)}"
    if math.isinf(high):
        interval = f"above {text(low)}" if low > 0 else "open"
    elif low == 0:
        interval = f"below {text(high)}"
    return {
        **{"name": name, "value": text(value) if _is(value) else "not determined"},
        **{"interval": interval, "confidence": f"{100 * fit.confidence:.0f} %"},
    }


def _is(value: float) -> bool:
    """True of a value that is neither that of no range nor of an infinite one."""
    return 0 < value < math.inf
