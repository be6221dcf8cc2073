"""Frequency-domain data of cards: measured moduli over frequency, and the fractional formula."""

from __future__ import annotations

import cmath
import math
import warnings

import numpy as np

from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import BesideSpring, Law, PowerLaw, RelaxationSeries
from viscontact.bodies.materials.cards.prony_terms import Moduli, with_volume
from viscontact.bodies.materials.material import Material
from viscontact.bodies.series_fits.fit import Fit
from viscontact.bodies.series_fits.prony import fit_dynamic

# Angle by which a formula written with a card's digits may miss its causal value [rad].
_ROUNDED_ANGLE = 5e-3
# Relative difference of the fitted and the stated long-term modulus that causes a warning [-].
_FAR_FROM_LONG_TERM = 0.1


@dataclass(frozen=True)
class Oscillation:
    """Rows of storage and loss moduli over their long-term modulus, by frequency.

    The long-term modulus G_inf and the transform g* of g(t) = G(t)/G_inf - 1 make
    G' = G_inf (1 - ω Im g*) and G'' = G_inf ω Re g*: Abaqus 2016 Analysis User's Guide, section
    22.7.2, "Frequency domain viscoelasticity".
    """

    where: str
    frequency: tuple[float, ...]  # in cycles [Hz]
    shear: tuple[complex, ...]  # G*/G_inf [-]
    bulk: tuple[complex, ...]  # K*/K_inf [-]

    def material(self, moduli: Moduli) -> Material:
        """Return the material with a fitted relaxation series, and its range and misfit."""
        fit = self._fit()
        assert isinstance(fit.series, RelaxationSeries)  # of moduli
        at_once = fit.law.relaxation(0.0)
        # The data are relative to the long-term modulus, which a card may leave to be found.
        scale = moduli.shear / at_once if moduli.instantaneous else moduli.shear
        law = RelaxationSeries(
            scale * fit.law.relaxation(math.inf),
            [scale * strength for strength in fit.series.moduli],
            fit.series.times,
        )
        material = with_volume(
            law, moduli, relaxes=any(k != 1 for k in self.bulk), alike=self.bulk == self.shear
        )
        until = float(1 / fit.points.min())
        return Material(
            material.law,
            material.poisson_ratio,
            bulk_modulus=material.bulk_modulus,
            measured_until=until,
            notes=(self._note(fit),),
            warning=self._warning(fit),
        )

    def _note(self, fit: Fit) -> str:
        """Origin of the law in words."""
        rms = " and ".join(
            f"{100 * np.sqrt(np.mean(each**2)):.2g} % of {name}"
            for name, each in fit.residuals.items()
        )
        return (
            f"{self.where}: the law is a relaxation series of {fit.terms} terms, fitted to "
            f"{len(self.frequency)} frequencies with residuals of {rms} (root mean square)"
        )

    def _warning(self, fit: Fit) -> str | None:
        """Warning of a fit that misses the data, or the long-term modulus that they refer to."""
        found = [] if fit.misfit is None else [fit.misfit.message]
        left = fit.law.relaxation(math.inf)
        if abs(left - 1) > _FAR_FROM_LONG_TERM:
            found.append(
                f"the long-term modulus of the law fitted to these frequencies is {left:.3g} times "
                "that of the card; give lower frequencies, or Prony terms"
            )
        return f"{self.where}: {'; '.join(found)}" if found else None

    def _fit(self) -> Fit:
        relative = np.array(self.shear)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", AccuracyWarning)
                return fit_dynamic(
                    2 * np.pi * np.array(self.frequency), relative.real, relative.imag, data="shear"
                )
        except ValueError as error:
            why = str(error).removeprefix("fit_dynamic: ")
            raise ValueError(
                f"{self.where}: {why} (storage = 1 - item 2, loss = item 1 of each line, over the "
                "long-term modulus)"
            ) from None


@dataclass(frozen=True)
class FrequencyFormula:
    """The formula g*(ω) = g_1 f^-a of a complex constant g_1 [s^(1-a)] and an exponent a.

    With n = 1 - a, G* = G_inf (1 + i ω g_1 f^-a) is a spring beside a spring-pot,
    G_inf (1 + c (iω)^n), if g_1 has the argument -a π/2; with any other, G* has no law in time.
    """

    where: str
    constant: complex
    exponent: float
    bulk_relaxes: bool
    bulk_alike: bool

    def material(self, moduli: Moduli) -> Material:
        """Return the material with a spring beside a power law; ValueError if it is not causal."""
        if moduli.instantaneous:
            raise ValueError(
                f"{self.where}: FREQUENCY=FORMULA needs long-term moduli in *ELASTIC; its modulus "
                "at once has no limit"
            )
        return with_volume(
            self._law(moduli.shear), moduli, relaxes=self.bulk_relaxes, alike=self.bulk_alike
        )

    def _law(self, spring: float) -> Law:
        a = self.exponent
        if not (0 <= a < 1 and self.constant != 0):
            raise ValueError(
                f"{self.where}: FREQUENCY=FORMULA must have a g_1 other than 0 and an exponent a "
                f"from 0 up to below 1, got g_1 = {self.constant} and a = {a!r}"
            )
        wanted = -a * math.pi / 2
        if abs(cmath.phase(self.constant) - wanted) > _ROUNDED_ANGLE:
            raise ValueError(
                f"{self.where}: FREQUENCY=FORMULA with these constants belongs to no law in time "
                f"(Kramers-Kronig relation): with a = {a:g}, the imaginary part of g_1 must be "
                f"{math.tan(wanted):.4g} times the real one; correct it, or give storage and loss "
                "with FREQUENCY=TABULAR"
            )
        n = 1 - a
        strength = spring * abs(self.constant) * (2 * math.pi) ** a
        return BesideSpring(PowerLaw(1 / (2 * strength * math.gamma(1 + n)), n, 1.0), spring)
