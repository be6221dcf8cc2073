"""Laws from indentation records: recovered parameters, confidence intervals, refusals."""

from __future__ import annotations

import math
import warnings
from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.stats import t as student

import viscontact as vc
from campaigns import fewest_held, tried
from closeness import close_to
from returned import some
from viscontact import AccuracyWarning, reference
from viscontact.bodies.materials.material import Material
from viscontact.case import read_material
from viscontact.identification import IndentationRecord, fit_indentation, material_section
from viscontact.identification.elastic_indentation import elastic_indentation
from viscontact.identification.record_problem import RecordProblem
from viscontact.indenters import Cone, FlatPunch, Paraboloid, Pyramid, Sphere
from viscontact.laws import Elastic, Maxwell, PowerLaw, Zener

RADIUS, NU = 5e-6, 0.45
SPHERE = Sphere(RADIUS)


def triangle(rows, rise=2.0, depth=1e-6):
    t = np.linspace(0.0, 2 * rise, rows)
    return t, depth * np.minimum(t, 2 * rise - t) / rise


def exact_record(law, indenter=SPHERE, rows=41, given="approach"):
    t, d = triangle(rows)
    profiles = {
        Sphere: lambda: reference.SphereProfile(indenter.radius),
        Cone: lambda: reference.ConeProfile(indenter.half_angle),
        FlatPunch: lambda: reference.PunchProfile(indenter.radius),
    }
    contact = reference.press_axisymmetric(
        profiles[type(indenter)](),
        t,
        approach=d,
        creep_compliance=Material(law, NU).contact_compliance(),
    )
    return IndentationRecord(indenter, t, d, contact.force)


def scattered(record, share, seed):
    noise = np.random.default_rng(seed).standard_normal(record.force.size)
    force = record.force + share * record.force.max() * noise
    return IndentationRecord(record.indenter, record.times, record.approach, force)


def ting_force(t, rise, depth, modulus, tau):
    """Force on a sphere pressed into a Maxwell body and drawn back, each at constant rate.

    Ting (1966): on the way back F = (8/3) sqrt(R)/(1 - nu) times the integral of
    G(t - t') d(approach^1.5) up to the instant t1 of equal contact radius during loading, where
    the integral of G(t - t') d(approach) from t1 to t is 0. Here by quadrature.
    """
    rate = depth / rise

    def upto(instant):
        def slope(u):
            return modulus * np.exp(-(t - u) / tau) * 1.5 * rate**1.5 * np.sqrt(u)

        return 8 / 3 * np.sqrt(RADIUS) / (1 - NU) * quad(slope, 0.0, instant)[0]

    if t <= rise:
        return upto(t)

    def balance(t1):
        inward = np.exp(-(t - rise) / tau) - np.exp(-(t - t1) / tau)
        return inward - (1 - np.exp(-(t - rise) / tau))

    return upto(brentq(balance, 0.0, rise)) if balance(0.0) > 0 else 0.0


def test_a_record_after_ting_by_quadrature_gives_its_maxwell_body_back():
    """An independent route to the record: no march, no elements, contact lost on the way."""
    t, d = triangle(41)
    force = np.array([ting_force(instant, 2.0, 1e-6, 1e6, 1.5) for instant in t])
    assert (force[-5:] == 0).all()
    fit = fit_indentation(IndentationRecord(SPHERE, t, d, force), "maxwell", poisson_ratio=NU)
    assert fit.parameters["shear_modulus"] == close_to(1e6, rel=2e-3)
    assert fit.parameters["viscosity"] == close_to(1.5e6, rel=2e-3)
    assert fit.residual < 1e-3


def test_hertz_sneddon_and_boussinesq_give_youngs_modulus_back():
    """F = 4/3 E* sqrt(R) d^1.5, 2/pi E* tan(a) d², 2 a E* d: any textbook on contact."""
    t, d = triangle(21)
    contact_modulus = 2e6 / (1 - NU)  # 2 G/(1 - nu) with G = 1 MPa
    for indenter, unit in (
        (SPHERE, 4 / 3 * np.sqrt(RADIUS) * d**1.5),
        (Cone(1.2), 2 / np.pi * np.tan(1.2) * d**2),
        (FlatPunch(2e-6), 4e-6 * d),
    ):
        record = IndentationRecord(indenter, t, d, contact_modulus * unit)
        fit = fit_indentation(record, "elastic", poisson_ratio=NU)
        assert fit.law.shear_modulus == close_to(1e6, rel=1e-6)


@pytest.mark.parametrize("faces", [3, 4])
def test_a_pyramid_on_a_creeping_half_space_gives_its_law_back(faces):
    """Loading and unloading of the whole contact on cells, which know nothing of a cone."""
    pyramid, law = Pyramid(math.radians(70), faces), Zener(1e6, 1e6, 1e6)
    t, d = triangle(21)
    size = (10 if faces == 3 else 7.5) * d.max()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        ds = vc.simulate(
            *(pyramid, Material(law, NU), vc.ApproachHistory(t[[0, 10, 20]], d[[0, 10, 20]])),
            *(vc.Grid((72, 72), (size, size)), t),
            errors=False,
            fields="none",
        )
    record = IndentationRecord(pyramid, t, d, ds["force"].values)
    fit = fit_indentation(record, "zener", poisson_ratio=NU)
    assert fit.residual < 4e-3
    times = np.linspace(0.2, 4.0, 10)
    np.testing.assert_allclose(fit.law(times), law(times), rtol=8e-3)


def test_the_force_of_a_pyramid_is_near_the_one_that_bilodeau_approximates():
    """Bilodeau 1992: 0.7453 of four faces; and above that of the cone of equal area."""
    d, angle = np.array([1e-6]), math.radians(35)
    for faces in (3, 4):
        [force] = elastic_indentation(Pyramid(angle, faces)).force(d)
        area = faces * math.tan(math.pi / faces) / math.pi  # over that of the cone inside
        cone = 2 / math.pi * math.tan(angle) * math.sqrt(area) * 1e-12
        assert 1.02 < force / cone < 1.09
    assert elastic_indentation(Pyramid(angle, 4)).force(d)[0] == close_to(
        0.7453 * math.tan(angle) * 1e-12, rel=0.011
    )


CASES = [
    ("maxwell", Maxwell(1e6, 2e6), SPHERE),
    ("zener", Zener(1e6, 5e5, 1e6), Cone(1.2)),
    ("creep-series", Zener(1e6, 5e5, 1e6), FlatPunch(2e-6)),
    ("power-law", PowerLaw(1e-6, 0.2, 4.0), SPHERE),
    ("power-law-with-instant", PowerLaw(1e-6, 0.4, 4.0, 5e-7), SPHERE),
]


@cache
def fitted(number):
    """The fit of a case, which tests share."""
    name, law, indenter = CASES[number]
    return fit_indentation(exact_record(law, indenter, rows=31), name, poisson_ratio=NU)


@pytest.mark.parametrize("number", range(5), ids=[case[0] for case in CASES])
def test_each_law_is_found_again_without_scatter(number):
    name, law, _ = CASES[number]
    fit = fitted(number)
    t = np.linspace(0.2, 4.0, 20)
    np.testing.assert_allclose(fit.law(t), law(t), rtol=2e-3)
    if name.startswith("power-law"):  # whose compliance is the one at the record's end
        assert fit.law.reference_time == close_to(4.0)
        assert fit.parameters["compliance"] == close_to(law.compliance, rel=0.02)


def test_the_approach_under_a_given_force_gives_the_same_law():
    fit = fit_indentation(
        exact_record(Maxwell(1e6, 2e6), rows=25), "maxwell", poisson_ratio=NU, given="force"
    )
    assert fit.parameters["shear_modulus"] == close_to(1e6, rel=5e-3)
    assert fit.parameters["viscosity"] == close_to(2e6, rel=5e-3)
    assert np.isnan(fit.residuals).any()  # where contact was lost there is nothing to compare


def test_an_elastic_bulk_gives_the_same_shear_as_its_poisson_ratio():
    """K = 2 G (1 + nu)/(3 (1 - 2 nu)) for an elastic body."""
    K = 2e6 * (1 + NU) / (3 * (1 - 2 * NU))
    fit = fit_indentation(exact_record(Elastic(1e6)), "elastic", bulk_modulus=K)
    assert fit.law.shear_modulus == close_to(1e6, rel=1e-3)
    assert fit.material.bulk_modulus == close_to(K)


def test_intervals_shrink_with_the_scatter_and_the_root_of_the_rows():
    """Linear regression: the standard error goes with sigma / sqrt(rows)."""

    def width(rows, share):
        record = scattered(exact_record(Elastic(1e6), rows=rows), share, 7)
        fit = fit_indentation(record, "elastic", poisson_ratio=NU)
        low, high = fit.intervals["shear_modulus"]
        return np.log(high / low)

    many = width(101, 0.01)
    assert many / width(101, 0.001) == close_to(10.0, rel=0.01)
    # The scatter itself is estimated from the rows: 1/sqrt(2 * 25) uncertain.
    assert width(25, 0.01) / many == close_to(np.sqrt(101 / 25), rel=0.3)


def test_the_elastic_interval_is_that_of_linear_regression():
    """F = k x by least squares: k ± t s / sqrt(sum x²) (any textbook), here on k itself."""
    record = scattered(exact_record(Elastic(1e6)), 0.01, 3)
    fit = fit_indentation(record, "elastic", poisson_ratio=NU, confidence=0.9)
    x = 4 / 3 * np.sqrt(RADIUS) * record.approach**1.5 * 2 / (1 - NU)
    k = x @ record.force / (x @ x)
    s = np.sqrt(np.sum((record.force - k * x) ** 2) / (x.size - 1))
    half = student.ppf(0.95, x.size - 1) * s / np.sqrt(x @ x)
    assert fit.parameters["shear_modulus"] == close_to(k, rel=1e-5)
    low, high = fit.intervals["shear_modulus"]
    assert (high - low) / 2 == close_to(half, rel=1e-3)
    rms = np.sqrt(np.mean((record.force - k * x)[np.isfinite(fit.residuals)] ** 2))
    assert fit.residual == close_to(rms / record.force.max(), rel=1e-5)


@pytest.mark.slow
def test_intervals_cover_the_truth_at_their_level():
    """Of seeded repeats 95 in 100, as the binomial distribution has it."""
    truth = {"shear_modulus": 1e6, "viscosity": 2e6}
    record = exact_record(Maxwell(*truth.values()))
    hits = dict.fromkeys(truth, 0)
    count = tried(30, 100)
    for seed in range(count):
        fit = fit_indentation(scattered(record, 0.01, seed), "maxwell", poisson_ratio=NU)
        for name, value in truth.items():
            low, high = fit.intervals[name]
            hits[name] += low <= value <= high
    assert min(hits.values()) >= fewest_held(count), hits


def test_a_fit_prints_what_it_found_with_units_and_intervals():
    fit = fit_indentation(
        scattered(exact_record(Maxwell(1e6, 2e6)), 0.01, 0), "maxwell", poisson_ratio=NU
    )
    assert "Maxwell to 41 rows over 4 s" in repr(fit)
    assert "viscosity = " in repr(fit)
    assert "Pa s (95%: " in repr(fit)
    np.testing.assert_allclose(np.diag(fit.correlation), 1.0)


@pytest.mark.parametrize("number", range(3), ids=[c[0] for c in CASES[:3]])
def test_the_section_of_a_case_file_is_the_law_that_was_found(number, tmp_path):
    fit = fitted(number)
    path = tmp_path / "material.yaml"
    path.write_text(material_section(fit), encoding="utf-8")
    found = read_material(path)
    t = np.linspace(0.0, 4.0, 20)
    np.testing.assert_allclose(found.law(t), fit.law(t), rtol=5e-6)
    assert found.poisson_ratio == close_to(NU)


def test_the_section_of_a_power_law_has_the_keys_of_its_arguments():
    fit = fitted(3)
    keys = [line.split(":")[0].strip() for line in material_section(fit).splitlines()[1:]]
    wanted = ["law", "compliance", "exponent", "reference_time", "data", "poisson_ratio"]
    assert keys == wanted


def test_an_undetermined_parameter_is_warned_about():
    record = scattered(exact_record(Elastic(1e6), rows=25), 0.01, 1)
    with pytest.warns(AccuracyWarning, match=r"leaves open .*fewer parameters"):
        fit_indentation(record, "maxwell", poisson_ratio=NU)


T, D = triangle(21)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: IndentationRecord(Paraboloid(1.0, 2.0), T, D, D),
            "a Sphere, a Cone, a Pyramid with",
        ),
        (
            lambda: IndentationRecord(FlatPunch(half_length=1.0, half_width=1.0), T, D, D),
            "round FlatPunch",
        ),
        (
            lambda: IndentationRecord(SPHERE, T, D, np.where(T == 2, np.nan, D)),
            "force, row 10: .*nan",
        ),
        (lambda: IndentationRecord(SPHERE, T[::-1], D, D), "times, row 1: must not be before"),
        (lambda: IndentationRecord(SPHERE, T, D[:-1], D), "21 times, 20 approach, 21 force"),
        (lambda: IndentationRecord(SPHERE, T[:3], D[:3], D[:3]), "needs at least 5 rows"),
        (lambda: IndentationRecord(SPHERE, T, -D, D), "approach and force must be positive"),
        (lambda: IndentationRecord(SPHERE, T, D, "x"), "force must be numbers in N, got 'x'"),
        (
            lambda: fit_indentation(RECORD, "kelvin", poisson_ratio=0.5),
            "one of elastic, .*'kelvin'",
        ),
        (lambda: fit_indentation(RECORD, "elastic"), "exactly one of poisson_ratio"),
        (
            lambda: fit_indentation(RECORD, "creep-series", terms=6, poisson_ratio=0.5),
            "13 parameters and needs at least 26 rows, got 21",
        ),
        (lambda: fit_indentation(RECORD, "creep-series", terms=0, poisson_ratio=0.5), "terms must"),
        (lambda: fit_indentation(RECORD, "elastic", poisson_ratio=0.5, given="time"), "given must"),
        (
            lambda: fit_indentation(RECORD, "elastic", poisson_ratio=0.5, confidence=95),
            "between 0 and 1, got 95",
        ),
        (
            lambda: fit_indentation(
                IndentationRecord(SPHERE, T, D, np.where(D > 0.2e-6, -1e-6, 1e-9)),
                "elastic",
                poisson_ratio=0.5,
            ),
            "force is not positive where its approach is",
        ),
    ],
)
def test_bad_records_and_options_are_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()


RECORD = IndentationRecord(SPHERE, T, D, 1e3 * D**1.5)


@pytest.mark.parametrize("scatter", [0.01, 1e-6])
@pytest.mark.parametrize("indenter", [SPHERE, Cone(1.2)], ids=["sphere", "cone"])
def test_a_record_that_is_searched_with_the_tip_alone_has_the_fit_of_the_whole_contact(
    scatter, indenter, monkeypatch
):
    """The force on the tip is a search for the solution of the rods, which the fit ends with."""
    law = Zener(1e6, 1e6, 1e6)
    record = scattered(exact_record(law, indenter), scatter, seed=7)
    coarse = fit_indentation(record, "zener", poisson_ratio=NU)
    monkeypatch.setattr(RecordProblem, "has_coarser", False)
    whole = fit_indentation(record, "zener", poisson_ratio=NU)
    for name, (low, high) in some(whole.intervals.items()):
        deviation = (high - low) / 4
        assert abs(coarse.parameters[name] - whole.parameters[name]) < 0.05 * deviation
        begin, end = coarse.intervals[name]
        assert end - begin == close_to(high - low, rel=0.02)


def test_a_record_whose_approach_has_scatter_has_the_fit_of_the_whole_contact_too(monkeypatch):
    """Small reversals of a hold are no second indentation, but the tip alone forgets them."""
    rng = np.random.default_rng(3)
    record = exact_record(Zener(1e6, 1e6, 1e6))
    noisy = record.approach + 3e-3 * record.approach.max() * rng.standard_normal(41)
    record = scattered(
        IndentationRecord(record.indenter, record.times, noisy, record.force), 0.01, seed=8
    )
    coarse = fit_indentation(record, "zener", poisson_ratio=NU)
    monkeypatch.setattr(RecordProblem, "has_coarser", False)
    whole = fit_indentation(record, "zener", poisson_ratio=NU)
    for name, (low, high) in some(whole.intervals.items()):
        assert abs(coarse.parameters[name] - whole.parameters[name]) < 0.05 * (high - low) / 4
