"""Base class of indenters, sums of indenters, and rotated or shifted indenters."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.position_checks import positions
from viscontact.units.display import Displayable
from viscontact.units.numbers import check_fields, finite


class Indenter(Displayable, ABC):
    """A rigid shape, known by its initial gap to the plane it is pressed on.

    To add a shape, write a frozen dataclass with a `gap`; give it `curvatures` too if it is
    smooth at its deepest point.

    Examples
    --------
    >>> from viscontact.bodies.indenters import Sphere, Waviness
    >>> wavy_ball = Sphere(0.01) + Waviness(amplitude=1e-6, wavelength_x=1e-3)
    >>> round(1e6 * float(wavy_ball.gap(0.5e-3, 0.0)), 2)  # 12.51 of the ball, 2 of the waves
    14.51
    """

    @abstractmethod
    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the initial gap h_i(x, y) between the undeformed bodies, just touching.

        Parameters
        ----------
        x, y : array_like
            Positions along and across the indenter, any shapes that broadcast [m].

        Returns
        -------
        ndarray
            Gap, positive when open, zero at the deepest point, +inf outside the outline of
            the body [m].
        """

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures along x and y at the deepest point, zero where they mean nothing [1/m]."""
        return 0.0, 0.0

    @property
    def radius_of_curvature(self) -> float:
        """Smallest radius of curvature at the deepest point, inf where it means nothing [m]."""
        sharpest = max(self.curvatures)
        return 1 / sharpest if sharpest > 0 else math.inf

    @property
    def period(self) -> float:
        """Shortest length over which the shape repeats itself, inf if it does not [m]."""
        return math.inf

    @property
    def periods(self) -> tuple[float, float]:
        """Lengths along x and y over which it repeats, inf along an axis where it does not [m].

        Examples
        --------
        >>> from viscontact.bodies.indenters import Waviness
        >>> Waviness(amplitude=1e-6, wavelength_x=2e-3).periods
        (0.002, inf)
        """
        return self.period, self.period

    @property
    def endless(self) -> tuple[bool, bool]:
        """Axes x and y along which the body continues without end at the same gap.

        Examples
        --------
        >>> from viscontact.bodies.indenters import Paraboloid
        >>> Paraboloid(math.inf, 0.01).endless
        (True, False)
        """
        return False, False

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """Smallest steps along x and y between given points of the surface, 0 without any [m].

        Examples
        --------
        >>> from viscontact.bodies.indenters import HeightMap
        >>> HeightMap([0.0, 1.0, 3.0], [0.0, 2.0], np.zeros((3, 2))).sample_spacing
        (1.0, 2.0)
        """
        return 0.0, 0.0

    @property
    def sample_points(self) -> tuple[Floats, Floats]:
        """Given points of the surface: x and y, empty for a shape that is a formula [m]."""
        return np.empty(0), np.empty(0)

    def rotated(self, angle: float) -> PlacedIndenter:
        """Return the indenter turned about z by an angle from +x towards +y [rad]."""
        return PlacedIndenter(self, angle=angle)

    def shifted(self, x: float = 0.0, y: float = 0.0) -> PlacedIndenter:
        """Return the indenter moved along x and y [m]."""
        return PlacedIndenter(self, x=x, y=y)

    def __add__(self, other: Indenter) -> CombinedIndenter:
        if not isinstance(other, Indenter):
            return NotImplemented
        return CombinedIndenter((self, other))


@dataclass(frozen=True)
class CombinedIndenter(Indenter):
    """Several shapes in one: their gaps add, and the sum is not shifted to zero.

    So a waviness or a roughness is laid over a shape. ``a + b`` makes one.

    Parameters
    ----------
    parts : tuple of Indenter
        The shapes; sums among them are taken apart, so that a + b + c has three parts.

    Raises
    ------
    ValueError
        If there is no part, or one of them is not an indenter.

    Examples
    --------
    Two equal spheres on each other meet like one of half the radius on a plane:

    >>> from viscontact.bodies.indenters import Sphere
    >>> (Sphere(0.01) + Sphere(0.01)).radius_of_curvature
    0.005
    """

    parts: tuple[Indenter, ...]

    def __post_init__(self) -> None:
        parts = tuple(self.parts)
        if not parts:
            raise ValueError("CombinedIndenter: parts must hold at least one indenter, got none")
        for part in parts:
            if not isinstance(part, Indenter):
                raise ValueError(f"CombinedIndenter: parts must be indenters, got {part!r}")
        object.__setattr__(self, "parts", tuple(leaf for part in parts for leaf in _summands(part)))

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the sum of the parts' gaps; see `Indenter.gap`."""
        return np.asarray(sum(part.gap(x, y) for part in self.parts), dtype=np.float64)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Sums of the parts' curvatures along x and y [1/m]."""
        along_x, along_y = zip(*(part.curvatures for part in self.parts), strict=True)
        return math.fsum(along_x), math.fsum(along_y)

    @property
    def endless(self) -> tuple[bool, bool]:
        """Axes along which all parts continue without end."""
        along_x, along_y = zip(*(part.endless for part in self.parts), strict=True)
        return all(along_x), all(along_y)

    @property
    def period(self) -> float:
        """The shortest of the parts' [m]."""
        return min(part.period for part in self.parts)

    @property
    def periods(self) -> tuple[float, float]:
        """The shortest of the parts' along each axis [m]."""
        along_x, along_y = zip(*(part.periods for part in self.parts), strict=True)
        return min(along_x), min(along_y)

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """The smallest steps of the parts [m]."""
        found = [part.sample_spacing for part in self.parts if min(part.sample_spacing) > 0]
        if not found:
            return 0.0, 0.0
        return min(along for along, _ in found), min(across for _, across in found)

    @property
    def sample_points(self) -> tuple[Floats, Floats]:
        """Points of all parts [m]."""
        x, y = zip(*(part.sample_points for part in self.parts), strict=True)
        return np.concatenate(x), np.concatenate(y)


@dataclass(frozen=True)
class PlacedIndenter(Indenter):
    """An indenter turned about z and then moved; ``rotated`` and ``shifted`` make one.

    Parameters
    ----------
    body : Indenter
        The indenter to be rotated and shifted.
    angle : float, optional
        Angle of rotation, from +x towards +y [rad].
    x, y : float, optional
        New position of its origin [m].

    Raises
    ------
    ValueError
        If the body is not an indenter, or a number is not finite.

    Examples
    --------
    A roller lying along y, 1 mm off the origin:

    >>> import math
    >>> from viscontact.bodies.indenters import Roller
    >>> across = Roller(radius=5e-3, half_length=10e-3).rotated(math.pi / 2).shifted(x=1e-3)
    >>> across.gap(1e-3, [9e-3, 11e-3]).tolist()
    [0.0, inf]
    """

    body: Indenter
    angle: float = field(default=0.0, metadata={"unit": "rad", "name": "turned by"})
    x: float = field(default=0.0, metadata={"unit": "m", "name": "moved along x by"})
    y: float = field(default=0.0, metadata={"unit": "m", "name": "moved along y by"})

    def __post_init__(self) -> None:
        if not isinstance(self.body, Indenter):
            raise ValueError(f"PlacedIndenter: body must be an indenter, got {self.body!r}")
        check_fields(self, "angle", "x", "y", check=finite)

    @property
    def _turn(self) -> tuple[float, float]:
        """Cosine and sine of the angle; exact for quarter turns."""
        quarters = self.angle / (math.pi / 2)
        if abs(quarters) < 2**20 and quarters == round(quarters):
            return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
        return math.cos(self.angle), math.sin(self.angle)

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the gap of the rotated and shifted body; see `Indenter.gap`."""
        x, y = positions(x, y)
        cosine, sine = self._turn
        east, north = x - self.x, y - self.y
        return self.body.gap(cosine * east + sine * north, cosine * north - sine * east)

    def place(self, x: ArrayLike, y: ArrayLike) -> tuple[Floats, Floats]:
        """Return the rotated and shifted positions of points of the body [m]."""
        x, y = positions(x, y)
        cosine, sine = self._turn
        return self.x + cosine * x - sine * y, self.y + sine * x + cosine * y

    @property
    def endless(self) -> tuple[bool, bool]:
        """Axes of the body as it is turned; both, if it is endless along neither of them."""
        along, across = self.body.endless
        cosine, sine = self._turn
        if sine == 0:
            return along, across
        return (across, along) if cosine == 0 else (along or across, along or across)

    @property
    def period(self) -> float:
        """Period of the body [m]."""
        return self.body.period

    @property
    def periods(self) -> tuple[float, float]:
        """Lengths along x and y over which the body repeats as it is turned [m]."""
        x, y = (1 / each for each in self.body.periods)
        cosine, sine = self._turn
        waves = math.hypot(cosine * x, sine * y), math.hypot(sine * x, cosine * y)
        along_x, along_y = (1 / each if each > 0 else math.inf for each in waves)
        return along_x, along_y

    @property
    def sample_spacing(self) -> tuple[float, float]:
        """Steps of the body; the smaller one both ways if it is turned [m]."""
        steps = self.body.sample_spacing
        return steps if self.angle == 0 else (min(steps), min(steps))

    @property
    def sample_points(self) -> tuple[Floats, Floats]:
        """Points of the rotated and shifted body [m]."""
        return self.place(*self.body.sample_points)

    @property
    def curvatures(self) -> tuple[float, float]:
        """Curvatures along x and y of the body as it is turned [1/m]."""
        along, across = self.body.curvatures
        cosine, sine = self._turn
        return along * cosine**2 + across * sine**2, along * sine**2 + across * cosine**2


def _summands(part: Indenter) -> tuple[Indenter, ...]:
    return part.parts if isinstance(part, CombinedIndenter) else (part,)
