"""Candidate laws of an indentation fit: parameters and starting values."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies import laws


@dataclass(frozen=True)
class Candidate:
    """Law with unknown positive parameters; names are those of its constructor."""

    names: tuple[str, ...]
    units: tuple[str, ...]
    build: Callable[..., laws.Law]
    starts: tuple[tuple[float, ...], ...]

    @property
    def bounded(self) -> Floats:
        """Mask of the parameters that are exponents, between 0 and 1."""
        return np.array([name == "exponent" for name in self.names])

    def free(self, values: Floats) -> Floats:
        """Parameters on an unbounded scale: ln p, or ln(p/(1 - p)) of exponents."""
        below_one = np.where(self.bounded, 1.0 - values, 1.0)
        return np.asarray(np.log(values) - np.log(below_one))

    def values(self, free: Floats) -> Floats:
        """Parameters from the unbounded scale."""
        with np.errstate(over="ignore"):
            grown = np.exp(free)
            return np.where(self.bounded, 1.0 / (1.0 + np.exp(-free)), grown)


def candidate(
    name: str, terms: int, modulus: float, duration: float, reference: float | None = None
) -> Candidate:
    """Candidate law of `CANDIDATES`, started from apparent shear modulus [Pa] and duration [s].

    A power law states its compliance at the time `reference` [s], or at the end of the record.
    """
    if name not in CANDIDATES:
        raise ValueError(
            f"fit_indentation: law must be one of {', '.join(CANDIDATES)}, got {name!r}"
        )
    if reference is None:
        return CANDIDATES[name](terms, modulus, duration)
    if name not in _POWER_LAWS:
        raise ValueError(
            f"fit_indentation: reference_time goes with {' or '.join(_POWER_LAWS)}; {name} has none"
        )
    return _POWER_LAWS[name](terms, modulus, duration, reference)


def _elastic(terms: int, modulus: float, duration: float) -> Candidate:
    return Candidate(("shear_modulus",), ("Pa",), laws.Elastic, ((modulus,),))


def _maxwell(terms: int, modulus: float, duration: float) -> Candidate:
    starts = tuple((1.5 * modulus, modulus * duration * share) for share in (0.3, 3.0))
    return Candidate(("shear_modulus", "viscosity"), ("Pa", "Pa s"), laws.Maxwell, starts)


def _zener(terms: int, modulus: float, duration: float) -> Candidate:
    names = ("shear_modulus", "delayed_modulus", "viscosity")
    starts = tuple(
        (stiffer * modulus, 2 * modulus, 2 * modulus * duration * share)
        for stiffer, share in itertools.product((1.5, 5.0), (0.03, 0.2, 1.5))
    )
    return Candidate(names, ("Pa", "Pa", "Pa s"), laws.Zener, starts)


def _burgers(terms: int, modulus: float, duration: float) -> Candidate:
    names = ("shear_modulus", "viscosity", "delayed_modulus", "delayed_viscosity")
    starts = tuple(
        (2 * modulus, 3 * modulus * duration, 2 * modulus, 2 * modulus * duration * share)
        for share in (0.01, 0.1, 0.5)
    )
    return Candidate(names, ("Pa", "Pa s", "Pa", "Pa s"), laws.Burgers, starts)


def _creep_series(terms: int, modulus: float, duration: float) -> Candidate:
    names = (
        "instant",
        *(f"amplitudes[{i}]" for i in range(terms)),
        *(f"times[{i}]" for i in range(terms)),
    )
    phi = 0.5 / modulus
    shares = np.geomspace(0.01, 1.0, 2 * terms + 1)[1::2]
    start = (0.6 * phi, *(terms * [phi / terms]), *(duration * shares).tolist())

    def build(*values: float) -> laws.CreepSeries:
        return laws.CreepSeries(values[0], values[1 : terms + 1], values[terms + 1 :])

    units = ("1/Pa", *(terms * ["1/Pa"]), *(terms * ["s"]))
    return Candidate(names, units, build, (start,))


def _power_law(
    terms: int, modulus: float, duration: float, reference: float | None = None
) -> Candidate:
    # The compliance at the end of the record: nearest to what was measured.
    stated = reference or duration

    def build(compliance: float, exponent: float) -> laws.PowerLaw:
        return laws.PowerLaw(compliance, exponent, stated)

    starts = tuple(
        (0.5 / modulus * (stated / duration) ** exponent, exponent) for exponent in (0.05, 0.2, 0.5)
    )
    return Candidate(("compliance", "exponent"), ("1/Pa", ""), build, starts)


def _power_law_with_instant(
    terms: int, modulus: float, duration: float, reference: float | None = None
) -> Candidate:
    stated = reference or duration

    def build(compliance: float, exponent: float, instant: float) -> laws.PowerLaw:
        return laws.PowerLaw(compliance, exponent, stated, instant)

    starts = tuple(
        (
            0.5 * (1 - share) / modulus * (stated / duration) ** exponent,
            exponent,
            0.5 * share / modulus,
        )
        for share, exponent in itertools.product((0.2, 0.7), (0.2, 0.5))
    )
    names, units = ("compliance", "exponent", "instant"), ("1/Pa", "", "1/Pa")
    return Candidate(names, units, build, starts)


#: Names as in case files.
CANDIDATES: dict[str, Callable[[int, float, float], Candidate]] = {
    "elastic": _elastic,
    "maxwell": _maxwell,
    "zener": _zener,
    "burgers": _burgers,
    "creep-series": _creep_series,
    "power-law": _power_law,
    "power-law-with-instant": _power_law_with_instant,
}
_POWER_LAWS = {"power-law": _power_law, "power-law-with-instant": _power_law_with_instant}
