"""The sections of a case file for a fitted law, and for fitted adhesion."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields
from textwrap import wrap

from viscontact import identification
from viscontact.bodies.laws import (
    Burgers,
    CreepSeries,
    Elastic,
    Law,
    Maxwell,
    PowerLaw,
    RelaxationSeries,
    Zener,
)
from viscontact.bodies.series_fits.fit import Fit
from viscontact.identification.adhesion_fit import AdhesionFit
from viscontact.identification.indentation_fit import IndentationFit
from viscontact.identification.shift_section import shift_lines

_DIGITS = 6


def material_section(
    fit: Fit | IndentationFit,
    curve: identification.MasterCurve | None = None,
    temperature: float | None = None,
) -> str:
    """Return the law of a fit as a section to paste into a case file.

    Parameters
    ----------
    fit : Fit or IndentationFit
        From `fit_creep`, `fit_relaxation`, `fit_dynamic` or `fit_indentation`.
    curve : MasterCurve, optional
        The master curve that was fitted: its shift factors are written, so that a case may ask for
        another temperature, and its warnings. A fit to a test under a temperature that varied
        has its own.
    temperature : float, optional
        Temperature of the law of `fit` [K]; that of the curve if left out.

    Returns
    -------
    str
        YAML, in the terms of the data and with six digits. Without data on the
        volume, a comment asks for it. A misfit is a comment and a warning, which runs with the law
        issue.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.bodies.series_fits.prony import fit_relaxation
    >>> t = np.geomspace(0.1, 100.0, 20)
    >>> fit = fit_relaxation(t, 1e9 + 2e9 * np.exp(-t / 5.0), data="uniaxial", poisson_ratio=0.4)
    >>> print(material_section(fit))
    material:
      law: relaxation-series
      equilibrium: 1000 MPa
      moduli: [2000 MPa]
      times: [5 s]
      data: uniaxial
      poisson_ratio: 0.4
    """
    if isinstance(fit, IndentationFit):
        law: Law = fit.law
        data = "deviatoric" if isinstance(law, CreepSeries | PowerLaw) else "shear"
        volume = _volume(fit.material.poisson_ratio, fit.material.bulk_modulus)
    else:
        law, data = fit.series, fit.data
        volume = _volume(fit.poisson_ratio, fit.bulk_modulus)
    doubts, shift = _shift_of(fit, curve, temperature)
    lines = [*_warning(fit, doubts), *_law(law), f"data: {data}", volume, *shift]
    if isinstance(fit, IndentationFit) and fit.thickness is not None:
        layer = [f"thickness: {_number(1e6 * fit.thickness)} um", *lines]
        lines = ["layers:", f"- {layer[0]}", *(f"  {line}" for line in layer[1:]), "base: rigid"]
    return "\n".join(["material:", *(f"  {line}" for line in lines)])


def adhesive_sections(fit: AdhesionFit) -> str:
    """Return modulus and adhesion of a fit as sections to paste into a case file.

    Parameters
    ----------
    fit : AdhesionFit
        From `fit_adhesion`.

    Returns
    -------
    str
        YAML, with six digits; a comment says which range it may be where the curve does not
        determine one.
    """
    work, length = fit.parameters["work"], fit.parameters["range"]
    given = f"range: {_number(length)} m"
    if not fit.tells_range:
        given = f"# range: {fit.limit}"
    volume = _volume(fit.material.poisson_ratio, fit.material.bulk_modulus)
    material = ["material:", *_law(fit.material.law), "data: shear", volume]
    adhesion = ["adhesion:", f"work: {_number(work)} J/m2", given, "law: dugdale"]
    return "\n".join("\n  ".join(each) for each in (material, adhesion))


def _shift_of(
    fit: Fit | IndentationFit, curve: identification.MasterCurve | None, temperature: float | None
) -> tuple[Sequence[str], list[str]]:
    """Doubts about the shift of a fit, and the lines of it; none without a shift."""
    if curve is not None:
        reference = curve.reference_temperature if temperature is None else temperature
        return curve.warnings, shift_lines(curve.shift, reference)
    found = None if isinstance(fit, IndentationFit) else fit.found_shift
    if found is None:
        return (), []
    reference = found.reference_temperature if temperature is None else temperature
    return found.warnings, shift_lines(found.shift, reference)


def _warning(fit: Fit | IndentationFit, doubts: Sequence[str]) -> list[str]:
    """Lines with the doubts and the misfit of a fit, which each run with the law repeats."""
    misfit = fit.misfit
    said = [*doubts, *([misfit.message] if misfit else [])]
    if not said:
        return []
    comment = [f"# misfit: {misfit.reason.value}"] if misfit else []
    text = wrap("; ".join(said), 92, break_on_hyphens=False)
    return [*comment, "warning: >-", *(f"  {line}" for line in text)]


def _law(law: Law) -> list[str]:
    """Lines of the law itself; the keys are the constructor's arguments."""
    lines = [f"law: {_NAMES[type(law)]}"]
    for field in fields(law):
        value, write = getattr(law, field.name), _WRITTEN[field.name]
        if isinstance(value, tuple):
            lines.append(f"{field.name}: {_list_words(map(write, value))}")
        elif value != 0 or field.name not in _OPTIONAL[type(law)]:
            lines.append(f"{field.name}: {write(value)}")
    return lines


def _volume(poisson_ratio: float | None, bulk_modulus: float | None) -> str:
    if poisson_ratio is not None:
        return f"poisson_ratio: {_number(poisson_ratio)}"
    if bulk_modulus is not None:
        return f"bulk_modulus: {_modulus(bulk_modulus)}"
    return "# the data are of shear alone: add poisson_ratio, or bulk_modulus"


#: Unit of moduli, and the modulus below which it is a pascal [Pa].
_MEGAPASCAL, _SOFT = (1e6, "MPa"), 1e4


def _list_words(words: Iterable[str]) -> str:
    return f"[{', '.join(words)}]"


def _compliance(value: float) -> str:
    factor, unit = _unit_of(1 / value) if value > 0 else _MEGAPASCAL
    return f"{factor * value:.{_DIGITS}g} / {unit}"


def _modulus(value: float) -> str:
    factor, unit = _unit_of(value)
    return f"{value / factor:.{_DIGITS}g} {unit}"


def _unit_of(modulus: float) -> tuple[float, str]:
    """Factor and symbol of the unit of a modulus [Pa]: smaller ones for gels."""
    return _MEGAPASCAL if modulus >= _SOFT or modulus <= 0 else (1.0, "Pa")


def _duration(value: float) -> str:
    return f"{value:.{_DIGITS}g} s"


def _viscosity(value: float) -> str:
    factor, unit = _unit_of(value)
    return f"{value / factor:.{_DIGITS}g} {unit} s"


def _fluidity(value: float) -> str:
    return f"{1e6 * value:.{_DIGITS}g} / (MPa s)"


def _number(value: float) -> str:
    return f"{value:.{_DIGITS}g}"


_NAMES: dict[type[Law], str] = {
    Burgers: "burgers",
    CreepSeries: "creep-series",
    Elastic: "elastic",
    Maxwell: "maxwell",
    PowerLaw: "power-law",
    RelaxationSeries: "relaxation-series",
    Zener: "zener",
}
# Arguments that are 0 when left out.
_OPTIONAL: dict[type[Law], tuple[str, ...]] = defaultdict(
    tuple, {CreepSeries: ("fluidity",), PowerLaw: ("instant",)}
)
_WRITTEN: dict[str, Callable[[float], str]] = {
    "shear_modulus": _modulus,
    "delayed_modulus": _modulus,
    "equilibrium": _modulus,
    "moduli": _modulus,
    "viscosity": _viscosity,
    "delayed_viscosity": _viscosity,
    "instant": _compliance,
    "compliance": _compliance,
    "amplitudes": _compliance,
    "fluidity": _fluidity,
    "times": _duration,
    "reference_time": _duration,
    "exponent": _number,
}
