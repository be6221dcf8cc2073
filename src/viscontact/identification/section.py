"""A fitted law as the `material:` section of a case file."""

from __future__ import annotations

from collections.abc import Iterable

from viscontact.identification.fit import Fit
from viscontact.laws import CreepSeries

_DIGITS = 6


def material_section(fit: Fit) -> str:
    """Return the law of a fit as a section to paste in a case file.

    Parameters
    ----------
    fit : Fit
        What `fit_creep`, `fit_relaxation` or `fit_dynamic` returned.

    Returns
    -------
    str
        YAML, in the terms of the data and with six digits. Where the data say nothing of the
        volume, a comment asks for it.

    Examples
    --------
    >>> import numpy as np
    >>> from viscontact.identification.prony import fit_relaxation
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
    series = fit.series
    if isinstance(series, CreepSeries):
        lines = [
            "law: creep-series",
            f"instant: {_compliance(series.instant)}",
            f"amplitudes: {_listed(map(_compliance, series.amplitudes))}",
            f"times: {_listed(map(_duration, series.times))}",
        ]
        if series.fluidity > 0:
            lines.append(f"fluidity: {1e6 * series.fluidity:.{_DIGITS}g} / (MPa s)")
    else:
        lines = [
            "law: relaxation-series",
            f"equilibrium: {_modulus(series.equilibrium)}",
            f"moduli: {_listed(map(_modulus, series.moduli))}",
            f"times: {_listed(map(_duration, series.times))}",
        ]
    lines += [f"data: {fit.data}", _volume(fit)]
    return "\n".join(["material:", *(f"  {line}" for line in lines)])


def _volume(fit: Fit) -> str:
    if fit.poisson_ratio is not None:
        return f"poisson_ratio: {fit.poisson_ratio:.{_DIGITS}g}"
    if fit.bulk_modulus is not None:
        return f"bulk_modulus: {_modulus(fit.bulk_modulus)}"
    return "# the data are of shear alone: add poisson_ratio, or bulk_modulus"


def _listed(words: Iterable[str]) -> str:
    return f"[{', '.join(words)}]"


def _compliance(value: float) -> str:
    return f"{1e6 * value:.{_DIGITS}g} / MPa"


def _modulus(value: float) -> str:
    return f"{1e-6 * value:.{_DIGITS}g} MPa"


def _duration(value: float) -> str:
    return f"{value:.{_DIGITS}g} s"
