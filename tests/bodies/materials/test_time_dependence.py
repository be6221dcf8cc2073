"""No keyword of a card that states a dependence on time or rate is left out in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

import viscontact as vc
from returned import some
from viscontact.bodies.materials.cards import read_card, time_dependence
from viscontact.bodies.materials.cards.abaqus_keywords import BEYOND, NOTED

ABAQUS = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2e5, 0.3\n"
ANSYS = "MP,EX,1,2e5\nMP,PRXY,1,0.3\n"
DYNA = "*MAT_ELASTIC\n7, 7.8e-9, 2e5, 0.3\n"
STEEL = vc.Material(vc.Elastic(2e11 / 2.6), 0.3)


def refused(folder: Path, text: str) -> str:
    path = folder / "card.txt"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=r".") as caught:
        read_card(path, modulus_unit="MPa", time_unit="s", temperature_unit="K")
    return str(caught.value)


def card(folder: Path, text: str) -> vc.Card:
    path = folder / "card.txt"
    path.write_text(text, encoding="utf-8")
    return read_card(path, modulus_unit="MPa", time_unit="s", temperature_unit="K")


@pytest.mark.parametrize("keyword", sorted(time_dependence.ABAQUS))
def test_abaqus_material_with_it_is_refused_at_its_line(keyword: str, tmp_path: Path) -> None:
    for written in (keyword, keyword.lower(), keyword.replace(" ", ""), f" {keyword.title()}"):
        for options in ("", ", LAW=TIME"):
            said = refused(tmp_path, f"{ABAQUS}*{written}{options}\n1., 2., 3.\n")
            assert said.startswith(f"card.txt:4: *{keyword} is not read: it defines ")
            assert "Prony series" in said


ABBREVIATED = [
    (keyword[:letters], keyword)
    for keyword in sorted({*time_dependence.ABAQUS, "VISCOELASTIC", "ELASTIC"})
    for letters in range(2, len(keyword) + 1, 2)
    if keyword[:letters].strip() not in (*NOTED, *BEYOND)
]


def test_no_abbreviated_keyword_of_time_is_left_out(tmp_path: Path) -> None:
    # Input syntax rules: enough characters to distinguish a keyword from the others.
    for short, keyword in some(ABBREVIATED):
        said = refused(tmp_path, f"{ABAQUS}*{short}, TIME=CREEP TEST DATA\n")
        assert said.startswith("card.txt:4: *"), (short, keyword)
    assert "*VISC may stand for " in refused(tmp_path, ABAQUS + "*visc, time=PRONY\n.3, 0., 1.\n")
    series = card(tmp_path, ABAQUS + "*viscoe, time=PRONY\n.3, 0., 1.\n").material.law
    assert isinstance(series, vc.RelaxationSeries)


@pytest.mark.parametrize("label", sorted(time_dependence.ANSYS_TABLES))
def test_ansys_material_with_the_table_is_refused_at_its_line(label: str, tmp_path: Path) -> None:
    for written in (label, label.lower(), label + "XYZ" * (len(label) == 4)):
        said = refused(tmp_path, f"{ANSYS}tb,{written},1,1,2,EVH\ntbdata,1,0.3,10\n")
        assert said.startswith(f"card.txt:3: TB,{written.upper()} is not read: it defines ")
    # Another material of the file is read.
    two = tmp_path / "two.mac"
    two.write_text(f"{ANSYS}MP,EX,2,1\nMP,PRXY,2,.3\nTB,{label},2\nTBDATA,1,1\n", encoding="utf-8")
    found = read_card(two, modulus_unit="MPa", time_unit="s", name="1")
    assert found.material == STEEL


def test_ansys_options_and_properties_of_time_are_refused(tmp_path: Path) -> None:
    for label, options in some(time_dependence.ANSYS_OPTIONS.items()):
        for option in some(options):
            said = refused(tmp_path, f"{ANSYS}TB,{label},1,,,{option}\n")
            assert said.startswith(f"card.txt:3: TB,{label},,,,{option} is not read")
    for label in some(time_dependence.ANSYS_PROPERTIES):
        for command in (f"MP,{label},1,3", f"mpdata,{label.lower()},1,1,3"):
            assert f"card.txt:3: MP{'DATA' * ('data' in command)},{label} is not read" in refused(
                tmp_path, f"{ANSYS}{command}\n"
            )


@pytest.mark.parametrize("word", time_dependence.LS_DYNA_ADDED)
def test_ls_dyna_addition_of_it_is_refused_for_its_material_only(word: str, tmp_path: Path) -> None:
    added = f"*MAT_ADD_{word}_TITLE\nadded\n         7\n"
    assert f"card.txt:3: *MAT_ADD_{word} is not read" in refused(tmp_path, DYNA + added)
    other = added.replace("         7", "         8")
    assert card(tmp_path, DYNA + other).material == STEEL


@pytest.mark.parametrize("line", ["*VISCO PLASTIC", "*CREEPX", "*MY RELAXATION", "*RATEX"])
def test_unknown_keyword_that_names_time_is_refused(line: str, tmp_path: Path) -> None:
    assert refused(tmp_path, f"{ABAQUS}{line}\n1.\n").startswith(f"card.txt:4: {line} is not read")


def test_rate_of_plasticity_and_other_files_are_refused(tmp_path: Path) -> None:
    assert "*PLASTIC, RATE is not read" in refused(
        tmp_path, ABAQUS + "*PLASTIC, RATE=10.\n1., 0.\n"
    )
    said = refused(tmp_path, ABAQUS + "*INCLUDE, INPUT=more.inp\n")
    assert "card.txt:4: *INCLUDE is not followed" in said
    assert "needs *VISCOELASTIC" in refused(tmp_path, ABAQUS + "*TRS\n20., 17.4, 51.6\n")
    noted = card(tmp_path, ANSYS + "/INPUT,more,mac\n")
    assert noted.notes == ("card.txt:3: the file that /INP names is not read with this one",)


def test_keyword_of_time_outside_of_the_materials_is_no_part_of_them(tmp_path: Path) -> None:
    gasket = "*GASKET BEHAVIOR, NAME=G\n*CREEP\n1., 2.\n"
    step = "*STEP\n*VISCO\n*CREEP STRAIN RATE CONTROL\n1.\n"
    found = card(tmp_path, gasket + ABAQUS + "*SOLID SECTION\n1.,\n" + step)
    assert found.material == STEEL
    assert found.notes == ()
    # A card alone has no *MATERIAL to end.
    alone = ABAQUS.partition("\n")[2]
    for text in (f"*CREEP\n1., 2.\n{alone}", f"{alone}*CREEP\n1., 2.\n"):
        assert "*CREEP is not read" in refused(tmp_path, text)


def test_elastic_card_without_such_data_is_read(tmp_path: Path) -> None:
    plastic = "*PLASTIC\n200., 0.\n*DAMPING, ALPHA=1.\n*DENSITY\n7.8e-9,\n*EXPANSION\n1e-5\n"
    found = card(tmp_path, ABAQUS + plastic)
    assert found.material == STEEL
    assert len(found.notes) == 4
    found = card(tmp_path, ANSYS + "TB,BISO,1\nTBDATA,1,200,1e3\nMP,DENS,1,7.8e-9\nMP,BETD,1,1\n")
    assert found.material == STEEL
    assert len(found.notes) == 3
    for keyword in some(NOTED):
        assert card(tmp_path, f"{ABAQUS}*{keyword}\n1.\n").material == STEEL
