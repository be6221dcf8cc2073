"""Abaqus cards in the frequency domain against the definitions of its manual."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.cards import read_card

ELASTIC = "*MATERIAL, NAME=PAD\n*ELASTIC\n3000., 0.25\n"  # of the long term: G = 1200, K = 2000
LONG_TERM, BULK = 1.2e9, 2e9
PARTS, TIMES = np.array([0.5, 1.5]), np.array([0.02, 0.6])  # over the long-term modulus, s


def read(folder: Path, text: str, **units: Any) -> vc.Card:
    path = folder / "card.inp"
    path.write_text(text, encoding="utf-8")
    return read_card(path, **{"modulus_unit": "MPa", "time_unit": "s", **units})


def problem(folder: Path, text: str) -> str:
    with pytest.raises(ValueError, match=r".") as caught:
        read(folder, text, temperature_unit="degC")
    return str(caught.value)


def transform(omega: float) -> complex:
    """Return g*(ω) = ∫ (G(t)/G_inf - 1) exp(-iωt) dt, by quadrature [s]."""

    def relative(t: float) -> float:
        return float(np.sum(PARTS * np.exp(-t / TIMES)))

    options = {"wvar": omega, "limlst": 500, "epsabs": 1e-10}
    real, *_ = scipy.integrate.quad(relative, 0, np.inf, weight="cos", **options)
    imaginary, *_ = scipy.integrate.quad(relative, 0, np.inf, weight="sin", **options)
    return complex(real, -imaginary)


def rows(bulk: str) -> str:
    lines = []
    for f in np.geomspace(0.01, 100, 25):
        wg = 2 * math.pi * f * transform(2 * math.pi * f)
        volume = f"{wg.real:.9e}, {wg.imag:.9e}" if bulk == "alike" else bulk
        lines.append(f"{wg.real:.9e}, {wg.imag:.9e}, {volume}, {f:.12e}\n")
    return "".join(lines)


@pytest.fixture(scope="module")
def table() -> dict[str, str]:
    return {bulk: rows(bulk) for bulk in ("0., 0.", "alike", "0.01, 0.")}


def test_prony_terms_are_the_same_in_time_and_frequency(tmp_path: Path) -> None:
    terms = "0.3, 0., 0.1\n0.2, 0., 1.\n"
    time = read(tmp_path, f"{ELASTIC}*VISCOELASTIC, TIME=PRONY\n{terms}")
    for written in ("FREQUENCY=PRONY", "freq = pro", "Frequency=Prony"):
        assert read(tmp_path, f"{ELASTIC}*Visco Elastic, {written}\n{terms}") == time
    assert time.material.law.relaxation(math.inf) == close_to(LONG_TERM, rel=1e-14)
    assert time.material.law.relaxation(0.0) == close_to(2 * LONG_TERM, rel=1e-14)


def test_test_data_are_the_same_in_time_and_frequency(tmp_path: Path) -> None:
    data = " TEST DATA\n*SHEAR TEST DATA, SHRINF=0.5\n0.8, 1.\n0.5, 10.\n"
    time, frequency = (
        read(tmp_path, f"{ELASTIC}*VISCOELASTIC, {domain}=RELAXATION{data}")
        for domain in ("TIME", "FREQUENCY")
    )
    assert time == frequency


@pytest.mark.parametrize("option", ["FREQUENCY=TABULAR", "TIME=FREQUENCY DATA"])
def test_tabular_data_of_a_prony_series_give_it_back(
    option: str, table: dict[str, str], tmp_path: Path
) -> None:
    # ω Re g* = G''/G_inf and ω Im g* = 1 - G'/G_inf with g* of the relaxation function, f in Hz.
    material = read(tmp_path, f"{ELASTIC}*VISCOELASTIC, {option}\n{table['0., 0.']}").material
    t = np.geomspace(1e-3, 3, 20)
    expected = LONG_TERM * (1 + np.sum(PARTS * np.exp(-t[:, None] / TIMES), axis=1))
    np.testing.assert_allclose(material.law.relaxation(t), expected, rtol=2e-3)
    assert material.bulk_modulus == close_to(BULK, rel=1e-14)
    # Known until the inverse of the lowest angular frequency.
    assert material.measured_until == close_to(1 / (2 * math.pi * 0.01), rel=1e-12)
    assert material.warning is None


def test_frequencies_are_in_cycles_per_unit_of_time(table: dict[str, str], tmp_path: Path) -> None:
    text = f"{ELASTIC}*VISCOELASTIC, FREQUENCY=TABULAR\n{table['0., 0.']}"
    seconds, minutes = (read(tmp_path, text, time_unit=unit).material.law for unit in ("s", "min"))
    np.testing.assert_allclose(minutes.relaxation(60 * 0.3), seconds.relaxation(0.3), rtol=1e-6)


def test_frequency_data_of_instantaneous_constants_end_below_them(
    table: dict[str, str], tmp_path: Path
) -> None:
    text = ELASTIC.replace("*ELASTIC", "*ELASTIC, MODULI=INSTANTANEOUS")
    text += f"*VISCOELASTIC, TIME=FREQUENCY DATA\n{table['0., 0.']}"
    law = read(tmp_path, text).material.law
    assert law.relaxation(0.0) == close_to(LONG_TERM, rel=1e-12)
    assert law.relaxation(math.inf) == close_to(LONG_TERM / 3, rel=2e-3)


def test_bulk_columns_are_a_constant_ratio_an_elastic_volume_or_refused(
    table: dict[str, str], tmp_path: Path
) -> None:
    head = f"{ELASTIC}*VISCOELASTIC, FREQUENCY=TABULAR\n"
    assert read(tmp_path, head + table["alike"]).material.poisson_ratio == 0.25
    assert "bulk modulus relaxes otherwise" in problem(tmp_path, head + table["0.01, 0."])


def test_data_far_above_the_long_term_modulus_warn(tmp_path: Path) -> None:
    above = "".join(f"0.1, -1.{k}, 0., 0., {10.0**k}\n" for k in range(4))
    material = read(tmp_path, f"{ELASTIC}*VISCOELASTIC, FREQUENCY=TABULAR\n{above}").material
    assert material.warning is not None
    assert "times that of the card; give lower frequencies" in material.warning


@pytest.mark.parametrize("a", [0.0, 0.3, 0.8])
def test_causal_formula_is_a_spring_beside_a_spring_pot(a: float, tmp_path: Path) -> None:
    # g*(ω) = g_1 f^-a, G* = G_inf (1 + i ω g*); Kramers-Kronig relation: g_1 ~ exp(-iaπ/2).
    g = 0.05 * np.exp(-0.5j * np.pi * a)
    line = f"{g.real:.8e}, {g.imag:.8e}, {a}\n"
    text = f"{ELASTIC}*VISCOELASTIC, FREQUENCY=FORMULA\n{line}"
    law = read(tmp_path, text, time_unit="ms").material.law
    f = np.array([1.0, 30.0, 1e3])  # Hz; in the card per ms
    expected = LONG_TERM * (1 + 2j * np.pi * (f / 1e3) * g * (f / 1e3) ** -a)
    np.testing.assert_allclose(law.complex_modulus(2 * np.pi * f), expected, rtol=1e-4)
    assert law(1e6) == close_to(1 / (2 * LONG_TERM), rel=0.02)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("0.05, 0.03, 0.3\n", "belongs to no law in time (Kramers-Kronig relation): with a = 0.3,"),
        ("0.05, 0.03, 0.3\n", "the imaginary part of g_1 must be -0.5095 times the real one"),
        ("0., 0., 0.3\n", "must have a g_1 other than 0 and an exponent a"),
        ("0.05, 0., 1.5\n", "from 0 up to below 1"),
        ("", "must have one line of g_1, a, k_1, b"),
        ("0.05, 0.\n", "must have 3 to 6 numbers"),
    ],
)
def test_formula_that_is_no_law_is_refused(lines: str, said: str, tmp_path: Path) -> None:
    assert said in problem(tmp_path, f"{ELASTIC}*VISCOELASTIC, FREQUENCY=FORMULA\n{lines}")


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("0.1, -0.2, 0., 0., 0.\n" * 3, "angular_frequency"),
        ("0.1, 1.2, 0., 0., 1.\n0.1, 1., 0., 0., 2.\n0.1, 1., 0., 0., 3.\n", "storage"),
        ("0.1, -0.2, 0., 0., 1.\n", "(storage = 1 - item 2, loss = item 1 of each line"),
        ("", "*VISCOELASTIC has no data lines"),
        ("0.1, -0.2, 1.\n", "card.inp:5: must have 5 numbers, got 3"),
    ],
)
def test_table_that_cannot_be_fitted_is_refused(lines: str, said: str, tmp_path: Path) -> None:
    assert said in problem(tmp_path, f"{ELASTIC}*VISCOELASTIC, FREQUENCY=TABULAR\n{lines}")


ARRHENIUS = f"{ELASTIC}*VISCOELASTIC, TIME=PRONY\n0.3, 0., 0.1\n*TRS, DEFINITION=ARRHENIUS\n"


@pytest.mark.parametrize(
    ("energy", "constants"),
    [
        ("80000.", ""),
        ("8e7", "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, UNIVERSAL GAS=8314.46261815324\n"),
        ("8e7", "*Physical constants, universal gas constant=8314.46261815324\n"),
    ],
)
def test_arrhenius_shift_is_that_of_the_manual(energy: str, constants: str, tmp_path: Path) -> None:
    # ln A = (E_0/R) (1/(θ - θ_Z) - 1/(θ_0 - θ_Z)): Analysis User's Guide, section 22.7.1.
    found = read(tmp_path, f"{constants}{ARRHENIUS}20., {energy}\n", temperature_unit="degC")
    assert found.shift is not None
    expected = math.exp(80000 / 8.31446261815324 * (1 / 313.15 - 1 / 293.15))
    assert found.shift.factor(313.15) == close_to(expected, rel=1e-12)
    assert len(found.notes) == (0 if constants else 1)


def test_arrhenius_shift_of_unknown_unit_is_refused(tmp_path: Path) -> None:
    text = f"{ARRHENIUS}20., 8e7\n"
    assert "is no activation energy in J/mol; state its unit" in problem(tmp_path, text)
    zero = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0.\n" + ARRHENIUS + "20., 8e4\n"
    assert "does not go with temperature_unit" in problem(tmp_path, zero)
