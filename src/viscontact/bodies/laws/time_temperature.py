"""Time-temperature superposition: shift factors by WLF, Arrhenius or a table.

A thermorheologically simple body has one law, Phi_r(t), at a reference temperature; at
temperature T it is Phi_r(t/a_T), with one shift factor a_T for all its times. All temperatures
are absolute, in kelvin: 20 °C is 293.15 K.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import field
from typing import ClassVar, overload

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.parameter_checks import check_items
from viscontact.units.display import Displayable
from viscontact.units.numbers import check_fields, real_array

#: Molar gas constant, exact since 2019 [J/(mol K)].
GAS_CONSTANT = 8.31446261815324

#: Largest shift factor, and reciprocal of the least: squares of times have to remain numbers.
LARGEST_FACTOR = 1e100


class Shift(Displayable, ABC):
    """A rule that gives the shift factor a_T of each temperature.

    ``law.slowed(shift.factor(T))`` is the law at temperature T.
    """

    @overload
    def factor(self, temperature: float) -> float: ...
    @overload
    def factor(self, temperature: Sequence[float] | Floats) -> Floats: ...
    def factor(self, temperature: ArrayLike) -> float | Floats:
        """Return the shift factor a_T.

        Parameters
        ----------
        temperature : float or array_like
            Absolute temperature T > 0 [K].

        Returns
        -------
        float or ndarray
            Ratio of all times to those at the reference temperature [-], of the shape of
            `temperature`: above 1 where it is colder.

        Raises
        ------
        ValueError
            If a temperature is not positive, or where the rule does not hold.
        """
        T = real_array("temperature", temperature, "K")
        wrong = ~(np.isfinite(T) & (T > 0))
        if wrong.any():
            raise ValueError(
                f"temperature must be a finite number above 0 K, got {T[wrong].flat[0]:.6g} K; "
                "temperatures are absolute: 20 °C is 293.15 K"
            )
        with np.errstate(over="ignore", under="ignore"):
            factors = np.exp(self._log_factor(T))
        beyond = ~((factors >= 1 / LARGEST_FACTOR) & (factors <= LARGEST_FACTOR))
        if beyond.any():
            raise ValueError(
                f"temperature: {T[beyond].flat[0]:.6g} K is so far from the reference temperature "
                f"that its shift factor is beyond {LARGEST_FACTOR:g} or its reciprocal; choose a "
                "nearer one (temperatures are absolute: 20 °C is 293.15 K)"
            )
        return float(factors) if T.ndim == 0 else factors

    @overload
    def vertical_factor(self, temperature: float) -> float: ...
    @overload
    def vertical_factor(self, temperature: Sequence[float] | Floats) -> Floats: ...
    def vertical_factor(self, temperature: ArrayLike) -> float | Floats:
        """Return the vertical shift factor b_T.

        Parameters
        ----------
        temperature : float or array_like
            Absolute temperature T > 0 [K].

        Returns
        -------
        float or ndarray
            Ratio of all moduli to those at the reference temperature in the same state [-], of the
            shape of `temperature`; 1 unless the shift has vertical factors.

        Raises
        ------
        ValueError
            As in `factor`.
        """
        T = real_array("temperature", temperature, "K")
        self.factor(T)  # refuses what the rule does not hold for
        factors = np.exp(self._log_vertical(T))
        return float(factors) if T.ndim == 0 else factors

    @property
    def kinks(self) -> Sequence[float]:
        """Temperatures at which the slope of ln a_T jumps [K]; none of a formula."""
        return ()

    @abstractmethod
    def referred_to(self, temperature: float) -> Shift:
        """Return the same rule with another reference temperature.

        Parameters
        ----------
        temperature : float
            Absolute temperature at which the factors of the new rule are 1 [K].

        Returns
        -------
        Shift
            Rule whose factors are a_T over the factor at this temperature, likewise b_T.

        Raises
        ------
        ValueError
            As in `factor`.
        """

    @abstractmethod
    def _log_factor(self, temperature: Floats) -> Floats:
        """Return ln a_T."""

    def _log_vertical(self, temperature: Floats) -> Floats:
        """Return ln b_T."""
        return np.zeros_like(temperature)


@dataclass(frozen=True)
class WLF(Shift):
    """Williams-Landel-Ferry (WLF) equation, for polymers above their glass transition.

    Parameters
    ----------
    reference_temperature : float
        Absolute temperature T_r > 0 at which a_T = 1 [K].
    c1 : float
        Constant C_1 > 0, of the decimal logarithm [-].
    c2 : float
        Constant C_2 > 0 [K].
    given_at : float, optional
        Reference temperature at which the constants were given, if the rule was referred to another
        one [K]. `referred_to` sets it, for the warning below the glass transition; two rules are
        equal without it.

    Raises
    ------
    ValueError
        If one is not a positive finite number.

    Notes
    -----
    log10 a_T = -C_1 (T - T_r) / (C_2 + T - T_r) [1]_, for T above T_r - C_2, where it is
    infinite. Abaqus and Ansys take the same two constants of the decimal logarithm. Multiply C_1
    by log10(e) = 0.4343 if yours are of the natural one.

    References
    ----------
    .. [1] M. L. Williams, R. F. Landel, J. D. Ferry, J. Am. Chem. Soc. 77 (1955) 3701-3707.

    Examples
    --------
    The "universal" constants at 50 K above the glass transition:

    >>> print(f"{WLF(373.15, 17.44, 51.6).factor(423.15):.3e}")
    2.614e-09
    """

    reference_temperature: float = field(metadata={"unit": "K"})
    c1: float = field(metadata={"unit": "1"})
    c2: float = field(metadata={"unit": "K"})
    given_at: float | None = field(
        default=None,
        kw_only=True,
        compare=False,
        repr=False,
        metadata={"unit": "K", "recorded": "if given"},
    )

    def __post_init__(self) -> None:
        check_fields(self, "reference_temperature", "c1", "c2", "given_at")

    def referred_to(self, temperature: float) -> WLF:
        """Return the same rule with another reference temperature, see `Shift.referred_to`."""
        self.factor(temperature)  # refuses what the rule does not hold for
        if temperature == self.reference_temperature:
            return self
        # Ferry, Viscoelastic Properties of Polymers, 3rd ed., 1980, eq. 11-22 and 11-23.
        c2 = self.c2 + temperature - self.reference_temperature
        given_at = self.reference_temperature if self.given_at is None else self.given_at
        return WLF(float(temperature), self.c1 * self.c2 / c2, c2, given_at=given_at)

    def _log_factor(self, temperature: Floats) -> Floats:
        above = temperature - self.reference_temperature
        too_cold = ~(self.c2 + above > 0)
        if too_cold.any():
            raise ValueError(
                f"WLF: must be used above T_r - C_2 = {self.reference_temperature - self.c2:.6g} "
                f"K, where its shift factor is infinite, got {temperature[too_cold].flat[0]:.6g} "
                "K; use Arrhenius or a table of factors below the glass transition"
            )
        return np.asarray(-np.log(10.0) * self.c1 * above / (self.c2 + above))


@dataclass(frozen=True)
class Arrhenius(Shift):
    """Arrhenius equation: one activation energy at all temperatures.

    Parameters
    ----------
    reference_temperature : float
        Absolute temperature T_r > 0 at which a_T = 1 [K].
    activation_energy : float
        Energy E_a > 0 [J/mol].

    Raises
    ------
    ValueError
        If one is not a positive finite number.

    Notes
    -----
    ln a_T = (E_a/R) (1/T - 1/T_r), with the molar gas constant R: Ferry, Viscoelastic Properties
    of Polymers, 3rd ed., Wiley, 1980, chapter 11.

    Examples
    --------
    >>> print(f"{Arrhenius(293.15, 80e3).factor(303.15):.4f}")
    0.3387
    """

    reference_temperature: float = field(metadata={"unit": "K"})
    activation_energy: float = field(metadata={"unit": "J/mol"})

    def __post_init__(self) -> None:
        check_fields(self, "reference_temperature", "activation_energy")

    def referred_to(self, temperature: float) -> Arrhenius:
        """Return the same rule with another reference temperature, see `Shift.referred_to`."""
        self.factor(temperature)  # refuses what the rule does not hold for
        return Arrhenius(float(temperature), self.activation_energy)

    def _log_factor(self, temperature: Floats) -> Floats:
        scale = self.activation_energy / GAS_CONSTANT
        return np.asarray(scale * (1.0 / temperature - 1.0 / self.reference_temperature))


@dataclass(frozen=True)
class TabulatedShift(Shift):
    """Measured shift factors, linear in ln a_T and ln b_T between them.

    Parameters
    ----------
    temperatures : sequence of float
        Absolute temperatures, increasing, two or more [K].
    factors : sequence of float
        Shift factors a_T > 0, one for each, falling or equal [-].
    vertical : sequence of float, optional
        Vertical shift factors b_T > 0, one for each: the moduli at T over those at the reference
        temperature in the same state [-]; 1 if left out.

    Raises
    ------
    ValueError
        If a number is not positive, the temperatures do not increase or the factors rise: a
        body is not slower where it is warmer.

    Notes
    -----
    Nothing is extrapolated: a temperature outside the table is refused.

    Examples
    --------
    >>> shift = TabulatedShift([283.15, 293.15, 303.15], [100.0, 1.0, 0.1])
    >>> print(f"{shift.factor(288.15):.4f}")
    10.0000
    """

    temperatures: Sequence[float] = field(metadata={"unit": "K"})
    factors: Sequence[float] = field(metadata={"unit": "1"})
    vertical: Sequence[float] | None = field(
        default=None, metadata={"unit": "1", "recorded": "if given"}
    )
    _OWNER: ClassVar[str] = "TabulatedShift"

    def __post_init__(self) -> None:
        temperatures, factors = (check_items(self, name) for name in ("temperatures", "factors"))
        if len(temperatures) != len(factors) or len(temperatures) < 2:
            raise ValueError(
                f"{self._OWNER}: temperatures and factors must have equal lengths of at least 2, "
                f"got {len(temperatures)} temperatures and {len(factors)} factors"
            )
        if self.vertical is not None and len(check_items(self, "vertical")) != len(factors):
            raise ValueError(
                f"{self._OWNER}: vertical must have one factor for each of the {len(factors)} "
                f"temperatures, got {len(self.vertical)}"
            )
        for i in range(1, len(temperatures)):
            self._require_order(i, temperatures, factors)

    @property
    def kinks(self) -> Sequence[float]:
        """Temperatures of the table, between which ln a_T is linear [K]."""
        return self.temperatures

    def referred_to(self, temperature: float) -> TabulatedShift:
        """Return the same rule with another reference temperature, see `Shift.referred_to`."""
        factor, raised = self.factor(temperature), self.vertical_factor(temperature)
        vertical = None if self.vertical is None else [each / raised for each in self.vertical]
        return TabulatedShift(self.temperatures, [each / factor for each in self.factors], vertical)

    def _require_order(
        self, i: int, temperatures: tuple[float, ...], factors: tuple[float, ...]
    ) -> None:
        if not temperatures[i] > temperatures[i - 1]:
            raise ValueError(
                f"{self._OWNER}: temperatures[{i}] must be above the one before, "
                f"{temperatures[i - 1]!r} K, got {temperatures[i]!r} K"
            )
        if factors[i] > factors[i - 1]:
            raise ValueError(
                f"{self._OWNER}: factors[{i}] must not be above the one before, "
                f"{factors[i - 1]!r}, got {factors[i]!r}; a_T falls where it gets warmer "
                "(are these 1/a_T, or logarithms?)"
            )

    def _log_factor(self, temperature: Floats) -> Floats:
        first, last = self.temperatures[0], self.temperatures[-1]
        outside = ~((first <= temperature) & (temperature <= last))
        if outside.any():
            raise ValueError(
                f"{self._OWNER}: must be used between {first:.6g} and {last:.6g} K, got "
                f"{temperature[outside].flat[0]:.6g} K; WLF and Arrhenius hold beyond a table"
            )
        return np.asarray(np.interp(temperature, self.temperatures, np.log(self.factors)))

    def _log_vertical(self, temperature: Floats) -> Floats:
        if self.vertical is None:
            return np.zeros_like(temperature)
        return np.asarray(np.interp(temperature, self.temperatures, np.log(self.vertical)))
