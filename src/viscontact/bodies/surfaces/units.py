"""Units of a map, from its file or from the caller; never assumed."""

from __future__ import annotations

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.parsing import parse_unit

Spacing = float | tuple[float, float]


@dataclass(frozen=True)
class Units:
    """Units of a file's map as the caller gives them; None where not given."""

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
        """Unit of the heights in metres; ValueError if it is not given."""
        if self.height_unit is None:
            raise ValueError(
                f"height_unit is missing: {self.name} does not state the unit of its heights; "
                "give e.g. um"
            )
        return parse_unit(self.height_unit, "length")

    @property
    def steps(self) -> Spacing:
        """Spacing of the points [m]; ValueError if it is not given."""
        if self.spacing is None:
            raise ValueError(
                f"spacing is missing: {self.name} does not state the distance of its points; "
                "give one distance, or one along x and one along y"
            )
        return self.spacing

    def require_none(self, *names: str) -> None:
        """Refuse units, all or those named, that the file already states."""
        for name in names or ("spacing", "height_unit"):
            if getattr(self, name) is not None:
                raise ValueError(
                    f"{name}: is given in {self.name}; leave it out "
                    "(height_factor: corrects a wrong unit)"
                )
