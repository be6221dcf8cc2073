"""Parts of a run over time: larger grids, load cycles, moving bodies, progress, provenance."""

from __future__ import annotations

from datetime import datetime
from types import SimpleNamespace

import numpy as np
import pytest

from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Paraboloid
from viscontact.bodies.indenters.periodic_body import PeriodicBody
from viscontact.bodies.loads import LoadProgram, Travel
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.time_integration.fixed_steps import TimeStep
from viscontact.simulation.transient.grid_enlargement import GridEnlargement, overrun
from viscontact.simulation.transient.load_cycles import LoadCycleWork
from viscontact.simulation.transient.moving_body import cells_seen
from viscontact.simulation.transient.progress_bar import ProgressBar, reported
from viscontact.simulation.transient.provenance import date_and_time
from viscontact.simulation.transient.segments_so_far import ProgramCourse


def test_displacement_on_the_larger_grid_is_the_same_in_the_smaller_one() -> None:
    small = ContactDomain(Grid((4, 4), (1.0, 1.0)))
    large = ContactDomain(small.grid.widened((8, 8)))
    pressure = np.ones((4, 4))
    pair = np.stack([pressure, small.convolution.apply(pressure)])
    grown = GridEnlargement(small, large).pairs(pair)
    np.testing.assert_allclose(grown[1, 2:6, 2:6], pair[1], rtol=1e-14)


def test_loss_of_a_cycle_is_known_at_its_end() -> None:
    cycles = LoadCycleWork([((0.0, "left"), (2.0, "right"))])
    assert np.isnan(cycles.last_loss)
    cycles.record_work(TimeStep(2.0, 2.0, 2.0, smooth=False), work=3.0)
    assert cycles.last_loss == 3.0


def test_loss_of_a_cycle_that_ends_after_a_jump_has_the_work_of_the_jump() -> None:
    cycles = LoadCycleWork([((0.0, "right"), (2.0, "right"))])
    cycles.record_work(TimeStep(0.0, 0.0, 0.0, smooth=False), work=5.0)
    cycles.record_work(TimeStep(2.0, 2.0, None, smooth=False, before_jump=True), work=9.0)
    assert np.isnan(cycles.last_loss)
    cycles.record_work(TimeStep(2.0, 0.0, 2.0, smooth=False), work=6.0)
    assert cycles.last_loss == 1.0


@pytest.mark.parametrize("cell", [(0, 2), (3, 2), (2, 0), (2, 3)])
def test_contact_outgrows_its_grid_at_either_end_of_an_axis(cell: tuple[int, int]) -> None:
    pressure = np.zeros((4, 4))
    pressure[cell] = 1.0
    assert overrun(pressure) == (cell[0] in (0, 3), cell[1] in (0, 3))


def test_event_has_the_value_of_its_condition_and_not_that_of_the_step_found() -> None:
    program = LoadProgram(["move at 1 um/s until force reaches 6 N", "hold force for 2 s"])
    course = ProgramCourse(program, 100.0)
    found = SimpleNamespace(time=3.0, force=6.000004, approach=3e-6, stage_position=None)
    course.finish(found, course.segment.until)
    assert course.history().at(4.0).force == 6.0


def test_gap_of_a_periodic_body_repeats_itself() -> None:
    period = Grid((4, 4), (2.0, 2.0), periodic=True)
    found = PeriodicBody(Paraboloid(0.5, 0.5), period).gap([-0.5, 1.5], 0.0).tolist()
    assert found == [0.25, 0.25]


def test_cells_seen_reach_farther_by_the_travel() -> None:
    path = Travel([0.0, 1.0], y=[0.0, 0.5])
    found = cells_seen(Grid((4, 4), (1.0, 1.0)), path)[1].tolist()
    assert found == [-0.875, -0.625, -0.375, -0.125, 0.125, 0.375]


def test_progress_that_is_off_is_not_reported() -> None:
    assert reported(False, ProgressBar("step")) is None


def test_date_has_an_offset_from_utc() -> None:
    assert datetime.fromisoformat(date_and_time()).utcoffset() is not None
