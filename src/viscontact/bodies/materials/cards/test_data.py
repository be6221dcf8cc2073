"""Normalised creep and relaxation test data of cards."""

from __future__ import annotations

import math
import re
from typing import Literal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import TabulatedCreep, TabulatedRelaxation
from viscontact.bodies.materials.cards.prony_terms import Moduli, with_volume
from viscontact.bodies.materials.material import Material

# Relative difference of two equal values written with a card's digits.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class NormalisedTest:
    """A creep or relaxation test in shear, over the value at once: j_S or g_R.

    Abaqus fits a Prony series, here the data are used as measured. Abaqus 2016 Keywords Reference
    Guide, ``*SHEAR TEST DATA``, ``*COMBINED TEST DATA``: lines of j_S or g_R and t > 0, with the
    long-term value in SHRINF. Both functions start at 1.
    """

    where: str
    lines: tuple[str, ...]  # places of the rows
    creep: bool
    times: tuple[float, ...]  # [s]
    shear: tuple[float, ...]  # [-]
    volume: tuple[tuple[float, float], ...]  # rows of the bulk modulus alike: value [-], time [s]
    infinite: float | None = None  # the long-term value in shear [-]

    def material(self, moduli: Moduli) -> Material:
        """Return the material: G_0 g_R(t) as modulus [Pa], or j_S(t)/(2 G_0) as compliance."""
        alike = self.volume == tuple(zip(self.shear, self.times, strict=True))
        relaxes = any(value != 1 for value, _ in self.volume)
        law = self._law(moduli.at_once(self._final_modulus(moduli)))
        return with_volume(law, moduli, relaxes=relaxes, alike=alike)

    @property
    def ends(self) -> bool:
        """True if the last row is the long-term value."""
        last = self.shear[-1] if self.shear else 1.0
        return self.infinite is not None and math.isclose(self.infinite, last, rel_tol=_ROUNDING)

    def _final_modulus(self, moduli: Moduli) -> float:
        """Return g_R at infinite time; 1 where it is not needed."""
        if moduli.instantaneous:
            return 1.0
        if self.infinite is None:
            raise ValueError(
                f"{self.where}: the elastic constants are long-term ones, and the data do not say "
                "what is left in the long term; give SHRINF=, or MODULI=INSTANTANEOUS in *ELASTIC"
            )
        return 1.0 / self.infinite if self.creep else self.infinite

    def _law(self, at_once: float) -> TabulatedCreep | TabulatedRelaxation:
        beyond: Literal["last", "slope"] = "last" if self.ends else "slope"
        relative, times = (1.0, *self.shear), (0.0, *self.times)
        try:
            if self.creep:
                values = [value / (2 * at_once) for value in relative]
                return TabulatedCreep(times, values, beyond=beyond)
            values = [value * at_once for value in relative]
            return TabulatedRelaxation(times, values, beyond=beyond)
        except ValueError as error:
            lines = [f"1 at time 0 ({self.where})", *self.lines]
            raise ValueError(
                f"{self.where}: "
                + re.sub(r"\brow (\d+)", lambda match: lines[int(match[1])], str(error))
            ) from None
