"""Stresses in bodies that end: free faces and surface, walls, plates, and balance."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from mechanics.halfspace.ended_bodies import ENDS, GRID
from returned import some
from viscontact.backend.arrays import Floats
from viscontact.bodies.grid import Grid
from viscontact.mechanics.halfspace.elastic_stack import ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.ended_load import EndedLoad
from viscontact.mechanics.halfspace.ended_response import EndedLayers, EndedResponse
from viscontact.mechanics.halfspace.ended_stress import (
    ended_stress_on_plane,
    ended_stress_on_section,
)
from viscontact.mechanics.halfspace.layered_stress import LayeredStress
from viscontact.mechanics.halfspace.stress import stress_on_plane, stress_on_section
from viscontact.mechanics.halfspace.stress_response import HalfSpaceStress

DEPTHS = np.array([0.0, 0.02, 0.1, 0.3, 1.0, 3.0])


def _pressure() -> Floats:
    """Smooth pressure that reaches both ends, unequal on both sides and along y."""
    x, y = GRID.x[:, None], GRID.y
    inside = np.abs(x) < 2.0
    profile = np.sqrt(np.maximum(1 - ((y - 0.1) / 0.5) ** 2, 0.0)) * (1 + 0.3 * y)
    return np.where(inside, (1 + 0.25 * x) * profile, 0.0)


def _load(name: str, ratio: float, pressure: Floats | None = None) -> EndedLoad:
    planes, free = ENDS[name]
    fields = _pressure() if pressure is None else pressure
    return EndedLoad(EndedResponse(ratio, planes, free), fields[None], GRID)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("name", ENDS)
def test_free_faces_bear_no_stress(name: str, ratio: float) -> None:
    load = _load(name, ratio)
    for face in some(load.faces):
        found = ended_stress_on_section(load, DEPTHS[1:], x=face.place)
        assert np.abs(found["zz"]).max() > 0.5
        for component in ("xx", "xy", "xz"):
            assert np.abs(found[component]).max() < 5e-5  # of a peak of 1.6


@pytest.mark.parametrize("name", ENDS)
def test_the_surface_bears_the_pressure_alone(name: str) -> None:
    load = _load(name, 0.3)
    found = ended_stress_on_section(load, DEPTHS[:1], y=float(GRID.y[18]))
    body = load.rows
    assert -found["zz"][0, 0, body] == close_to(_pressure()[body, 18], rel=0.0, abs=2e-5)
    for component in ("xz", "yz"):
        assert np.abs(found[component][0, 0, body]).max() < 1e-9
    beyond = np.ones(GRID.shape[0], dtype=bool)
    beyond[body] = False
    assert np.isnan(found.components[..., beyond]).all()


def test_a_body_turned_round_is_stressed_as_its_mirror_image() -> None:
    own = ended_stress_on_section(_load("one end", 0.3), DEPTHS, y=0.05)
    turned = _load("the other end", 0.3, _pressure()[::-1])
    other = ended_stress_on_section(turned, DEPTHS, y=0.05).components[..., ::-1]
    signs = np.array([1, 1, 1, 1, -1, -1])[:, None, None, None]
    body = slice(2, 42)
    assert (signs * other)[..., body] == close_to(own.components[..., body], rel=0.0, abs=1e-12)


def test_two_far_ends_act_one_by_one() -> None:
    pressure = np.where(np.abs(GRID.x + 1.5)[:, None] < 0.4, _pressure(), 0.0)
    y, one = 0.05, ENDS["one end"][0][0]
    near = ended_stress_on_section(_load("one end", 0.3, pressure), DEPTHS, y=y)
    apart = []
    for length in (8.0, 16.0):
        both = EndedResponse(0.3, (one, -2.0 + length), (True, True))
        far = ended_stress_on_section(EndedLoad(both, pressure[None], GRID), DEPTHS, y=y)
        change = far.components - near.components
        apart.append(np.abs(change[..., 2:20]).max())
    # The stress of a load falls as the square of the distance.
    assert apart[0] / apart[1] == close_to(4.0, rel=0.3)
    assert apart[1] < 2e-3


def test_sections_and_planes_agree_where_they_cross() -> None:
    load = _load("two free ends", 0.4)
    x, y, depth = 5, 12, 0.2
    along = ended_stress_on_section(load, np.array([depth]), y=float(GRID.y[y]))
    across = ended_stress_on_section(load, np.array([depth]), x=float(GRID.x[x]))
    level = ended_stress_on_plane(load, depth)
    here = level.components[:, 0, x, y]
    assert along.components[:, 0, 0, x] == close_to(here, rel=0.0, abs=1e-9)
    assert across.components[:, 0, 0, y] == close_to(here, rel=0.0, abs=1e-9)
    assert np.isnan(level.components[:, 0, :2]).all()


def test_the_stress_of_several_pressures_is_found_at_once() -> None:
    load = _load("two free ends", 0.3)
    both = EndedLoad(load.response, np.stack([_pressure(), 2 * _pressure()]), GRID)
    found = ended_stress_on_section(both, DEPTHS[:3], y=0.0)
    alone = ended_stress_on_section(load, DEPTHS[:3], y=0.0)
    one, other = (each.components[..., 2:42] for each in (alone, found))
    assert other[:, 1] == close_to(2 * one[:, 0], rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("ratio", [0.0, 0.45])
def test_a_short_body_between_free_ends_is_in_plane_stress(ratio: float) -> None:
    # Uniform pressure over its whole length, and a half of it over y: a plate under its edge, whose
    # stresses in its plane do not depend on Poisson's ratio (Johnson 1985, section 2.5a).
    half, depth, length = 1.0, 1.0, 0.1
    grid = Grid((4, 64), (length, 3.2))
    fields = np.where(np.abs(grid.y) < half, 1.0, 0.0) * np.ones((4, 1))
    body = EndedResponse(ratio, (-length / 2, length / 2), (True, True))
    load = EndedLoad(body, fields[None], grid)
    found = ended_stress_on_section(load, np.array([depth]), x=length / 8)
    y = grid.y
    one, other = (np.arctan2(depth, y + side * half) for side in (1, -1))
    turn, rest = other - one, np.sin(2 * other) - np.sin(2 * one)
    assert -found["zz"][0, 0] == close_to((turn - rest / 2) / np.pi, rel=0.0, abs=2e-3)
    assert -found["yy"][0, 0] == close_to((turn + rest / 2) / np.pi, rel=0.0, abs=2e-3)
    assert np.abs(found["xx"]).max() < 1e-3
    # Between walls it is in plane strain.
    walls = EndedLoad(EndedResponse(ratio, body.planes, (False, False)), fields[None], grid)
    held = ended_stress_on_section(walls, np.array([depth]), x=length / 8)
    assert held["xx"] == close_to(ratio * (held["yy"] + held["zz"]), rel=1e-3, abs=2e-6)


def test_all_of_the_load_passes_each_plane_between_two_ends() -> None:
    grid = Grid((48, 128), (2.4, 25.6))
    x, y = grid.x[:, None], grid.y
    fields = np.where((np.abs(x - 0.3) < 0.6) & (np.abs(y) < 0.5), 1.0, 0.0)
    load = EndedLoad(EndedResponse(0.3, (-1.2, 1.2), (True, True)), fields[None], grid)
    forces = fields.sum()
    for depth in (1.0, 2.0):
        found = ended_stress_on_plane(load, depth)
        # Beyond the grid the plate bears the part of a line load that is farther than y = 12.8.
        left_out = 4 / (3 * np.pi) * (depth / 12.8) ** 3
        assert -found["zz"][0].sum() == close_to(forces * (1 - left_out), rel=3e-4)


@pytest.mark.parametrize("layered", [False, True])
def test_between_walls_stresses_are_those_of_a_grid_with_images(*, layered: bool) -> None:
    stack = ElasticStack((ElasticLayer(0.8, 1.0, 0.4),), None)
    plain = EndedResponse(0.3, (-2.0, 2.0), (False, False))
    walls = EndedLayers(0.4, plain.planes, plain.free, stack) if layered else plain
    load = EndedLoad(walls, _pressure()[None], GRID)
    body = LayeredStress(stack) if layered else HalfSpaceStress(0.3)
    fields = np.concatenate([_pressure()[2:42], _pressure()[2:42][::-1]])
    doubled = Grid((80, 32), (8.0, 1.6), periodic=(True, False), centre=(2.0, 0.0))
    depths = np.array([0.1, 0.5])
    wanted = stress_on_section(fields, doubled, depths, body, y=0.05).components[..., :40]
    found = ended_stress_on_section(load, depths, y=0.05).components[:, 0, :, 2:42]
    assert found == close_to(wanted, rel=1e-9, abs=1e-12)
    level = stress_on_plane(fields, doubled, 0.5, body).components[:, :40]
    assert ended_stress_on_plane(load, 0.5).components[:, 0, 2:42] == close_to(
        level, rel=1e-9, abs=1e-12
    )


def test_what_has_no_stresses_is_refused() -> None:
    with pytest.raises(ValueError, match=r"no body at 2\.1 m, beyond its end"):
        ended_stress_on_section(_load("two free ends", 0.3), DEPTHS, x=2.1)
    with pytest.raises(ValueError, match="known to 100 m here, 50 half lengths, got 101 m"):
        ended_stress_on_section(_load("two free ends", 0.3), np.array([101.0]), y=0.0)
    stack = ElasticStack((ElasticLayer(0.8, 1.0, 0.4),), None)
    free = EndedLayers(0.4, (-2.0, 2.0), (True, False), stack)
    with pytest.raises(ValueError, match="layers end at a face free of stress"):
        ended_stress_on_section(EndedLoad(free, _pressure()[None], GRID), DEPTHS, y=0.0)


def test_progress_reaches_its_end() -> None:
    steps: list[tuple[int, int]] = []
    ended_stress_on_section(
        _load("one end", 0.3),
        DEPTHS,
        y=0.0,
        progress=lambda done, total: steps.append((done, total)),
    )
    assert steps[-1][0] == steps[-1][1]
    assert [done / total for done, total in steps] == sorted(done / total for done, total in steps)
