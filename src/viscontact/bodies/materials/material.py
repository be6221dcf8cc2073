"""Material: a creep law in shear with a constant Poisson's ratio or an elastic bulk modulus."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, field, replace

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import (
    Ageing,
    BesideSpring,
    Elastic,
    Law,
    SeriesLaw,
    Shift,
    TabulatedCreep,
    TabulatedRelaxation,
)
from viscontact.bodies.laws.interconversion.series import relaxation_from_creep
from viscontact.bodies.laws.parameter_checks import compressibility
from viscontact.bodies.loads.clock import TIME, Clock, ReducedTime
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.compliance import (
    ContactCompliance,
    LawCompliance,
    SeriesCompliance,
    SummedCompliance,
)
from viscontact.bodies.materials.hardness import READ_AT, HardnessEstimate
from viscontact.bodies.materials.measured_range import MeasuredRange
from viscontact.units.display import Displayable
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import check_fields, positive, store


@dataclass(frozen=True)
class Material(Displayable):
    """A linear viscoelastic material: a creep law in shear, and ν or the bulk modulus.

    Parameters
    ----------
    law : Law
        Creep law in shear.
    poisson_ratio : float, optional
        Constant Poisson's ratio, above -1 and up to 0.5 [-].
    bulk_modulus : float, optional
        Elastic bulk modulus K > 0 [Pa]: Poisson's ratio then varies in time with the law.
        Exactly one of the two must be given.
    measured_until : float, optional
        Last time at which the law was measured or fitted [s]; longer runs issue a warning. A
        table has its own.
    thickness : float, optional
        Thickness of the body [m]. Used for a warning only, if the half width of the contact
        exceeds a fifth of it: the body is still modelled as a half-space.
    notes : sequence of str, optional
        Notes on the origin of the law, such as the quality of its fit; results keep them.
    warning : str, optional
        Warning about the law, such as a fit that misses its data; each run issues it.
    shift : WLF, Arrhenius or TabulatedShift, optional
        Time-temperature shift, for `at` and for runs under a temperature. The law and its measured
        range are those at its reference temperature; a run without a temperature uses them
        unshifted.
    ageing : Ageing, optional
        Physical ageing since time 0 of a run; the law is that at this age.
    measured_range : MeasuredRange, optional
        Strain, stress, first time and temperatures of the tests; runs beyond them issue a warning.
    yield_stress : float, optional
        Yield stress in tension [Pa], or another stress up to which the material may be loaded. A
        run on a half-space warns of a peak pressure at which a contact of Hertz begins to yield.
    fatigue_limit : float, optional
        Likewise, under loads that repeat: in cycles, and of bodies that move [Pa].

    Raises
    ------
    ValueError
        If the law, the shift or the ageing is not one, not exactly one of ν and K is given, or a
        number is out of range.

    Examples
    --------
    >>> from viscontact.bodies.laws import Elastic
    >>> rubber = Material(Elastic(shear_modulus=1e6), poisson_ratio=0.5)
    >>> rubber.contact_compliance()(0.0)
    2.5e-07
    """

    law: Law
    poisson_ratio: float | None = field(default=None, metadata={"unit": "1"})
    _: KW_ONLY
    bulk_modulus: float | None = field(default=None, metadata={"unit": "Pa"})
    measured_until: float | None = field(default=None, metadata={"unit": "s"})
    thickness: float | None = field(default=None, metadata={"unit": "m"})
    notes: tuple[str, ...] = field(default=(), metadata={"recorded": "if given"})
    warning: str | None = field(default=None, metadata={"recorded": "if given"})
    shift: Shift | None = field(default=None, metadata={"recorded": "if given"})
    ageing: Ageing | None = field(default=None, metadata={"recorded": "if given"})
    measured_range: MeasuredRange | None = field(default=None, metadata={"recorded": "if given"})
    yield_stress: float | None = field(
        default=None, metadata={"unit": "Pa", "recorded": "if given"}
    )
    fatigue_limit: float | None = field(
        default=None, metadata={"unit": "Pa", "recorded": "if given"}
    )

    def __post_init__(self) -> None:
        if not isinstance(self.law, Law):
            raise ValueError(
                f"Material: law must be a creep law such as Zener or CreepSeries, got {self.law!r}"
            )
        ratio, bulk = compressibility("Material", self.poisson_ratio, self.bulk_modulus)
        store(self, poisson_ratio=ratio, bulk_modulus=bulk)
        check_fields(self, "measured_until", "thickness", "yield_stress", "fatigue_limit")
        object.__setattr__(self, "notes", tuple(self.notes))
        if self.shift is not None and not isinstance(self.shift, Shift):
            raise ValueError(
                f"Material: shift must be WLF, Arrhenius or TabulatedShift, got {self.shift!r}"
            )
        if not isinstance(self.ageing, Ageing | None):
            raise ValueError(f"Material: ageing must be Ageing(age, exponent), got {self.ageing!r}")
        if not isinstance(self.measured_range, MeasuredRange | None):
            raise ValueError(
                f"Material: measured_range must be a MeasuredRange, got {self.measured_range!r}"
            )

    def at(self, temperature: float) -> Material:
        """Return the material at a constant temperature.

        Parameters
        ----------
        temperature : float
            Absolute temperature [K].

        Returns
        -------
        Material
            The material whose law and measured range have all their times multiplied by the
            shift factor a_T, and whose law has all moduli multiplied by the vertical factor b_T.
            Its shift is the same rule with this temperature as reference.

        Raises
        ------
        ValueError
            If the material has no shift, or the shift does not hold at this temperature.

        Notes
        -----
        Phi(t) becomes Phi(t/a_T)/b_T. Poisson's ratio and the bulk modulus do not change with
        temperature.

        Examples
        --------
        >>> from viscontact.bodies.laws import WLF, Maxwell
        >>> fluid = Maxwell(shear_modulus=1e6, viscosity=1e9)
        >>> warm = Material(fluid, 0.5, shift=WLF(293.15, c1=8.86, c2=101.6)).at(313.15)
        >>> print(f"{warm.law.viscosity:.3g} Pa s")
        3.49e+07 Pa s
        """
        if self.shift is None:
            raise ValueError(
                f"Material: shift must be given for the law at {temperature:g} K, got None; write "
                "e.g. Material(law, poisson_ratio, shift=WLF(298.15, 17.44, 51.6))"
            )
        factor = self.shift.factor(temperature)
        raised = self.shift.vertical_factor(temperature)
        law = self.law if factor == 1.0 else self.law.slowed(factor)
        until, tested = self.measured_until, self.measured_range
        return replace(
            self,
            law=law if raised == 1.0 else law.stiffened(raised),
            measured_until=None if until is None else factor * until,
            shift=self.shift.referred_to(temperature),
            measured_range=None if tested is None else tested.at(temperature, factor),
        )

    def scaled(self, factor: float) -> Material:
        """Return the material with all moduli and viscosities of its law multiplied by a factor.

        Parameters
        ----------
        factor : float
            Scale of the stiffness, above 0 [-]; compliances are divided by it.

        Returns
        -------
        Material
            The material whose law is `factor` times as stiff at all times. An elastic bulk modulus
            stays as it is. So do the strains of the measured range; its stress becomes less with a
            softer law, and stays with a stiffer one. A note keeps the factor.

        Raises
        ------
        ValueError
            If the factor is not positive and finite.

        Notes
        -----
        Phi(t) becomes Phi(t)/factor: the same creep at another stiffness, as an assumption on
        compounds of one family, of which only one was tested.

        Examples
        --------
        >>> from viscontact.bodies.laws import Zener
        >>> rubber = Material(Zener(2e6, 1e6, 1e6), poisson_ratio=0.5)
        >>> rubber.scaled(1.5).law
        Zener(shear_modulus=3000000.0, delayed_modulus=1500000.0, viscosity=1500000.0)
        """
        factor = positive("Material.scaled: factor", factor)
        if factor == 1.0:
            return self
        tested = self.measured_range
        return replace(
            self,
            law=self.law.stiffened(factor),
            measured_range=None if tested is None else tested.of_scaled(factor),
            notes=(*self.notes, f"the moduli of the law are multiplied by {factor:.6g}"),
        )

    def with_hardness(self, estimate: HardnessEstimate) -> Material:
        """Return the material as stiff as a hardness says, with a warning on the estimate.

        Parameters
        ----------
        estimate : HardnessEstimate
            Young's modulus of a Shore hardness, of `modulus_from_shore`.

        Returns
        -------
        Material
            The material whose law is scaled so that its Young's modulus 3 s after a step of strain,
            when a durometer is read, is that of the estimate. Each run issues the warning.

        Raises
        ------
        ValueError
            If the bulk modulus is too small for the modulus.

        Examples
        --------
        >>> from viscontact.bodies.laws import Elastic
        >>> from viscontact.bodies.materials.hardness import modulus_from_shore
        >>> found = Material(Elastic(1e6), 0.5).with_hardness(modulus_from_shore(50))
        >>> print(f"{found.law.shear_modulus / 1e6:.3f} MPa")
        0.967 MPa
        """
        wanted = estimate.youngs_modulus
        if self.bulk_modulus is not None:
            if wanted >= 9 * self.bulk_modulus:
                young, bulk = (format_quantity(e, "Pa", 3) for e in (wanted, self.bulk_modulus))
                raise ValueError(
                    f"bulk_modulus: must be above a ninth of E = {young} of {estimate.hardness}, "
                    f"got {bulk}"
                )
            shear = 3 * self.bulk_modulus * wanted / (9 * self.bulk_modulus - wanted)
        else:
            assert self.poisson_ratio is not None  # exactly one is given
            shear = wanted / (2 * (1 + self.poisson_ratio))
        factor = shear / float(self.law.relaxation(READ_AT))
        # An elastic law that was made of the hardness has it already.
        made = self if math.isclose(factor, 1.0, rel_tol=1e-9) else self.scaled(factor)
        warning = "; ".join(filter(None, (self.warning, estimate.words)))
        return replace(made, warning=warning)

    def clock(self, temperature: TemperatureHistory | None) -> Clock:
        """Return the clock of its creep under a temperature that varies, or none.

        Parameters
        ----------
        temperature : TemperatureHistory or None
            Temperature over the time of a run; None where it is that of the law.

        Returns
        -------
        Clock
            Reduced time over time; the time itself of an elastic material, which does not creep.

        Raises
        ------
        ValueError
            If it creeps and has no shift, or the shift does not hold at a temperature.
        """
        if isinstance(self.law, Elastic):
            return TIME
        if temperature is None:
            return TIME if self.ageing is None else ReducedTime(ageing=self.ageing)
        if self.shift is None:
            raise ValueError(
                "temperature: a material that creeps must have a shift, under a temperature that "
                "varies, got none; write e.g. shift=WLF(298.15, 17.44, 51.6)"
            )
        try:
            self.shift.factor(temperature.range)
        except ValueError as error:
            raise ValueError(f"temperature: {error}") from None
        return ReducedTime(temperature, self.shift, self.ageing)

    def strength(self, *, repeats: bool = False) -> float | None:
        """Stress up to which it may be loaded [Pa], under a load that repeats; None without."""
        limits = (self.yield_stress, self.fatigue_limit if repeats else None)
        return min((each for each in limits if each is not None), default=None)

    @property
    def instant_poisson_ratio(self) -> float:
        """Poisson's ratio just after a load [-]; that at a bulk modulus follows from the law.

        Of a law without instant compliance it is 0.5, which such a body tends to as it creeps.
        """
        if self.poisson_ratio is not None:
            return self.poisson_ratio
        assert self.bulk_modulus is not None  # exactly one is given
        shear, bulk = float(self.law.relaxation(0.0)), self.bulk_modulus
        return (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear)) if math.isfinite(shear) else 0.5

    @property
    def known_until(self) -> float:
        """Last time on which the law rests on data [s]; inf for a formula."""
        own = math.inf if self.measured_until is None else self.measured_until
        return min(own, self.law.measured_until)

    @property
    def known_from(self) -> float:
        """First time on which the law rests on data [s]; 0 for a formula."""
        law = self.law.law if isinstance(self.law, BesideSpring) else self.law
        tested = 0.0 if self.measured_range is None else self.measured_range.first
        own = law.times[0] if isinstance(law, TabulatedCreep | TabulatedRelaxation) else 0.0
        return max(own, tested)

    def contact_compliance(self) -> ContactCompliance:
        """Return the contact compliance J(t) of a half-space of this material.

        Returns
        -------
        ContactCompliance
            J(t) [1/Pa]; exact unless the bulk modulus is elastic and the law is not a series.

        Notes
        -----
        With a constant Poisson's ratio J(t) = (1 - ν) Phi(t). With an elastic bulk modulus,
        (1 - ν)/(2G) in terms of K and G is, after the correspondence principle with
        G~ = s L[G],

            s L[J] = (3K + 4G~) / (4 G~ (3K + G~)) = 1/(4 G~) + (3/4) / (3K + G~).

        The first part is Phi/2, as 1/G~ = 2 s L[Phi]. The second is a spring 3K in
        parallel with the law, a series if the law is one, and else interconverted numerically.

        Examples
        --------
        With K and G of ν = 0.25 both ways agree:

        >>> from viscontact.bodies.laws import Elastic
        >>> law = Elastic(shear_modulus=3e9)
        >>> round(Material(law, poisson_ratio=0.25).contact_compliance()(0.0) * 1e9, 9)
        0.125
        >>> round(Material(law, bulk_modulus=5e9).contact_compliance()(0.0) * 1e9, 9)
        0.125
        """
        if isinstance(self.law, SeriesLaw):
            return self._of_series(self.law)
        if self.poisson_ratio is not None:
            return LawCompliance(self.law, 1.0 - self.poisson_ratio)
        assert self.bulk_modulus is not None  # exactly one is given
        beside = BesideSpring(self.law, 3.0 * self.bulk_modulus)
        return SummedCompliance((LawCompliance(self.law, 0.5), LawCompliance(beside, 1.5)))

    def _of_series(self, law: SeriesLaw) -> ContactCompliance:
        creep = SeriesCompliance(*law.creep_series().terms)
        if self.poisson_ratio is not None:
            return creep.scaled(1.0 - self.poisson_ratio)
        assert self.bulk_modulus is not None  # exactly one is given
        beside = _beside_spring(creep.scaled(2.0), 3.0 * self.bulk_modulus)
        return creep.scaled(0.5) + beside.scaled(0.75)


def uniaxial_compression(material: Material) -> SeriesCompliance:
    """Creep compliance of a Prony series in uniaxial compression, without lateral strain [1/Pa]."""
    # With G~ = s L[G] it is 3/(3K + 4G~), or (1 - 2ν)/(1 - ν) Phi~ at a constant Poisson's ratio.
    assert isinstance(material.law, SeriesLaw)
    creep, ratio = SeriesCompliance(*material.law.creep_series().terms), material.poisson_ratio
    if ratio is not None:
        return creep.scaled((1 - 2 * ratio) / (1 - ratio))
    assert material.bulk_modulus is not None  # exactly one is given
    return _beside_spring(creep.scaled(0.5), 3.0 * material.bulk_modulus).scaled(3.0)


def _beside_spring(creep: SeriesCompliance, stiffness: float) -> SeriesCompliance:
    """Return the creep series of a body in parallel with a spring of stiffness 1/c."""
    # With C = s L[creep], both have 1/(1/c + 1/C) = c - c²/(c + C). The fraction is the relaxation
    # function of the same body with the spring in series, which is a series even if the body has no
    # instant compliance and its own relaxation modulus is none.
    c = 1.0 / stiffness
    in_series = relaxation_from_creep(
        c + creep.instant, creep.amplitudes, creep.times, creep.fluidity
    )
    # Relaxation that is subtracted is creep: -M exp(-t/τ) = M (1 - exp(-t/τ)) - M.
    instant = creep.instant / (1.0 + stiffness * creep.instant)
    return SeriesCompliance(instant, c * c * in_series.moduli, in_series.times)
