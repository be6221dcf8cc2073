"""Cards of Abaqus and Ansys are read as their manuals say."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from bodies.materials.card_texts import ABAQUS, ANSYS, RELAXATION, problem, read
from closeness import close_to
from viscontact.bodies.materials.cards import read_cards


@pytest.mark.parametrize("text", [ABAQUS, ANSYS])
def test_shear_terms_alone_leave_the_bulk_modulus_elastic(text: str, tmp_path: Path) -> None:
    # By hand: E = 3000 and nu = 0.25 are G = 1200 and K = 2000 MPa; G_inf = 0.5 G.
    material = read(tmp_path, text).material
    assert material.poisson_ratio is None
    assert material.bulk_modulus == close_to(2e9, rel=1e-15)
    law = material.law
    assert law.equilibrium == close_to(0.6e9, rel=1e-15)
    np.testing.assert_allclose(law.moduli, [0.36e9, 0.24e9], rtol=1e-15)
    assert law.times == (10.0, 100.0)


def test_abaqus_name_is_kept_and_what_is_not_used_is_noted(tmp_path: Path) -> None:
    card = read(tmp_path, ABAQUS)
    assert card.name == "PMMA 25"
    assert card.notes == ("card.txt:5: *DENSITY is not used",)
    assert read(tmp_path, ANSYS).notes == ("card.txt:5: MP,DENS is not used",)


def test_abaqus_constants_are_of_the_long_term_unless_they_say_instantaneous(
    tmp_path: Path,
) -> None:
    # Keywords Reference Guide, *ELASTIC: MODULI=LONG TERM is the default.
    for line in ("*elastic", "*ELASTIC, MODULI = long term", "*Elastic,\nmoduli=LONG"):
        text = ABAQUS.replace("*elastic, moduli=INSTANTANEOUS", line)
        material = read(tmp_path, text).material
        assert material.law.relaxation(np.inf) == close_to(1.2e9, rel=1e-15)
        assert material.law.relaxation(0.0) == close_to(2.4e9, rel=1e-15)
        assert material.bulk_modulus == close_to(2e9, rel=1e-15)


@pytest.mark.parametrize(
    "text",
    [
        ABAQUS.replace("0.3, 0.,", "0.3, 0.3,").replace("0.2, ,", "0.2, .2,"),
        ANSYS + "TB,PRONY,1,1,2,BULK\nTBDATA,1,.3,10,.2,100\n",
    ],
)
def test_bulk_terms_like_those_in_shear_are_a_constant_poissons_ratio(
    text: str, tmp_path: Path
) -> None:
    material = read(tmp_path, text).material
    assert (material.poisson_ratio, material.bulk_modulus) == (0.25, None)
    assert material.law.relaxation(0.0) == close_to(1.2e9, rel=1e-15)


@pytest.mark.parametrize("text", [ABAQUS, ANSYS])
def test_units_are_those_that_are_said(text: str, tmp_path: Path) -> None:
    law = read(tmp_path, text, modulus_unit="GPa", time_unit="ms").material.law
    assert law.relaxation(0.0) == close_to(1.2e12, rel=1e-15)
    np.testing.assert_allclose(law.times, [0.01, 0.1], rtol=1e-15)


def test_card_without_terms_is_elastic(tmp_path: Path) -> None:
    for text in ("*Elastic\n3000, 0.25\n", "MP,EX,7,3000\nMP,NUXY,7,0.25\n"):
        material = read(tmp_path, text).material
        assert material == vc.Material(vc.Elastic(1.2e9), 0.25)
    assert read(tmp_path, text).name == "7"


def test_one_of_several_materials_is_read_by_name(tmp_path: Path) -> None:
    text = ABAQUS + "*Material, name=foam\n*Hyperfoam\n1, 2\n*Material, name=B\n*Elastic\n1,.1\n"
    assert read(tmp_path, text, name="b").material.poisson_ratio == 0.1
    assert "material 'foam' has no *ELASTIC" in problem(tmp_path, text)
    assert "has no material 'C'; there are 'PMMA 25', 'foam', 'B'" in problem(
        tmp_path, text, name="C"
    )
    two = ANSYS + ANSYS.replace(",1,", ",2,", 4).replace("TB,PRONY,1,1", "TB,PRONY,2,1")
    assert [card.name for card in read(tmp_path, two, read_cards)] == ["1", "2"]
    with pytest.raises(ValueError, match="several materials; name one of '1', '2'"):
        read(tmp_path, two)
    assert "has no material '3'; there are 1, 2" in problem(tmp_path, two, name="3")


def test_apdl_parameters_and_dollar_signs_are_read(tmp_path: Path) -> None:
    text = "e0 = 3000 $ mat=4\nMP,EX,mat,E0 $ MP,PRXY,MAT,.25 ! E0\n"
    card = read(tmp_path, text)
    assert (card.name, card.material) == ("4", vc.Material(vc.Elastic(1.2e9), 0.25))


def test_wlf_shift_is_in_the_temperatures_that_are_said(tmp_path: Path) -> None:
    # Both programs' C1 and C2 are those of log10 a_T = -C1 (T - Tr)/(C2 + T - Tr).
    for text in (ABAQUS.replace("*Step", "*Trs\n25., 17.44, 51.6\n*Step"),
                 ANSYS + "TB,SHIFT,1,1,3,WLF\nTBDATA,1,25,17.44,51.6\n"):  # fmt: skip
        assert read(tmp_path, text, temperature_unit="degC").shift == vc.WLF(298.15, 17.44, 51.6)
        fahrenheit = read(tmp_path, text, temperature_unit="degF").shift
        assert fahrenheit.c2 == close_to(51.6 * 5 / 9, rel=1e-15)
        assert "give temperature_unit, e.g. 'degC'" in problem(tmp_path, text)


def test_tool_narayanaswamy_is_arrhenius_in_absolute_temperatures(tmp_path: Path) -> None:
    text = ANSYS + "TB,SHIFT,1,1,2,TN\nTBDATA,1,300,1e4\n"
    shift = read(tmp_path, text, temperature_unit="K").shift
    # ln A = (H/R)(1/Tr - 1/T) and A = 1/a_T, Material Reference.
    expected = np.exp(1e4 * (1 / 320 - 1 / 300))
    assert float(shift.factor(320.0)) == close_to(expected, rel=1e-13)
    assert "absolute temperatures" in problem(tmp_path, text, temperature_unit="degC")


def test_relaxation_test_data_are_used_as_measured(tmp_path: Path) -> None:
    card = read(tmp_path, RELAXATION, time_unit="min")
    law = card.material.law
    assert isinstance(law, vc.TabulatedRelaxation)
    np.testing.assert_allclose(law.times, [0.0, 60.0, 600.0], rtol=1e-15)
    np.testing.assert_allclose(law.modulus, [1.2e9, 0.9e9, 0.6e9], rtol=1e-15)
    assert card.material.bulk_modulus == close_to(2e9, rel=1e-15)
    assert card.notes == ("card.txt:4: NMAX is not used: test data are taken as measured",)


def test_creep_test_data_are_compliances_over_the_instant_one(tmp_path: Path) -> None:
    text = RELAXATION.replace("RELAXATION", "CREEP").replace("0.75,", "1.5,").replace("0.5,", "2,")
    law = read(tmp_path, text).material.law
    # Phi = j_S/(2 G_0) with G_0 = 1.2 GPa
    assert isinstance(law, vc.TabulatedCreep)
    np.testing.assert_allclose(law.compliance, np.array([1, 1.5, 2]) / 2.4e9, rtol=1e-15)


def test_long_term_constants_with_test_data_need_the_long_term_value(tmp_path: Path) -> None:
    text = RELAXATION.replace(", moduli=INSTANTANEOUS", "")
    assert "give SHRINF=, or MODULI=INSTANTANEOUS" in problem(tmp_path, text)
    card = read(tmp_path, text.replace("Test Data\n", "Test Data, shrinf=0.25\n"))
    assert card.material.law.relaxation(0.0) == close_to(4.8e9, rel=1e-15)
    assert any("SHRINF is not used beyond" in note for note in card.notes)
    creep = text.replace("RELAXATION", "CREEP").replace("0.75,", "1.5,").replace("0.5,", "2,")
    found = read(tmp_path, creep.replace("Test Data\n", "Test Data, shrinf=4\n")).material
    assert found.law.relaxation(0.0) == close_to(4.8e9, rel=1e-12)  # j_S = 1/g_R
    ended = read(tmp_path, text.replace("Test Data\n", "Test Data, shrinf=0.5\n"))
    assert ended.material.law.beyond == "last"


def test_combined_test_data_that_agree_are_a_constant_poissons_ratio(tmp_path: Path) -> None:
    text = RELAXATION.replace("*Shear", "*Combined").replace("0.75, 1.", "0.75, 0.75, 1.")
    text = text.replace("0.5, 10.", "0.5, 0.5, 10.")
    assert read(tmp_path, text).material.poisson_ratio == 0.25
    other = text.replace("0.5, 0.5,", "0.5, 0.6,")
    assert "the bulk modulus relaxes otherwise" in problem(tmp_path, other)
    volumetric = RELAXATION + "*Volumetric Test Data\n0.75, 1.\n0.5, 10.\n"
    assert read(tmp_path, volumetric).material.poisson_ratio == 0.25
