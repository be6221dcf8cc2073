"""Indentation of a film on a rigid base: against expansions, simulated contacts, and refusals."""

from __future__ import annotations

import warnings
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.identification import (
    IndentationRecord,
    find_contact,
    fit_indentation,
    material_section,
)
from viscontact.identification.elastic_indentation import Film, elastic_indentation
from viscontact.indenters import Cone, FlatPunch, Sphere

RADIUS, THICKNESS, NU, STIFFNESS = 5e-6, 10e-6, 0.5, 0.03
TRUTH = {"shear_modulus": 500.0, "delayed_modulus": 333.0, "viscosity": 277.0}
LAW = vc.Zener(*TRUTH.values())
CORNERS, COURSE = [0.0, 1.0, 4.0, 5.0], [0.0, 0.8e-6, 0.8e-6, 0.0]


def first_term(nu):
    """Integral of 1 - L over wave number times thickness, twice over π: softer by that times a/h.

    L is the displacement under a wave over that of a half-space (Johnson 1985, section 5.8).
    """
    k = 3 - 4 * nu

    def missing(w):
        low = 2 * k * np.cosh(2 * w) + 1 + k**2 + 4 * w**2
        return 1 - (2 * k * np.sinh(2 * w) - 4 * w) / low

    return 2 / np.pi * quad(missing, 0.0, 40.0)[0]


@pytest.mark.parametrize("nu", [0.3, 0.5])
@pytest.mark.parametrize("tip", [Sphere(1e-6), Cone(1.2), FlatPunch(1e-8)], ids=repr)
def test_a_thick_film_is_stiffer_in_proportion_to_the_contact_over_the_thickness(tip, nu):
    depth, rises = 1e-8, []
    for thickness in (2e-5, 1e-5):
        film = elastic_indentation(tip, Film(thickness, nu))
        above = film.force(depth) / elastic_indentation(tip).force(depth) - 1
        rises.append(above / film.contact_ratio(depth))
    # The next term is proportional to a/h: it doubles between the two.
    rise = 2 * rises[0] - rises[1]
    assert rise == close_to(first_term(nu), rel=1e-3)
    # Dimitriadis et al. (2002) Biophys. J. 82, 2798: 1 - 2 α/π a/h, with a fit for α.
    alpha = -(1.2876 - 1.4678 * nu + 1.3442 * nu**2) / (1 - nu)
    assert rise == close_to(-2 * alpha / np.pi, rel=6e-3)


def test_the_slope_is_the_derivative_of_the_force():
    depth = np.geomspace(1e-8, 2e-6, 30)
    for tip in (Sphere(RADIUS), Cone(1.2), FlatPunch(2e-6)):
        elastic = elastic_indentation(tip, Film(4e-6, 0.4))
        # The force is linear between 4000 places.
        difference = (elastic.force(1.001 * depth) - elastic.force(0.999 * depth)) / (0.002 * depth)
        np.testing.assert_allclose(elastic.force_and_slope(depth)[1], difference, rtol=3e-4)


def case_of(material, folder):
    """Case of a ball on a material."""
    path = folder / "film.yaml"
    path.write_text(
        f"{material}\nindenter: {{shape: sphere, radius: 5 um}}\n"
        "load: {kind: ramp, approach: 0.5 um, duration: 1 s}\n"
        "time: {end: 1 s, steps: 10}\n",
        encoding="utf-8",
    )
    return path


@cache
def simulated(cells):
    """Times, approach and force of a ball on a layer that creeps, by the contact solver."""
    t = np.linspace(0.0, 5.0, cells + 1)
    film = vc.Layered([vc.Layer(THICKNESS, vc.Material(LAW, NU))], base="rigid")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # slopes of 0.33
        ds = vc.simulate(
            *(vc.Paraboloid(RADIUS, RADIUS), film, vc.ApproachHistory(CORNERS, COURSE)),
            *(vc.Grid((cells, cells), (5.6e-6, 5.6e-6)), t),
            errors=False,
            fields="none",
        )
    return t, np.interp(t, CORNERS, COURSE), ds["force"].values


def test_the_law_of_a_film_is_found_from_simulated_loading_hold_and_retraction():
    misses = []
    for cells in (32, 64):
        record = IndentationRecord(Sphere(RADIUS), *simulated(cells))
        fit = fit_indentation(record, "zener", poisson_ratio=NU, thickness=THICKNESS)
        misses.append(fit.residual)
        for name, value in TRUTH.items():
            assert fit.parameters[name] == close_to(value, rel=0.02 if cells == 64 else 0.05)
    assert misses[1] < 1e-3
    assert misses[1] < misses[0] / 2
    with pytest.warns(vc.AccuracyWarning, match="the residuals"):
        deep = fit_indentation(record, "zener", poisson_ratio=NU)
    assert deep.parameters["shear_modulus"] > 1.2 * LAW.shear_modulus


def test_law_and_contact_point_of_a_raw_curve_on_a_film_are_found_together(tmp_path):
    t, depth, force = simulated(64)
    bent = force / STIFFNESS
    lead, tail = np.linspace(-1.5e-6, 0, 201)[:-1], np.linspace(0, -1e-6, 101)[1:]
    ways = np.concatenate([lead, depth + bent, tail])
    times = np.concatenate([lead / 1e-6, t, t[-1] - tail / 1e-6])
    even = np.linspace(times[0], times[-1], 1500)
    position, bending = (
        np.interp(even, times, each) for each in (ways, np.concatenate([0 * lead, bent, 0 * tail]))
    )
    noise = 3e-10 * np.random.default_rng(0).standard_normal(even.size)
    curve = vc.ForceCurve(even, position, bending + 0.003 * position + noise, STIFFNESS)
    record = find_contact(curve, Sphere(RADIUS)).record()
    fit = fit_indentation(record, "zener", poisson_ratio=NU, thickness=THICKNESS)
    for name, value in TRUTH.items():
        assert fit.parameters[name] == close_to(value, rel=0.02)
    assert abs(fit.contact.position) < 3e-9
    film = read_case(case_of(material_section(fit), tmp_path)).bodies[0]
    assert film.layers[0].thickness == close_to(THICKNESS, rel=1e-6)


def record_of(course, radius=RADIUS):
    tip = Sphere(radius)
    t = np.arange(float(len(course)))
    d = 1e-6 * np.array(course)
    force = elastic_indentation(tip, Film(THICKNESS, NU)).force(np.maximum(d, 0.0))
    return IndentationRecord(tip, t, d, 2e3 * force)


def test_what_a_film_does_not_go_with_is_refused():
    rise = np.linspace(0.0, 0.8, 11)
    once = record_of(rise)
    film = {"poisson_ratio": NU, "thickness": THICKNESS}
    with pytest.raises(ValueError, match="thickness goes with poisson_ratio"):
        fit_indentation(once, "elastic", bulk_modulus=1e9, thickness=THICKNESS)
    with pytest.raises(ValueError, match="given='approach'"):
        fit_indentation(once, "elastic", given="force", **film)
    with pytest.raises(ValueError, match=r"thickness must be .*positive"):
        fit_indentation(once, "elastic", poisson_ratio=NU, thickness=-1e-6)
    twice = record_of([*rise, *rise[-2::-1], *rise[1:]])
    with pytest.raises(ValueError, match="a second approach begins at 20 s"):
        fit_indentation(twice, "elastic", **film)
    # On an incompressible film the table ends where a half-space has a contact of 4.56 thicknesses.
    wide = record_of(rise, (4.7 * THICKNESS) ** 2 / 0.8e-6)
    with pytest.raises(ValueError, match=r"the contact is more than 8 times as wide .* thick"):
        fit_indentation(wide, "elastic", **film)
    narrow = record_of(rise, (4.4 * THICKNESS) ** 2 / 0.8e-6)
    fit = fit_indentation(narrow, "elastic", **film)
    assert fit.parameters["shear_modulus"] == close_to(500.0, rel=1e-6)
    tip = vc.indenters.Pyramid(0.6, faces=4)
    pyramid = IndentationRecord(tip, once.times, once.approach, once.force)
    with pytest.raises(ValueError, match="thickness: goes with spheres, cones and round punches"):
        fit_indentation(pyramid, "elastic", **film)


def test_a_record_that_begins_before_contact_is_fitted_from_its_touch_on():
    rise = np.linspace(-0.1, 0.5, 25)
    noisy = np.array([0.0, -1e-3, 5e-4, -5e-4, *np.linspace(0.02, 0.5, 20)])
    for course in (rise, noisy):
        fit = fit_indentation(record_of(course), "elastic", poisson_ratio=NU, thickness=THICKNESS)
        assert fit.parameters["shear_modulus"] == close_to(500.0, rel=1e-3)


def test_a_record_that_begins_with_a_jump_relaxes_as_the_law():
    times = np.append([0.0], np.geomspace(0.01, 5.0, 40))
    depth = np.full(times.size, 0.8e-6)
    elastic = elastic_indentation(Sphere(RADIUS), Film(THICKNESS, NU))
    # E* relaxes as 2 G(t)/(1 - nu), of the Zener law from G to G G'/(G + G').
    relaxed, tau = 500.0 * 333.0 / 833.0, 277.0 / 833.0
    modulus = relaxed + (500.0 - relaxed) * np.exp(-times / tau)
    force = 2 * modulus / (1 - NU) * elastic.force(0.8e-6)
    record = IndentationRecord(Sphere(RADIUS), times, depth, force)
    fit = fit_indentation(record, "zener", poisson_ratio=NU, thickness=THICKNESS)
    # Of second order in the steps, over which the force changes evenly.
    assert fit.residual < 2e-4
    for name, value in TRUTH.items():
        assert fit.parameters[name] == close_to(value, rel=2e-3)


def test_an_indentation_beyond_small_strains_of_the_film_is_warned_of():
    deep = record_of(np.linspace(0.0, 1.1, 12))
    with pytest.warns(vc.AccuracyWarning, match="11 % of the thickness of the film"):
        fit = fit_indentation(deep, "elastic", poisson_ratio=NU, thickness=THICKNESS)
    assert fit.parameters["shear_modulus"] == close_to(2e3 * (1 - NU) / 2, rel=1e-6)
    assert "film of 10 µm on a rigid base" in repr(fit)
    assert "10 µm on a rigid base" in str(fit)
