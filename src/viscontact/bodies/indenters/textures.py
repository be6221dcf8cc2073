"""Periodic surface textures to be added to a shape: waviness and dimples."""

from __future__ import annotations

import math
from dataclasses import field
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.indenter import Indenter
from viscontact.bodies.indenters.position_checks import positions
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import check_fields, finite

Pattern = Literal["square", "hexagonal"]
PATTERNS: tuple[Pattern, ...] = get_args(Pattern)


#: Cells that a wave or a dimple is to have: the points of a cosine then miss (pi/10)^2/2 = 5 % of
#: its height at most.
CELLS_OF_A_WAVE = 10


@dataclass(frozen=True)
class Waviness(Indenter):
    """A wavy surface, along x, along y, or crests in both directions; it has no end.

    Parameters
    ----------
    amplitude : float
        Half the height from trough to crest [m].
    wavelength_x, wavelength_y : float, optional
        Distance from crest to crest along x and along y, one or both [m].
    phase_x, phase_y : float, optional
        Phase at the origin; a crest when zero [rad].

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, no wavelength is given, or a phase goes
        with none.

    Notes
    -----
    Johnson (1985), Contact Mechanics, section 13.2: the gap is
    Δ (1 - cos(2π x/λ_x + φ_x) cos(2π y/λ_y + φ_y)), computed as
    Δ (sin²((u + v)/2) + sin²((u - v)/2)) with u and v for the angles. Crests have no part in
    `curvatures`: a contact is many of them wide.

    Examples
    --------
    >>> ridges = Waviness(amplitude=1e-6, wavelength_x=2e-3)
    >>> (1e6 * (ridges.gap([0.0, 0.5e-3, 1e-3], 0.0))).round(12).tolist()
    [0.0, 1.0, 2.0]
    """

    amplitude: float = field(metadata={"unit": "m"})
    wavelength_x: float | None = field(default=None, metadata={"unit": "m"})
    wavelength_y: float | None = field(default=None, metadata={"unit": "m"})
    phase_x: float = field(default=0.0, metadata={"unit": "rad"})
    phase_y: float = field(default=0.0, metadata={"unit": "rad"})

    def __post_init__(self) -> None:
        check_fields(self, "amplitude", "wavelength_x", "wavelength_y")
        check_fields(self, "phase_x", "phase_y", check=finite)
        for axis in ("x", "y"):
            if getattr(self, f"phase_{axis}") and getattr(self, f"wavelength_{axis}") is None:
                raise ValueError(
                    f"Waviness: phase_{axis} goes with wavelength_{axis}, which is not given"
                )
        if self.wavelength_x is None and self.wavelength_y is None:
            raise ValueError("Waviness: give wavelength_x, wavelength_y or both, got neither")

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the depth below the crests; see `Indenter.gap`."""
        x, y = positions(x, y)
        u = _angle(x, self.wavelength_x, self.phase_x)
        v = _angle(y, self.wavelength_y, self.phase_y)
        return np.asarray(self.amplitude * (np.sin((u + v) / 2) ** 2 + np.sin((u - v) / 2) ** 2))

    @property
    def period(self) -> float:
        """The shorter wavelength [m]."""
        return min(self.periods)

    @property
    def periods(self) -> tuple[float, float]:
        """The wavelengths, inf along an axis without waves [m]."""
        return self.wavelength_x or math.inf, self.wavelength_y or math.inf


@dataclass(frozen=True)
class Dimples(Indenter):
    """A plane with a pattern of equal round dimples, one of them at the origin; it has no end.

    Parameters
    ----------
    depth : float
        Depth of a dimple in its middle, at most its radius [m].
    radius : float
        Radius of its mouth [m].
    spacing : float
        Distance between the middles of neighbours, at least two radii [m].
    pattern : str, optional
        ``"square"``: rows along x and y; ``"hexagonal"``: rows along x, each dimple with six
        neighbours.

    Raises
    ------
    ValueError
        If a length is not a positive, finite number, dimples overlap or undercut, or the pattern
        is unknown.

    Notes
    -----
    A dimple is the cap of a sphere of radius ρ = (a² + d²)/(2 d), a for its mouth's radius, d for
    its depth: the gap is sqrt(ρ² - r²) - (ρ - d), computed without cancellation. At the edge of a
    mouth the slope jumps, and with it pressure has a peak that depends on the mesh.

    Examples
    --------
    >>> texture = Dimples(depth=1.0, radius=3.0, spacing=10.0)
    >>> texture.gap([0.0, 10.0, 5.0], [0.0, 20.0, 0.0]).tolist()
    [1.0, 1.0, 0.0]
    """

    depth: float = field(metadata={"unit": "m"})
    radius: float = field(metadata={"unit": "m"})
    spacing: float = field(metadata={"unit": "m"})
    pattern: Pattern = "square"

    def __post_init__(self) -> None:
        check_fields(self, "depth", "radius", "spacing")
        if self.depth > self.radius:
            raise ValueError(
                "Dimples: depth must be at most the radius "
                f"{format_quantity(self.radius, 'm', 9)}, half a sphere, got "
                f"{format_quantity(self.depth, 'm', 9)}"
            )
        if self.spacing < 2 * self.radius:
            raise ValueError(
                "Dimples: spacing must be at least two radii, "
                f"{format_quantity(2 * self.radius, 'm', 9)}, or dimples overlap, got "
                f"{format_quantity(self.spacing, 'm', 9)}"
            )
        if self.pattern not in PATTERNS:
            raise ValueError(
                f"Dimples: pattern must be {' or '.join(map(repr, PATTERNS))}, got {self.pattern!r}"
            )

    def gap(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Return the depth of the nearest dimple, zero between them; see `Indenter.gap`."""
        x, y = positions(x, y)
        r = self._from_nearest(x, y)
        a, d = self.radius, self.depth
        sphere, below = (a * a + d * d) / (2 * d), (a - d) * (a + d) / (2 * d)
        within = np.minimum(r, a)
        root = np.sqrt((sphere - within) * (sphere + within))
        # Of half a sphere only the mouth itself has no depth: 0/0 otherwise.
        span = root + below
        return np.divide((a - within) * (a + within), span, out=np.zeros_like(r), where=span > 0)

    @property
    def period(self) -> float:
        """A dimple's mouth, which is shorter than their distance [m]."""
        return 2 * self.radius

    def _from_nearest(self, x: Floats, y: Floats) -> Floats:
        """Distance from the nearest dimple's middle [m]."""
        s = self.spacing
        if self.pattern == "square":
            return np.hypot(_from_multiple(x, s), _from_multiple(y, s))
        row = s * math.sqrt(3)
        return np.minimum(
            np.hypot(_from_multiple(x, s), _from_multiple(y, row)),
            np.hypot(_from_multiple(x - s / 2, s), _from_multiple(y - row / 2, row)),
        )


def _angle(position: Floats, wavelength: float | None, phase: float) -> Floats:
    if wavelength is None:
        return np.zeros_like(position)
    return np.asarray(2 * math.pi * (position / wavelength) + phase)


def _from_multiple(position: Floats, step: float) -> Floats:
    return np.asarray(position - step * np.round(position / step))
