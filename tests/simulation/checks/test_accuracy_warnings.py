"""Accuracy warnings: issued where they apply, with their number, once, and nowhere else."""

import warnings

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.laws import TabulatedCreep, TabulatedRelaxation, Zener
from viscontact.simulation.checks.collector import WarningCollector
from viscontact.simulation.checks.contact_geometry import Geometry
from viscontact.simulation.checks.material import passivity_warnings
from viscontact.simulation.checks.mesh import WARNING_CELLS, cells_across_spots, mesh_warnings
from viscontact.simulation.checks.steps import relative_change

rubber = vc.Material(vc.Elastic(1e6), 0.5)  # J = 1/(4 MPa)


def warnings_of(indenter, load, grid, times=(0.0,), material=rubber):
    """All warnings, as the states carry them, after a check that Python was warned alike."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        states = list(vc.march(indenter, material, load, grid, times))
    restart_data = [text for state in states for text in state.warnings]
    said = [str(each.message) for each in caught if each.category is vc.AccuracyWarning]
    assert said == restart_data
    return restart_data


def hertz_force(part, radius=1.0):
    """Force that presses a sphere to a contact radius of a part of its own: a³ = 3 R W J/4."""
    return 4 * (part * radius) ** 3 / (3 * radius * 0.25e-6)


def test_a_gentle_contact_on_a_good_mesh_causes_no_warning():
    grid = vc.Grid((60, 60), (0.28, 0.28))
    assert warnings_of(vc.Paraboloid(1.0, 1.0), vc.step(hertz_force(0.1)), grid) == []


def test_a_wide_deep_and_steep_contact_causes_a_warning_for_each():
    texts = warnings_of(
        vc.Paraboloid(1.0, 1.0), vc.step(hertz_force(0.4)), vc.Grid((40, 40), (1.1, 1.1))
    )
    assert len(texts) == 3
    assert any("half width is 0.4 " in text for text in texts)
    assert any("approach is 0.16 " in text for text in texts)  # a²/R, Hertz
    assert any("slope" in text for text in texts)


def test_a_steep_cone_is_warned_about_its_slope_and_tip_only():
    texts = warnings_of(vc.Cone(np.radians(60)), vc.step(1.0), vc.Grid((40, 40), (0.0025, 0.0025)))
    assert len(texts) == 2
    assert any("the indenter's slope within the contact" in text for text in texts)
    assert any("at a tip" in text for text in texts)


def line_of(kinks, radius=0.0):
    """A roller with a sharp or rounded corner of 50 mrad at seven eighths of its half length."""
    chamfer = {"angle": 0.05, "length": 0.625e-3, "corner_radius": radius}
    profile = {"profile": "chamfer", **chamfer} if kinks else {"crown_radius": 0.05}
    return vc.Roller(5e-3, 5e-3 if kinks else 4e-3, cross_section="parabola", **profile)


CORNERS = {
    "cone, tip between cells": (vc.Cone(np.radians(88)), 40, True),
    "cone, tip in a cell": (vc.Cone(np.radians(88)), 41, True),
    "cone aside": (vc.Cone(np.radians(88)).shifted(1.3e-5, -0.7e-5), 40, True),
    "pyramid": (vc.Pyramid(np.radians(88), 4), 40, True),
    "ball": (vc.Sphere(5e-3), 12, False),
    "sharp chamfer": (line_of(True), 72, True),
    "rounded in a tenth of a cell": (line_of(True, 3e-4), 72, True),
    "rounded over three cells": (line_of(True, 1e-2), 72, False),
    "crown": (line_of(False), 72, False),
}


@pytest.mark.parametrize("name", CORNERS)
def test_a_peak_at_a_tip_or_a_corner_causes_a_warning_of_the_mesh(name):
    """The pressure there grows with the logarithm of the cell size: `test_roller_ends`."""
    body, cells, singular = CORNERS[name]
    roller = isinstance(body, vc.Roller)
    size = (11.25e-3, 1.3e-3) if roller else (1.2e-3, 1.2e-3)
    force = 0.4 if roller else 0.04
    texts = warnings_of(body, vc.step(force), vc.Grid((cells, 40), size))
    assert any("at a tip, an edge or a corner" in text for text in texts) == singular


def test_a_punch_causes_a_warning_for_the_end_of_its_profile():
    (text,) = warnings_of(vc.FlatPunch(1.0), vc.step(1e3), vc.Grid((40, 40), (2.4, 2.4)))
    assert "end of the indenter's profile" in text


def test_few_cells_across_cause_a_warning_and_too_few_refused():
    load = vc.step(hertz_force(0.1))
    (text,) = warnings_of(vc.Paraboloid(1.0, 1.0), load, vc.Grid((12, 12), (0.36, 0.36)))
    assert "cells lie across" in text
    with pytest.raises(vc.DomainError, match="cells lie across"):
        warnings_of(vc.Paraboloid(1.0, 1.0), load, vc.Grid((12, 12), (1.0, 1.0)))


soft = vc.Material(vc.Zener(1e6, 1e5, 1e5), 0.5)  # tau = 1 s, J(inf) = 11 J(0)
ball, wide = vc.Paraboloid(1.0, 1.0), vc.Grid((40, 40), (0.8, 0.8))


def step_warnings_of(times):
    found = warnings_of(ball, vc.step(hertz_force(0.1)), wide, times, soft)
    return [text for text in found if "time step" in text]


def test_a_step_too_long_for_the_law_causes_a_warning_while_something_happens():
    # Central pressure errs by 0.39 of itself with this one step.
    assert "time step of 5 s" in step_warnings_of([0.0, 5.0])[0]


def test_an_even_longer_step_causes_a_warning_too():
    assert step_warnings_of([0.0, 10.0])


@pytest.mark.slow
def test_steps_as_short_as_the_law_wants_cause_no_warning():
    assert not step_warnings_of(np.concatenate([vc.uniform_times(10.0, 500), [1000.0]]))


def test_each_kind_is_said_once():
    warnings = WarningCollector()
    assert warnings.new({"mesh": "coarse"}, {"slope": "steep"}) == ("coarse", "steep")
    assert warnings.new({"mesh": "coarser"}) == ()


def test_mesh_warnings_begin_below_their_bound():
    assert mesh_warnings(WARNING_CELLS) == {}
    assert "only 9 cells" in mesh_warnings(WARNING_CELLS - 1)["mesh"]


def test_spots_are_measured_by_their_chords():
    x = np.arange(120) - 59.5
    disc = x[:, None] ** 2 + x[None, :] ** 2 < 40**2
    # A disc's mean chord is pi/4 of its diameter; counted in cells, to a half of one at each end.
    assert cells_across_spots(disc) == close_to(np.pi / 4 * 80, rel=0.02)
    # A strip two cells wide, askew, that spans the whole grid both ways.
    strip = np.abs(x[:, None] - x[None, :]) < 1.5
    assert strip.any(axis=0).all()
    assert strip.any(axis=1).all()
    assert cells_across_spots(strip) == close_to(3, abs=0.1)
    # One long way and one short: the short one counts.
    assert cells_across_spots(np.abs(x[:, None]) < 2 + 0 * x) == 4
    assert cells_across_spots(np.zeros((4, 4), dtype=bool)) == 0


def test_askew_strip_causes_a_warning_though_its_extents_hold_many_cells():
    assert list(mesh_warnings(120, across_spots=3.0)) == ["spots"]


def test_relative_change_knows_zero():
    assert relative_change(0.0, 0.0) == 0.0
    assert relative_change(0.0, 2.0) == 1.0
    assert relative_change(4.0, 3.0) == 0.25


def test_a_law_that_is_remembered_or_converted_badly_causes_a_warning(monkeypatch):
    # Ten times the compliance within a factor 1.5 in time: no positive exponentials do that.
    times, jump = [1.0, 2.0, 3.0, 4.0], [1e-9, 1.001e-9, 9e-9, 9.01e-9]
    ball, load, grid = vc.Sphere(1e-3), vc.step(1e-3), vc.Grid((32, 32), (1.6e-5, 1.6e-5))
    creep = vc.Material(vc.TabulatedCreep(times, jump), 0.5)
    drop = vc.TabulatedRelaxation([1.0, 1.05, 1.1, 4.0], [5e8, 4.99e8, 5.5e6, 5.49e6])
    modulus = vc.Material(drop, 0.5)

    def kinds(material):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", vc.AccuracyWarning)
            vc.simulate(ball, material, load, grid, [0.0, 0.5, 1.0], fields="none")
        words = ("remembered are off by", "converted from the law's modulus")
        return [sum(word in str(w.message) for w in caught) for word in words]

    assert kinds(creep) == [0, 0]  # the sum over all steps takes it unchanged
    assert kinds(modulus) == [0, 1]
    monkeypatch.setattr("viscontact.mechanics.time_integration.plan.MAX_HISTORY_BYTES", 0)
    assert kinds(creep) == [1, 0]


@pytest.mark.parametrize(
    ("times", "compliance"), [([1, 10, 100], [1, 3, 10]), ([0.1, 10], [1e-9, 4e-8])]
)
def test_a_table_that_would_gain_energy_causes_a_warning(times, compliance):
    law = TabulatedCreep(times, compliance)
    assert law.complex_modulus(np.geomspace(0.1, 100, 50)).imag.min() < 0
    (text,) = passivity_warnings(law, 100.0).values()
    assert "no material gains energy; add rows" in text


@pytest.mark.parametrize("rows", [2, 5, 20])
def test_a_table_of_a_material_causes_no_warning(rows):
    zener, times = Zener(1e9, 1e8, 1e8), np.geomspace(1e-3, 1e3, 6 * rows + 1)
    for law in (
        TabulatedCreep([0.0, *times], [zener(0.0), *zener(times)]),
        TabulatedRelaxation([0.0, *times], [zener.relaxation(0.0), *zener.relaxation(times)]),
        zener,
    ):
        assert passivity_warnings(law, 100.0) == {}


def test_the_end_of_a_body_is_followed_across_the_border_along_the_period_only():
    for periodic, sides in (((False, False), 1), ((True, False), 1), ((False, True), 2)):
        grid = vc.Grid((4, 8), (4.0, 8.0), periodic=periodic)
        open_gap = np.zeros(grid.shape)
        open_gap[:, 0] = np.inf
        beside = Geometry(vc.FlatPunch(2.0), open_gap, grid).end_cells
        assert beside[:, 1].all()
        assert beside.sum() == 4 * sides
        assert beside[:, -1].all() == (sides == 2)
