"""Units of a map: from its file, or from who knows them, but never guessed."""

from __future__ import annotations

from dataclasses import dataclass

from viscontact.units.parsing import parse_unit

Spacing = float | tuple[float, float]


@dataclass(frozen=True)
class Units:
    """What is told of a file's units beside it.

    Parameters
    ----------
    name : str
        The file's name.
    spacing : float or pair of float or None
        Distance of the points [m]; None if not told.
    height_unit : str or None
        Unit of the heights; None if not told.

    Raises
    ------
    ValueError
        If the unit is none of length.
    """

    name: str
    spacing: Spacing | None
    height_unit: str | None

    def __post_init__(self) -> None:
        if self.height_unit is not None:
            try:
                parse_unit(self.height_unit, "length")
            except ValueError as error:
                raise ValueError(f"height_unit: {error}") from error

    @property
    def height_scale(self) -> float:
        """Metres in the unit of the heights; ValueError if it is not told."""
        if self.height_unit is None:
            raise ValueError(
                f"height_unit is missing: {self.name} does not tell the unit of its heights; "
                "give e.g. um"
            )
        return parse_unit(self.height_unit, "length")

    @property
    def steps(self) -> Spacing:
        """Distance of the points [m]; ValueError if it is not told."""
        if self.spacing is None:
            raise ValueError(
                f"spacing is missing: {self.name} does not tell how far its points are apart; "
                "give one distance, or one along x and one along y"
            )
        return self.spacing

    def require_none(self, *names: str) -> None:
        """Refuse what is told although the file tells it.

        Parameters
        ----------
        *names : str
            What stands in the file: ``"spacing"``, ``"height_unit"``; both when left out.

        Raises
        ------
        ValueError
            If it is told beside it, too.
        """
        for name in names or ("spacing", "height_unit"):
            if getattr(self, name) is not None:
                raise ValueError(
                    f"{name}: stands in {self.name}; leave it out (height_factor: mends a unit "
                    "that is wrong there)"
                )
