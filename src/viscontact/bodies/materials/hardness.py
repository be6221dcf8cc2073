"""Young's modulus of rubbers from their Shore hardness: an estimate with its spread."""

from __future__ import annotations

import math
from dataclasses import field
from typing import Literal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import finite

#: Time at which a durometer is read [s]: ISO 48-4 for vulcanised rubber.
READ_AT = 3.0
#: Difference between readings of one rubber [points].
READING = 5.0
#: Lowest and highest hardness of the estimates, by scale.
RANGES = {"A": (20.0, 90.0), "D": (30.0, 60.0)}
#: Modulus of thermoplastic polyurethanes of 55 Shore D over that of the relation for rubbers.
THERMOPLASTIC = 2.3


@dataclass(frozen=True)
class HardnessEstimate:
    """Young's modulus that a Shore hardness stands for, and the range in which it may lie.

    Attributes
    ----------
    youngs_modulus : float
        Estimate, of the response within some seconds [Pa].
    lowest, highest : float
        Ends of the range that readings, relations and kinds of elastomers leave [Pa].
    hardness : str
        Hardness with its scale, as ``70 Shore A``.
    """

    youngs_modulus: float = field(metadata={"unit": "Pa"})
    lowest: float = field(metadata={"unit": "Pa"})
    highest: float = field(metadata={"unit": "Pa"})
    hardness: str

    @property
    def words(self) -> str:
        """Sentence on the estimate and its spread."""
        modulus, low, high = (
            format_quantity(each, "Pa", 2)
            for each in (self.youngs_modulus, self.lowest, self.highest)
        )
        return (
            f"the stiffness is estimated from {self.hardness}: E = {modulus}, and may lie between "
            f"{low} and {high}; measure it where that matters"
        )


def modulus_from_shore(hardness: float, scale: Literal["A", "D"] = "A") -> HardnessEstimate:
    """Young's modulus of a rubber from its Shore hardness, as an estimate with its range.

    Parameters
    ----------
    hardness : float
        Reading of the durometer [points]: 20 to 90 Shore A, or 30 to 60 Shore D.
    scale : {"A", "D"}, optional
        Scale of the durometer.

    Returns
    -------
    HardnessEstimate
        ``youngs_modulus``, ``lowest`` and ``highest`` [Pa].

    Raises
    ------
    ValueError
        If the hardness is outside the range of its scale, or the scale is another one.

    Notes
    -----
    Two relations are known for Shore A. That of Gent (1958, Rubber Chemistry and Technology 31,
    896) takes the indenter for a flat punch under the spring of the durometer,
    E = 0.0981 (56 + 7.62336 S) / (0.137505 (254 - 2.54 S)) MPa. The other one is logarithmic,
    log10(E/MPa) = 0.0235 S - 0.6403, with S = S_D + 50 for Shore D; it is mostly attributed to the
    simulations at large strains of Qi, Joyce and Boyce (2003, Rubber Chemistry and Technology 76,
    419). They differ by a factor of 1.9 at 80 Shore A. The estimate is their geometric mean, and
    the range goes from the lower one of 5 points less to the higher one of 5 points more, as far
    as readings of one rubber differ. For Shore D only the logarithmic one is known; thermoplastic
    polyurethanes of 55 Shore D have 2.3 times its modulus (data sheets: 138 to 152 MPa), which is
    in the range, and harder ones many times, so that they are refused.

    Examples
    --------
    >>> found = modulus_from_shore(70)
    >>> [round(each / 1e6, 1) for each in (found.lowest, found.youngs_modulus, found.highest)]
    [4.4, 7.5, 13.2]
    """
    if scale not in RANGES:
        raise ValueError(f"modulus_from_shore: scale must be 'A' or 'D', got {scale!r}")
    number = finite("modulus_from_shore: hardness", hardness, "1")
    low, high = RANGES[scale]
    if not low <= number <= high:
        other = "; a harder one is no rubber: give a measured modulus" if number > high else ""
        raise ValueError(
            f"modulus_from_shore: hardness must be from {low:g} to {high:g} Shore {scale}, got "
            f"{number:g}{other}"
        )
    less, more = number - READING, number + READING
    name = f"{number:g} Shore {scale}"
    if scale == "D":
        ends = _logarithmic(less + 50), THERMOPLASTIC * _logarithmic(more + 50)
        return HardnessEstimate(_logarithmic(number + 50), *ends, name)
    relations = (_gent, _logarithmic)
    return HardnessEstimate(
        math.sqrt(_gent(number) * _logarithmic(number)),
        min(relation(less) for relation in relations),
        max(relation(more) for relation in relations),
        name,
    )


def _gent(hardness: float) -> float:
    """Young's modulus of a Shore A hardness [Pa] (Gent 1958)."""
    return 1e6 * 0.0981 * (56 + 7.62336 * hardness) / (0.137505 * (254 - 2.54 * hardness))


def _logarithmic(hardness: float) -> float:
    """Young's modulus of a Shore A hardness, or of Shore D and 50 points more [Pa]."""
    return float(1e6 * 10 ** (0.0235 * hardness - 0.6403))
