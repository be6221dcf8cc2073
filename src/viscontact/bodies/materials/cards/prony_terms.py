"""Relative Prony terms and elastic constants, from which cards define laws.

With the instant modulus G_0, G(t) = G_0 [1 - sum g_i (1 - exp(-t/τ_i))], and likewise the bulk
modulus with k_i. The elastic constants E and ν are those of the instant modulus, or of the one
left after all relaxation, G_inf = G_0 (1 - sum g_i).
"""

from __future__ import annotations

import math

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Elastic, Law, RelaxationSeries, SeriesLaw
from viscontact.bodies.materials.material import Material
from viscontact.units.formatting import format_quantity

# Difference from 1 of a sum written with a card's digits.
_ROUNDING = 1e-12
# Moduli beyond these [Pa] leave compliances or contacts that are no numbers.
_LEAST_MODULUS, _MOST_MODULUS = 1e-60, 1e60


@dataclass(frozen=True)
class Moduli:
    """Elastic constants of a card, E [Pa] and ν [-], instantaneous or after all relaxation.

    A card that states the bulk modulus [Pa] has it as `stated_bulk`, since near ν = 1/2 it cannot
    be computed from the others.
    """

    where: str
    youngs_modulus: float
    poisson_ratio: float
    instantaneous: bool
    stated_bulk: float | None = None

    def __post_init__(self) -> None:
        _require_modulus(self.where, "Young's", self.youngs_modulus)
        if not -1 < self.poisson_ratio <= 0.5:
            raise ValueError(
                f"{self.where}: Poisson's ratio must lie above -1 and not above 0.5, got "
                f"{self.poisson_ratio!r}"
            )

    @classmethod
    def of_shear_and_bulk(cls, where: str, shear: float, bulk: float) -> Moduli:
        """Return instantaneous constants from the moduli G and K [Pa]; ValueError unless > 0."""
        _require_modulus(where, "the shear", shear)
        _require_modulus(where, "the bulk", bulk)
        # Divided by the larger of both, so that no product of them is beyond all numbers.
        g, k = shear / max(shear, bulk), bulk / max(shear, bulk)
        ratio = (3 * k - 2 * g) / (2 * (3 * k + g))
        return cls(where, 2 * (1 + ratio) * shear, ratio, instantaneous=True, stated_bulk=bulk)

    @property
    def shear(self) -> float:
        """Shear modulus [Pa]."""
        return self.youngs_modulus / (2 * (1 + self.poisson_ratio))

    @property
    def bulk(self) -> float:
        """Bulk modulus [Pa]; inf for an incompressible body."""
        if self.stated_bulk is not None:
            return self.stated_bulk
        nu = self.poisson_ratio
        return math.inf if nu == 0.5 else self.youngs_modulus / (3 * (1 - 2 * nu))

    def at_once(self, left: float) -> float:
        """Return the instant shear modulus [Pa], of which the part `left` does not relax."""
        if self.instantaneous:
            return self.shear
        if not left > 0:
            raise ValueError(
                f"{self.where}: the elastic constants are long-term ones, and the terms leave "
                "nothing in the long term; give instantaneous ones (MODULI=INSTANTANEOUS)"
            )
        return self.shear / left


def _require_modulus(where: str, name: str, value: float) -> None:
    """ValueError unless a modulus [Pa] and its inverse are positive numbers."""
    if not value > 0:
        raise ValueError(f"{where}: {name} modulus must be positive, got {value!r}")
    if not _LEAST_MODULUS <= value <= _MOST_MODULUS:
        said = format_quantity(value, "Pa", 3)
        raise ValueError(f"{where}: {name} modulus of {said} is beyond all materials")


@dataclass(frozen=True)
class Terms:
    """Relative terms of a card in shear or volume: weights g_i or k_i [-], times τ_i [s].

    A card that states the part that does not relax [-] has it as `stated_left`.
    """

    weights: tuple[float, ...] = ()
    times: tuple[float, ...] = ()
    stated_left: float | None = None

    @property
    def left(self) -> float:
        """The part that does not relax, 1 - sum g_i."""
        if self.stated_left is not None:
            return self.stated_left
        left = math.fsum([1.0, *(-g for g in self.weights)])
        return 0.0 if abs(left) < _ROUNDING else left

    @property
    def active(self) -> frozenset[tuple[float, float]]:
        """Weights and times of the terms that relax."""
        pairs = zip(self.weights, self.times, strict=True)
        return frozenset((weight, time) for weight, time in pairs if weight > 0)

    @property
    def is_idle(self) -> bool:
        """True if no term relaxes."""
        return not any(self.weights)


def checked_terms(where: str, weights: list[float], times: list[float]) -> Terms:
    """Return relative terms [-] with times [s]; ValueError unless they describe relaxation."""
    for i, (weight, time) in enumerate(zip(weights, times, strict=True), start=1):
        if not 0 <= weight <= 1:
            raise ValueError(
                f"{where}: term {i} must be a part of the modulus between 0 and 1, got {weight!r}; "
                "cards take relative moduli (G_i/G_0), not moduli"
            )
        if not (math.isfinite(time) and time > 0):
            raise ValueError(
                f"{where}: the relaxation time of term {i} must be positive, got {time!r}"
            )
    terms = Terms(tuple(weights), tuple(times))
    if terms.left < 0:
        raise ValueError(
            f"{where}: the terms add up to {math.fsum(weights):.12g}: more than all of the modulus "
            "would relax; they must add up to 1 at most"
        )
    return terms


def relaxing_material(moduli: Moduli, shear: Terms, bulk: Terms) -> Material:
    """Return the material of a card with Prony terms.

    Poisson's ratio is constant if bulk and shear modulus relax alike, the bulk modulus is elastic
    if only shear relaxes; ValueError for any other relaxation of the bulk modulus. Terms in shear
    alone do *not* mean a constant Poisson's ratio: it grows while G falls.
    """
    if shear.is_idle and bulk.is_idle:
        return Material(Elastic(moduli.shear), moduli.poisson_ratio)
    at_once = moduli.at_once(shear.left)
    law = RelaxationSeries(shear.left * at_once, [g * at_once for g in shear.weights], shear.times)
    return with_volume(law, moduli, relaxes=not bulk.is_idle, alike=bulk.active == shear.active)


def with_volume(law: Law, moduli: Moduli, *, relaxes: bool, alike: bool) -> Material:
    """Return the material of a law; ValueError if the volume relaxes, but unlike shear."""
    if moduli.poisson_ratio == 0.5 or (relaxes and alike):
        return Material(law, moduli.poisson_ratio)
    if relaxes:
        raise ValueError(
            f"{moduli.where}: the bulk modulus relaxes otherwise than the shear modulus, which is "
            "not built; it can relax alike (a constant Poisson's ratio) or not at all"
        )
    return Material(law, bulk_modulus=moduli.bulk)


@dataclass(frozen=True)
class Relative:
    """A material in a card's terms: elastic constants, and the relaxing parts of both moduli."""

    moduli: Moduli
    shear: Terms
    bulk: Terms


def relative(material: Material, *, instantaneous: bool) -> Relative:
    """Return a material in a card's terms; ValueError if it is no series or lacks the constants."""
    law = material.law
    if not isinstance(law, SeriesLaw):
        raise ValueError(
            f"a card takes a Prony series, and {type(law).__name__} is none; fit one first, e.g. "
            "with viscontact.identification.fit_relaxation"
        )
    series = law.relaxation_series()
    at_once = math.fsum([series.equilibrium, *series.moduli])
    shear = Terms(tuple(m / at_once for m in series.moduli), tuple(series.times))
    modulus = at_once if instantaneous else series.equilibrium
    if not modulus > 0:
        raise ValueError("a fluid has no long-term moduli; write instantaneous ones")
    if shear.is_idle:
        shear = Terms()
    alike = material.poisson_ratio is not None and material.poisson_ratio != 0.5
    return Relative(
        constants(material, modulus, instantaneous=instantaneous),
        shear,
        shear if alike else Terms(),
    )


def constants(material: Material, shear_modulus: float, *, instantaneous: bool) -> Moduli:
    """Return the elastic constants that go with a shear modulus [Pa] of a material."""
    nu, bulk = material.poisson_ratio, material.bulk_modulus
    if nu is None:
        assert bulk is not None  # exactly one is given
        nu = (3 * bulk - 2 * shear_modulus) / (2 * (3 * bulk + shear_modulus))
    return Moduli("the material", 2 * (1 + nu) * shear_modulus, nu, instantaneous)
