"""Runs of simple bodies, whose contact closed forms say, and what guards them.

Contact radius a of a paraboloid after Hertz, a^3 = 3 F R J/4 with approach a^2/R (Johnson
1985, Contact Mechanics, eqs. 4.22-4.24), half width b of a cylinder, b^2 = 4 (F/length) R J/pi
(eq. 4.43).
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import viscontact as vc
from viscontact.indenters import Indenter

J = 0.25e-6
RUBBER = vc.Material(vc.Elastic(1e6), 0.5)  # J = (1 - nu)/(2G)
#: tau = 1 s, and J grows elevenfold
SOFT = vc.Material(vc.Zener(1e6, 1e5, 1e5), 0.5)
FLUID = vc.Material(vc.Maxwell(1e6, 1e6), 0.5)
BALL = vc.Paraboloid(1.0, 1.0)
#: Its first row is at 1 s, its last at 100 s; one logarithmic slope, so that it is a material's.
TABLE = vc.Material(
    vc.TabulatedCreep(np.geomspace(1, 100, 21), 1e-6 * np.geomspace(1, 100, 21) ** 0.05), 0.5
)


def hertz_force(radius: float) -> float:
    """Force that presses `BALL` to this contact radius [m]."""
    return 4 * radius**3 / (3 * J)


FEWER = vc.Grid((32, 32), (0.28, 0.28))
PRESSED, FINE = vc.step(hertz_force(0.1)), vc.Grid((60, 60), (0.28, 0.28))


#: Waves of one direction, pressed flat on a period of 64 x 4 cells.
WAVES = vc.Waviness(1e-6, wavelength_x=0.1)
LINE_OF_CELLS, MEAN_PRESSED = vc.Grid((64, 4), (0.1, 0.1), periodic=True), vc.step(10.0)


@dataclass(frozen=True)
class Job:
    """Arguments of `simulate`."""

    indenter: Indenter = BALL
    load: Any = PRESSED
    grid: vc.Grid | None = FINE
    material: vc.Material = RUBBER
    times: Any = (0.0,)
    indenter_material: vc.Material | None = None

    def run(self) -> list[str]:
        """The warnings of the run, which Python and the result have heard alike."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = vc.simulate(
                self.indenter,
                self.material,
                self.load,
                self.grid,
                self.times,
                indenter_material=self.indenter_material,
                fields="none",
                errors=False,  # what they warn of is met in test_error_bars
            )
        kept = result.attrs["warnings"]
        said = [str(each.message) for each in caught if each.category is vc.AccuracyWarning]
        assert list(kept if isinstance(kept, list) else kept.splitlines()) == said
        return said


@dataclass(frozen=True)
class Guard:
    """What ends how, and its words; a run that meets it, and one that does not.

    `besides` are words of other guards that the second run may meet.
    """

    outcome: type[Warning] | type[Exception]
    words: str
    met: Job
    missed: Job
    besides: tuple[str, ...] = field(default=())


class Shifted(Indenter):
    """A ball that stands elsewhere."""

    def __init__(self, x: float, y: float) -> None:
        self.x, self.y = x, y

    def gap(self, x: Any, y: Any) -> np.ndarray:
        """Gap of a paraboloid of radius 1 m."""
        return BALL.gap(np.asarray(x) - self.x, np.asarray(y) - self.y)


class TwoHills(Indenter):
    """Two balls, one of them 0.75 m away."""

    def gap(self, x: Any, y: Any) -> np.ndarray:
        """Gap of the nearer."""
        return np.minimum(BALL.gap(x, y), BALL.gap(np.asarray(x) - 0.75, y))


class NotAlwaysANumber(vc.PowerLaw):
    """A law with a mistake in it, from 0.4 s to 0.9 s."""

    def _creep(self, t: np.ndarray) -> np.ndarray:
        return np.where((t > 0.4) & (t < 0.9), np.nan, super()._creep(t))


class Shrinking(vc.PowerLaw):
    """A law that takes creep back, from 0.4 s on."""

    def _creep(self, t: np.ndarray) -> np.ndarray:
        return np.where(t > 0.4, 0.5, 1.0) * super()._creep(t)


def mapped(half_size: float, spacing: float, roughness: float = 0.0) -> vc.HeightMap:
    """A ball as an instrument sees it, as far as its view goes."""
    count = 2 * round(half_size / spacing) + 1
    x = np.linspace(-half_size, half_size, count)
    noise = np.random.default_rng(7).normal(size=(count, count)) * roughness
    return vc.HeightMap(x, x, noise - BALL.gap(x[:, None], x[None, :]))


def round_bump(half_angle_degrees: float) -> Job:
    """A cone pressed to a contact radius of about 1 m; its slope is all over."""
    slope = 1 / np.tan(np.radians(half_angle_degrees))
    force = np.pi * slope / (2 * J)  # Sneddon: F = pi a^2 cot(alpha)/(2 J)
    cone = vc.Cone(np.radians(half_angle_degrees))
    return Job(cone, vc.step(force), vc.Grid((40, 40), (2.6, 2.6)))


def rolled(half_width: float, half_length: float) -> Job:
    """A roller of radius 1 m with sharp ends."""
    force = np.pi * half_width**2 * 2 * half_length / (4 * J)
    grid = vc.Grid((24, 48), (2.2 * half_length, 3 * half_width))
    return Job(vc.Roller(1.0, half_length), vc.step(force), grid)


def pressed_punch(depth: float) -> Job:
    """A flat punch of radius 1 m."""
    return Job(vc.FlatPunch(1.0), vc.step(approach=depth), vc.Grid((40, 40), (2.6, 2.6)))


END, SLOPE, WIDE = "end of the indenter's profile", "indenter's slope", "half width is"
crowned = vc.Roller(1.0, 0.05, crown_radius=2.0)
# Grid points are map points: nothing is higher between them.
on_map: dict[str, Any] = {
    "load": vc.step(hertz_force(0.1) / 5),
    "grid": vc.Grid((101, 101), (0.202, 0.202)),
}
