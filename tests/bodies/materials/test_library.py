"""The shipped materials: each against its source, and what the reader makes of its file."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import viscontact as vc
from returned import some
from viscontact.bodies.materials import library
from viscontact.bodies.materials.library.points import Points, read_points
from viscontact.bodies.materials.library.unknown_names import nearest_names
from viscontact.case import CaseError, read_material, shipped_material
from viscontact.laws import SeriesLaw
from viscontact.plot import material_curves

NAMES = library.names()
ALL_POINTS = [
    pytest.param(name, points, id=f"{name}-{number}-{points.quantity}")
    for name in NAMES
    for number, points in enumerate(library.entry(name).points)
]
ELASTIC = [name for name in NAMES if isinstance(shipped_material(name).law, vc.Elastic)]
CREEPING = [name for name in NAMES if name not in ELASTIC]
SERIES = [name for name in CREEPING if isinstance(shipped_material(name).law, SeriesLaw)]
POWERS = [name for name in NAMES if isinstance(shipped_material(name).law, vc.PowerLaw)]


def measured_times(name: str) -> tuple[float, float]:
    """First and last time on which the constants of a material that creeps rest."""
    found = library.entry(name).measured
    assert found is not None
    return found


POINTS = {"quantity": "creep_compliance", "what": "", "data": "shear", "tolerance": 0.01}


@pytest.mark.parametrize(("name", "points"), ALL_POINTS)
def test_a_material_keeps_to_what_its_source_prints_or_measured(name: str, points: Points) -> None:
    # The tolerance is given with the points, and its reason.
    law = shipped_material(name).law
    assert_allclose(points.of_law(law), points.values, rtol=points.tolerance)


@pytest.mark.parametrize("name", SERIES)
def test_a_doubled_mode_within_the_range_is_found_by_the_points(name: str) -> None:
    # What a slip in one constant would do: were the tolerances wider, it would pass.
    entry = library.entry(name)
    law = shipped_material(name).law
    assert isinstance(law, SeriesLaw)
    series = law.relaxation_series()
    first, last = measured_times(name)
    within = [i for i, time in enumerate(series.times) if first <= time <= last]
    assert within
    for i in within:
        moduli = [G * (2 if k == i else 1) for k, G in enumerate(series.moduli)]
        slipped = vc.RelaxationSeries(series.equilibrium, moduli, series.times)
        assert any(
            np.abs(points.of_law(slipped) / points.values - 1).max() > points.tolerance
            for points in entry.points
        )


@pytest.mark.parametrize("name", POWERS)
@pytest.mark.parametrize("constant", ["instant", "compliance", "exponent"])
def test_a_power_law_with_one_wrong_constant_is_found_by_the_points(
    name: str, constant: str
) -> None:
    law = shipped_material(name).law
    slipped = replace(law, **{constant: 1.02 * getattr(law, constant)})
    printed = library.entry(name).points[0]
    assert np.abs(printed.of_law(slipped) / printed.values - 1).max() > printed.tolerance


@pytest.mark.parametrize(
    "copied", [copy.copy, copy.deepcopy, replace, lambda one: pickle.loads(pickle.dumps(one))]
)
@pytest.mark.parametrize("name", NAMES)
def test_copies_of_entries_points_and_materials_are_equal(
    name: str, copied: Callable[[Any], object]
) -> None:
    entry = library.entry(name)
    for one in (entry, entry.points[0], shipped_material(name)):
        assert copied(one) == one
        assert hash(copied(one)) == hash(one)


def test_entries_and_points_that_differ_are_unequal() -> None:
    entry = library.entry("pom-c-23c")
    points = entry.points[0]
    assert replace(entry, title="other") != entry
    for name in ("at", "values"):
        assert replace(points, **{name: getattr(points, name) * 1.1}) != points
    assert replace(points, tolerance=0.5) != points


def test_every_material_that_creeps_is_a_power_law_or_a_series() -> None:
    assert sorted([*SERIES, *POWERS]) == sorted(CREEPING)


@pytest.mark.parametrize("name", ELASTIC)
def test_an_elastic_constant_that_is_a_fifth_wrong_is_found_by_the_points(name: str) -> None:
    law, [other] = shipped_material(name).law, library.entry(name).points
    for factor in (0.8, 1.2):
        slipped = vc.Elastic(factor * float(law.relaxation(0.0)))
        assert np.abs(other.of_law(slipped) / other.values - 1).max() > other.tolerance


@pytest.mark.parametrize("name", CREEPING)
def test_a_material_creeps_relaxes_and_dissipates(name: str) -> None:
    # The second law, within the range: J increases, G decreases above 0, G'' > 0.
    law = shipped_material(name).law
    first, last = measured_times(name)
    times = np.geomspace(max(first, 1e-3 * last), last, 40)
    assert (np.diff(law(times)) > 0).all()
    moduli = law.relaxation(times)
    assert (np.diff(moduli) < 0).all()
    assert moduli[-1] > 0
    assert (law.complex_modulus(1 / times).imag > 0).all()


@pytest.mark.parametrize("name", ["pom-c-23c", "pa66-conditioned-23c"])
def test_the_assumed_poisson_ratio_matters_as_little_as_its_file_says(name: str) -> None:
    # Tensile data: the contact compliance is (1 - nu^2) D, here at 1 h.
    given = library.entry(name).material

    def compliance(ratio: float) -> float:
        material = vc.Material(
            vc.PowerLaw.from_uniaxial(1.0, 0.3, 1.0, poisson_ratio=ratio), poisson_ratio=ratio
        )
        return float(material.contact_compliance()(1.0))

    assert given["data"] == "uniaxial"
    assumed = compliance(given["poisson_ratio"])
    assert_allclose(compliance(0.35) / assumed - 1, 0.045, atol=0.001)
    assert_allclose(compliance(0.45) / assumed - 1, -0.051, atol=0.001)


@pytest.mark.parametrize("name", ["pom-c-23c", "pa66-conditioned-23c"])
def test_a_typical_value_says_that_it_is_none_for_design(name: str) -> None:
    assert library.entry(name).title.endswith("typical, not for design")


def test_the_library_covers_many_kinds_of_material() -> None:
    families = {library.entry(name).family for name in NAMES}
    assert len(NAMES) >= 8
    assert len(families) >= 4


@pytest.mark.parametrize("name", NAMES)
def test_an_entry_says_all_that_is_asked_of_it(name: str) -> None:
    entry = library.entry(name)
    assert entry.name == name
    texts = (entry.family, entry.title, entry.source, entry.cite, entry.temperature, entry.test)
    assert all(texts)
    assert all((entry.constants, entry.volume, entry.checked, entry.licence))
    assert entry.points
    assert (entry.measured is None) == (name in ELASTIC)
    if entry.measured is not None:
        assert 0 <= entry.measured[0] < entry.measured[1] < math.inf


@pytest.mark.parametrize("name", CREEPING)
def test_points_lie_where_the_constants_rest_on_something(name: str) -> None:
    entry = library.entry(name)
    first, last = measured_times(name)
    for points in some(entry.points):
        times = points.at if points.over_time else 1 / points.at
        # The printings of formulas are compared a little beyond the range of their times, and
        # at once.
        assert times[times > 0].min() >= 0.5 * first
        assert times.max() <= 4 * last


def test_the_two_readings_of_pmma_are_what_they_were() -> None:
    # As `case/materials/library.py` held them before there were files, digit for digit.
    paper, kumar = (library.entry(name).material for name in ("pmma-paper", "pmma-kumar-2004"))
    assert (paper["instant"], paper["data"]) == ("5.545e-4 / MPa", "deviatoric")
    assert paper["amplitudes"] == ["6.17e-5 / MPa", "8.38e-5 / MPa"]
    assert paper["times"] == ["10 s", "133.868808567604 s"]
    assert kumar["moduli"] == ["184.15 MPa", "190.71 MPa"]
    assert (kumar["equilibrium"], kumar["times"]) == ("1428.57 MPa", ["8.989 s", "117.97 s"])
    assert paper["poisson_ratio"] == kumar["poisson_ratio"] == 0.38


def test_the_papers_reading_is_1_38_times_too_stiff() -> None:
    # Phi = D where Phi = (1 + nu) D was meant, and the two inverses agree to six digits.
    times = np.geomspace(0.1, 1000, 20)
    paper, kumar = (shipped_material(name).law for name in ("pmma-paper", "pmma-kumar-2004"))
    assert_allclose(kumar(times) / paper(times), 1.38, rtol=1e-5)


def test_glass_flows_with_the_viscosity_of_its_modes() -> None:
    # The relaxation of a Maxwell body's parts adds up to eta = sum G_i tau_i, 28.7 GPa s: the
    # 10^10.5 Pa s of a soda-lime glass some 50 K above its transition.
    law = shipped_material("soda-lime-glass-596c").law
    assert isinstance(law, vc.RelaxationSeries)
    viscosity = sum(np.multiply(law.moduli, law.times))
    fluidity = (law(1e4) - law(1e3)) / 9e3
    assert_allclose(1 / (2 * fluidity), viscosity, rtol=1e-9)
    assert_allclose(viscosity, 28.7e9, rtol=1e-3)


def test_the_bulk_of_glass_errs_as_its_file_says() -> None:
    # 1/J at Laplace s ~ 1/t with the bulk relaxing to 18 % as printed, or elastic: at most 19 %.
    weights = np.array([0.0222, 0.0224, 0.0286, 0.2137, 0.394, 0.3191])
    times = np.array([5.009e-5, 9.945e-4, 2.022e-3, 1.925e-2, 0.1199, 2.033])
    glass = shipped_material("soda-lime-glass-596c")
    law, bulk = glass.law, glass.bulk_modulus
    assert isinstance(law, vc.RelaxationSeries)
    assert bulk is not None
    assert_allclose(bulk, 70e9 / (3 * (1 - 2 * 0.22)), rtol=1e-4)

    def compliance(s: float, *, relaxing: bool) -> float:
        tau = np.array(law.times)
        G = float(np.sum(np.array(law.moduli) * s * tau / (1 + s * tau)))
        left = 0.18 + 0.82 * float(np.sum(weights * s * times / (1 + s * times)))
        K = bulk * (left if relaxing else 1.0)
        return (3 * K + 4 * G) / (4 * G * (3 * K + G))

    errors = [
        compliance(1 / t, relaxing=False) / compliance(1 / t, relaxing=True) - 1
        for t in (0.01, 1.0, 100.0)
    ]
    assert_allclose(errors, [-0.041, -0.184, -0.028], atol=0.001)


@pytest.mark.parametrize("name", CREEPING)
def test_a_material_knows_how_long_it_was_measured(name: str) -> None:
    assert shipped_material(name).known_until == measured_times(name)[1]


def test_a_run_beyond_the_measured_time_warns() -> None:
    material = replace(shipped_material("epdm-70-25c"), measured_range=None)  # to 15.9 s

    def press(end: float) -> str:
        ds = vc.simulate(
            vc.Sphere(0.01),
            material,
            vc.step(1.0),
            grid=vc.Grid((32, 32), (2.4e-3, 2.4e-3)),
            times=vc.log_times(1e-4, end, 60),
        )
        return str(ds.attrs["warnings"])

    assert press(15.0) == ""
    with pytest.warns(vc.AccuracyWarning, match=r"15\.9 s"):
        assert "15.9 s" in press(20.0)


@pytest.mark.parametrize(
    ("given", "near"),
    [
        ("POM", ["pom-c-23c"]),
        ("PA66", ["pa66-conditioned-23c"]),
        ("acetal", ["pom-c-23c"]),
        ("rubber", ["epdm-70-25c", "polyisoprene-226k-25c"]),
        ("pom-23c", ["pom-c-23c"]),
        ("cast_iron", ["ductile-iron"]),
        ("Stainless steel", ["stainless-steel"]),
        ("PEEK", []),
        ("PU", []),
        ("PE", []),
        (" ", []),
    ],
)
def test_an_unknown_name_finds_the_entries_it_may_mean(given: str, near: list[str]) -> None:
    assert nearest_names(given) == near


def test_unknown_names_are_refused_with_those_there_are() -> None:
    with pytest.raises(ValueError, match=r"'pmma-papre'; did you mean 'pmma-paper'\?.*ldpe-160c"):
        shipped_material("pmma-papre")
    with pytest.raises(KeyError):
        library.entry("../pmma-paper")


def test_constants_of_crystals_are_the_mean_of_the_bounds_of_voigt_and_reuss() -> None:
    # Hill, 1952, Proc. Phys. Soc. A 65, 349: over all directions, of the constants in the files.
    silicon = _stiffness(166, 166, 80, 64, 64, 0)
    sapphire = _stiffness(496.8, 498.1, 147.4, 163.6, 110.9, -23.5)
    silicon[5, 5] = 80.0  # cubic
    for name, stiffness in (("silicon", silicon), ("sapphire", sapphire)):
        bulk, shear = _mean_moduli(stiffness)
        material = shipped_material(name)
        assert_allclose(material.law.relaxation(0.0), 1e9 * shear, rtol=5e-3)
        ratio = (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)
        assert material.poisson_ratio is not None
        assert_allclose(material.poisson_ratio, ratio, rtol=5e-3)
    # Along [100], 130 GPa, and along the c axis: as the files say.
    assert_allclose(1 / np.linalg.inv(silicon)[0, 0], 130, rtol=5e-3)
    assert_allclose(1 / np.linalg.inv(sapphire)[2, 2], 461, rtol=5e-3)


def _stiffness(*constants: float) -> Any:
    """Stiffness of a trigonal crystal from c11, c33, c44, c12, c13, c14 (Nye, 1957, table 9)."""
    c11, c33, c44, c12, c13, c14 = constants
    c66 = (c11 - c12) / 2
    return np.array(
        [
            [c11, c12, c13, c14, 0, 0],
            [c12, c11, c13, -c14, 0, 0],
            [c13, c13, c33, 0, 0, 0],
            [c14, -c14, 0, c44, 0, 0],
            [0, 0, 0, 0, c44, c14],
            [0, 0, 0, 0, c14, c66],
        ]
    )


def _mean_moduli(stiffness: Any) -> Any:
    """Bulk and shear modulus: means of those at equal strain and at equal stress."""
    compliance = np.linalg.inv(stiffness)
    c, s = stiffness[:3, :3], compliance[:3, :3]
    bulk = c.sum() / 9, 1 / s.sum()
    sheared = np.trace(stiffness[3:, 3:]), np.trace(compliance[3:, 3:])
    shear = (
        (3 * np.trace(c) - c.sum()) / 30 + sheared[0] / 5,
        15 / (6 * np.trace(s) - 2 * s.sum() + 3 * sheared[1]),
    )
    return np.mean(bulk), np.mean(shear)


@pytest.mark.parametrize(
    ("data", "factor"), [("deviatoric", 1.0), ("shear", 0.5), ("uniaxial", 1.3)]
)
def test_points_come_in_the_convention_of_their_test(data: str, factor: float) -> None:
    # Phi = J/2 = (1 + nu) D, and so G = E / (2 (1 + nu)).
    creep = read_points({**POINTS, "data": data, "times": [1.0], "values": [2.0]}, 0.3)
    assert_allclose(creep.values, 2.0 * factor)
    modulus = {**POINTS, "quantity": "relaxation_modulus", "data": data}
    relaxation = read_points({**modulus, "times": [1.0], "values": [2.0]}, 0.3)
    assert_allclose(relaxation.values, 1.0 / factor)
    printed = {**POINTS, "quantity": "creep_modulus", "data": data}
    stiffness = read_points({**printed, "times": [1.0], "values": [0.5]}, 0.3)
    assert stiffness.quantity == "creep_compliance"
    assert_allclose(stiffness.values, 2.0 * factor)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"quantity": "viscosity"}, "quantity must be one of creep_compliance"),
        ({"values": [1.0, 2.0]}, "1 places and 2 values"),
        ({"data": "uniaxial"}, "needs a constant poisson_ratio"),
    ],
)
def test_wrong_points_are_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        read_points({**POINTS, "times": [1.0], "values": [1.0], **change}, None)


def test_the_material_of_a_case_file_is_read_whatever_else_it_holds(tmp_path: Any) -> None:
    section = "law: maxwell\nshear_modulus: 1 GPa\nviscosity: 1 GPa s\npoisson_ratio: 0.5\n"
    whole, alone = tmp_path / "case.yaml", tmp_path / "alone.yaml"
    indented = "".join(f"  {line}\n" for line in section.splitlines())
    whole.write_text(f"indenter: not yet\nmaterial:\n{indented}", encoding="utf-8")
    alone.write_text(section, encoding="utf-8")
    assert read_material(whole) == read_material(alone)
    assert read_material(whole).law == vc.Maxwell(1e9, 1e9)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("load: {}\n", "holds no material"),
        ("law: zenr\n", r"yaml:1: material.law: unknown value 'zenr'; did you mean 'zener'"),
        ("material: pmma\n", "no shipped material is called 'pmma'"),
    ],
)
def test_a_file_without_a_material_is_refused(tmp_path: Any, text: str, message: str) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError, match=message):
        read_material(path)


def test_curves_are_solid_where_the_constants_rest_and_dashed_beyond() -> None:
    law = vc.Maxwell(1e9, 1e9)
    figure = material_curves(law, (0.01, 100.0), measured=(0.1, 10.0))
    for axes in figure.axes:
        dashed, solid = axes.lines[:2]
        assert dashed.get_linestyle() == "--"
        inside = np.asarray(solid.get_xdata())
        assert_allclose([inside.min(), inside.max()], [0.1, 10.0], rtol=0.05)
    whole = np.asarray(figure.axes[2].lines[0].get_xdata())
    assert_allclose([whole[0], whole[-1]], [0.01, 100.0])


def test_curves_carry_the_points_of_an_entry() -> None:
    entry = library.entry("polystyrene-130c")
    law = shipped_material(entry.name).law
    figure = material_curves(law, (0.1, 1e4), measured=entry.measured, points=entry.points)
    creep = next(p for p in entry.points if p.quantity == "creep_compliance")
    drawn = figure.axes[0].lines[-1]
    assert_allclose(drawn.get_xdata(), creep.at)
    assert_allclose(np.asarray(drawn.get_ydata()) / creep.values, 1e6)  # in 1/MPa


def test_a_law_that_cannot_jump_is_drawn_without_its_impulse() -> None:
    figure = material_curves(vc.CreepSeries(0.0, [1e-9], [1.0]), (0.01, 100.0))
    assert [axes.get_ylabel().split()[0] for axes in figure.axes] == ["Creep", "Modulus"]


def test_curves_refuse_times_out_of_order() -> None:
    with pytest.raises(ValueError, match="two, above 0 s and increasing"):
        material_curves(vc.Elastic(1e9), (1.0, 0.1))


def test_a_loss_that_has_gone_beyond_the_data_does_not_come_back_in_the_picture() -> None:
    times = np.array([1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000])
    law = vc.TabulatedCreep(times, 1e-9 * (0.40 + 0.04 * times**0.25))
    beyond = 1.0 / np.geomspace(0.1, 1.0, 200)
    assert (np.diff(np.sign(law.complex_modulus(beyond).imag)) != 0).sum() > 1  # of no meaning
    figure = material_curves(law, (0.1, 1e5), measured=(1.0, 1e4))
    storage, _, loss, _ = (line.get_ydata() for line in figure.axes[-1].lines)
    shown = np.isfinite(np.asarray(loss, dtype=float))
    assert np.count_nonzero(np.diff(shown)) == 1  # one end, at the high frequencies
    assert np.isfinite(np.asarray(storage, dtype=float)).all()
