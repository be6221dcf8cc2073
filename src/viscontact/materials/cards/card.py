"""What a material card says, and the units that it does not say."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal

from viscontact.display import Displayable
from viscontact.laws import Shift
from viscontact.materials.material import Material
from viscontact.units.parsing import Scale, parse_scale, parse_unit


@dataclass(frozen=True)
class Card(Displayable):
    """A material as a finite-element program has it.

    Parameters
    ----------
    name : str
        Its name, or with Ansys its number.
    material : Material
        The law in shear, and what the volume does.
    shift : WLF, Arrhenius or TabulatedShift, optional
        How its times shift with temperature; the law holds at the reference temperature.
    notes : tuple of str, optional
        What stood in the file and was not used.

    Examples
    --------
    >>> from viscontact.laws import Maxwell
    >>> Card("gel", Material(Maxwell(1e3, 2e3), poisson_ratio=0.5)).material.poisson_ratio
    0.5
    """

    name: str
    material: Material
    shift: Shift | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class CardUnits:
    """The units of a card's numbers, of which its program knows nothing.

    Parameters
    ----------
    modulus, time : float
        How many pascals, and how many seconds, its units are.
    temperature : Scale or None
        Its unit of temperature, if that is known.
    words : str
        The same in words, for a comment in the card.
    """

    modulus: float
    time: float
    temperature: Scale | None
    words: str

    def kelvins(self, where: str) -> Scale:
        """Return the unit of temperature; ValueError if it is not known."""
        if self.temperature is None:
            raise ValueError(
                f"{where}: has temperatures, and cards do not say their unit; give "
                "temperature_unit, e.g. 'degC' or 'K'"
            )
        return self.temperature


def card_units(modulus_unit: str, time_unit: str, temperature_unit: str | None) -> CardUnits:
    """Return the units of a card.

    Parameters
    ----------
    modulus_unit, time_unit : str
        Such as ``"MPa"`` and ``"s"``.
    temperature_unit : str or None
        Such as ``"degC"``.

    Returns
    -------
    CardUnits
        The same as factors.

    Raises
    ------
    ValueError
        If one is not a unit of that kind.

    Examples
    --------
    >>> card_units("MPa", "ms", None).time
    0.001
    """
    words = f"moduli in {modulus_unit}, times in {time_unit}"
    if temperature_unit is not None:
        words += f", temperatures in {temperature_unit}"
    degrees = None if temperature_unit is None else parse_scale(temperature_unit, "temperature")
    return CardUnits(
        parse_unit(modulus_unit, "pressure"), parse_unit(time_unit, "time"), degrees, words
    )


def in_unit(kelvins: float, scale: Scale) -> float:
    """Return a temperature [K] as a number in another unit.

    Examples
    --------
    >>> in_unit(298.15, Scale(1.0, 273.15))
    25.0
    """
    above = Decimal(repr(kelvins)) - Decimal(repr(scale.offset))
    return float(above / Decimal(repr(scale.factor)))
