"""Indenters with flat flanks: wedge and pyramids, as hardness testers have them."""

from __future__ import annotations

import math
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import acute_angle, positions
from viscontact.units.numbers import check_fields, store, whole


@dataclass(frozen=True)
class Wedge(Indenter):
    """A wedge, its edge along x, its flanks without end.

    Parameters
    ----------
    half_angle : float
        Angle from the plane of symmetry to a flank, between 0 and π/2, both excluded [rad].
    half_length : float, optional
        Distance of the sharp ends from the middle [m]; the edge has no end when left out.

    Raises
    ------
    ValueError
        If the angle or the length is invalid.

    Examples
    --------
    >>> wedge = Wedge(half_angle=math.radians(45), half_length=2.0)
    >>> wedge.gap([0.0, 1.0, 3.0], [0.0, -3.0, 0.0]).round(12).tolist()
    [0.0, 3.0, inf]
    """

    half_angle: float = field(metadata={"unit": "rad"})
    half_length: float | None = field(default=None, metadata={"unit": "m"})

    def __post_init__(self) -> None:
        check_fields(self, "half_angle", check=acute_angle)
        check_fields(self, "half_length")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return |y| / tan(half_angle), +inf beyond the edge's ends; see `Indenter.gap`."""
        x, y = positions(x, y)
        end = math.inf if self.half_length is None else self.half_length
        return np.where(np.abs(x) <= end, np.abs(y) / math.tan(self.half_angle), np.inf)

    @property
    def endless(self) -> tuple[bool, bool]:
        """Along x if the edge has no end."""
        return self.half_length is None, False


@dataclass(frozen=True)
class Pyramid(Indenter):
    """A pyramid on a regular polygon, apex down, its faces without end.

    Parameters
    ----------
    half_angle : float
        Angle from the axis to a face (not to an edge), between 0 and π/2, both excluded [rad].
    faces : int
        Number of faces, from 3 to 1000; one of them looks along +x.

    Raises
    ------
    ValueError
        If the angle is invalid, or the number of faces.

    Notes
    -----
    The section at the height h is a regular polygon of the area n tan(π/n) tan²(half_angle) h².

    Examples
    --------
    >>> pyramid = Pyramid(half_angle=math.radians(45), faces=4)
    >>> pyramid.gap([3.0, 3.0, -4.0], [0.0, 2.0, 4.0]).round(12).tolist()
    [3.0, 3.0, 4.0]
    """

    half_angle: float = field(metadata={"unit": "rad"})
    faces: int = field(metadata={"unit": "1"})

    def __post_init__(self) -> None:
        check_fields(self, "half_angle", check=acute_angle)
        store(self, faces=whole("Pyramid: faces", self.faces, 3, 1000))

    @classmethod
    def vickers(cls) -> Pyramid:
        """Return a Vickers pyramid: 4 faces, 136° between opposite ones, area 24.504 h².

        Examples
        --------
        >>> round(math.degrees(Pyramid.vickers().half_angle), 2)
        68.0
        """
        return cls(math.radians(68.0), faces=4)

    @classmethod
    def berkovich(cls) -> Pyramid:
        """Return a modified Berkovich pyramid: 3 faces at 65.27° to the axis, area 24.5 h².

        Notes
        -----
        The angle that gives it the area of a Vickers pyramid; Berkovich's first one had 65.03°,
        for equal surfaces.

        Examples
        --------
        >>> round(math.degrees(Pyramid.berkovich().half_angle), 2)
        65.27
        """
        return cls(math.radians(65.27), faces=3)

    @classmethod
    def cube_corner(cls) -> Pyramid:
        """Return the corner of a cube: 3 faces at right angles, 35.26° to the axis.

        Examples
        --------
        >>> round(math.degrees(Pyramid.cube_corner().half_angle), 2)
        35.26
        """
        return cls(math.atan(math.sqrt(0.5)), faces=3)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the height of the highest face; see `Indenter.gap`."""
        x, y = positions(x, y)
        gap = np.zeros(np.broadcast_shapes(x.shape, y.shape))
        for k in range(self.faces):
            towards = 2 * math.pi * k / self.faces
            np.maximum(gap, x * math.cos(towards) + y * math.sin(towards), out=gap)
        return gap / math.tan(self.half_angle)
