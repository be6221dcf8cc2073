"""Drawings of a case before it is run: indenter and spectra, curves and fits of laws, load."""

from __future__ import annotations

from collections.abc import Iterator

from matplotlib.figure import Figure

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads import MixedHistory
from viscontact.bodies.materials.layers import Layered, creeping_laws, without_ends
from viscontact.bodies.materials.material import Material
from viscontact.case import Case, CaseError, Parts
from viscontact.drawing.content.law_curves import curve_times
from viscontact.drawing.content.shape import natural_size
from viscontact.drawing.content.small_panels import law_span
from viscontact.drawing.matplotlib import (
    creep_curve,
    draw_indenter,
    draw_load,
    draw_power_spectrum,
    fitted_series,
)
from viscontact.drawing.matplotlib.layout.page import Width
from viscontact.runs.check_report import drawn_size
from viscontact.runs.forecast import Forecast
from viscontact.runs.preparation import PreparedRun
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.workspace.pictures import PictureChoice, picture
from viscontact.web.workspace.problems import RequestError, case_problems


@dataclass(frozen=True)
class Captioned:
    """Figure with its caption; None where nothing can be drawn, as the caption explains."""

    figure: Figure | None
    caption: str = ""


def drawings(
    cases: CaseReader, text: str, what: str, width: Width | None = None
) -> list[Captioned]:
    """Draw a part of a case, on its own where the rest of the case is not valid."""
    try:
        return _of_case(cases, text, what, width)
    except RequestError:
        alone = _draw_part(cases.parts(text), what, width)
        if alone is None:
            raise
        return [Captioned(alone)]


def drawn_as_svg(
    cases: CaseReader, text: str, choice: PictureChoice, width: Width | None
) -> list[dict[str, str]]:
    """Draw a part of a case, as captions and SVG; empty where there is a caption only."""
    found = drawings(cases, text, choice.name, width)
    return [{"caption": each.caption, "svg": _svg(each, choice)} for each in found]


def _svg(drawn: Captioned, choice: PictureChoice) -> str:
    return "" if drawn.figure is None else picture(drawn.figure, choice).decode()


def _of_case(cases: CaseReader, text: str, what: str, width: Width | None) -> list[Captioned]:
    case = cases.case(text)
    try:
        if what == "indenter":
            return [Captioned(_indenter(*cases.forecast(text), width)), *_spectra(case, width)]
        if what == "load":
            if isinstance(case.load, MixedHistory):  # carried out for the forecast
                case = cases.forecast(text)[0].case
            return [Captioned(draw_load(case.load, case.end, temperature=case.temperature))]
        return list(_material(case, what, width))
    except CaseError as error:
        raise case_problems(error, case.document.path) from error
    except ValueError as error:
        raise RequestError(422, f"the {what} cannot be drawn: {error}") from error


def _spectra(case: Case, width: Width | None) -> list[Captioned]:
    """Power spectra of the measured surfaces of a case."""
    return [
        Captioned(None, f"{surface.name}: no power spectrum is drawn, because points are missing")
        if surface.missing.any()
        else Captioned(draw_power_spectrum(surface, width=width))
        for surface in case.surfaces
    ]


def _draw_part(parts: Parts, what: str, width: Width | None) -> Figure | None:
    """Drawing of a valid part of an invalid case, over a range of its own."""
    try:
        if what == "indenter" and parts.indenter is not None:
            return draw_indenter(parts.indenter, natural_size(parts.indenter), width=width)
        if what == "load" and isinstance(parts.load, MixedHistory):
            return None  # nothing is known of its course
        if what == "load" and parts.load is not None:
            end = parts.end or float(parts.load.kinks[-1])
            return draw_load(parts.load, end)
        material = parts.indenter_material if what == "indenter_material" else parts.material
        if what.endswith("material") and material is not None:
            return _curves(material, parts.end, width)
    except ValueError:  # such as a step without an end
        return None
    return None


def _indenter(found: PreparedRun, expected: Forecast, width: Width | None) -> Figure:
    case, estimate = found.case, expected.estimate
    contact = None
    if estimate is not None:
        contact = (estimate.centre_x, estimate.centre_y, estimate.length, estimate.width)
    size, ends = drawn_size(found.run), found.run.contact.planes
    return draw_indenter(case.indenter, size, contact=contact, ends=ends, width=width)


def _material(case: Case, what: str, width: Width | None) -> Iterator[Captioned]:
    """Fit of a law, or curves of the laws of a body and the fits of its layers."""
    body = _body(case, what)
    if what in case.fits:
        yield Captioned(fitted_series(case.fits[what], width=width))
        return
    yield Captioned(_curves(body, case.end, width))
    for key, fit in case.fits.items():
        if key.startswith(f"{what}."):
            yield Captioned(fitted_series(fit, width=width), key)


def _body(case: Case, what: str) -> Material | Layered:
    material = case.indenter_material if what == "indenter_material" else case.material
    if material is None:
        raise RequestError(422, "the indenter is rigid: there are no curves of its material")
    return without_ends(material)


def _curves(body: Material | Layered, end: float | None, width: Width | None) -> Figure:
    """Curves of the parts that creep, up to the end of the run, else over their own times."""
    laws = creeping_laws(body)
    last = end or max(law_span(law)[1] for law in laws.values())
    return creep_curve(laws, curve_times(last), width=width)
