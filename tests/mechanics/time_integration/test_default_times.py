"""Times of a run for which none are given."""

import numpy as np
import pytest

import viscontact as vc
from viscontact.bodies.loads.clock import ReducedTime
from viscontact.bodies.materials.compliance import ClockedCompliance, SeriesCompliance
from viscontact.mechanics.time_integration.default_times import (
    EVEN_STEPS,
    MAX_LOAD_STEPS,
    default_times,
)

RIGID = SeriesCompliance(1.0, [], [])
RELAXING = SeriesCompliance(1.0, [9.0], [10.0])  # relaxes to a tenth with a time of 1 s


def crept(times, kink, compliance=RELAXING):
    """Creep over the first step after a kink, over J(0)."""
    following = times[times > kink * (1 + 1e-12)][0]
    return compliance(following - kink) / compliance.instant - 1


@pytest.mark.parametrize("control", ["force", "approach"])
@pytest.mark.parametrize("duration", [1e-3, 0.5, 3.0])
def test_steps_after_each_kink_are_short_against_the_law(control, duration):
    times = default_times(vc.ramp(**{control: 1.0}, duration=duration), RELAXING)
    assert {0.0, duration} <= set(times.tolist())
    assert times[-1] == duration + 50.0
    assert crept(times, 0.0) < 0.2
    assert crept(times, duration) < 0.2
    assert len(times) < 4 * EVEN_STEPS
    assert np.diff(times).min() > 1e-5


def test_an_elastic_body_has_even_steps_and_the_kinks():
    times = default_times(vc.triangle(1.0, 0.3, 0.7), RIGID)
    np.testing.assert_allclose(times, np.union1d(np.linspace(0, 1, EVEN_STEPS + 1), [0.3]))


def test_a_load_that_is_held_from_time_zero_needs_no_times_on_an_elastic_body():
    assert default_times(vc.step(1.0), RIGID).tolist() == [0.0]


def test_steps_under_a_load_of_many_rows_are_its_rows():
    times = np.linspace(0.0, 20.0, MAX_LOAD_STEPS + 2)
    load = vc.ForceHistory(times, 1.0 + np.sin(times) ** 2)
    chosen = default_times(load, RELAXING)
    assert set(times.tolist()) <= set(chosen.tolist())
    assert len(chosen) <= len(times) + EVEN_STEPS


def test_steps_under_an_oscillating_load_are_chosen_after_it():
    """While it oscillates, every run divides its steps."""
    load = vc.harmonic(1.0, 0.5, period=2.0, cycles=3)
    times, even = default_times(load, RELAXING), default_times(load, RIGID)
    during = times[times < 6.0]
    np.testing.assert_allclose(np.diff(during), during[1] - during[0], rtol=1e-9)
    assert crept(times, 6.0) < 0.2
    assert len(even) < len(times)


def test_a_law_whose_creep_has_no_end_needs_times_under_a_held_load():
    law = vc.Material(vc.PowerLaw(2e-9, 0.5, 1.0), 0.5).contact_compliance()
    with pytest.raises(ValueError, match="say when the run ends"):
        default_times(vc.ramp(1.0, 0.5), law)
    assert default_times(vc.triangle(1.0, 0.5), law)[-1] == 1.0


def test_creep_that_age_stops_has_no_end_of_its_own():
    # The effective time never exceeds t_e/(µ - 1) = 2 s (Struik 1978, with µ = 1.5), and the creep
    # needs 50 s.
    ageing = ReducedTime(ageing=vc.Ageing(1.0, 1.5))
    with pytest.raises(
        ValueError, match=r"the creep slows down, with age .* say when the run ends"
    ):
        default_times(vc.step(1.0), ClockedCompliance(RELAXING, ageing))
