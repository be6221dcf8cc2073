"""Cards of Abaqus and Ansys: read as their manuals say, and written so that they read back."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscontact as vc
from closeness import close_to
from random_examples import given_few_or_many
from returned import some
from viscontact.bodies.materials.cards import (
    Card,
    read_abaqus,
    read_ansys,
    read_card,
    read_cards,
    read_ls_dyna,
    write_abaqus,
    write_ansys,
)
from viscontact.laws import TabulatedShift

IN_SI = {"modulus_unit": "Pa", "time_unit": "s"}
IN_MPA = {"modulus_unit": "MPa", "time_unit": "s"}

# E = 3000 and nu = 0.25 make G = 1200 and K = 2000; half of G relaxes.
ABAQUS = """\
*Heading
 a model
** a comment
*Material, name="PMMA 25"
*Density
 1.19e-9,
*elastic, moduli=INSTANTANEOUS
 3000., 0.25
*Viscoelastic, time=PRONY
 0.3, 0., 10.
** between the terms
 0.2, , 1.D2
*Step
*Static
"""
ANSYS = """\
/PREP7
! half of G relaxes
MP,EX,1,3000
mp,prxy,1,0.25   ! instantaneous
MP,DENS,1,1.19e-9
TB,PRONY,1,1,2,SHEAR
TBDATA,1,0.3,10
TBDATA,,0.2,100
"""


def read(folder: Path, text: str, reader: Callable[..., Any] = read_card, **options: Any) -> Any:
    path = folder / "card.txt"
    path.write_text(text, encoding="utf-8")
    return reader(path, **{**IN_MPA, **options})


def problem(folder: Path, text: str, **options: Any) -> str:
    with pytest.raises(ValueError, match=r".") as refusal:
        read(folder, text, read_cards, **options)
    assert "\n" not in str(refusal.value)
    return str(refusal.value)


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


RELAXATION = """\
*Material, name=T
*Elastic, moduli=INSTANTANEOUS
 3000., 0.25
*Viscoelastic, time=RELAXATION TEST DATA, nmax=3
*Shear Test Data
 0.75, 1.
 0.5, 10.
"""


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


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("0.3, 0.,", "0.3, 0.1,", "card.txt:8: the bulk modulus relaxes otherwise than the shear"),
        ("0.3, 0.,", "0.9, 0.,", "card.txt:9: shear terms g: the terms add up to 1.1: more than a"),
        ("0.3, 0.,", "300., 0.,", "term 1 must be a part of the modulus between 0 and 1, got 300."),
        ("0.3, 0.,", "-0.3, 0.,", "must be a part of the modulus between 0 and 1, got -0.3"),
        ("1.D2", "0.", "the relaxation time of term 2 must be positive, got 0.0"),
        ("1.D2", "tau", "card.txt:12: 'tau' is not a number"),
        ("1.D2", "1e999", "card.txt:12: '1e999' is beyond all numbers"),
        ("0.2, , 1.D2", "0.2, 0.2", "card.txt:12: must have 3 numbers, got 2"),
        ("0.2, , 1.D2", "0.7, , 1.D2", None),
        ("time=PRONY", "time=FREQUENCY DATA", "card.txt:10: must have 5 numbers, got 3"),
        ("time=PRONY", "frequency=TABULAR", "FREQUENCY needs long-term moduli, and *ELASTIC has"),
        ("time=PRONY", "time=FREQUENCY DATA, preload=UNIAXIAL", "PRELOAD is not read"),
        ("time=PRONY", "nonlinear", "*VISCOELASTIC, NONLINEAR is not read"),
        ("time=PRONY", "time=PRUNY", "TIME=PRUNY: must be one of PRONY, CREEP TEST DATA"),
        (", time=PRONY", "", "must say TIME=PRONY"),
        ("moduli=INSTANTANEOUS", "moduli=SHORT", "MODULI=SHORT: must be one of LONG TERM, INSTA"),
        ("moduli=INSTANTANEOUS", "type=ORTHO", "TYPE=ORTHO: must be one of ISOTROPIC"),
        ("3000., 0.25", "3000., 0.6", "card.txt:8: Poisson's ratio must lie above -1 and"),
        ("3000., 0.25", "0., 0.2", "card.txt:8: Young's modulus must be positive"),
        ("3000., 0.25", "3000., 0.2, 0.\n2000., 0.2, 50.", "must have one line of E and nu, got 2"),
        ("*Density", "*Elastic\n1, .2\n*Density", "card.txt:9: *ELASTIC occurs twice"),
        ("*elastic, moduli=INSTANTANEOUS\n 3000., 0.25\n", "", "has no *ELASTIC; give E and nu"),
        ("*Step", "*Trs, definition=USER\n*Step", "*TRS, DEFINITION=USER is not read"),
    ],
)  # fmt: skip
def test_abaqus_card_that_cannot_be_read_is_refused_at_its_line(
    old: str, new: str, said: str | None, tmp_path: Path
) -> None:
    assert old in ABAQUS
    text = ABAQUS.replace(old, new, 1)
    if said is None:  # all of the modulus relaxes: a fluid, if the constants are of the instant
        assert read(tmp_path, text).material.law.equilibrium == 0.0
        text = text.replace(", moduli=INSTANTANEOUS", "")
        said = "leave nothing in the long term"
    assert said in problem(tmp_path, text, temperature_unit="K")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("TBDATA,,0.2,100", "TBDATA,,0.2", "TB,PRONY,,,,SHEAR: must have 2 pairs in TBDATA, got 3"),
        ("TBDATA,,0.2,100", "TBDATA,,0.8,100", "the terms add up to 1.1"),
        ("TBDATA,,0.2,100", "TBDATA,,400,100", "cards take relative moduli (G_i/G_0)"),
        ("TBDATA,,0.2,100", "TBDATA,0,0.2,100", "TBDATA begins at a place from 1"),
        ("TBDATA,,0.2,100", "TBDATA,1e99,0.2,100", "TBDATA begins at a place from 1"),
        ("TBDATA,,0.2,100", "TBTEMP,0\nTBTEMP,20\nTBDATA,,0.2,100", "several temperatures"),
        ("SHEAR", "EXPERIMENTAL", "TB,PRONY with the option 'EXPERIMENTAL' is not read"),
        ("SHEAR", "", "TB,PRONY with the option '' is not read; give SHEAR or BULK"),
        ("mp,prxy,1,0.25", "", "material 1 has no MP,PRXY"),
        ("MP,EX,1,3000", "", "material 1 has no MP,EX"),
        ("MP,EX,1,3000", "MP,EX,1,E0", "card.txt:3: 'E0' is not a number"),
        ("MP,EX,1,3000", "MP,EX,1,3000,-2", "MP,EX depends on temperature"),
        ("MP,EX,1,3000", "MP,EX,1,3000\nMP,NUXY,1,.3", "PRXY and NUXY of an isotropic material"),
        ("MP,EX,1,3000", "MPTEMP,1,0,9\nMPDATA,EX,1,1,3,2", "MPDATA,EX depends on temperature"),
        ("MP,EX,1,3000", "MPDATA,EX,1,1,3\nMPDATA,EX,1,2,2", "MPDATA,EX depends on temperature"),
        ("MP,EX,1,3000", "MPDATA,EX,1", "MPDATA,EX has no value; give a constant with MP,EX"),
        ("MP,EX,1,3000", "MP,EX,1,3000\nTBCOPY,ALL,2,1", "TBCOPY is not read"),
        ("TBDATA,1,0.3", "TBFIELD,FREQ,1\nTBDATA,1,0.3", "TBFIELD,FREQ is not read"),
        ("TBDATA,1,0.3", "TBPT,DEFI,1,2\nTBDATA,1,0.3", "points (TBPT) are not read"),
        ("TBDATA,1,0.3,10\nTBDATA,,0.2,100\n", "", "TB,PRONY,,,,SHEAR: has no TBDATA"),
        ("TB,PRONY", "TBDELE,ALL,1\nTB,PRONY", None),
        ("TBDATA,,0.2,100\n", "TBDATA,,0.2,100\nTB,SHIFT,1,,,WLF\nTBDELE,PRON,1\n", "needs TB,PR"),
        ("MP,EX,1,3000", "MP,EX,1.5,3000", "a material's number is whole and positive"),
        ("TB,PRONY", "TB,SHIFT,1,,,USER\nTB,PRONY", "TB,SHIFT with 'USER' is not read"),
        ("TB,PRONY", "TB,SHIFT,1,,,WLF\nTBDATA,1,1,2,3,4\nTB,PRONY", "has more than 3 values"),
        ("TB,PRONY", "TB,PRONY,1,,2,SHEAR\nTBDATA,1,1\nTB,PRONY", "occurs twice"),
        ("TB,PRONY", "TB,ELASTIC,1,,,ORTE\nTB,PRONY", "TB,ELASTIC must be ISOT"),
    ],
)  # fmt: skip
def test_ansys_card_that_cannot_be_read_is_refused_at_its_line(
    old: str, new: str, said: str | None, tmp_path: Path
) -> None:
    assert old in ANSYS
    if said is None:
        assert read(tmp_path, ANSYS.replace(old, new, 1)) == read(tmp_path, ANSYS)
        return
    assert said in problem(tmp_path, ANSYS.replace(old, new, 1), temperature_unit="K")


def test_file_of_neither_program_is_refused(tmp_path: Path) -> None:
    assert "is no card of a program that is read" in problem(tmp_path, "time [s], E [MPa]\n1, 2\n")
    both = problem(tmp_path, ABAQUS + ANSYS)
    assert "has commands of Abaqus (*ELASTIC, *VISCOELASTIC) and of Ansys (MP,EX and TB" in both
    for reader in (read_abaqus, read_ansys):
        with pytest.raises(ValueError, match="is it an"):
            read(tmp_path, "", reader)
        with pytest.raises(ValueError, match="cannot read 'm' as a pressure"):
            read(tmp_path, ABAQUS, reader, modulus_unit="m")


# --- written, and read back ---------------------------------------------------------------------

Writer = Callable[..., str]
WRITERS = pytest.mark.parametrize(
    ("write", "reader"), [(write_abaqus, read_abaqus), (write_ansys, read_ansys)]
)


def back(folder: Path, card: Card, write: Writer, reader: Callable[..., Any], **units: Any) -> Card:
    path = folder / "back.txt"
    path.write_text(write(card, **units), encoding="ascii")
    units.pop("moduli", None)
    [found] = reader(path, **units)
    assert isinstance(found, Card)
    return found


@WRITERS
@pytest.mark.parametrize("volume", [{"poisson_ratio": 0.38}, {"bulk_modulus": 4e9}])
@pytest.mark.parametrize(
    "law",
    [
        vc.Elastic(1e9),
        vc.Maxwell(1e9, 1e10),
        vc.Zener(1e9, 2e9, 1e10),
        vc.Burgers(1e9, 1e12, 2e9, 1e10),
        vc.CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.87]),
        vc.RelaxationSeries(1e6, [1e9, 2e8, 3e7, 4e6], [1e-3, 0.1, 10.0, 1e4]),
    ],
)
def test_series_law_is_the_same_after_a_card(
    law: vc.Law, volume: dict[str, float], write: Writer, reader: Any, tmp_path: Path
) -> None:
    card = Card("A-1", vc.Material(law, **volume))
    found = back(tmp_path, card, write, reader, modulus_unit="MPa", time_unit="min")
    t = np.geomspace(1e-4, 1e5, 40)
    # 13 digits or more are printed; what is left in the end is 1e-3 of the modulus at once.
    np.testing.assert_allclose(found.material.law.relaxation(t), law.relaxation(t), rtol=1e-9)
    np.testing.assert_allclose(found.material.law(t), law(t), rtol=1e-9)
    if isinstance(law, vc.Elastic):
        return  # its bulk modulus is its Poisson's ratio
    for name, value in volume.items():
        assert getattr(found.material, name) == close_to(value, rel=1e-12)
    j, k = (m.contact_compliance()(t) for m in (found.material, card.material))
    np.testing.assert_allclose(j, k, rtol=1e-9)


@settings(max_examples=100, deadline=None)
@given(
    st.lists(st.tuples(st.floats(1e-3, 1e3), st.floats(1e-12, 1e12)), min_size=1, max_size=20),
    st.floats(1e-2, 1e3),
    st.floats(-0.9, 0.49),
    st.booleans(),
    st.sampled_from([(write_abaqus, read_abaqus), (write_ansys, read_ansys)]),
    st.sampled_from(["instantaneous", "long term"]),
)
def test_any_series_is_read_back_to_its_printed_digits(
    tmp_path_factory: pytest.TempPathFactory,
    terms: list[tuple[float, float]],
    equilibrium: float,
    ratio: float,
    elastic_bulk: bool,
    programs: tuple[Writer, Any],
    moduli: str,
) -> None:
    strengths, times = zip(*terms, strict=True)
    law = vc.RelaxationSeries(equilibrium, strengths, times)
    at_once = law.relaxation(0.0)
    bulk = 2 * at_once * (1 + ratio) / (3 * (1 - 2 * ratio))
    volume = {"bulk_modulus": bulk} if elastic_bulk else {"poisson_ratio": ratio}
    card = Card("x", vc.Material(law, **volume))
    options = {**IN_SI, "moduli": moduli} if programs[0] is write_abaqus else IN_SI
    found = back(tmp_path_factory.getbasetemp(), card, *programs, **options).material
    assert isinstance(found.law, vc.RelaxationSeries)
    # 13 digits of each weight, of which the end is what they leave of 1.
    loss = 20 * 1e-13 * (at_once / equilibrium)
    assert found.law.equilibrium == close_to(equilibrium, rel=loss)
    np.testing.assert_allclose(found.law.moduli, strengths, rtol=loss)
    np.testing.assert_allclose(found.law.times, times, rtol=1e-12)
    if elastic_bulk:
        # E and nu hold K by 1 - 2 nu only; long-term ones are nearer to 1/2.
        bound = loss + 1e-12 * (bulk / equilibrium + 1)
        assert found.bulk_modulus == close_to(bulk, rel=bound)
    else:
        assert found.poisson_ratio == close_to(ratio, rel=1e-12)


@WRITERS
def test_shift_is_the_same_after_a_card(write: Writer, reader: Any, tmp_path: Path) -> None:
    material = vc.Material(vc.Zener(1e9, 2e9, 1e10), 0.3)
    card = Card("1", material, vc.WLF(298.15, 17.44, 51.6))
    found = back(tmp_path, card, write, reader, **IN_MPA, temperature_unit="degC")
    assert found.shift == card.shift
    with pytest.raises(ValueError, match="give temperature_unit"):
        write(card, **IN_MPA)
    table = Card("1", material, TabulatedShift([280.0, 300.0], [10.0, 1.0]))
    with pytest.raises(ValueError, match="got TabulatedShift; fit one"):
        write(table, **IN_MPA, temperature_unit="K")


@WRITERS
@pytest.mark.parametrize("unit", ["K", "degF"])
def test_arrhenius_shift_is_the_same_after_a_card(
    write: Writer, reader: Any, unit: str, tmp_path: Path
) -> None:
    card = Card("1", vc.Material(vc.Zener(1e9, 2e9, 1e10), 0.3), vc.Arrhenius(293.15, 8e4))
    if write is write_ansys and unit != "K":
        with pytest.raises(ValueError, match="absolute temperatures"):
            write(card, **IN_MPA, temperature_unit=unit)
        return
    found = back(tmp_path, card, write, reader, **IN_MPA, temperature_unit=unit)
    assert isinstance(found.shift, vc.Arrhenius)
    assert found.shift.activation_energy == close_to(8e4, rel=1e-14)
    assert found.shift.reference_temperature == close_to(293.15, rel=1e-14)
    assert found.notes == ()


@pytest.mark.parametrize("volume", [{"poisson_ratio": 0.5}, {"poisson_ratio": 0.3}])
@pytest.mark.parametrize(
    "law",
    [
        vc.TabulatedCreep([0.0, 1.0, 10.0], [1e-9, 2e-9, 2.5e-9]),
        vc.TabulatedCreep([0.0, 1.0, 10.0], [1e-9, 2e-9, 2.5e-9], beyond="last"),
        vc.TabulatedRelaxation([0.0, 1.0, 10.0], [3e9, 2e9, 1e9]),
        vc.TabulatedRelaxation([0.5, 1.0, 10.0], [3e9, 2e9, 1e9], beyond="last"),
    ],
)
def test_table_is_written_as_test_data_and_read_back(
    law: vc.Law, volume: dict[str, float], tmp_path: Path
) -> None:
    card = Card("T", vc.Material(law, **volume))
    found = back(tmp_path, card, write_abaqus, read_abaqus, **IN_MPA).material
    t = np.array([0.0, 0.3, 0.5, 1.0, 5.0, 10.0, 50.0])
    assert type(found.law) is type(law)
    assert found.poisson_ratio == volume["poisson_ratio"]
    # A table is the same to the digits, and what is interconverted from creep. Creep by relaxation
    # has the error it tells, some 1e-5, which depends on where the table begins.
    inverted = 2 * (law.inversion_error + found.law.inversion_error)
    creep = isinstance(law, vc.TabulatedCreep)
    np.testing.assert_allclose(found.law(t), law(t), rtol=1e-9 if creep else inverted)
    np.testing.assert_allclose(found.law.relaxation(t), law.relaxation(t), rtol=1e-9)


def test_what_is_no_series_is_refused_with_a_remedy() -> None:
    fractional = Card("F", vc.Material(vc.FractionalZener(3e6, 1e6, 2.0, 0.5), 0.5))
    table = Card("T", vc.Material(vc.TabulatedCreep([1.0, 2.0], [1e-9, 2e-9]), 0.5))
    for write, card in (
        (write_abaqus, fractional),
        (write_ansys, fractional),
        (write_ansys, table),
    ):
        with pytest.raises(ValueError, match=r"takes a Prony series.* fit one first"):
            write(card, **IN_MPA)
    sloped = vc.TabulatedCreep([1.0, 2.0], [1e-9, 2e-9], before="slope")
    with pytest.raises(ValueError, match="needs the instantaneous modulus"):
        write_abaqus(Card("T", vc.Material(sloped, 0.5)), **IN_MPA)
    with pytest.raises(ValueError, match="instant"):  # a Kelvin body has no modulus at once
        write_ansys(Card("K", vc.Material(vc.CreepSeries(0.0, [1e-9], [1.0]), 0.5)), **IN_MPA)
    fluid = Card("M", vc.Material(vc.Maxwell(1e9, 1e9), 0.5))
    with pytest.raises(ValueError, match="a fluid has no long-term moduli"):
        write_abaqus(fluid, **IN_MPA, moduli="long term")
    with pytest.raises(ValueError, match="moduli: must be"):
        write_abaqus(fluid, **IN_MPA, moduli="short")
    with pytest.raises(ValueError, match="1 to 80 plain characters"):
        write_abaqus(Card("x\n*STEP", fluid.material), **IN_MPA)
    with pytest.raises(ValueError, match="number must be a whole number >= 1"):
        write_ansys(fluid, **IN_MPA, number=0)


def test_fields_of_abaqus_are_no_wider_than_it_reads() -> None:
    law = vc.RelaxationSeries(1 / 3e-7, [1e9 / 7, 2e-5 / 9], [1 / 3e-9, 1e17 / 7])
    text = write_abaqus(Card("odd name", vc.Material(law, 1 / 3)), **IN_MPA)
    assert '*MATERIAL, NAME="odd name"\n' in text
    data = [line for line in text.splitlines() if not line.startswith("*")]
    assert max(len(field) for line in data for field in line.split(", ")) <= 20
    assert text.isascii()


PIECES = st.sampled_from(
    ["*Material, name=A\n", "*Elastic\n", "*Viscoelastic, time=PRONY\n", "3., 0.3\n", "0.5,0.,1.\n",
     "*Trs\n", "*Shear Test Data, shrinf=.5\n", "time=RELAXATION TEST DATA", ",", "\n", "1e400",
     '"', "MP,EX,1,3\n", "MP,PRXY,1,.3\n", "TB,PRONY,1,1,1,SHEAR\n", "TBDATA,1,.5,1\n", "TBDATA,",
     "*MAT_006\n", "*mat_76_TITLE\n", "1,,2.,3.,1.,.5\n", "3.         2.\n", "*PARAMETER\nRa,1\n",
     "MPDATA,R5.0,1,EX,1,1,3\n", "TBDELE,ALL,ALL\n", "*Viscoel, freq=TABULAR\n", "&a", "*Creep\n",
     "$", "TB,SHIFT,1,,,WLF\n", "=", "*", "!", "-1", "TBTEMP,", "x", "0.5, 1.\n", "*Step\n"]
)  # fmt: skip
CARDS = (
    [
        "*Material, name=A\n",
        "*Elastic\n",
        "3., 0.3\n",
        "*Viscoelastic, time=PRONY\n",
        "0.5,0.,1.\n",
    ],
    ["MP,EX,1,3\n", "MP,PRXY,1,.3\n", "TB,PRONY,1,1,1,SHEAR\n", "TBDATA,1,.5,1\n"],
    ["*MAT_076\n", "1,,3.\n", "\n", "2.,1.\n", "1.,0.\n"],
)


def _damaged(card: list[str], at: int, piece: str) -> str:
    return "".join([*card[:at], piece, *card[at:]])


#: Cards with a piece put in somewhere: by chance alone none of a hundred files is a card.
DAMAGED = st.builds(_damaged, st.sampled_from(CARDS), st.integers(0, 5), PIECES)


@given_few_or_many(
    25, 300, st.lists(PIECES, max_size=14).map("".join) | DAMAGED | st.text(max_size=30)
)
def test_any_file_is_a_card_or_a_value_error(
    tmp_path_factory: pytest.TempPathFactory, text: str
) -> None:
    path = tmp_path_factory.getbasetemp() / "any.txt"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    for reader in (read_abaqus, read_ansys, read_ls_dyna, read_cards):
        with suppress(ValueError):
            for card in some(reader(path, **IN_SI, temperature_unit="K")):
                assert np.isfinite(card.material.law(1.0))
