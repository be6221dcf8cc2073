"""Forecast of the steps of bodies that adhere, beside those that runs take."""

from unittest.mock import patch

import numpy as np
import pytest

import viscontact as vc
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.runs.adhesive_forecast import adhesive_steps
from viscontact.simulation.transient.setup import prepare_run
from viscontact.simulation.transient.stepper import Stepper

RADIUS, WORK, COMPLIANCE = 1e-3, 0.05, 1e-6
GEL = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
CREEPING = vc.Material(vc.Zener(7.5e5, 3.75e5, 3.75e5), poisson_ratio=0.5)  # from a third of it
RANGE = np.cbrt(RADIUS * (WORK * COMPLIANCE) ** 2)  # a Tabor number of 1
#: Units of force, radius and approach (Maugis 1992).
FORCE = np.pi * WORK * RADIUS
LENGTH = np.cbrt(0.75 * FORCE * RADIUS * COMPLIANCE)
DEPTH = LENGTH**2 / RADIUS
WITHDRAWN = vc.ApproachHistory([0.0, 1.0, 3.0], np.array([0.0, 3.0, -3.0]) * DEPTH)
PULLED = vc.ForceHistory([0.0, 1.0, 3.0], np.array([0.0, 3.0, -3.0]) * FORCE)


@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")
@pytest.mark.parametrize(
    ("law", "material", "load", "instants"),
    [
        ("exponential", GEL, WITHDRAWN, 10),
        ("exponential", GEL, WITHDRAWN, 100),
        ("exponential", CREEPING, WITHDRAWN, 10),
        ("exponential", GEL, PULLED, 30),
        ("dugdale", GEL, WITHDRAWN, 30),
    ],
)
def test_steps_of_a_sphere_are_foreseen_within_a_factor_of_one_and_a_half(
    law, material, load, instants
):
    """Pressed and withdrawn until they are apart, or pulled off by a force."""
    given = {
        "indenter": vc.Paraboloid(RADIUS, RADIUS),
        **{"material": material, "load": load, "times": vc.uniform_times(3.0, instants)},
        "grid": vc.Grid((64, 64), (9 * LENGTH, 9 * LENGTH)),
        "adhesion": vc.Adhesion(WORK, range=RANGE, law=law),
    }
    run = prepare_run(contact_problem(**given))
    expected, taken, accept = adhesive_steps(run, run.law), [], Stepper.accept

    def counted(self, step, trial):
        taken.append(step)
        return accept(self, step, trial)

    with patch.object(Stepper, "accept", counted):
        for _ in vc.march(**given):
            pass
    assert len(taken) / 1.5 < expected < len(taken) * 1.5
