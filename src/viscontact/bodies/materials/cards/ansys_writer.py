"""Writer of Ansys material cards."""

from __future__ import annotations

from viscontact.bodies.laws import WLF, Arrhenius, Shift
from viscontact.bodies.laws.time_temperature import GAS_CONSTANT
from viscontact.bodies.materials.cards.card import Card, CardUnits, card_units, in_unit
from viscontact.bodies.materials.cards.numbers import card_digits
from viscontact.bodies.materials.cards.prony_terms import Terms, relative
from viscontact.units.numbers import whole

# Limits of Ansys: values in one TBDATA, and pairs in one table.
_IN_A_LINE, _MOST_PAIRS = 6, 100


def write_ansys(
    card: Card,
    *,
    modulus_unit: str,
    time_unit: str,
    temperature_unit: str | None = None,
    number: int = 1,
) -> str:
    """Write a material as Ansys APDL commands.

    Parameters
    ----------
    card : Card
        The material. Its law must be a Prony series of some kind.
    modulus_unit, time_unit : str
        Of the model that the card is for, e.g. ``"MPa"`` and ``"s"``.
    temperature_unit : str, optional
        Needed if the card has a shift; ``"K"`` for an Arrhenius shift.
    number : int, optional
        The material's number.

    Returns
    -------
    str
        ``MP``, ``TB,PRONY`` and ``TB,SHIFT``, as `read_ansys` describes them.

    Raises
    ------
    ValueError
        If the law or the shift cannot be written, with what to do.

    Examples
    --------
    >>> from viscontact.bodies.laws import RelaxationSeries
    >>> from viscontact.bodies.materials.material import Material
    >>> rubber = Card("R", Material(RelaxationSeries(1e6, [1e6], [10.0]), 0.5))
    >>> print(write_ansys(rubber, modulus_unit="MPa", time_unit="s"))
    ! R: moduli in MPa, times in s
    MP,EX,1,6.0
    MP,PRXY,1,0.5
    TB,PRONY,1,1,1,SHEAR
    TBDATA,1,0.5,10.0
    <BLANKLINE>
    """
    number = whole("write_ansys: number", number, 1)
    units = card_units(modulus_unit, time_unit, temperature_unit)
    found = relative(card.material, instantaneous=True)
    title = " ".join(card.name.split()).replace("!", "")
    lines = [
        f"! {title}: {units.words}",
        f"MP,EX,{number},{card_digits(found.moduli.youngs_modulus / units.modulus)}",
        f"MP,PRXY,{number},{card_digits(found.moduli.poisson_ratio)}",
    ]
    for terms, kind in ((found.shear, "SHEAR"), (found.bulk, "BULK")):
        lines += _terms(terms, kind, number, units)
    if card.shift is not None:
        lines += _shift(card.shift, number, units)
    return "\n".join(lines) + "\n"


def _terms(terms: Terms, kind: str, number: int, units: CardUnits) -> list[str]:
    pairs = len(terms.weights)
    if pairs == 0:
        return []
    if pairs > _MOST_PAIRS:
        raise ValueError(
            f"Ansys takes {_MOST_PAIRS} terms, got {pairs}; fit a series of fewer terms"
        )
    times = [time / units.time for time in terms.times]
    values = [value for pair in zip(terms.weights, times, strict=True) for value in pair]
    return [f"TB,PRONY,{number},1,{pairs},{kind}", *_data(values)]


def _shift(shift: Shift, number: int, units: CardUnits) -> list[str]:
    scale = units.kelvins("the card's shift")
    if isinstance(shift, WLF):
        reference = in_unit(shift.reference_temperature, scale)
        values = [reference, shift.c1, shift.c2 / scale.factor]
        return [f"TB,SHIFT,{number},1,3,WLF", *_data(values)]
    if not isinstance(shift, Arrhenius):
        raise ValueError(
            f"Ansys takes WLF and Arrhenius (TN) shifts, got {type(shift).__name__}; fit one with "
            "viscontact.identification.fit_wlf"
        )
    if scale.offset != 0.0:
        raise ValueError("an Arrhenius shift is in absolute temperatures; temperature_unit='K'")
    values = [
        shift.reference_temperature / scale.factor,
        shift.activation_energy / GAS_CONSTANT / scale.factor,
    ]
    return [f"TB,SHIFT,{number},1,2,TN", *_data(values)]


def _data(values: list[float]) -> list[str]:
    return [
        ",".join(["TBDATA", str(i + 1), *map(card_digits, values[i : i + _IN_A_LINE])])
        for i in range(0, len(values), _IN_A_LINE)
    ]
