"""A material card with its units."""

from __future__ import annotations

from decimal import Decimal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Shift
from viscontact.bodies.materials.material import Material
from viscontact.units.display import Displayable
from viscontact.units.parsing import UnitScale, parse_scale, parse_unit


@dataclass(frozen=True)
class Card(Displayable):
    """A material of a finite-element program.

    Parameters
    ----------
    name : str
        Its name, or with Ansys its number.
    material : Material
        The law in shear, with Poisson's ratio or bulk modulus.
    shift : WLF, Arrhenius or TabulatedShift, optional
        Time-temperature shift; the law holds at the reference temperature.
    notes : tuple of str, optional
        Data of the file that are not used.

    Examples
    --------
    >>> from viscontact.bodies.laws import Maxwell
    >>> Card("gel", Material(Maxwell(1e3, 2e3), poisson_ratio=0.5)).material.poisson_ratio
    0.5
    """

    name: str
    material: Material
    shift: Shift | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class CardUnits:
    """Units of a card: factors to Pa and s, scale of temperature if known; the same in words."""

    modulus: float
    time: float
    temperature: UnitScale | None
    words: str

    def kelvins(self, where: str) -> UnitScale:
        """Return the unit of temperature; ValueError if it is not known."""
        if self.temperature is None:
            raise ValueError(
                f"{where}: has temperatures, and cards do not say their unit; give "
                "temperature_unit, e.g. 'degC' or 'K'"
            )
        return self.temperature


def card_units(modulus_unit: str, time_unit: str, temperature_unit: str | None) -> CardUnits:
    """Return the units of a card from words such as ``"MPa"``, ``"s"`` and ``"degC"``."""
    words = f"moduli in {modulus_unit}, times in {time_unit}"
    if temperature_unit is not None:
        words += f", temperatures in {temperature_unit}"
    degrees = None if temperature_unit is None else parse_scale(temperature_unit, "temperature")
    return CardUnits(
        parse_unit(modulus_unit, "pressure"), parse_unit(time_unit, "time"), degrees, words
    )


def in_unit(kelvins: float, scale: UnitScale) -> float:
    """Return a temperature [K] as a number in another unit."""
    above = Decimal(repr(kelvins)) - Decimal(repr(scale.offset))
    return float(above / Decimal(repr(scale.factor)))
