"""Each guard against a number that is silently wrong has a run that meets it and one that does not.

Where a closed form says how large a contact is, both lie close to the guard's bound: contact radius
a of a paraboloid after Hertz, a^3 = 3 F R J/4 with approach a^2/R (Johnson 1985, Contact Mechanics,
eqs. 4.22-4.24), half width b of a cylinder, b^2 = 4 (F/length) R J/pi (eq. 4.43).
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from viscontact.cli import main
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

GUARDS = {
    "contact at the edge of the grid": Guard(
        vc.DomainError,
        "the contact reaches the edge of the grid at t = 0 s; enlarge grid.size",
        met=Job(grid=vc.Grid((40, 40), (0.2, 0.2))),
        missed=Job(grid=vc.Grid((40, 40), (0.22, 0.22))),
    ),
    "far fewer cells than can be read": Guard(
        vc.DomainError,
        "3 cells lie across the run's largest contact and 4 are the least",
        met=Job(grid=vc.Grid((15, 15), (1.0, 1.0))),
        missed=Job(),
    ),
    "fewer cells than are wanted": Guard(
        vc.AccuracyWarning,
        "only 9 cells lie across the largest contact",
        met=Job(grid=vc.Grid((13, 13), (0.28, 0.28))),
        missed=Job(grid=vc.Grid((16, 16), (0.28, 0.28))),
    ),
    "enough cells one way, too few the other": Guard(
        vc.DomainError,
        "2 cells lie across",
        met=Job(grid=vc.Grid((4, 100), (0.6, 0.6))),
        missed=Job(grid=vc.Grid((40, 100), (0.6, 0.6))),
    ),
    "cells enough over all, and spots of one": Guard(
        vc.AccuracyWarning,
        "spots or strips",
        met=Job(mapped(0.1, 0.002, roughness=2e-4), **on_map),
        missed=Job(mapped(0.1, 0.002), **on_map),
    ),
    "a map finer than the grid": Guard(
        vc.AccuracyWarning,
        "the height map rises",
        met=Job(mapped(0.25, 0.005, roughness=1e-4), grid=vc.Grid((32, 32), (0.28, 0.28))),
        missed=Job(mapped(0.25, 0.005), grid=vc.Grid((32, 32), (0.28, 0.28))),
    ),
    "a turned map finer than the grid": Guard(
        vc.AccuracyWarning,
        "the height map rises",
        met=Job(
            mapped(0.25, 0.005, roughness=1e-4).rotated(0.3), grid=vc.Grid((32, 32), (0.28, 0.28))
        ),
        missed=Job(mapped(0.25, 0.005).rotated(0.3), grid=vc.Grid((32, 32), (0.28, 0.28))),
    ),
    "waves finer than the grid": Guard(
        vc.AccuracyWarning,
        "which are 9.8 of the grid's cells; 10 or more are wanted",
        met=Job(BALL + vc.Waviness(1e-6, wavelength_x=9.8 * 0.28 / 60)),
        missed=Job(BALL + vc.Waviness(1e-6, wavelength_x=10.2 * 0.28 / 60)),
    ),
    "waves that vary along one axis, on few cells along it or along the other": Guard(
        vc.AccuracyWarning,
        "over 100 mm along y, which are 4 of the grid's cells",
        met=Job(WAVES.rotated(math.pi / 2), MEAN_PRESSED, LINE_OF_CELLS),
        missed=Job(WAVES, MEAN_PRESSED, LINE_OF_CELLS),
    ),
    "dimples finer than the grid": Guard(
        vc.AccuracyWarning,
        "the body repeats itself over",
        met=Job((BALL + vc.Dimples(1e-6, 4.9 * 0.28 / 60, 0.1)).rotated(0.5)),
        missed=Job((BALL + vc.Dimples(1e-6, 5.1 * 0.28 / 60, 0.1)).rotated(0.5)),
    ),
    "a map that leaps from point to point": Guard(
        vc.AccuracyWarning,
        "the height map rises",
        # A third of a per cent of the approach, and the peak pressure is half as much again.
        met=Job(mapped(0.1, 0.002, roughness=1e-5), **on_map),
        missed=Job(mapped(0.1, 0.002), **on_map),
    ),
    "a body that would touch beyond the grid": Guard(
        vc.AccuracyWarning,
        "would touch outside the grid",
        met=Job(TwoHills(), grid=vc.Grid((40, 40), (0.3, 0.3))),
        missed=Job(TwoHills(), grid=vc.Grid((134, 40), (2.0, 0.6))),
    ),
    "a step long against the law": Guard(
        vc.AccuracyWarning,
        "a time step of 5 s is long against the law",
        met=Job(material=SOFT, times=[0.0, 5.0], grid=vc.Grid((40, 40), (0.8, 0.8))),
        missed=Job(
            material=SOFT,
            times=[0.0, *np.geomspace(0.02, 20, 80)],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
    ),
    "a load put on in one step": Guard(
        vc.AccuracyWarning,
        "grows from nothing to 100% of its largest in a single step of 1 s",
        met=Job(
            material=SOFT,
            load=vc.ramp(hertz_force(0.1), 1.0),
            times=[0.0, 1.0],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
        missed=Job(
            material=SOFT,
            load=vc.ramp(hertz_force(0.1), 1.0),
            times=np.linspace(0, 1, 41),
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
    ),
    "a load taken off in one step": Guard(
        vc.AccuracyWarning,
        "the contact is lost as the load falls by 100% of its largest in a single step of 1 s",
        met=Job(
            material=SOFT,
            load=vc.ForceHistory([0, 20, 21], [hertz_force(0.1)] * 2 + [0]),
            times=[0.0, *np.geomspace(0.02, 20, 80), 21.0],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
        missed=Job(
            material=SOFT,
            load=vc.ForceHistory([0, 20, 21], [hertz_force(0.1)] * 2 + [0]),
            times=[0.0, *np.geomspace(0.02, 20, 80), *np.linspace(20, 21, 41)[1:]],
            grid=vc.Grid((40, 40), (0.8, 0.8)),
        ),
    ),
    "an approach that is taken back in one step": Guard(
        vc.AccuracyWarning,
        # Not all of it: the body has crept away, and the contact is lost before.
        "the contact is lost as the load falls by 70% of its largest in a single step of 200 ms",
        met=Job(
            material=FLUID,
            load=vc.ApproachHistory([0, 6, 6.2], [1e-2, 1e-2, 3e-3]),
            times=[0.0, *np.geomspace(0.02, 6, 160), 6.2],
        ),
        missed=Job(
            material=FLUID,
            load=vc.ApproachHistory([0, 6, 6.2], [1e-2, 1e-2, 3e-3]),
            times=[0.0, *np.geomspace(0.02, 6, 160), *np.linspace(6, 6.2, 41)[1:]],
        ),
    ),
    "a load that cycles between the instants asked for": Guard(
        vc.AccuracyWarning,
        "between the requested times the peak pressure reaches",
        met=Job(load=vc.harmonic(1e3, 8e2, 1.0, 2), grid=FEWER, times=[0.0, 1.0, 2.0]),
        missed=Job(load=vc.harmonic(1e3, 8e2, 1.0, 2), grid=FEWER, times=np.linspace(0, 2, 17)),
    ),
    "a run beyond the last row of a table": Guard(
        vc.AccuracyWarning,
        "beyond 100 s, where the material's data end",
        met=Job(material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 101, 30)),
        missed=Job(material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 100, 30)),
    ),
    "a run beyond the data of one of two materials": Guard(
        vc.AccuracyWarning,
        "beyond 100 s, where the indenter material's data end",
        met=Job(indenter_material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 101, 30)),
        missed=Job(
            indenter_material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 100, 30)
        ),
    ),
    "a load sooner than the first row of a table": Guard(
        vc.AccuracyWarning,
        "at t = 0 s 100% of the load has come within less than 1 s",
        met=Job(material=TABLE, load=vc.step(100.0), times=np.linspace(0, 20, 30)),
        missed=Job(material=TABLE, load=vc.ramp(100.0, 20.0), times=np.linspace(0, 20, 30)),
    ),
    "a later jump sooner than the first row": Guard(
        vc.AccuracyWarning,
        "at t = 15 s 50% of the load has come within less than 1 s",
        met=Job(
            material=TABLE,
            load=vc.ForceHistory([0, 10, 15, 15], [0, 50, 50, 100]),
            times=np.linspace(0, 20, 41),
        ),
        missed=Job(
            material=TABLE,
            load=vc.ForceHistory([0, 10, 15, 15], [0, 90, 90, 100]),
            times=np.linspace(0, 20, 41),
        ),
    ),
    "a table that would gain energy": Guard(
        vc.AccuracyWarning,
        "a loss modulus of -13% of its modulus, and no material gains energy",
        met=Job(
            material=vc.Material(vc.TabulatedCreep([1, 10, 100], [1e-6, 3e-6, 1e-5]), 0.5),
            load=vc.ramp(100.0, 20.0),
            times=np.linspace(0, 100, 30),
        ),
        missed=Job(
            material=vc.Material(
                vc.TabulatedCreep([0, 1, 10, 100], [1e-6, 1.1e-6, 1.2e-6, 1.3e-6]), 0.5
            ),
            load=vc.ramp(100.0, 20.0),
            times=np.linspace(0, 100, 30),
        ),
    ),
    "a law that is no number": Guard(
        ValueError,
        "material: its law gives a contact compliance of nan /Pa",
        met=Job(material=vc.Material(NotAlwaysANumber(1e-6, 0.3, 1.0, 1e-7), 0.5), times=[0, 1]),
        missed=Job(
            material=vc.Material(NotAlwaysANumber(1e-6, 0.3, 1.0, 1e-7), 0.5),
            load=vc.step(100.0),
            times=np.linspace(0, 0.3, 31),
        ),
        besides=("time step",),
    ),
    "a law that takes creep back": Guard(
        ValueError,
        "never decrease",
        met=Job(material=vc.Material(Shrinking(1e-6, 0.3, 1.0, 1e-7), 0.5), times=[0, 1]),
        missed=Job(
            material=vc.Material(Shrinking(1e-6, 0.3, 1.0, 1e-7), 0.5),
            load=vc.step(100.0),
            times=np.linspace(0, 0.3, 31),
        ),
        besides=("time step",),
    ),
    "slopes": Guard(
        vc.AccuracyWarning,
        "slope within the contact reaches 0.32",
        met=round_bump(90 - np.degrees(np.arctan(0.32))),
        missed=round_bump(90 - np.degrees(np.arctan(0.28))),
        besides=("at a tip",),
    ),
    "a wide contact": Guard(
        vc.AccuracyWarning,
        "half width is 0.31 of the indenter's radius",
        met=Job(load=vc.step(hertz_force(0.31)), grid=vc.Grid((60, 60), (0.8, 0.8))),
        missed=Job(load=vc.step(hertz_force(0.29)), grid=vc.Grid((60, 60), (0.8, 0.8))),
    ),
    "a wide contact of a long roller": Guard(
        vc.AccuracyWarning,
        "half width is 0.3",
        met=rolled(half_width=0.33, half_length=10.0),
        missed=rolled(half_width=0.25, half_length=10.0),
        # By the logarithm of its length a line's approach is far more than local.
        besides=(END, "the approach"),
    ),
    "a wide contact of a roller shorter than that": Guard(
        vc.AccuracyWarning,
        "half width is 0.3",
        met=Job(vc.Roller(1.0, 0.1), vc.step(1.4e5), vc.Grid((24, 40), (0.24, 0.9))),
        missed=Job(vc.Roller(1.0, 0.1), vc.step(5e4), vc.Grid((24, 40), (0.24, 0.9))),
        besides=(END,),
    ),
    "a deep approach": Guard(
        vc.AccuracyWarning,
        "the approach is 0.1 of the indenter's radius",  # 0.104
        met=Job(load=vc.step(approach=0.104), grid=vc.Grid((60, 60), (0.9, 0.9))),
        missed=Job(load=vc.step(approach=0.098), grid=vc.Grid((60, 60), (0.9, 0.9))),
        besides=(SLOPE, WIDE),
    ),
    "a flat punch pressed deep": Guard(
        vc.AccuracyWarning,
        "the approach is 0.6 of the contact's half width",
        met=pressed_punch(0.6),
        missed=pressed_punch(0.4),
        besides=(END,),
    ),
    "contact at a profile's end": Guard(
        vc.AccuracyWarning,
        END,
        met=Job(vc.Roller(1.0, 0.05), vc.step(2e3), vc.Grid((32, 32), (0.2, 0.2))),
        missed=Job(crowned, vc.step(2e3), vc.Grid((40, 40), (0.4, 0.2))),
    ),
    "contact at a map's edge": Guard(
        vc.AccuracyWarning,
        END,
        met=Job(mapped(0.09, 0.001), grid=vc.Grid((60, 60), (0.28, 0.28))),
        missed=Job(mapped(0.12, 0.001), grid=vc.Grid((60, 60), (0.28, 0.28))),
    ),
    "an end face beside the contact": Guard(
        vc.AccuracyWarning,
        "the indenter ends within a half width of the contact",
        # Both give alike, so that half of each makes the contact of J.
        met=Job(
            mapped(0.18, 0.001),
            grid=vc.Grid((70, 70), (0.5, 0.5)),
            material=vc.Material(vc.Elastic(2e6), 0.5),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5),
        ),
        missed=Job(
            mapped(0.22, 0.001),
            grid=vc.Grid((70, 70), (0.5, 0.5)),
            material=vc.Material(vc.Elastic(2e6), 0.5),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5),
        ),
    ),
    "an end face of a rigid body": Guard(
        vc.AccuracyWarning,
        END,  # and nothing else: a rigid body has no half-space that goes on
        met=Job(mapped(0.09, 0.001), grid=vc.Grid((70, 70), (0.5, 0.5))),
        missed=Job(mapped(0.18, 0.001), grid=vc.Grid((70, 70), (0.5, 0.5))),
    ),
    "a thin half-space": Guard(
        vc.AccuracyWarning,
        "half width is 0.2 of the body's thickness of 490 mm",
        met=Job(material=vc.Material(vc.Elastic(1e6), 0.5, thickness=0.49)),
        missed=Job(material=vc.Material(vc.Elastic(1e6), 0.5, thickness=0.51)),
    ),
    "a thin indenter": Guard(
        vc.AccuracyWarning,
        "half width is 0.21 of the body's thickness of 480 mm",
        met=Job(
            material=vc.Material(vc.Elastic(2e6), 0.5, thickness=1.0),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5, thickness=0.48),
        ),
        missed=Job(
            material=vc.Material(vc.Elastic(2e6), 0.5, thickness=1.0),
            indenter_material=vc.Material(vc.Elastic(2e6), 0.5, thickness=0.51),
        ),
    ),
}
#: Those whose words another guard has too, met in another way.
LIKE_ANOTHER = {
    "a turned map finer than the grid",
    "an approach that is taken back in one step",
    "a run beyond the data of one of two materials",
    "a later jump sooner than the first row",
}
each_guard = pytest.mark.parametrize(
    "guard",
    [
        pytest.param(each, id=name, marks=[pytest.mark.slow] if name in LIKE_ANOTHER else [])
        for name, each in GUARDS.items()
    ],
)


@each_guard
def test_guard_is_met(guard: Guard) -> None:
    if not issubclass(guard.outcome, Warning):
        with pytest.raises(guard.outcome) as refusal:
            guard.met.run()
        assert guard.words in str(refusal.value)
        return
    said = guard.met.run()
    assert sum(guard.words in text for text in said) == 1, said


@each_guard
def test_guard_is_missed(guard: Guard) -> None:
    said = guard.missed.run()
    assert [text for text in said if not any(words in text for words in guard.besides)] == []
    assert not any(guard.words in text for text in said)


@pytest.mark.parametrize("shift", [(0.05, 0.0), (-0.05, 0.0), (0.0, 0.05), (0.0, -0.05)])
def test_rim_is_guarded_on_every_side(shift: tuple[float, float]) -> None:
    # Free tilts would bring the contact under the force.
    load, grid = vc.step(hertz_force(0.1), tilt_x=0.0, tilt_y=0.0), vc.Grid((50, 50), (0.25, 0.25))
    assert Job(Shifted(0.0, 0.0), load, grid).run() == []
    with pytest.raises(vc.DomainError, match="edge of the grid"):
        Job(Shifted(*shift), load, grid).run()


def test_rim_met_within_a_run_keeps_the_steps_before() -> None:
    load = vc.ForceHistory([0.0, 1.0, 1.0], [0.0, hertz_force(0.1), hertz_force(0.15)])
    grid = vc.Grid((60, 60), (0.28, 0.28))
    with pytest.raises(vc.DomainError, match="at t = 1 s") as stopped:
        vc.simulate(BALL, RUBBER, load, grid, [0.5, 0.75, 1.0])
    assert stopped.value.partial is not None
    assert stopped.value.partial.time.values.tolist() == [0.5, 0.75]


def test_mesh_is_judged_at_the_largest_contact_though_it_is_lost_at_the_end() -> None:
    load = vc.ForceHistory([0.0, 1.0, 1.0], [hertz_force(0.1), hertz_force(0.1), 0.0])
    grid = vc.Grid((13, 13), (0.28, 0.28))
    (said,) = Job(load=load, grid=grid, times=[0.0, 1.0]).run()
    assert "only 9 cells lie across the largest contact" in said
    with pytest.raises(vc.DomainError, match="3 cells lie across"):
        Job(load=load, grid=vc.Grid((15, 15), (1.0, 1.0)), times=[0.0, 1.0]).run()


def test_small_contacts_on_the_way_are_no_matter() -> None:
    load = vc.ForceHistory([0.0, 1.0, 2.0], [0.0, hertz_force(0.1), 0.0])
    assert Job(load=load, times=np.linspace(0, 2, 41)).run() == []


CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 10 MPa, delayed_modulus: 10 MPa, viscosity: 10 MPa s,
  poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 30}
grid: {shape: [32, 32], size: [3 mm, 3 mm]}
output: {fields: none, errors: false}
"""
ROLLER = "indenter={shape: roller, radius: 10 mm, half_length: 2 mm}"
SLOW, WIDE_GRID = "load={kind: ramp, force: 4 N, duration: 2 s}", "grid.size=[4 mm, 4 mm]"
TABLED = (
    "material={law: table, file: creep.csv, quantity: creep_compliance, data: deviatoric, "
    "poisson_ratio: 0.5}"
)
OFF, OFF_AT_ONCE = (
    f"load={{kind: history, points: [[0 s, 4 N], [3 s, 4 N], [{end} s, 0 N]]}}" for end in (4, 3)
)
# Contact radius after 5 s, with J = (1 - nu)/G: a = (3 * 4 N * 10 mm/(40 MPa))^(1/3) = 1.14 mm.
EXPECTED = {
    "rim": (
        ["grid.size=[2.1 mm, 2.1 mm]"],
        "will probably overrun the grid",
        "the contact reaches the edge of the grid",
    ),
    "cells": (["grid.shape=[10, 10]"], "fewer than 10 cells across", "only 8 cells lie across"),
    "thickness of the half-space": (["material.thickness=5 mm"], "of the body's thickness"),
    "thickness of the indenter": (
        [
            "indenter_material={law: elastic, shear_modulus: 10 GPa, poisson_ratio: 0.3, "
            "thickness: 5 mm}"
        ],
        "of the body's thickness",
    ),
    "slope": (["indenter={shape: cone, half_angle: 65 deg}", WIDE_GRID], "the indenter's slope"),
    "end": ([ROLLER, "grid.size=[5 mm, 3 mm]"], END),
    "end face": (
        [
            ROLLER,
            "grid.size=[5 mm, 3 mm]",
            "indenter_material={law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}",
        ],
        "the indenter ends within a half width",
    ),
    "width": (["load.force=172 N", "grid.size=[12 mm, 12 mm]"], "half width"),
    "approach": (["load.force=172 N", "grid.size=[12 mm, 12 mm]"], "the approach"),
    "data": (["material.measured_until=4 s"], "the material's data end"),
    "early": ([TABLED], "where the material's data begin"),
    "touch": ([SLOW, "time.steps=2"], "grows from nothing to 100% of its largest"),
    "release": ([OFF, "time.steps=5"], "the load falls by 100% of its largest in a single"),
}
#: Warned of where another of the same kind is: of either body, of the same contact.
SIBLINGS = {"thickness of the indenter", "approach"}


@pytest.fixture
def case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A case without any warning, and a table beside it."""
    monkeypatch.chdir(tmp_path)
    times = np.geomspace(1, 100, 21)
    rows = "".join(f"{t!r}; {0.05 * t**0.05!r}\n" for t in times.tolist())
    text = "time [s]; creep_compliance [1/MPa]\n" + rows
    (tmp_path / "creep.csv").write_text(text, encoding="utf-8")
    (tmp_path / "case.yaml").write_text(CASE, encoding="utf-8")
    return tmp_path / "case.yaml"


def checked(capsys: pytest.CaptureFixture[str], *settings: str) -> str:
    assert main(["check", "case.yaml", *(f"--set={each}" for each in settings)]) == 0
    return " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(
    "settings",
    [
        ["output.errors=true"],
        pytest.param(["material.thickness=6 mm"], marks=pytest.mark.slow),  # 1.14 mm is 0.19 of it
        pytest.param([SLOW], marks=pytest.mark.slow),
        [TABLED, "load={kind: ramp, force: 4 N, duration: 5 s}", "grid.size=[2 mm, 2 mm]"],
        pytest.param(["material.measured_until=5 s"], marks=pytest.mark.slow),
        # A crown ends the contact before the roller ends.
        [
            "indenter={shape: roller, radius: 10 mm, half_length: 1 mm, crown_radius: 20 mm}",
            "grid.size=[6 mm, 3 mm]",
        ],
    ],
)
@pytest.mark.usefixtures("case")
def test_check_and_run_warn_of_nothing_in_a_sound_case(
    settings: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert "case.yaml: no problems found" in checked(capsys, *settings)
    assert warned(capsys, settings) == ""


def warned(capsys: pytest.CaptureFixture[str], settings: list[str]) -> str:
    """Everything that a run of the case says against itself."""
    chosen = [f"--set={each}" for each in settings]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", vc.AccuracyWarning)
        code = main(["run", "case.yaml", "-q", "-o", "out", *chosen])
    return capsys.readouterr().err if code else vc.open_results("out").attrs["warnings"]


@pytest.mark.parametrize(
    "expected",
    [
        pytest.param(each, id=name, marks=[pytest.mark.slow] if name in SIBLINGS else [])
        for name, each in EXPECTED.items()
    ],
)
@pytest.mark.usefixtures("case")
def test_check_predicts_the_warnings_of_the_run(
    expected: tuple[Any, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    settings, words, *others = expected
    printed = checked(capsys, *settings)
    assert "can be read, but:" in printed
    assert words in printed
    assert (others[0] if others else words) in warned(capsys, settings)


@pytest.mark.usefixtures("case")
@pytest.mark.parametrize("settings", [[OFF], [OFF_AT_ONCE, "time.steps=5"]], ids=["steps", "jump"])
def test_load_taken_off_as_it_should_be_is_no_release_in_one_step(
    settings: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert "the contact is lost as" not in checked(capsys, *settings)
    assert "the contact is lost as" not in warned(capsys, settings)
