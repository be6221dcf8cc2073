"""Fits of scattered records at which a search may miss the solution, or leave the exact one."""

from __future__ import annotations

import warnings

import numpy as np

from campaigns import fewest_held
from closeness import close_to
from viscontact import AccuracyWarning, reference
from viscontact.bodies.materials.material import Material
from viscontact.identification import IndentationFit, IndentationRecord, fit_indentation
from viscontact.indenters import FlatPunch, Sphere
from viscontact.laws import Zener

PROFILES = {
    FlatPunch(1e-3): reference.PunchProfile(1e-3),
    Sphere(1e-3): reference.SphereProfile(1e-3),
}


def fitted(indenter, law, t, d, share: float, seed: int) -> IndentationFit:
    """Fit of a Zener body to the force on one, with noise of a share of the largest force."""
    compliance = Material(law, 0.5).contact_compliance()
    contact = reference.press_axisymmetric(
        PROFILES[indenter], t, approach=d, creep_compliance=compliance
    )
    noise = np.random.default_rng(seed).standard_normal(t.size)
    force = contact.force + share * contact.force.max() * noise
    record = IndentationRecord(indenter, t, d, force)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        return fit_indentation(record, "zener", poisson_ratio=0.5)


def test_relaxations_of_few_rows_have_their_viscosity_in_the_interval() -> None:
    """A step past the solution, to where all has relaxed in the first row, ends at 1e-12 Pa s."""
    t, law = np.linspace(0.0, 10.0, 12), Zener(1e5, 1e5, 1e5)
    fits = [fitted(FlatPunch(1e-3), law, t, np.full(12, 1e-6), 0.02, seed) for seed in range(60)]
    ends = np.array([fit.intervals["viscosity"] for fit in fits])
    assert (np.isfinite(ends) & (ends > 0)).all()
    assert np.sum((ends[:, 0] < 1e5) & (ends[:, 1] > 1e5)) >= fewest_held(60)
    found = np.array([fit.parameters["viscosity"] for fit in fits])
    assert (np.abs(np.log10(found / 1e5)) < 1).all()


def test_a_record_is_fitted_though_the_coarser_search_leaves_the_exact_solution() -> None:
    """Under the law that fits best by the force on the tip alone, the contact becomes a ring."""
    t, law = np.linspace(0.0, 100.0, 30), Zener(1e5, 1e3, 1e2)
    approach = 1e-6 * np.minimum(5 * t / t[-1], 1)
    fit = fitted(Sphere(1e-3), law, t, approach, 0.1, 143)
    # Of instant and delayed modulus the record tells what they are in series.
    g, d = fit.parameters["shear_modulus"], fit.parameters["delayed_modulus"]
    assert 1 / (1 / g + 1 / d) == close_to(1 / (1 / 1e5 + 1 / 1e3), rel=0.05)
    assert fit.residual < 0.11
