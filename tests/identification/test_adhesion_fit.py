"""Work, range, modulus and contact point from force curves of adhering spheres."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from identification.adhesive_curves import RADIUS, curve_of, drawn
from viscontact.identification.adhesive_branch import adhesive_branch
from viscontact.identification.adhesive_problem import AdhesiveRows
from viscontact.reference import maugis_dugdale

TIP = vc.Sphere(RADIUS)


@pytest.mark.parametrize("tabor", [0.1, 0.5, 1.0, 3.0])
def test_branch_is_that_of_maugis_and_continues_into_attraction_without_contact(tabor):
    force, approach = adhesive_branch(tabor, 3.0)
    modulus, work = 2e6, 0.02
    length = np.cbrt(RADIUS * (work / modulus) ** 2) / tabor
    sphere = maugis_dugdale(RADIUS, 1 / modulus, work, length)
    unit, depth = np.pi * work * RADIUS, sphere._depth
    least = int(np.argmin(approach[:-300]))
    for contact_radius in (0.8, 1.0, 2.0):
        state = sphere.at_radius(contact_radius * sphere._length)
        at = state.approach / depth
        found = np.interp(at, approach[least::-1], force[least::-1])
        assert found == close_to(state.force / unit, rel=2e-4)
    # The contact shrinks to a point where a circle begins that pulls without contact; this one
    # vanishes where the gap is the range.
    point = sphere.at_radius(1e-4 * sphere._length)
    assert force[-300] == close_to(point.force / unit, rel=1e-3)
    assert approach[-300] == close_to(point.approach / depth, rel=1e-3)
    assert approach[-1] == close_to(-length / depth, rel=1e-12)
    assert force[-1] == 0


def fitted(seed, tabor, noise=0.01):
    curve, truth = drawn(seed, tabor, noise)
    return vc.fit_adhesion(curve, TIP, poisson_ratio=0.5), truth


@pytest.mark.parametrize("tabor", [np.inf, 0.7])
def test_fit_of_an_exact_curve_finds_what_it_was_made_of(tabor):
    fit, truth = fitted(0, tabor, noise=1e-5)
    # Noise of 1e-5 of the pull leaves the range open by 1 %, and the work by 0.3 %.
    assert fit.parameters["contact_modulus"] == close_to(truth["contact_modulus"], rel=1e-3)
    assert fit.parameters["work"] == close_to(truth["work"], rel=3e-3)
    assert fit.contact.position == close_to(1e-6, rel=1e-3)
    assert fit.contact.baseline["slope"] == close_to(1e-3, rel=0.02)
    assert fit.contact.baseline["offset"] == close_to(2e-9, rel=0.02)
    assert fit.material.law.shear_modulus == close_to(truth["contact_modulus"] / 4, rel=1e-3)
    if np.isinf(tabor):
        low, high = fit.intervals["tabor_number"]
        assert (high, fit.intervals["range"][0]) == (np.inf, 0.0)
        assert low > 2
        assert fit.adhesion.range is None
        row = fit.in_numbers("a")
        assert np.isnan([row.values["range"], row.values["tabor_number"]]).all()
        assert row.intervals["tabor_number"] == (low, high)
        said = repr(vc.identification.CurveFits((row,)))
        assert "range: not determined by any curve" in said
    else:
        assert fit.tells_range
        assert fit.parameters["range"] == close_to(truth["range"], rel=0.02)
        assert fit.adhesion.range == fit.parameters["range"]
        assert fit.parameters["tabor_number"] == close_to(tabor, rel=0.02)
        assert fit.in_numbers("a").values["range"] == fit.parameters["range"]


def counted(tabor, seeds):
    """Curves whose intervals hold the truth, of each value."""
    held = {}
    for seed in seeds:
        fit, truth = fitted(seed, tabor)
        ends = {**fit.intervals, "position": fit.contact.position_interval}
        for name, value in {**truth, "position": 1e-6}.items():
            low, high = ends[name]
            held[name] = held.get(name, 0) + bool(low <= value <= high)
    return held


@pytest.mark.slow
@pytest.mark.parametrize("tabor", [np.inf, 1.0, 0.4])
def test_intervals_hold_the_truth_under_noise(tabor):
    # Of 10 intervals of 95 %, fewer than 8 hold once in 90 times.
    held = counted(tabor, range(100, 110))
    assert min(held.values()) >= 8, held


def test_shallow_jump_of_a_soft_cantilever_ends_the_rows_without_force():
    """It pulls by less than a sixth of the pull-off, and the force then rises through zero."""
    sphere = vc.reference.jkr_sphere(RADIUS, 1 / 2e6, 0.02)
    curve = curve_of(sphere, 0.5, 0.01, np.random.default_rng(0), rows=400)
    rows, turn = AdhesiveRows.of(curve), curve.loading_rows
    touching = 1e-6  # position of the first touch, at which the tip jumps
    step = float(np.diff(curve.position).max())
    last = curve.position[:turn][rows.free[:turn]].max()
    assert touching - 4 * step < last < touching


def test_curve_without_a_pull_off_is_refused():
    z = np.concatenate([np.linspace(0, 2e-6, 200), np.linspace(2e-6, 0, 200)])
    bent = 1e-2 * np.maximum(z - 1e-6, 0.0) + 1e-10 * np.random.default_rng(0).standard_normal(400)
    curve = vc.ForceCurve(np.arange(400.0), z, bent, 0.1)
    with pytest.raises(ValueError, match="fit_adhesion: no pull-off is found"):
        vc.fit_adhesion(curve, TIP, poisson_ratio=0.5)
    approach = vc.ForceCurve(np.arange(200.0), z[:200], bent[:200], 0.1)
    with pytest.raises(ValueError, match="fit_adhesion: no pull-off is found"):
        vc.fit_adhesion(approach, TIP, poisson_ratio=0.5)


def test_cone_is_refused_and_named():
    curve, _ = drawn(0, np.inf)
    with pytest.raises(ValueError, match=r"fit_adhesion: the tip must be a Sphere.*fit_case"):
        vc.fit_adhesion(curve, vc.Cone(0.5), poisson_ratio=0.5)
    with pytest.raises(ValueError, match="fit_adhesion: confidence must lie between 0 and 1"):
        vc.fit_adhesion(curve, TIP, poisson_ratio=0.5, confidence=95)
