"""Body of finite length: a half-space that ends at planes across x."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from typing import TYPE_CHECKING, Any, Literal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.material import Material
from viscontact.units.display import Displayable
from viscontact.units.numbers import check_fields, finite, store

if TYPE_CHECKING:
    from viscontact.bodies.materials.layers import Layered

#: What a body is at an end: free of stress, or held by a frictionless wall.
END_KINDS = ("free", "held")


@dataclass(frozen=True)
class Body(Displayable):
    """A body that ends along x, where a half-space goes on.

    It takes the place of a `Material` where a body is given. Across y and in depth it is a
    half-space. Its ends are planes across x.

    Parameters
    ----------
    material : Material or Layered
        Its material, with a constant Poisson's ratio; or layers that creep alike, bonded to each
        other and to a rigid base, which end on both sides.
    length : float
        Length along x [m]; one end alone lies at half of it from the centre.
    centre : float, keyword only
        Position x of its middle [m].
    ends : {"free", "held"} or pair, keyword only
        Kind of both ends, or of each, that at -x first: "free" of stress, or "held" by a wall
        without friction. None: the body goes on without end there.

    Raises
    ------
    ValueError
        If the material is none or its Poisson's ratio varies in time, the length is not positive,
        the centre is not finite, a kind is unknown, or both ends are None.

    Notes
    -----
    The ends are planes about which the pressure has a mirror image; a free end adds the
    displacement of a plane without stress (M. Hetényi, J. Appl. Mech. 27 (1960) 289), by an
    operator that depends on Poisson's ratio alone. So creep and ends separate. Between two ends the
    body is a plate below a depth of its length, and the approach has no datum (NaN); between two
    free ones, it also bends, and the tilt along x has none unless all is symmetric about x = 0.

    Examples
    --------
    A track that ends 30 mm beyond the middle, at +x:

    >>> from viscontact.bodies.laws import Elastic
    >>> rubber = Material(Elastic(1e6), poisson_ratio=0.5)
    >>> Body(rubber, 0.06, ends=(None, "free")).planes
    (None, 0.03)
    """

    material: Material | Layered
    length: float = field(metadata={"unit": "m"})
    centre: float = field(default=0.0, kw_only=True, metadata={"unit": "m"})
    ends: tuple[str | None, str | None] = field(default=("free", "free"), kw_only=True)

    if TYPE_CHECKING:  # a kind for both is kept as a pair

        def __init__(
            self,
            material: Material | Layered,
            length: float,
            *,
            centre: float = 0.0,
            ends: Literal["free", "held"] | Sequence[str | None] = "free",
        ) -> None: ...

    def __post_init__(self) -> None:
        given: Any = self.material
        layered = hasattr(given, "layers")  # whose module imports this one
        if not (layered or isinstance(given, Material)):
            raise ValueError(f"Body: material must be a Material or Layered, got {given!r}")
        parts = given.materials if layered else (given,)
        if any(part.poisson_ratio is None for part in parts):
            raise ValueError(
                "Body: material must have a constant poisson_ratio, as what an end adds depends on "
                "it, got an elastic bulk modulus; write Material(law, poisson_ratio)"
            )
        check_fields(self, "length")
        check_fields(self, "centre", check=finite)
        store(self, ends=_pair_of_kinds(self.ends))
        if layered:
            self._check_layers()

    def _check_layers(self) -> None:
        """Refuse layers whose ends are not available."""
        given: Any = self.material
        if given.base != "rigid" or not all(given.bonded):
            raise ValueError(
                "Body: layers that end must be bonded to each other and to a rigid base, as what "
                "an end adds is not known otherwise; write base='rigid', or leave the ends out"
            )
        if None in self.ends:
            raise ValueError(
                f"Body: layers end on both sides, got ends {self.ends}; give both, with a length "
                "of some thicknesses more than the contact"
            )

    @property
    def planes(self) -> tuple[float | None, float | None]:
        """Positions x of the ends at -x and at +x; None where the body goes on [m]."""
        before, after = (
            None if kind is None else self.centre + side * self.length / 2
            for kind, side in zip(self.ends, (-1, 1), strict=True)
        )
        return before, after

    @property
    def is_even(self) -> bool:
        """True if it is its own mirror image about x = 0."""
        return self.centre == 0.0 and self.ends[0] == self.ends[1]


def _pair_of_kinds(given: Any) -> tuple[str | None, str | None]:
    """Kinds of the ends at -x and at +x, of one kind for both or a pair."""
    pair = tuple(given) if isinstance(given, list | tuple) else (given, given)
    known = len(pair) == 2 and all(each in (*END_KINDS, None) for each in pair)
    if not known or pair == (None, None):
        raise ValueError(
            f"Body: ends must be 'free' or 'held', or a pair of these or None, got {given!r}; a "
            "body without ends is a Material"
        )
    return pair[0], pair[1]
