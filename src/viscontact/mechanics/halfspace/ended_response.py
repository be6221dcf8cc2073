"""Half-spaces cut by planes across x: free ends, and frictionless walls."""

from __future__ import annotations

from dataclasses import field

from viscontact.backend.arrays import Numbers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.halfspace.elastic_stack import ElasticStack
from viscontact.mechanics.halfspace.surface_response import (
    HalfSpaceResponse,
    SummedResponse,
    SurfaceResponse,
)


@dataclass(frozen=True)
class EndedResponse(HalfSpaceResponse):
    """Half-space that ends at planes across x; far from them it is one without ends."""

    poisson_ratio: float
    planes: tuple[float | None, float | None]  # at -x and at +x [m]; None: it goes on
    free: tuple[bool, bool]  # free of stress; otherwise held by a frictionless wall
    #: All pressures are even about the middle between two planes.
    even: bool = field(default=False, kw_only=True)


@dataclass(frozen=True)
class EndedLayers(EndedResponse):
    """Layers on a rigid base that end at two planes across x."""

    stack: ElasticStack

    @property
    def long_waves(self) -> float:  # type: ignore[override]
        """Limit of L for long waves, which the base does not let pass [-]."""
        return self.stack.long_waves

    @property
    def length(self) -> float:  # type: ignore[override]
        """Thickness of the thinnest layer [m]."""
        return self.stack.length

    def ratio(self, wave_number: Numbers) -> Numbers:
        """L at wave numbers [1/m], far from the ends."""
        return self.stack.ratio(wave_number)

    @property
    def mean_displacement(self) -> float:
        """Displacement per uniform p and J, without strain across [m]."""
        return self.stack.mean_displacement


def parts_of(response: SurfaceResponse) -> list[tuple[SurfaceResponse, float]]:
    """Responses that are no sums, with their weights."""
    if not isinstance(response, SummedResponse):
        return [(response, 1.0)]
    pairs = zip(response.parts, response.weights, strict=True)
    return [(part, weight * own) for each, weight in pairs for part, own in parts_of(each)]


def has_ends(response: SurfaceResponse) -> bool:
    """True of a half-space that ends, and of a sum with one."""
    return any(isinstance(part, EndedResponse) for part, _ in parts_of(response))


def planes_in(response: SurfaceResponse) -> tuple[float, ...]:
    """Positions x of all ends of a response [m]."""
    ended = (part for part, _ in parts_of(response) if isinstance(part, EndedResponse))
    return tuple(plane for part in ended for plane in part.planes if plane is not None)


def has_even_ends(response: SurfaceResponse) -> bool:
    """True if all ends are alike on both sides of x = 0, and without ends."""
    ended = [part for part, _ in parts_of(response) if isinstance(part, EndedResponse)]
    return all(
        part.free[0] == part.free[1]
        and None not in part.planes
        and part.planes[0] == -(part.planes[1] or 0.0)
        for part in ended
    )
