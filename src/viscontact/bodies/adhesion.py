"""Adhesion between the bodies: work, range and law."""

from __future__ import annotations

import difflib
from dataclasses import field

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.cohesive_laws import LAWS, CohesiveLaw
from viscontact.units.numbers import check_fields

#: Tabor numbers up to which the limit of long ranges (DMT) holds within some percents, and from
#: which that of short ones (JKR) does [-].
DMT_BELOW, JKR_ABOVE = 0.1, 5.0


@dataclass(frozen=True)
class Adhesion:
    """Adhesion: the surfaces attract each other over a short range, with a work w per area.

    Parameters
    ----------
    work : float
        Work of adhesion w, which separating the surfaces takes, positive [J/m²].
    range : float, optional
        Range rho of the attraction, w over the strength [m].
    strength : float, optional
        In place of the range: largest attraction sigma0 [Pa].
    law : {"exponential", "dugdale", "lennard-jones"}, optional
        Attraction over the gap g: sigma0 exp(-g/rho); constant up to the gap rho; or the attractive
        branch of the Lennard-Jones 3-9 law behind a hard wall at its equilibrium distance.

    Raises
    ------
    ValueError
        If a value is not positive, both or neither of range and strength are given, or the law is
        unknown.

    Examples
    --------
    >>> Adhesion(0.05, range=2e-9).cohesive_law.strength
    25000000.0
    """

    work: float = field(metadata={"unit": "J/m^2"})
    range: float | None = field(default=None, kw_only=True, metadata={"unit": "m"})
    strength: float | None = field(default=None, kw_only=True, metadata={"unit": "Pa"})
    law: str = field(default="exponential", kw_only=True)

    def __post_init__(self) -> None:
        check_fields(self, "work")
        given = [name for name in ("range", "strength") if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(
                "Adhesion: give range or strength, not both: the range is work/strength"
            )
        for name in given:
            check_fields(self, name)
        if self.law not in LAWS:
            close = difflib.get_close_matches(str(self.law), LAWS, 1)
            hint = f"; did you mean {close[0]!r}?" if close else ""
            raise ValueError(
                f"Adhesion: law must be one of {', '.join(LAWS)}, got {self.law!r}{hint}"
            )

    @property
    def cohesive_law(self) -> CohesiveLaw:
        """Law with its range; ValueError while neither range nor strength is known."""
        length = self.range
        if length is None:
            if self.strength is None:
                raise ValueError("Adhesion: range or strength must be known")
            length = self.work / self.strength
        return LAWS[self.law](self.work, length)


def regime(tabor_number: float) -> str:
    """Return the limit that applies to a sphere of a Tabor number [-], in words."""
    if tabor_number <= DMT_BELOW:
        return f"long range, DMT's limit applies (below {DMT_BELOW:g})"
    if tabor_number >= JKR_ABOVE:
        return f"short range, JKR's limit applies (above {JKR_ABOVE:g})"
    return f"between DMT's limit (below {DMT_BELOW:g}) and JKR's (above {JKR_ABOVE:g})"
