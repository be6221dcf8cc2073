"""LS-DYNA cards against the formulas of its manual."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.cards import read_card, read_cards

FIXED_6 = """\
*KEYWORD
*MAT_VISCOELASTIC
$#     mid        ro      bulk        g0        gi      beta
         1  1.05E-09    2000.0     330.0      80.0       4.0
*END
"""
FIXED_76 = """\
*mat_general_viscoelastic_title
damping rubber
         3  1.05E-09    2000.0       0.0       0.0       0.0       0.0       0.0

     150.0      10.0
     100.0       1.0
      80.0       0.0
*PART
"""


def read(folder: Path, text: str, **options: Any) -> vc.Card:
    path = folder / "card.k"
    path.write_text(text, encoding="utf-8")
    return read_card(path, **{"modulus_unit": "MPa", "time_unit": "s", **options})


def problem(folder: Path, text: str, **options: Any) -> str:
    with pytest.raises(ValueError, match=r".") as caught:
        read(folder, text, temperature_unit="K", **options)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        FIXED_6,
        FIXED_6.replace("*MAT_VISCOELASTIC", "*mat_006"),
        "*MAT_006_TITLE\n1\n1, 1.05e-9, 2000., 330., 80., 4.\n",
        "*MAT_006+\n" + "".join(f"{n:>20}" for n in ("1", "0.", "2000.", "330.", "80.", "4.")),
        "*KEYWORD LONG=Y\n*MAT_6\n"
        + "".join(f"{n:>20}" for n in ("1", "0.", "2d3", "3.3E2", "80", "4")),
        "*PARAMETER\nR       g0     330.0R       gi      80.0\n*MAT_006\n1,,2000.,&g0,&GI,4.\n",
        "*PARAMETER\nR g0, 330., r k, -2000.\n*MAT_006\n1,,-&k,&g0,80.,4.\n",
        "*MAT_006-\n         1          2000.0    330.0     80.0      4.0       \n",
    ],
)
def test_mat_006_relaxes_by_its_formula(text: str, tmp_path: Path) -> None:
    # G(t) = GI + (G0 - GI) exp(-BETA t), with an elastic bulk modulus.
    found = read(tmp_path, text)
    t = np.array([0.0, 0.1, 1.0, 10.0])
    expected = 1e6 * (80 + (330 - 80) * np.exp(-4 * t))
    np.testing.assert_allclose(found.material.law.relaxation(t), expected, rtol=1e-14)
    assert found.material.bulk_modulus == 2e9
    assert found.name == "1"


def test_decay_constants_are_in_the_inverse_of_the_unit_of_time(tmp_path: Path) -> None:
    assert read(tmp_path, FIXED_6, time_unit="ms").material.law.times == close_to((2.5e-4,))


def test_mat_076_is_a_sum_of_terms(tmp_path: Path) -> None:
    # G(t) = sum GI exp(-BETAI t), of which a term with BETAI = 0 does not relax.
    found = read(tmp_path, FIXED_76)
    t = np.array([0.0, 0.03, 0.5, 2.0, np.inf])
    expected = 1e6 * (150 * np.exp(-10 * t) + 100 * np.exp(-t) + 80)
    np.testing.assert_allclose(found.material.law.relaxation(t), expected, rtol=1e-14)
    assert found.material.bulk_modulus == 2e9
    assert found.name == "damping rubber"
    for name in ("3", "Damping Rubber"):
        assert read(tmp_path, FIXED_76, name=name) == found


def test_a_fluid_relaxes_to_nothing(tmp_path: Path) -> None:
    law = read(tmp_path, FIXED_76.replace("      80.0       0.0\n", "")).material.law
    assert law.relaxation(math.inf) == 0.0


def test_bulk_terms_alike_are_a_constant_poissons_ratio(tmp_path: Path) -> None:
    # K_i = 2.5 G_i, to three digits: 3 K (1 - 2 nu) = 2 G (1 + nu) gives nu = 0.3235.
    text = FIXED_76.replace("2000.0", "   0.0")
    for shear, bulk in (("150.0      10.0", "     375.0      10.0"),
                        ("100.0       1.0", "     250.0       1.0"),
                        ("80.0       0.0", "     200.0       0.0")):  # fmt: skip
        text = text.replace(shear, shear + bulk)
    material = read(tmp_path, text).material
    assert material.poisson_ratio == close_to((3 * 2.5 - 2) / (2 * (3 * 2.5 + 1)), rel=1e-12)
    assert "relaxes otherwise" in problem(tmp_path, text.replace("375.0", "475.0"))
    two = text.replace(
        "   0.0       0.0       0.0       0.0", "2000.0       0.0       0.0       0.0", 1
    )
    assert "BULK and the sum of KI are two bulk moduli" in problem(tmp_path, two)


def test_an_elastic_term_of_the_bulk_modulus_is_its_bulk_modulus(tmp_path: Path) -> None:
    text = FIXED_76.replace("2000.0", "   0.0").replace(
        "80.0       0.0", "80.0       0.0    1700.0       0.0"
    )
    assert read(tmp_path, text).material.bulk_modulus == close_to(1.7e9, rel=1e-14)


def test_mat_elastic_is_read(tmp_path: Path) -> None:
    text = "*MAT_ELASTIC\n         7   7.8E-09  210000.0       0.3\n"
    assert read(tmp_path, text).material == vc.Material(vc.Elastic(2.1e11 / 2.6), 0.3)


def test_arrhenius_shift_speeds_up_by_its_formula(tmp_path: Path) -> None:
    # Rates are multiplied by exp(-A (1/T - 1/TREF)).
    head = "         3  1.05E-09    2000.0       0.0       0.0"
    text = FIXED_76.replace(head + "       0.0       0.0", head + "     300.0    9000.0")
    shift = read(tmp_path, text, temperature_unit="K").shift
    assert shift is not None
    assert shift.factor(320.0) == close_to(math.exp(9000 * (1 / 320 - 1 / 300)), rel=1e-12)
    with pytest.raises(ValueError, match="absolute temperatures"):
        read(tmp_path, text, temperature_unit="degC")
    wlf = text.replace("    9000.0       0.0", "      40.0      51.6")
    said = problem(tmp_path, wlf)
    assert "WLF shift of *MAT_GENERAL_VISCOELASTIC is not read" in said
    assert "c1 = 17.37 and c2 = 51.6" in said  # 40 / ln 10


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("2000.0", "   0.0", "the bulk modulus must be positive, got 0.0"),
        ("2000.0", "  -5.0", "a negative BULK names a load curve"),
        ("330.0", "-55.0", "a negative G0 names a load curve"),
        ("330.0", " 30.0", "GI must lie between 0 and G0, got G0 = 30 and GI = 80"),
        ("       4.0", "       0.0", "card.k:4: BETA must be positive, got 0"),
        ("       4.0", "     &beta", "the parameter '&beta' has no number in this file"),
        ("       4.0", "   <beta*2", "card.k:4: '<beta*2' is not a number"),
        ("    2000.0     330.0", "2000. 330.          ", "is not a number; fields are as wide"),
        ("     330.0      80.0", "   330.0      80.0  ", None),
        ("    2000.0     330.0", " 2000.0   330.0     ", None),
        ("    2000.0     330.0", "   2000.0005    330.0", "lies across the edge of two fields"),
        ("    2000.0     330.0", "\t2000.0\t330.0", "has tabs"),
        ("*END", "         9\n*END", "*MAT_VISCOELASTIC has one line, got 2"),
        ("VISCOELASTIC", "KELVIN-MAXWELL_VISCOELASTIC", "-MAXWELL_VISCOELASTIC is not read"),
        ("VISCOELASTIC", "061", "card.k:2: *MAT_061 is not read; read are *MAT_ELASTIC (001)"),
        ("*MAT_VISCOELASTIC", "*PART", "has no *MAT_..."),
    ],
)  # fmt: skip
def test_mat_006_that_cannot_be_read_is_refused_at_its_line(
    old: str, new: str, said: str | None, tmp_path: Path
) -> None:
    assert old in FIXED_6
    text = FIXED_6.replace(old, new, 1)
    if said is None:
        assert read(tmp_path, text) == read(tmp_path, FIXED_6)
    else:
        assert said in problem(tmp_path, text)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("\n\n", "\n       401         6\n", "LCID: constants from a load curve are not read"),
        ("\n\n", "\n,,,,402\n", "LCIDK: constants from a load curve are not read"),
        ("\n\n", "\n", "LCID: constants from a load curve are not read"),  # taken for its line
        ("       0.0\n\n", "       0.0\n*PART\n", "must have a line for load curves, blank"),
        ("2000.0       0.0       0.0", "2000.0       0.0       1.0", "card.k:3: EF must be 0"),
        ("     150.0", "    -150.0", "GI and its decay constant must not be negative"),
        ("150.0      10.0", "  0.0      10.0", None),
        ("elastic_title", "elastic_moisture_title", "_MOISTURE_TITLE is not read"),
    ],
)  # fmt: skip
def test_mat_076_that_cannot_be_read_is_refused_at_its_line(
    old: str, new: str, said: str | None, tmp_path: Path
) -> None:
    assert old in FIXED_76
    text = FIXED_76.replace(old, new, 1)
    if said is None:
        assert read(tmp_path, text).material.law.relaxation(0.0) == close_to(180e6, rel=1e-14)
    else:
        assert said in problem(tmp_path, text)


def test_one_of_several_materials_is_read_by_name(tmp_path: Path) -> None:
    text = FIXED_6.replace(
        "*END", FIXED_76 + "*MAT_RIGID\n         9\n*MAT_THERMAL_ISOTROPIC\n 1\n"
    )
    assert read(tmp_path, text, name="1") == read(tmp_path, FIXED_6)
    assert "*MAT_RIGID is not read" in problem(tmp_path, text)
    assert "has no material '4'; there are '1', 'damping rubber', '9'" in problem(
        tmp_path, text, name="4"
    )
    path = tmp_path / "card.k"
    path.write_text(FIXED_6.replace("*END", FIXED_76), encoding="utf-8")
    names = [card.name for card in read_cards(path, modulus_unit="MPa", time_unit="s")]
    assert names == ["1", "damping rubber"]


def test_what_is_not_used_is_noted(tmp_path: Path) -> None:
    text = FIXED_76.replace("2000.0       0.0", "2000.0       1.0").replace(
        "*PART", "*INCLUDE\nmore.k"
    )
    text += "*MAT_ADD_EROSION\n         3\n"
    notes = read(tmp_path, text).notes
    assert len(notes) == 3
    assert any("PCF is not used" in note for note in notes)
    assert any("*MAT_ADD_EROSION is not used" in note for note in notes)
    assert any("the file that *INCLUDE names is not read" in note for note in notes)
